#include "particle/mps/source.hpp"

#include <optional>

#include "particle/core/resolve.hpp"
#include "particle/mps/correction.hpp"
#include "particle/mps/surface.hpp"
#include "particle/mps/velocity_divergence.hpp"

namespace surge::mps {
namespace {

/// The part of the right side that belongs to a pressure rho a . x,
///   -rho 2d/(lambda n0) sum_j a . (x_j - x_i) w,
/// by the Laplacian model itself: the rows of the equation hold for it exactly, wherever the
/// neighbours are, and so does water at rest. Zero where they surround the particle evenly. Where
/// the acceleration differs from place to place it is taken half-way; between fluid and a wall that
/// moves, relative to the wall.
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
    if (moving && view.is_fluid(i) != view.is_fluid(j)) {
      const std::size_t wall = view.is_fluid(i) ? j : i;
      for (int a = 0; a < D; ++a) g[a] -= wall_acceleration[a][wall];
    }
    double head = 0.0;
    for (int a = 0; a < D; ++a) head += g[a] * d[a];
    sum += head * static_cast<double>(assembly.coupling(std::sqrt(squared_norm<D>(d))));
  }
  return -view.model.rho * sum;
}

/// What the pressures of the surface particles around add to the right side.
template <int D>
double surface_source(const View<D>& view, const PoissonAssembly<D>& assembly, std::size_t i) {
  const Field& pressure = view.p.pressure;
  double sum = 0.0;
  for (const std::uint32_t j : view.neighbours(i)) {
    if (pressure[j] == 0.0 || !view.is_surface(j) || !assembly.couples(view.p, i, j)) continue;
    const double r = std::sqrt(squared_norm<D>(view.displacement(i, j)));
    sum += pressure[j] * static_cast<double>(assembly.coupling(r));
  }
  return sum;
}

}  // namespace

template <int D>
PressureSource<D>::PressureSource(const Params& params, std::vector<Vec<D>> wall_normal)
    : source_(params.source),
      density_share_(params.density_share),
      relaxation_(params.source_relaxation),
      dynamic_(params.laplacian_of == LaplacianOf::dynamic_pressure),
      half_spacing_(params.surface_at == SurfaceAt::half_spacing),
      exact_(params.gradient == GradientModel::corrected),
      wall_normal_(std::move(wall_normal)) {}

template <int D>
void PressureSource<D>::fill(const View<D>& view, const PoissonAssembly<D>& assembly,
                             const BodyAcceleration<D>& still,
                             const std::array<Field, D>& wall_acceleration, double dt,
                             Field& rhs) const {
  const Model<D>& m = view.model;
  const Field& density = view.p.density;
  const auto for_each_unknown = [&](const auto& f) {
    view.for_each([&](std::size_t i) {
      if (view.unknown[i] >= 0) f(i, rhs[static_cast<std::size_t>(view.unknown[i])]);
    });
  };
  if (dynamic_)
    for_each_unknown([&](std::size_t i, double& row) {
      row = still_source<D>(view, assembly, still, wall_acceleration, i);
    });
  else
    for_each_unknown([](std::size_t, double& row) { row = 0.0; });
  if (half_spacing_)
    for_each_unknown([&](std::size_t i, double& row) { row += surface_source(view, assembly, i); });
  if (source_ == Source::number_density) {
    for_each_unknown([&](std::size_t i, double& row) {
      row = poisson_source(density[i], m.n0, m.rho, dt, relaxation_) + row;
    });
    return;
  }
  // What the body force has just added to the fluid, and not to the walls, is in still_source().
  Added added;
  if (dynamic_) added.fallen = still;
  if (dynamic_ && !wall_acceleration[0].empty()) added.wall = &wall_acceleration;
  resolve(exact_, [&](auto exact) {
    resolve(!wall_normal_.empty(), [&](auto smooth) {
      for_each_unknown([&](std::size_t i, double& row) {
        const double divergence = divergence_to_remove<exact(), smooth()>(view, i, dt, added);
        // Under a surface neighbours are missing, not far apart.
        double n = density[i];
        if (n < m.n0 && near_surface(view, i)) n = m.n0;
        row = relaxation_ * mixed_source(divergence, n, m.n0, m.rho, dt, density_share_) + row;
      });
    });
  });
}

/// v_j - v_i as the divergence sees it, less what this step has `added` to fluid and walls. Between
/// fluid and a slip wall, of which the normal is known, only the normal part: what slides along a
/// wall is not changed by the uneven places of the wall's particles.
template <int D>
template <bool Smooth>
Vec<D> PressureSource<D>::relative_velocity(const View<D>& view, std::size_t i, std::size_t j,
                                            double dt, const Added& added) const {
  const Particles<D>& p = view.p;
  const BodyAcceleration<D>& fallen = added.fallen;
  const auto velocity = [&](std::size_t k) {
    Vec<D> v = p.velocity(k);
    if (view.is_fluid(k)) {
      const Vec<D> g = fallen.turns ? fallen.at(p.position(k)) : fallen.uniform;
      for (int a = 0; a < D; ++a) v[a] -= dt * g[a];
    } else if (added.wall != nullptr) {
      for (int a = 0; a < D; ++a) v[a] -= dt * (*added.wall)[a][k];
    }
    return v;
  };
  const Vec<D> own = velocity(i);
  Vec<D> v = velocity(j);
  for (int a = 0; a < D; ++a) v[a] -= own[a];
  if constexpr (Smooth) {
    if (view.is_fluid(i) == view.is_fluid(j)) return v;
    const Vec<D>& n = wall_normal_[static_cast<std::size_t>(p.id[view.is_fluid(i) ? j : i])];
    double along = 0.0;
    for (int a = 0; a < D; ++a) along += v[a] * n[a];
    for (int a = 0; a < D; ++a) v[a] = along * n[a];
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
double PressureSource<D>::divergence_to_remove(const View<D>& view, std::size_t i, double dt,
                                               const Added& added) const {
  const Model<D>& m = view.model;
  const auto relative = [&](std::size_t j) {
    return relative_velocity<Smooth>(view, i, j, dt, added);
  };
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
