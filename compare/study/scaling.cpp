#include "compare/study/scaling.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

/// 97.5 % quantile of Student's t for 1, 2, ... degrees of freedom; beyond the table its last
/// value, which makes the interval slightly too wide.
double t_quantile(std::size_t freedom) {
  static constexpr std::array<double, 15> table{12.706, 4.303, 3.182, 2.776, 2.571,
                                                2.447,  2.365, 2.306, 2.262, 2.228,
                                                2.201,  2.179, 2.160, 2.145, 2.131};
  return table[std::min(freedom, table.size()) - 1];
}

}  // namespace

std::optional<PowerFit> fit_power(const std::vector<std::pair<double, double>>& xy) {
  const auto n = static_cast<double>(xy.size());
  double mean_x = 0.0, mean_y = 0.0;
  for (const auto& [x, y] : xy) {
    if (!(x > 0.0) || !(y > 0.0)) throw Error("power law: found a value that is not positive");
    mean_x += std::log(x) / n;
    mean_y += std::log(y) / n;
  }
  double xx = 0.0, cross = 0.0, yy = 0.0;
  for (const auto& [x, y] : xy) {
    const double a = std::log(x) - mean_x, b = std::log(y) - mean_y;
    xx += a * a;
    cross += a * b;
    yy += b * b;
  }
  if (xy.size() < 3 || xx <= 1e-12) return std::nullopt;
  PowerFit fit;
  fit.points = xy.size();
  fit.exponent = cross / xx;
  fit.factor = std::exp(mean_y - fit.exponent * mean_x);
  const double residual = std::max(0.0, yy - fit.exponent * cross);
  fit.half_width = t_quantile(xy.size() - 2) * std::sqrt(residual / (n - 2.0) / xx);
  return fit;
}

double median_of(std::vector<double> values) {
  if (values.empty()) throw Error("median: found no value");
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

}  // namespace surge::compare
