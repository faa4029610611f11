#include "particle/sph/shifting.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "particle/kernel/wendland_c2.hpp"
#include "particle/sph/momentum.hpp"
#include "particle/sph/solver.hpp"

namespace surge::sph {
namespace {

constexpr int count = 20;  ///< particles along each side of the unit square
constexpr double l0 = 1.0 / count;
constexpr double h = 1.5 * l0;
constexpr double rho = 1000.0;

/// Fluid over the whole width of a box that is periodic along x, `rows` rows of it from below,
/// periodic along y too where it is full; each particle off its place by up to `jitter` l0.
struct Layer {
  Particles<2> p;
  CellGrid<2> grid;
  Field fluid_volume;
  ClusterLists<2> lists;
  Survey<2> found;
  Surroundings<2> surroundings{h, l0, 1.0};
  WendlandC2<2> kernel{h};

  Layer(int rows, double jitter, double speed)
      : grid(Search::cell_grid, Periodicity<2>{{0.0, 0.0}, {1.0, rows == count ? 1.0 : 0.0}}) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    p.resize(static_cast<std::size_t>(rows) * count);
    for (std::size_t i = 0; i < p.size(); ++i) {
      const std::size_t row = i / count;
      const std::size_t column = i % count;
      p.x[0][i] = (static_cast<double>(column) + 0.5 + jitter * any(random)) * l0;
      p.x[1][i] = (static_cast<double>(row) + 0.5 + jitter * any(random)) * l0;
      p.v[0][i] = 1.0 + speed * any(random);
      p.v[1][i] = speed * any(random);
      p.density[i] = rho;
    }
    fluid_volume.assign(p.size(), l0 * l0);
    found = Survey<2>(p.size());
  }
  void survey() {
    grid.build(p.x, 2.0 * h, 2);
    grid.reorder(p);
    for (std::size_t i = 0; i < p.size(); ++i) {
      const bool fluid = p.type[i] == ParticleType::fluid;
      fluid_volume[i] = fluid ? l0 * l0 : 0.0;
    }
    lists.build(grid, p, 2.0 * h);
    surroundings.survey(kernel, lists, p, fluid_volume, 1.0, found);
  }
  void find_density_rate() { surroundings.find_density_rate(kernel, lists, p, found); }
  [[nodiscard]] double shift(int a, std::size_t i) const { return found.shift[a][i]; }
  [[nodiscard]] double fastest_shift() const {
    double fastest = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i)
      fastest = std::max(fastest, std::hypot(shift(0, i), shift(1, i)));
    return fastest;
  }
  /// Standard deviation of sum_j V_j W_ij, particles over each other in a periodic box.
  [[nodiscard]] double spread() const {
    double sum = 0.0;
    double square = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      double c = 0.0;
      for (std::size_t j = 0; j < p.size(); ++j) {
        const double dx = std::remainder(p.x[0][j] - p.x[0][i], 1.0);
        const double dy = std::remainder(p.x[1][j] - p.x[1][i], 1.0);
        c += l0 * l0 * kernel.value(std::hypot(dx, dy));
      }
      sum += c;
      square += c * c;
    }
    const auto n = static_cast<double>(p.size());
    return std::sqrt(square / n - sum / n * (sum / n));
  }
};

TEST(Shifting, LeavesALatticeAlone) {
  Layer lattice(count, 0.0, 0.5);
  lattice.survey();
  EXPECT_LT(lattice.fastest_shift(), 1e-12);
  lattice.find_density_rate();
  for (const double r : lattice.found.density_rate) EXPECT_NEAR(r, 0.0, 1e-9);
  for (const double lambda : lattice.found.lambda) EXPECT_NEAR(lambda, 1.0, 0.02);
}

TEST(Shifting, SpreadsParticlesEvenly) {
  Layer layer(count, 0.2, 0.5);
  const double before = layer.spread();
  for (int k = 0; k < 40; ++k) {
    layer.survey();
    for (std::size_t i = 0; i < layer.p.size(); ++i)
      for (int a = 0; a < 2; ++a) layer.p.x[a][i] += 0.05 * h * layer.shift(a, i);
  }
  EXPECT_LT(layer.spread(), 0.3 * before);
}

TEST(DeformationSpeed, OfShearStrainAndRotation) {
  const double rate = 3.0;
  const double r2 = 0.08;
  using G = std::array<std::array<double, 2>, 2>;
  // Velocities relative to the middle: rate y, and rate (x, -y), whose squares are rate^2 r2 times
  // 1/2 and 1 on the mean; that of the strain counts twice.
  EXPECT_NEAR(deformation_speed(G{{{0.0, rate}, {0.0, 0.0}}}, r2), rate * 0.2, 1e-15);
  EXPECT_NEAR(deformation_speed(G{{{rate, 0.0}, {0.0, -rate}}}, r2), rate * 0.4, 1e-15);
  EXPECT_EQ(deformation_speed(G{{{0.0, rate}, {-rate, 0.0}}}, r2), 0.0);
}

