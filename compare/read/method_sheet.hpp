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
  };
  std::string method;
  int dimension = 2;
  double spacing = 0.0;          ///< l0, m
  std::optional<double> length;  ///< h of SPH, m
  std::vector<Function> functions;
  std::string start, until, step;  ///< functions that surround the stages
  std::vector<Stage> stages;

  /// The function of that name; throws Error where there is none.
  [[nodiscard]] const Function& function(const std::string& wanted) const;
};

/// Empty where the run's folder has no such file: other programs write none. Throws Error where it
/// cannot be understood.
[[nodiscard]] std::optional<MethodSheet> read_method_sheet(const Run& run);

}  // namespace surge::compare
