#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include "particle/core/parallel_for.hpp"

namespace surge {

/// Least and largest of numbers. Of none: low > high.
struct Extremes {
  double low = std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::lowest();
  bool finite = true;  ///< all of them are; else low and high are of those that are numbers
};

/// Extremes of value(i), 0 <= i < n.
template <class Index, class F>
Extremes extremes_of(Index n, const F& value) {
  struct Own {
    double low = std::numeric_limits<double>::max();
    double high = std::numeric_limits<double>::lowest();
    double odd = 0.0;  // x - x of each: not zero where one is not finite
  };
  const auto look = [&](Index i, Own& own) {
    const double x = value(i);
    own.low = std::min(own.low, x);
    own.high = std::max(own.high, x);
    own.odd += x - x;
  };
  const auto join = [](Own& all, const Own& own) {
    all.low = std::min(all.low, own.low);
    all.high = std::max(all.high, own.high);
    all.odd += own.odd;
  };
  const Own all = parallel_reduce(n, worth_sharing, Own{}, look, join);
  return {all.low, all.high, all.odd == 0.0};
}

}  // namespace surge
