#include "compare/study/convergence.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "particle/support/error.hpp"

namespace surge::compare {

namespace {

/// Changes below this part of the values are rounding.
constexpr double order_rounding = 1e-12;
/// Where the search for an order ends; no scheme is near it.
constexpr double highest_order = 50.0;

std::string shown(double value) {
  std::ostringstream text;
  text.precision(2);
  text << std::fixed << value;
  return text.str();
}

void check(const std::array<Level, 3>& levels) {
  double before = 0.0;
  for (const Level& level : levels) {
    if (!(level.h > before) || !std::isfinite(level.h)) {
      throw Error("convergence: size " + std::to_string(level.h) + " found after " +
                  std::to_string(before) + ", a larger one expected");
    }
    if (!std::isfinite(level.value))
      throw Error("convergence: value " + std::to_string(level.value) + " found, finite expected");
    before = level.h;
  }
}

/// |eps32 / eps21| of a quantity whose error is C h^p, from Eqs. (3): r21^p (r32^p - s) / (r21^p -
/// s). Increases with p for both signs s.
double ratio_of_order(double p, double r21, double r32, double s) {
  const double numerator = s > 0.0 ? std::expm1(p * std::log(r32)) : std::pow(r32, p) + 1.0;
  const double denominator = s > 0.0 ? -std::expm1(-p * std::log(r21)) : 1.0 + std::pow(r21, -p);
  return numerator / denominator;
}

/// The order that Eqs. (3) define; Celik et al. solve them by a fixed-point iteration, which need
/// not converge where r32 is much larger than r21: halving an interval finds the same root always.
/// Without the outer modulus of Eq. (3a), which would give a diverging sequence an order: empty
/// where no positive order fits.
std::optional<double> observed_order(double eps21, double eps32, double r21, double r32) {
  const double s = eps32 / eps21 > 0.0 ? 1.0 : -1.0;
  const double wanted = std::abs(eps32 / eps21);
  double low = 1e-6, high = highest_order;
  if (wanted <= ratio_of_order(low, r21, r32, s)) return std::nullopt;
  if (wanted >= ratio_of_order(high, r21, r32, s)) return high;
  while (high - low > 1e-12 * high) {
    const double middle = 0.5 * (low + high);
    (ratio_of_order(middle, r21, r32, s) < wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double index_of(double eps, double ratio, double order) {
  return safety_factor * std::abs(eps) / std::expm1(order * std::log(ratio));
}

/// Whether a level between the three is farther from the curve through them than the index of the
/// finest one.
bool is_off_the_curve(const GridConvergence& result, const std::vector<Level>& others) {
  const Level& fine = result.levels.front();
  return std::any_of(others.begin(), others.end(), [&](const Level& level) {
    if (level.h >= result.levels.back().h) return false;
    const double predicted = *result.extrapolated + (fine.value - *result.extrapolated) *
                                                        std::pow(level.h / fine.h, *result.order);
    return std::abs(level.value - predicted) > *result.gci21;
  });
}

void add_doubts(GridConvergence& result, const std::vector<Level>& others) {
  const auto doubt = [&](const std::string& text) { result.doubts.push_back(text); };
  switch (result.approach) {
    case Approach::constant:
      doubt("two levels do not differ");
      return;
    case Approach::diverging:
      doubt("the changes do not shrink");
      return;
    case Approach::oscillating:
      doubt("the changes alternate in sign");
      break;
    case Approach::monotone:
      break;
  }
  const double p = *result.order;
  if (p < lowest_formal_order - order_margin)
    doubt("order " + shown(p) + " is below the formal ones");
  if (p > formal_order + order_margin) doubt("order " + shown(p) + " is above the formal ones");
  if (result.approach == Approach::monotone && is_off_the_curve(result, others))
    doubt("a level in between is off the curve by more than the index");
}

/// Largest change among the levels up to the second.
double spread(const GridConvergence& result, const std::vector<Level>& others) {
  double least = std::min(result.levels[0].value, result.levels[1].value);
  double most = std::max(result.levels[0].value, result.levels[1].value);
  for (const Level& level : others) {
    if (level.h > result.levels[1].h) continue;
    least = std::min(least, level.value);
    most = std::max(most, level.value);
  }
  return most - least;
}

}  // namespace

std::string approach_text(Approach approach) {
  switch (approach) {
    case Approach::constant:
      return "constant";
    case Approach::monotone:
      return "monotone";
    case Approach::oscillating:
      return "oscillating";
    case Approach::diverging:
      return "diverging";
  }
  return "unknown";
}

bool same_level(double h1, double h2) {
  return std::abs(h1 - h2) <= 0.01 * std::max(h1, h2);
}

std::optional<std::array<Level, 3>> systematic_levels(std::vector<Level> levels) {
  std::sort(levels.begin(), levels.end(), [](const Level& a, const Level& b) { return a.h < b.h; });
  std::array<Level, 3> chosen;
  std::size_t found = 0;
  for (const Level& level : levels) {
    if (found == chosen.size()) break;
    // Sizes are stated with some digits: 14.5 mm is 1.5 times 9.6666666666667 mm.
    if (found > 0 && level.h < (1.0 - 1e-6) * smallest_ratio * chosen[found - 1].h) continue;
    chosen[found++] = level;
  }
  if (found < chosen.size()) return std::nullopt;
  return chosen;
}

GridConvergence grid_convergence(const std::array<Level, 3>& levels,
                                 const std::vector<Level>& others) {
  check(levels);
  GridConvergence result;
  result.levels = levels;
  const auto& [fine, middle, coarse] = levels;
  result.r21 = middle.h / fine.h;
  result.r32 = coarse.h / middle.h;
  const double eps21 = middle.value - fine.value;
  const double eps32 = coarse.value - middle.value;
  const auto [least, most] = std::minmax({fine.value, middle.value, coarse.value});
  const double small = order_rounding * std::max(std::abs(least), std::abs(most));
  const double most_uncertain = 3.0 * (most - least);
  result.uncertainty = most_uncertain;
  if (std::abs(eps21) <= small || std::abs(eps32) <= small) {
    // Where only the finer two agree, the sequence has arrived; else it goes on after a standstill.
    result.approach = std::abs(eps21) <= small ? Approach::constant : Approach::diverging;
    add_doubts(result, others);
    return result;
  }
  result.order = observed_order(eps21, eps32, result.r21, result.r32);
  if (!result.order) {
    result.approach = Approach::diverging;
    add_doubts(result, others);
    return result;
  }
  result.approach = eps32 / eps21 > 0.0 ? Approach::monotone : Approach::oscillating;
  const double p = *result.order;
  result.extrapolated = fine.value - eps21 / std::expm1(p * std::log(result.r21));
  result.gci21 = index_of(eps21, result.r21, p);
  result.gci32 = index_of(eps32, result.r32, p);
  const double nearest = std::clamp(p, lowest_formal_order, formal_order);
  result.index_ratio = index_of(eps32, result.r32, nearest) /
                       (std::pow(result.r21, nearest) * index_of(eps21, result.r21, nearest));
  add_doubts(result, others);
  const double doubted =
      index_of(spread(result, others), result.r21, std::min(p, lowest_formal_order));
  result.uncertainty = std::min(result.asymptotic() ? *result.gci21 : doubted, most_uncertain);
  return result;
}

}  // namespace surge::compare
