#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "particle/linear/poisson_system.hpp"

namespace surge::linear::testing {

/// A jittered lattice of `counts` particles in cell order, with the weights of Eq. (7) for
/// re = `radius` l0 (l0 = 1, no factor in front). The particles of the uppermost layers,
/// `open_rows` of them, have p = 0 and are eliminated; with none the region is closed.
struct Lattice {
  std::array<int, 3> counts{30, 60, 1};
  int dimension = 2;
  int open_rows = 1;
  double jitter = 0.1;
  double radius = 4.0;
  unsigned seed = 7;
  bool periodic = false;  ///< along the first axis
};

class LatticeSystem {
 public:
  explicit LatticeSystem(const Lattice& lattice) : lattice_(lattice) {
    place();
    number();
    for (std::size_t i = 0; i < particle_.size(); ++i) add_row(particle_[i]);
    system.dimension = lattice_.dimension;
    system.spacing = 1.0;
    system.mean_square = mean_square();
    if (lattice_.periodic) system.period[0] = lattice_.counts[0];
  }

  PoissonSystem system;

 private:
  using Point = std::array<double, 3>;
  using Cell = std::array<int, 3>;

  [[nodiscard]] int vertical() const { return lattice_.dimension - 1; }
  [[nodiscard]] std::size_t index(const Cell& c) const {
    return (static_cast<std::size_t>(c[2]) * static_cast<std::size_t>(lattice_.counts[1]) +
            static_cast<std::size_t>(c[1])) *
               static_cast<std::size_t>(lattice_.counts[0]) +
           static_cast<std::size_t>(c[0]);
  }

  template <class Visit>
  static void each(const Cell& lower, const Cell& upper, Visit visit) {
    for (int z = lower[2]; z < upper[2]; ++z) {
      for (int y = lower[1]; y < upper[1]; ++y) {
        for (int x = lower[0]; x < upper[0]; ++x) visit(Cell{x, y, z});
      }
    }
  }

  void place() {
    std::mt19937 random(lattice_.seed);
    std::uniform_real_distribution<double> shift(-lattice_.jitter, lattice_.jitter);
    each({0, 0, 0}, lattice_.counts, [&](const Cell& c) {
      Point p{};
      for (int a = 0; a < lattice_.dimension; ++a) {
        p[static_cast<std::size_t>(a)] = c[static_cast<std::size_t>(a)] + 0.5 + shift(random);
      }
      point_.push_back(p);
    });
  }

  // Unknowns in order of cells 2 l0 wide, row of cells after row of cells.
  void number() {
    unknown_.assign(point_.size(), -1);
    const int top = lattice_.counts[static_cast<std::size_t>(vertical())] - lattice_.open_rows;
    Cell cells{1, 1, 1};
    for (int a = 0; a < lattice_.dimension; ++a) {
      cells[static_cast<std::size_t>(a)] = (lattice_.counts[static_cast<std::size_t>(a)] + 1) / 2;
    }
    each({0, 0, 0}, cells, [&](const Cell& cell) {
      Cell lower{};
      Cell upper{};
      for (std::size_t a = 0; a < 3; ++a) {
        const int width = static_cast<int>(a) < lattice_.dimension ? 2 : 1;
        lower[a] = width * cell[a];
        upper[a] = std::min(lower[a] + width, lattice_.counts[a]);
      }
      each(lower, upper, [&](const Cell& c) {
        if (c[static_cast<std::size_t>(vertical())] >= top) return;
        unknown_[index(c)] = static_cast<std::int32_t>(particle_.size());
        particle_.push_back(c);
      });
    });
  }

  [[nodiscard]] double mean_square() const {
    const int reach = static_cast<int>(std::ceil(lattice_.radius));
    Cell lower{};
    Cell upper{1, 1, 1};
    for (std::size_t a = 0; a < static_cast<std::size_t>(lattice_.dimension); ++a) {
      lower[a] = -reach;
      upper[a] = reach + 1;
    }
    double weights = 0.0;
    double moment = 0.0;
    each(lower, upper, [&](const Cell& c) {
      const double r = std::hypot(c[0], c[1], c[2]);
      if (r == 0.0 || r >= lattice_.radius) return;
      weights += lattice_.radius / r - 1.0;
      moment += (lattice_.radius / r - 1.0) * c[0] * c[0];
    });
    return moment / weights;
  }

  void add_row(const Cell& c) {
    const Point& here = point_[index(c)];
    const int reach = static_cast<int>(std::ceil(lattice_.radius + 2 * lattice_.jitter));
    Cell lower{};
    Cell upper{};
    for (std::size_t a = 0; a < 3; ++a) {
      lower[a] = std::max(c[a] - reach, 0);
      upper[a] = std::min(c[a] + reach + 1, lattice_.counts[a]);
    }
    if (lattice_.periodic) {
      lower[0] = c[0] - reach;
      upper[0] = c[0] + reach + 1;
    }
    system.row_start.push_back(static_cast<std::int32_t>(system.column.size()));
    double diagonal = 0.0;
    each(lower, upper, [&](const Cell& image) {
      if (image == c) return;
      Cell other = image;
      other[0] = (image[0] + lattice_.counts[0]) % lattice_.counts[0];
      Point there = point_[index(other)];
      there[0] += image[0] - other[0];
      const double r = std::hypot(there[0] - here[0], there[1] - here[1], there[2] - here[2]);
      if (r >= lattice_.radius) return;
      const auto w = static_cast<float>(lattice_.radius / r - 1.0);
      diagonal += static_cast<double>(w);
      if (unknown_[index(other)] < 0) return;
      system.column.push_back(unknown_[index(other)]);
      system.value.push_back(-w);
    });
    system.diagonal.push_back(diagonal);
    for (std::size_t a = 0; a < 3; ++a) system.x[a].push_back(here[a]);
    if (system.row_start.size() == particle_.size()) {
      system.row_start.push_back(static_cast<std::int32_t>(system.column.size()));
    }
  }

  Lattice lattice_;
  std::vector<Point> point_;
  std::vector<std::int32_t> unknown_;
  std::vector<Cell> particle_;
};

/// Uniform in -1 to 1, the same for the same seed.
inline Field noise(std::size_t n, unsigned seed = 3) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Field field(n, 0.0);
  for (double& value : field) value = uniform(random);
  return field;
}

inline double largest_difference(const Field& a, const Field& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

/// The right side that makes `solution` exact.
inline Field rhs_of(const PoissonSystem& system, const Field& solution) {
  Field rhs;
  multiply(system, solution, rhs);
  return rhs;
}

/// The same equations with the unknowns numbered from the end.
inline PoissonSystem in_reverse(const PoissonSystem& system) {
  PoissonSystem other = system;
  const auto last = static_cast<std::int32_t>(system.size()) - 1;
  std::reverse(other.column.begin(), other.column.end());
  for (std::int32_t& column : other.column) column = last - column;
  std::reverse(other.value.begin(), other.value.end());
  std::reverse(other.row_start.begin(), other.row_start.end());
  for (std::int32_t& start : other.row_start) start = system.row_start.back() - start;
  std::reverse(other.diagonal.begin(), other.diagonal.end());
  std::reverse(other.rhs.begin(), other.rhs.end());
  for (Field& x : other.x) std::reverse(x.begin(), x.end());
  return other;
}

}  // namespace surge::linear::testing
