#include "particle/mps/linear/closed_regions.hpp"

#include <algorithm>
#include <limits>

namespace surge::mps {

namespace {

bool has_open_neighbour(const PoissonSystem& system, const AlignedVector<char>& open,
                        std::size_t i) {
  for (auto k = system.row_start[i]; k < system.row_start[i + 1]; ++k) {
    if (open[static_cast<std::size_t>(system.column[static_cast<std::size_t>(k)])] != 0) {
      return true;
    }
  }
  return false;
}

}  // namespace

const std::vector<Region>& ClosedRegions::find(const PoissonSystem& system, const Field& excess) {
  const auto n = static_cast<std::int32_t>(system.size());
  regions_.clear();
  open_.resize(system.size());
  for (std::size_t i = 0; i < system.size(); ++i) open_[i] = excess[i] > 0.0 ? 1 : 0;

  // In cell order one sweep down and one up reach nearly everything; then sweep until at rest.
  std::int32_t found = 1;
  std::int32_t left = 1;
  const auto visit = [&](std::int32_t i) {
    const auto at = static_cast<std::size_t>(i);
    if (open_[at] != 0) return;
    if (has_open_neighbour(system, open_, at)) {
      open_[at] = 1;
      ++found;
    } else {
      ++left;
    }
  };
  while (found > 0 && left > 0) {
    found = 0;
    left = 0;
    for (std::int32_t i = n - 1; i >= 0; --i) visit(i);
    if (left == 0) break;
    left = 0;
    for (std::int32_t i = 0; i < n; ++i) visit(i);
  }
  if (left == 0) return regions_;

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

}  // namespace surge::mps
