#include "particle/linear/closed_regions.hpp"

#include <algorithm>
#include <atomic>
#include <limits>

#include "particle/core/parallel_for.hpp"

namespace surge::linear {

namespace {

/// Flags that threads read while others set them: a flag is only ever set, and the sweeps go on
/// until nothing changes, so that it does not matter when it is seen.
using Flag = std::atomic_ref<char>;

bool has_open_neighbour(const PoissonSystem& system, AlignedVector<char>& open, std::size_t i) {
  for (auto k = system.row_start[i]; k < system.row_start[i + 1]; ++k) {
    const auto j = static_cast<std::size_t>(system.column[static_cast<std::size_t>(k)]);
    if (Flag(open[j]).load(std::memory_order_relaxed) != 0) return true;
  }
  return false;
}

struct Sweep {
  std::int32_t found = 0;  ///< rows that were reached
  std::int32_t left = 0;   ///< rows that were not
};

/// Every thread goes through a stretch of its own, upwards or downwards.
Sweep sweep(const PoissonSystem& system, AlignedVector<char>& open, bool upwards) {
  const auto n = static_cast<std::int32_t>(system.size());
  const auto visit = [&](std::int32_t k, Sweep& done) {
    const auto i = static_cast<std::size_t>(upwards ? k : n - 1 - k);
    if (Flag(open[i]).load(std::memory_order_relaxed) != 0) return;
    if (has_open_neighbour(system, open, i)) {
      Flag(open[i]).store(1, std::memory_order_relaxed);
      ++done.found;
    } else {
      ++done.left;
    }
  };
  return parallel_reduce(n, worth_sharing, Sweep{}, visit, [](Sweep& all, const Sweep& own) {
    all.found += own.found;
    all.left += own.left;
  });
}

}  // namespace

const std::vector<Region>& ClosedRegions::find(const PoissonSystem& system, const Field& excess) {
  const auto n = static_cast<std::int32_t>(system.size());
  regions_.clear();
  open_.resize(system.size());
  parallel_for(n, worth_sharing, [&](std::int32_t i) {
    open_[static_cast<std::size_t>(i)] = excess[static_cast<std::size_t>(i)] > 0.0 ? 1 : 0;
  });

  // In cell order one sweep down and one up reach nearly everything; then sweep until at rest.
  for (bool upwards = false;; upwards = !upwards) {
    const Sweep done = sweep(system, open_, upwards);
    if (done.left == 0) return regions_;
    if (done.found == 0) break;
  }

  for (std::int32_t seed = 0; seed < n; ++seed) {
    if (open_[static_cast<std::size_t>(seed)] != 0) continue;
    Region region{seed};
    open_[static_cast<std::size_t>(seed)] = 1;
    for (std::size_t next = 0; next < region.size(); ++next) {
      const auto i = static_cast<std::size_t>(region[next]);
      for (auto k = system.row_start[i]; k < system.row_start[i + 1]; ++k) {
        const std::int32_t j = system.column[static_cast<std::size_t>(k)];
        if (open_[static_cast<std::size_t>(j)] != 0) continue;
        open_[static_cast<std::size_t>(j)] = 1;
        region.push_back(j);
      }
    }
    std::sort(region.begin(), region.end());
    regions_.push_back(std::move(region));
  }
  return regions_;
}

void anchor(const std::vector<Region>& regions, PoissonSystem& system, Field& excess,
            Field& guess) {
  for (const Region& region : regions) {
    double mean = 0.0;
    for (const std::int32_t i : region) mean += system.rhs[static_cast<std::size_t>(i)];
    mean /= static_cast<double>(region.size());
    const auto first = static_cast<std::size_t>(region.front());
    const double base = guess[first];
    for (const std::int32_t i : region) {
      system.rhs[static_cast<std::size_t>(i)] -= mean;
      guess[static_cast<std::size_t>(i)] -= base;
    }
    // A particle without neighbours has no equation: p = 0.
    const double held = system.diagonal[first] > 0.0 ? system.diagonal[first] : 1.0;
    system.diagonal[first] += held;
    excess[first] += held;
  }
}

void lift(const std::vector<Region>& regions, Field& p) {
  for (const Region& region : regions) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const std::int32_t i : region) {
      lowest = std::min(lowest, p[static_cast<std::size_t>(i)]);
    }
    for (const std::int32_t i : region) p[static_cast<std::size_t>(i)] -= lowest;
  }
}

}  // namespace surge::linear
