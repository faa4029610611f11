#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace surge::compare {

/// y = factor x^exponent by least squares of log y over log x.
struct PowerFit {
  double exponent = 0.0;
  double half_width = 0.0;  ///< of the 95 % confidence interval of the exponent (Student's t)
  double factor = 0.0;
  std::size_t points = 0;
};

/// Empty for fewer than three points, which leave no error to estimate, or for equal x. Throws
/// surge::Error for values that are not positive.
[[nodiscard]] std::optional<PowerFit> fit_power(const std::vector<std::pair<double, double>>& xy);

/// Middle value; the mean of the two middle ones of an even number. Throws surge::Error for none.
[[nodiscard]] double median_of(std::vector<double> values);

}  // namespace surge::compare
