#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "compare/study/check_output.hpp"

namespace surge::compare {

/// The largest values that runs may have of what metrics() measures against the reference, by the
/// name of a run; "" for all others. Empty maps limit nothing.
struct Limits {
  std::map<std::string, double> rms;      ///< of Z/L
  std::map<std::string, double> maximum;  ///< of |Z/L|
  std::map<std::string, double> bias;     ///< of Z/L, of its magnitude
  std::map<std::string, double> arrival;  ///< of T, at the level where it is largest

  [[nodiscard]] bool any() const;
};

/// Each run's limited numbers, a report per run but the reference. A run that a limit should hold
/// for and that has no finite number has failed. Throws surge::Error for a name that no run has,
/// and where there is no run to be held against anything.
[[nodiscard]] std::vector<CheckReport> check_limits(const nlohmann::json& metrics,
                                                    const Limits& limits);

}  // namespace surge::compare
