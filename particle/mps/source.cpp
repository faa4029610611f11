#include "particle/mps/source.hpp"

#include <optional>

#include "particle/core/resolve.hpp"
#include "particle/mps/correction.hpp"
#include "particle/mps/surface.hpp"
#include "particle/mps/velocity_divergence.hpp"

namespace surge::mps {
namespace {

/// Whether the acceleration is the same everywhere, and no wall has one of its own.
template <int D>
bool is_even(const BodyAcceleration<D>& still, const std::array<Field, D>& wall_acceleration) {
  return wall_acceleration[0].empty() && !still.turns;
}

/// The part of the right side that belongs to a pressure rho a . x,
///   -rho 2d/(lambda n0) sum_j a . (x_j - x_i) w,
/// by the Laplacian model itself: the rows of the equation hold for it exactly, wherever the
/// neighbours are, and so does water at rest. Zero where they surround the particle evenly. Where
/// the acceleration differs from place to place it is taken half-way; for a wall that moves,
/// relative to the wall. Water is not itself accelerated by the wall: only by its pressure. The
/// same acceleration everywhere is left to the assembly: even_slope().
template <int D>
double still_source(const View<D>& view, const PoissonAssembly<D>& assembly,
                    const BodyAcceleration<D>& still, const std::array<Field, D>& wall_acceleration,
                    std::size_t i) {
  const bool moving = !wall_acceleration[0].empty();
  double sum = 0.0;
  for (const std::uint32_t j : view.neighbours(i)) {
    if (!assembly.couples(view.p, i, j)) continue;
    const Vec<D> d = view.displacement(i, j);
    Vec<D> g = still.uniform;
    if (still.turns) {
      Vec<D> middle = view.p.position(i);
      for (int a = 0; a < D; ++a) middle[a] += 0.5 * d[a];
      g = still.at(middle);
    }
    if (moving && !view.is_fluid(i))
      for (int a = 0; a < D; ++a) g[a] -= wall_acceleration[a][i];
    double head = 0.0;
    for (int a = 0; a < D; ++a) head += g[a] * d[a];
    sum += head * static_cast<double>(assembly.coupling(std::sqrt(squared_norm<D>(d))));
  }
  return -view.model.rho * sum;
}

}  // namespace

template <int D>
PressureSource<D>::PressureSource(const Params& params, std::vector<Vec<D>> wall_normal)
    : source_(params.source),
      density_share_(params.density_share),
      relaxation_(params.source_relaxation),
      dynamic_(params.laplacian_of == LaplacianOf::dynamic_pressure),
      exact_(params.gradient == GradientModel::corrected),
      wall_normal_(std::move(wall_normal)) {}

template <int D>
Vec<D> PressureSource<D>::even_slope(double rho, const BodyAcceleration<D>& still,
                                     const std::array<Field, D>& wall_acceleration) const {
  Vec<D> slope{};
  if (!dynamic_ || !is_even<D>(still, wall_acceleration)) return slope;
  for (int a = 0; a < D; ++a) slope[a] = rho * still.uniform[a];
  return slope;
}

template <int D>
void PressureSource<D>::fill(const View<D>& view, const PoissonAssembly<D>& assembly,
                             const BodyAcceleration<D>& still,
                             const std::array<Field, D>& wall_acceleration, double dt, Field& rhs) {
  const Model<D>& m = view.model;
  const Field& density = view.p.density;
  const auto for_each_unknown = [&](const auto& f) {
    view.for_each([&](std::size_t i) {
      if (view.unknown[i] >= 0) f(i, rhs[static_cast<std::size_t>(view.unknown[i])]);
    });
  };
  if (dynamic_ && !is_even<D>(still, wall_acceleration))
    for_each_unknown([&](std::size_t i, double& row) {
      row += still_source<D>(view, assembly, still, wall_acceleration, i);
    });
  if (source_ == Source::number_density) {
    for_each_unknown([&](std::size_t i, double& row) {
      row += poisson_source(density[i], m.n0, m.rho, dt, relaxation_);
    });
    return;
  }
  // What the body force has just added to the fluid, and not to the walls, is in still_source().
  Added added;
  if (dynamic_) added.fallen = still;
  if (dynamic_ && !wall_acceleration[0].empty()) added.wall = &wall_acceleration;
  take_back(view, dt, added);
  resolve(exact_, [&](auto exact) {
    resolve(!wall_normal_.empty(), [&](auto smooth) {
      for_each_unknown([&](std::size_t i, double& row) {
        const double divergence = divergence_to_remove<exact(), smooth()>(view, i, dt);
        // Under a surface neighbours are missing, not far apart.
        double n = density[i];
        if (density_share_ == 0.0 || (n < m.n0 && near_surface(view, i))) n = m.n0;
        row += relaxation_ * mixed_source(divergence, n, m.n0, m.rho, dt, density_share_);
      });
    });
  });
}

/// The velocities less what this step has `added` to fluid and walls.
template <int D>
void PressureSource<D>::take_back(const View<D>& view, double dt, const Added& added) {
  const Particles<D>& p = view.p;
  for (Field& field : before_) field.resize(p.size());
  view.for_each([&](std::size_t k) {
    Vec<D> a{};
    if (view.is_fluid(k)) {
      a = added.fallen.turns ? added.fallen.at(p.position(k)) : added.fallen.uniform;
    } else if (added.wall != nullptr) {
      for (int axis = 0; axis < D; ++axis) a[axis] = (*added.wall)[axis][k];
    }
    for (int axis = 0; axis < D; ++axis) before_[axis][k] = p.v[axis][k] - dt * a[axis];
  });
}

/// v_j - v_i of those, as the divergence sees it. Between fluid and a slip wall, of which the
/// normal is known, only the normal part: what slides along a wall is not changed by the uneven
/// places of the wall's particles.
template <int D>
template <bool Smooth>
std::array<Simd, D> PressureSource<D>::relative_velocities(const View<D>& view, std::size_t i,
                                                           const LaneIndices& j) const {
  std::array<Simd, D> v;
  for (int a = 0; a < D; ++a) v[a] = pick(before_[a], j) - before_[a][i];
  if constexpr (Smooth) {
    const bool fluid = view.is_fluid(i);
    for (std::size_t k = 0; k < simd_width; ++k) {
      if (view.is_fluid(j[k]) == fluid) continue;
      const Vec<D>& n = wall_normal_[static_cast<std::size_t>(view.p.id[fluid ? j[k] : i])];
      double along = 0.0;
      for (int a = 0; a < D; ++a) along += v[a][k] * n[a];
      for (int a = 0; a < D; ++a) v[a][k] = along * n[a];
    }
  }
  return v;
}

/// Divergence of the velocity that this step's pressure takes back, 1/s. What this step's motion
/// has made, -dt tr(grad v grad v), goes at once. The rest is what the models of divergence,
/// gradient and Laplacian, which do not belong together, have left over, and goes within
/// divergence_time: taken back in every step it would come as pulses, the stronger the shorter the
/// step. The source is that of the MAC method (Harlow & Welch 1965, Phys. Fluids 8), the time that
/// of Baumgarte's stabilisation of constraints (1972, Comput. Methods Appl. Mech. Eng. 1).
template <int D>
template <bool Exact, bool Smooth>
double PressureSource<D>::divergence_to_remove(const View<D>& view, std::size_t i,
                                               double dt) const {
  const Model<D>& m = view.model;
  const auto relative = [&](const LaneIndices& j)
                            SURGE_INLINE { return relative_velocities<Smooth>(view, i, j); };
  const auto everyone = [](std::size_t) { return true; };
  std::optional<std::array<Vec<D>, D>> gradient;
  if (Exact || dt < m.divergence_time)
    gradient = velocity_gradient<D>(i, view.neighbours(i), view.displacement, m.re, m.n0,
                                    trusted_pivot, relative, everyone);
  double divergence = 0.0;
  if (gradient && Exact) {
    for (int a = 0; a < D; ++a) divergence += (*gradient)[a][a];
  } else {
    divergence = velocity_divergence<D>(i, view.neighbours(i), view.displacement, m.re, m.n0,
                                        relative, everyone);
  }
  if (dt >= m.divergence_time) return divergence;
  const double made = gradient ? -dt * convected_divergence<D>(*gradient) : 0.0;
  return made + dt / m.divergence_time * (divergence - made);
}

template class PressureSource<2>;
template class PressureSource<3>;

}  // namespace surge::mps