// A limit that the velocities themselves set would shift as fast in both.
TEST(Shifting, RotationRearrangesNothing) {
  const auto fastest_inside = [](double shear) {
    Layer layer(count, 0.2, 0.0);
    for (std::size_t i = 0; i < layer.p.size(); ++i) {
      layer.p.v[0][i] = 0.01 * (0.5 - layer.p.x[1][i]);
      layer.p.v[1][i] = 0.01 * shear * (layer.p.x[0][i] - 0.5);
    }
    layer.survey();
    double fastest = 0.0;
    for (std::size_t i = 0; i < layer.p.size(); ++i)
      if (std::max(std::abs(layer.p.x[0][i] - 0.5), std::abs(layer.p.x[1][i] - 0.5)) < 0.25)
        fastest = std::max(fastest, std::hypot(layer.shift(0, i), layer.shift(1, i)));
    return fastest;
  };
  EXPECT_GT(fastest_inside(-1.0), 0.01 * h);
  EXPECT_LT(fastest_inside(1.0), 0.2 * fastest_inside(-1.0));
}

// What only moves as a whole isn't rearranged, and no shift is faster than the fluid's own motion.
TEST(Shifting, IsBoundedByTheRelativeMotion) {
  Layer still(count, 0.2, 0.0);
  still.survey();
  EXPECT_LT(still.fastest_shift(), 1e-12);
  Layer slow(count, 0.2, 1e-3);
  slow.survey();
  EXPECT_GT(slow.fastest_shift(), 1e-4);
  EXPECT_LT(slow.fastest_shift(), std::sqrt(8.0) * 1e-3);
}

TEST(Shifting, NothingThroughTheFreeSurface) {
  Layer layer(count / 2, 0.0, 0.5);
  layer.survey();
  for (std::size_t i = 0; i < layer.p.size(); ++i) {
    const double depth = std::min(layer.p.x[1][i], 0.5 - layer.p.x[1][i]) / l0;  // two surfaces
    const double outward = layer.p.x[1][i] > 0.25 ? layer.shift(1, i) : -layer.shift(1, i);
    EXPECT_LT(outward, 1e-12) << depth;
    EXPECT_EQ(layer.found.near_surface(i), depth < 3.0) << depth;
    if (depth < 1.0) {
      EXPECT_NEAR(layer.found.lambda[i], 0.5, 0.15);
    }
    if (depth > 3.0) {
      EXPECT_NEAR(layer.found.lambda[i], 1.0, 0.02);
    }
  }
}

TEST(Shifting, OnlyWhatLeadsOutIsTakenOff) {
  using V = std::array<double, 2>;
  const V out = along_surface(V{1.0, 2.0}, V{0.0, 3.0});
  EXPECT_NEAR(out[0], 1.0, 1e-15);
  EXPECT_NEAR(out[1], 0.0, 1e-15);
  EXPECT_EQ(along_surface(V{1.0, -2.0}, V{0.0, 3.0}), (V{1.0, -2.0}));
  EXPECT_EQ(along_surface(V{1.0, 2.0}, V{0.0, 0.0}), (V{1.0, 2.0}));
}

TEST(Shifting, NothingTowardsAWallOrAwayInsideTheFluid) {
  // The lowest three rows are a wall.
  Layer layer(count / 2, 0.0, 0.5);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-0.1 * l0, 0.1 * l0);
  for (std::size_t i = 0; i < layer.p.size(); ++i) {
    if (i < std::size_t{3} * count)
      layer.p.type[i] = ParticleType::dummy;
    else
      layer.p.x[0][i] += any(random);  // along the wall
  }
  layer.survey();
  long seen = 0;
  double fastest = 0.0;
  for (std::size_t i = 0; i < layer.p.size(); ++i) {
    if (layer.p.type[i] != ParticleType::fluid || layer.p.x[1][i] > 5.0 * l0) continue;
    ++seen;
    double along = 0.0;
    double length = 0.0;
    Vec<2> normal{};
    for (std::size_t j = 0; j < layer.p.size(); ++j) {
      if (layer.p.type[j] == ParticleType::fluid) continue;
      const Vec<2> d{std::remainder(layer.p.x[0][j] - layer.p.x[0][i], 1.0),
                     layer.p.x[1][j] - layer.p.x[1][i]};
      const double r = std::hypot(d[0], d[1]);
      for (std::size_t a = 0; a < 2; ++a) normal[a] -= layer.kernel.derivative(r) / r * d[a];
    }
    for (int a = 0; a < 2; ++a) {
      along += layer.shift(a, i) * normal[a];
      length += normal[a] * normal[a];
    }
    ASSERT_LT(normal[1], 0.0);
    EXPECT_NEAR(along / std::sqrt(length), 0.0, 1e-12);
    fastest = std::max(fastest, std::abs(layer.shift(0, i)));
  }
  EXPECT_EQ(seen, 2 * count);
  EXPECT_GT(fastest, 1e-2 * l0);
}

