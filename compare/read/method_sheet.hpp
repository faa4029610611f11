#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/read/run.hpp"

namespace surge::compare {

/// What a run of surge-particle says that it computed with, from its method.json.
struct MethodSheet {
  /// A weight function or kernel, sampled by the program from its own code.
  struct Function {
    std::string name;              ///< "w", "w_laplacian"; "W", "dW/dr"
    std::string unit;              ///< of the value
    double support = 0;            ///< m
    std::vector<double> r, value;  ///< m; of the same length, r increasing
  };
  /// A function that the step calls, in the order of the calls.
  struct Stage {
    std::string function, does, equations;
    std::string options;  ///< "a or b=c": called where option a is on, or b is c; empty: always
  };
  std::string method;
  int dimension = 2;
  double spacing = 0.0;          ///< l0, m
  std::optional<double> length;  ///< h of SPH, m
  std::vector<Function> functions;
  std::string start, until, step;  ///< functions that surround the stages
  std::vector<Stage> stages;

  /// The stages that are called with what a manifest's "case" says.
  [[nodiscard]] std::vector<Stage> stages_with(const nlohmann::json& stated) const;
  /// The function of that name; throws Error where there is none.
  [[nodiscard]] const Function& function(const std::string& wanted) const;
};

/// Whether one of the options that "a or b=c" names is on with what a manifest's "case" says of the
/// method, the fluid and the case itself: a is not zero, false, "none" or empty, or b has the value
/// c. True for no options, and where the manifest does not state one.
[[nodiscard]] bool is_any_on(const std::string& options, const nlohmann::json& stated);

/// Empty where the run's folder has no such file: other programs write none. Throws Error where it
/// cannot be understood.
[[nodiscard]] std::optional<MethodSheet> read_method_sheet(const Run& run);

}  // namespace surge::compare
