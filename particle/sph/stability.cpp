#include "particle/sph/stability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "particle/core/for_each_cell.hpp"
#include "particle/core/particles.hpp"

namespace surge::sph {
namespace {

/// Waves along each axis; by symmetry k_x >= k_y >= k_z >= 0 are all there are.
template <int D>
inline constexpr int waves_along_axis = D == 2 ? 33 : 13;

}  // namespace

template <int D>
LatticeWaves::LatticeWaves(const Model<D>& model) {
  struct Neighbour {
    Vec<D> x;            ///< in spacings
    double slope = 0.0;  ///< V W'/r
  };
  std::vector<Neighbour> neighbours;
  const double volume = std::pow(model.spacing, D);
  std::visit(
      [&](const auto& kernel) {
        const int reach = static_cast<int>(std::ceil(kernel.support * model.h / model.spacing));
        std::array<int, D> lower;
        std::array<int, D> upper;
        lower.fill(-reach);
        upper.fill(reach + 1);
        for_each_cell<D>(lower, upper, [&](const std::array<int, D>& k) {
          Neighbour j;
          double r2 = 0.0;
          for (int a = 0; a < D; ++a) j.x[a] = k[a], r2 += j.x[a] * j.x[a];
          if (r2 == 0.0) return;
          j.slope = volume * kernel.slope(std::sqrt(r2) * model.spacing);
          if (j.slope != 0.0) neighbours.push_back(j);
        });
      },
      model.kernel);
  const int n = waves_along_axis<D>;
  std::array<int, D> last;
  last.fill(n);
  for_each_cell<D>({}, last, [&](const std::array<int, D>& k) {
    if (!std::is_sorted(k.rbegin(), k.rend())) return;
    Vec<D> gradient{};
    double laplacian = 0.0;
    for (const Neighbour& j : neighbours) {
      double phase = 0.0;
      for (int a = 0; a < D; ++a) phase += std::numbers::pi * k[a] / (n - 1) * j.x[a];
      for (int a = 0; a < D; ++a)
        gradient[a] += j.slope * std::sin(phase) * j.x[a] * model.spacing * model.h;
      laplacian -= 2.0 * j.slope * (1.0 - std::cos(phase)) * model.h * model.h;
    }
    double square = 0.0;
    for (const double g : gradient) square += g * g;
    waves_.push_back({square, laplacian});
  });
}

double LatticeWaves::courant_limit(double diffusion, double damping, double share) const {
  double limit = std::numeric_limits<double>::max();
  for (const Wave& w : waves_) {
    // g^2 N^2 + 2 b N = 4
    const double b = diffusion * w.laplacian + damping * w.gradient2 * share / (2.0 - share);
    if (b > 0.0 || w.gradient2 > 0.0)
      limit = std::min(limit, 4.0 / (b + std::sqrt(b * b + 4.0 * w.gradient2)));
  }
  return limit;
}

double LatticeWaves::damper_share(double diffusion, double damping, double courant) const {
  double seen = 1.0;  // s/(2 - s)
  for (const Wave& w : waves_) {
    const double room =
        4.0 - w.gradient2 * courant * courant - 2.0 * diffusion * w.laplacian * courant;
    const double need = 2.0 * damping * w.gradient2 * courant;
    if (need > 0.0) seen = std::min(seen, std::max(0.0, room) / need);
  }
  return 2.0 * seen / (1.0 + seen);
}

template LatticeWaves::LatticeWaves(const Model<2>&);
template LatticeWaves::LatticeWaves(const Model<3>&);

}  // namespace surge::sph