TEST(Shifting, LayersUnderASurfaceFillAGapAtAWall) {
  // Three rows of wall, and three of water with a gap below them.
  Layer layer(6, 0.0, 0.5);
  for (std::size_t i = 0; i < layer.p.size(); ++i) {
    if (i < std::size_t{3} * count)
      layer.p.type[i] = ParticleType::dummy;
    else
      layer.p.x[1][i] += 0.4 * l0;
  }
  layer.survey();
  long seen = 0;
  for (std::size_t i = 0; i < layer.p.size(); ++i) {
    if (layer.p.type[i] != ParticleType::fluid || layer.p.x[1][i] > 4.0 * l0) continue;
    ++seen;
    EXPECT_TRUE(layer.found.near_surface(i));
    EXPECT_LT(layer.shift(1, i), -0.01 * l0);
  }
  EXPECT_EQ(seen, count);
}

// Evening out moves the particles apart on the whole, by sum_i V_i div du_i, and only that is seen.
TEST(Shifting, DensityFollowsTheVolumeThatAShiftGives) {
  Layer layer(count, 0.2, 0.5);
  layer.survey();
  layer.find_density_rate();
  double seen = 0.0;
  double volume = 0.0;
  for (std::size_t i = 0; i < layer.p.size(); ++i) {
    seen += layer.found.density_rate[i];
    for (std::size_t j = 0; j < layer.p.size(); ++j) {
      if (i == j) continue;
      const double dx = std::remainder(layer.p.x[0][j] - layer.p.x[0][i], 1.0);
      const double dy = std::remainder(layer.p.x[1][j] - layer.p.x[1][i], 1.0);
      const double r = std::hypot(dx, dy);
      volume -= l0 * l0 * layer.kernel.derivative(r) / r *
                ((layer.shift(0, j) - layer.shift(0, i)) * dx +
                 (layer.shift(1, j) - layer.shift(1, i)) * dy);
    }
  }
  EXPECT_GT(volume, 0.0);
  EXPECT_NEAR(seen, -rho * volume, 1e-8 * rho * volume);
}

/// Acceleration by the pressures p(x, y) (Pa) of a particle inside a cloud, in either form.
template <class Pressure>
Vec<2> acceleration(double jitter, bool near_surface, Pressure&& pressure) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-jitter, jitter);
  const WendlandC2<2> kernel(h);
  const double own = without_tension(pressure(0.0, 0.0) / (rho * rho), near_surface);
  Vec<2> sum{};
  for (int k = -4; k <= 4; ++k)
    for (int m = -4; m <= 4; ++m) {
      if (k == 0 && m == 0) continue;
      const Vec<2> dx{(k + any(random)) * l0, (m + any(random)) * l0};
      const double r = std::hypot(dx[0], dx[1]);
      const double factor =
          pressure_term(own, pressure(dx[0], dx[1]) / (rho * rho), kernel.derivative(r) / r);
      for (std::size_t a = 0; a < 2; ++a) sum[a] += rho * l0 * l0 * factor * dx[a];
    }
  return sum;
}

// Tension that is the same everywhere moves nothing, however the particles lie; the sum does.
TEST(TensionByDifferences, UniformTensionMovesNothing) {
  const auto tension = [](double, double) { return -500.0; };
  const Vec<2> inside = acceleration(0.3, false, tension);
  EXPECT_NEAR(std::hypot(inside[0], inside[1]), 0.0, 1e-12);
  const Vec<2> surface = acceleration(0.3, true, tension);
  EXPECT_GT(std::hypot(surface[0], surface[1]), 0.1);
}

TEST(TensionByDifferences, GradientOfALinearField) {
  const auto linear = [](double x, double) { return -500.0 + 2000.0 * x; };
  for (const bool near_surface : {false, true}) {
    const Vec<2> a = acceleration(0.0, near_surface, linear);
    EXPECT_NEAR(a[0], -2.0, 0.02 * 2.0);
    EXPECT_NEAR(a[1], 0.0, 1e-12);
  }
  EXPECT_EQ(without_tension(3.0, false), 3.0) << "pressure acts as ever";
}

}  // namespace
}  // namespace surge::sph
