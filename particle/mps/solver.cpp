#include "particle/mps/solver.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "particle/core/fastest_speed.hpp"
#include "particle/core/initial_particles.hpp"
#include "particle/core/time_step.hpp"
#include "particle/mps/free_surface.hpp"
#include "particle/mps/gradient.hpp"
#include "particle/mps/laplacian.hpp"
#include "particle/mps/number_density.hpp"
#include "particle/mps/shifting.hpp"
#include "particle/mps/velocity_divergence.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::mps {
namespace {

constexpr double edge = 0.9;         ///< of the density under a flat surface; a corner has 0.63
constexpr double least_pivot = 0.3;  ///< of a corrected gradient; 1 on the full lattice
/// A pressure whose equation holds to no more than this is none: the run ends.
constexpr double largest_residual = 0.1;

template <int D>
double factor_of(const Params& params, double l0) {
  return laplacian_factor<D>(reference_number_density<D>(params.re_laplacian),
                             laplacian_lambda<D>(params.lambda, params.re_laplacian, l0));
}

/// s; a case without a speed has no such time.
double divergence_time_of(const Params& params, const Case& c) {
  const double speed = reference_speed(c);
  return speed > 0.0 ? params.divergence_time * c.spacing / speed : 0.0;
}

/// From the nearest point of a box to x; zero inside. m
template <int D>
Vec<D> outside_of(const Box& box, const Vec<D>& x) {
  Vec<D> d;
  for (std::size_t a = 0; a < D; ++a) d[a] = x[a] - std::clamp(x[a], box.lower[a], box.upper[a]);
  return d;
}

/// From x in a box to the nearest of its faces, m.
template <int D>
Vec<D> to_nearest_face(const Box& box, const Vec<D>& x) {
  Vec<D> d{};
  double least = std::numeric_limits<double>::max();
  for (std::size_t a = 0; a < D; ++a) {
    for (const double face : {box.lower[a], box.upper[a]}) {
      if (std::abs(face - x[a]) >= least) continue;
      least = std::abs(face - x[a]);
      d = {};
      d[a] = face - x[a];
    }
  }
  return d;
}

}  // namespace

template <int D>
Solver<D>::Solver(const Case& c, const Params& params, Search search)
    : params_(params),
      control_(c.time),
      spacing_(c.spacing),
      rho_(c.density),
      nu_(c.kinematic_viscosity),
      no_slip_(nu_ > 0.0 && c.has_tank && c.tank.wall == WallCondition::no_slip),
      re_(params_.re_gradient * c.spacing),
      re_laplacian_(params_.re_laplacian * c.spacing),
      n0_(reference_number_density<D>(params_.re_gradient)),
      laplacian_factor_(factor_of<D>(params_, c.spacing)),
      layer_thickness_(re_, c.spacing),
      divergence_time_(divergence_time_of(params_, c)),
      viscous_lambda_(laplacian_lambda<D>(Lambda::lattice, params_.re_laplacian, c.spacing)),
      collision_(params_.collision_distance * c.spacing, params_.collision_restitution),
      walls_(c, params_.wall_distance * c.spacing, params_.collision_restitution),
      p_(initial_particles<D>(c, wall_layers(params))),
      grid_(search, periodicity_of<D>(c)),
      periodicity_(periodicity_of<D>(c)),
      assembly_(re_laplacian_, laplacian_factor_, c.spacing,
                params_.wall_coupling == WallCoupling::all),
      pressure_solver_({params_.ppe_solver, params_.ppe_tolerance, params_.ppe_max_iterations,
                        params_.re_laplacian}) {
  const auto scope = clock_.measure(Phase::setup);
  // The neighbours of both sums are looked for within the Laplacian's radius.
  if (params_.re_gradient > params_.re_laplacian) {
    throw Error("mps.re_gradient: found " + number_text(params_.re_gradient) +
                ", expected at most mps.re_laplacian = " + number_text(params_.re_laplacian));
  }
  std::copy_n(c.gravity.begin(), D, gravity_.begin());
  const Point still = still_gravity(c);
  std::copy_n(still.begin(), D, still_gravity_.begin());
  for (int a = 0; a < D; ++a) correction_[a].assign(p_.size(), 0.0);
  for (int a = 0; a < D; ++a) {
    rubbing_velocity_[a].assign(p_.size(), 0.0);
    assembly_.system().period[a] = periodicity_.length[a];
  }
  least_.assign(p_.size(), 0.0);
  surface_pressure_.assign(p_.size(), 0.0);
  if (params_.wall_coupling == WallCoupling::fluid && !no_slip_) find_wall_normals(c);
  for (int a = 0; a < D; ++a) {
    concentration_gradient_[a].assign(p_.size(), 0.0);
    carried_[a].assign(p_.size(), 0.0);
  }
  unknown_.assign(p_.size(), -1);
  find_neighbours();
  compute_number_density();
  StepReport ignored;
  measure_speed(ignored);
}

/// Unit normals of wall particles, by the tank or the obstacle that they stand for. Their sign is
/// open: only the direction is used.
template <int D>
void Solver<D>::find_wall_normals(const Case& c) {
  wall_normal_.assign(p_.size(), Vec<D>{});
  for (std::size_t i = 0; i < p_.size(); ++i) {
    if (is_fluid(i)) continue;
    Vec<D> n{};
    if (c.has_tank) n = outside_of<D>(c.tank.box, p_.position(i));
    if (squared_norm<D>(n) == 0.0) {
      for (const Box& obstacle : c.obstacles)
        if (squared_norm<D>(outside_of<D>(obstacle, p_.position(i))) == 0.0)
          n = to_nearest_face<D>(obstacle, p_.position(i));
    }
    const double length = std::sqrt(squared_norm<D>(n));
    if (length == 0.0) continue;
    for (int a = 0; a < D; ++a) wall_normal_[static_cast<std::size_t>(p_.id[i])][a] = n[a] / length;
  }
}

template <int D>
double Solver<D>::stable_step() const {
  const double dt = std::min(courant_step(control_, spacing_, v_max_),
                             viscous_step(0.25 / (D + 2), std::sqrt(viscous_lambda_), viscosity()));
  return steps_ == 0 ? std::min(dt, control_.initial_step) : dt;
}

template <int D>
StepReport Solver<D>::step(double dt_limit) {
  StepReport report;
  const double dt = std::min(stable_step(), dt_limit);
  apply_body_forces(dt);
  move(dt, p_.v, report);
  find_neighbours();
  collide(dt, report);
  compute_number_density();
  find_free_surface();
  solve_pressure(dt, report);
  correct(dt, report);
  shift_particles(dt, report);
  measure_speed(report);
  time_ += dt;
  ++steps_;
  report.dt = dt;
  report.courant = v_max_ * dt / spacing_;
  return report;
}

template <int D>
template <class F>
void Solver<D>::for_each_fluid(F&& f) {
  loop_.each(p_.size(), [&](std::size_t i) {
    if (is_fluid(i)) f(i);
  });
}

/// Temporal velocity v* = v + dt (g + nu lap v).
template <int D>
void Solver<D>::apply_body_forces(double dt) {
  const auto scope = clock_.measure(Phase::forces);
  if (viscosity() > 0.0) add_viscosity(dt);
  for_each_fluid([&](std::size_t i) {
    for (int a = 0; a < D; ++a) p_.v[a][i] += dt * gravity_[a];
  });
}

/// The viscous term with the neighbours of the step before, which is where v_max is from, too. A
/// no-slip wall counts, a slip wall does not. Two neighbours' sums bound the eigenvalues, by which
/// stable_step() is half the stable one.
template <int D>
void Solver<D>::add_viscosity(double dt) {
  const Displacement<D> displacement(p_.x, periodicity_);
  for (int a = 0; a < D; ++a)
    std::copy(p_.v[a].begin(), p_.v[a].end(), rubbing_velocity_[a].begin());
  if (no_slip_) extrapolate_to_walls(displacement);
  for_each_fluid([&](std::size_t i) {
    const Vec<D> acceleration = viscous_acceleration(i, displacement);
    for (int a = 0; a < D; ++a) p_.v[a][i] += dt * acceleration[a];
  });
}

/// m/s2. The paper has no viscous term: its lambda does not enter.
template <int D>
Vec<D> Solver<D>::viscous_acceleration(std::size_t i, const Displacement<D>& displacement) const {
  const double factor =
      viscosity() *
      laplacian_factor<D>(reference_number_density<D>(params_.re_laplacian), viscous_lambda_);
  const auto counts = [&](std::size_t j) { return no_slip_ || is_fluid(j); };
  Vec<D> sum{};
  if (params_.viscous_term == ViscousTerm::deformation) {
    sum =
        deformation_sum<D>(i, list_.of(i), displacement, re_laplacian_, rubbing_velocity_, counts);
  } else {
    for (int a = 0; a < D; ++a)
      sum[a] = laplacian_sum<D>(
          i, list_.of(i), displacement, re_laplacian_,
          [&](std::size_t j) { return rubbing_velocity_[a][j]; }, counts);
  }
  for (double& component : sum) component *= factor;
  return sum;
}

/// A no-slip wall at rest shows the fluid its mirrored velocity, so that the line of no motion lies
/// on the wall's surface: v_w = -sum_f v_f w / sum_f w (Adami, Hu & Adams 2012, J. Comput. Phys.
/// 231, there for SPH).
template <int D>
void Solver<D>::extrapolate_to_walls(const Displacement<D>& displacement) {
  const auto n = static_cast<std::ptrdiff_t>(p_.size());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (is_fluid(i)) continue;
    Vec<D> sum{};
    double weights = 0.0;
    for (const std::uint32_t j : list_.of(i)) {
      if (!is_fluid(j)) continue;
      const double weight =
          mps_weight(std::sqrt(squared_norm<D>(displacement(i, j))), re_laplacian_);
      weights += weight;
      for (int a = 0; a < D; ++a) sum[a] += weight * p_.v[a][j];
    }
    for (int a = 0; a < D; ++a) rubbing_velocity_[a][i] = weights > 0.0 ? -sum[a] / weights : 0.0;
  }
}

/// x += dt velocity for the fluid, held back at walls.
template <int D>
void Solver<D>::move(double dt, const std::array<Field, D>& velocity, StepReport& report) {
  const auto scope = clock_.measure(Phase::forces);
  const auto n = static_cast<std::ptrdiff_t>(p_.size());
  long collisions = 0;
  long lost = 0;
#pragma omp parallel for schedule(static, stretch) reduction(+ : collisions, lost)
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    if (p_.type[i] != ParticleType::fluid) continue;
    Vec<D> start;
    Vec<D> end;
    Vec<D> v;
    for (int a = 0; a < D; ++a) {
      start[a] = p_.x[a][i];
      end[a] = start[a] + dt * velocity[a][i];
      v[a] = p_.v[a][i];
    }
    if (walls_.apply(start, end, v)) {
      ++collisions;
      for (int a = 0; a < D; ++a) p_.v[a][i] = v[a];
    }
    for (int a = 0; a < D; ++a) p_.x[a][i] = end[a];
    if (walls_.is_lost(end)) ++lost;
  }
  report.wall_collisions += collisions;
  report.lost = lost;
}

template <int D>
void Solver<D>::find_neighbours() {
  const auto scope = clock_.measure(Phase::neighbours);
  grid_.build(p_.x, re_laplacian_, 2);
  grid_.reorder(p_);
  grid_.reorder(surface_pressure_);
  // Only the viscous term asks who is near a dummy.
  const bool all = no_slip_;
  list_.build(grid_, p_.x, re_laplacian_, [&](std::size_t i) { return all || has_pressure(i); });
}

template <int D>
void Solver<D>::collide(double dt, StepReport& report) {
  std::atomic<long> collisions = 0;
  {
    const auto scope = clock_.measure(Phase::forces);
    const Displacement<D> displacement(p_.x, periodicity_);
    for_each_fluid([&](std::size_t i) {
      long met = 0;
      const Vec<D> change = collision_.velocity_change(
          i, list_.of(i), displacement, p_.v, [&](std::size_t j) { return !is_fluid(j); },
          params_.collision_speed * v_max_, met);
      for (int a = 0; a < D; ++a) correction_[a][i] = change[a];
      if (met > 0) collisions.fetch_add(met, std::memory_order_relaxed);
    });
    if (collisions == 0) return;
    for_each_fluid([&](std::size_t i) {
      for (int a = 0; a < D; ++a) p_.v[a][i] += correction_[a][i];
    });
  }
  report.particle_collisions = collisions;
  move(dt, correction_, report);
  find_neighbours();
}

template <int D>
void Solver<D>::compute_number_density() {
  const auto scope = clock_.measure(Phase::pressure);
  const Displacement<D> displacement(p_.x, periodicity_);
  loop_.each(p_.size(), [&](std::size_t i) {
    if (has_pressure(i)) p_.density[i] = number_density<D>(i, list_.of(i), displacement, re_);
  });
}

template <int D>
bool Solver<D>::is_on_surface(std::size_t i, const Displacement<D>& displacement) const {
  if (params_.wall_coupling == WallCoupling::fluid && !is_fluid(i)) {
    const auto neighbours = list_.of(i);
    return std::none_of(neighbours.begin(), neighbours.end(),
                        [&](std::uint32_t j) { return is_fluid(j); });
  }
  if (!on_free_surface(p_.density[i], params_.beta, n0_)) return false;
  if (params_.surface_offset == 0.0 || on_free_surface(p_.density[i], thin_sheet, n0_)) return true;
  return neighbour_offset<D>(i, list_.of(i), displacement, re_, n0_, spacing_) >
         params_.surface_offset;
}

/// Numbers the particles whose pressure is unknown; the others get that of the surface.
template <int D>
void Solver<D>::find_free_surface() {
  const auto scope = clock_.measure(Phase::pressure);
  unknowns_ = 0;
  const Displacement<D> displacement(p_.x, periodicity_);
  loop_.each(p_.size(), [&](std::size_t i) {
    const bool solved = has_pressure(i) && !is_on_surface(i, displacement);
    unknown_[i] = solved ? 0 : -1;
    if (!solved) p_.pressure[i] = surface_pressure_[i];
  });
  for (std::int32_t& number : unknown_)
    if (number == 0) number = static_cast<std::int32_t>(unknowns_++);
}

/// Whether a particle has a free surface within the radius of the number density.
template <int D>
bool Solver<D>::near_surface(std::size_t i, const Displacement<D>& displacement) const {
  if (is_surface(i)) return true;
  for (const std::uint32_t j : list_.of(i))
    if (is_surface(j) && squared_norm<D>(displacement(i, j)) < re_ * re_) return true;
  return false;
}

/// Pa/m^2, with the sign of the Laplacian turned.
template <int D>
double Solver<D>::source(std::size_t i, double dt, const Displacement<D>& displacement) const {
  const bool dynamic = params_.laplacian_of == LaplacianOf::dynamic_pressure;
  double still = dynamic ? still_source(i, displacement) : 0.0;
  if (params_.surface_at == SurfaceAt::half_spacing) still += surface_source(i, displacement);
  if (params_.source == Source::number_density)
    return poisson_source(p_.density[i], n0_, rho_, dt, params_.source_relaxation) + still;
  const double divergence = divergence_to_remove(i, dt, displacement);
  // Under a surface neighbours are missing, not far apart.
  double n = p_.density[i];
  if (n < n0_ && near_surface(i, displacement)) n = n0_;
  return params_.source_relaxation *
             mixed_source(divergence, n, n0_, rho_, dt, params_.density_share) +
         still;
}

/// The part of the right side that belongs to a pressure rho g . x,
///   -rho 2d/(lambda n0) sum_j g . (x_j - x_i) w,
/// by the Laplacian model itself: the rows of the equation hold for it exactly, wherever the
/// neighbours are, and so does water at rest. Zero where they surround the particle evenly.
template <int D>
double Solver<D>::still_source(std::size_t i, const Displacement<D>& displacement) const {
  double sum = 0.0;
  for (const std::uint32_t j : list_.of(i)) {
    if (!assembly_.couples(p_, i, j)) continue;
    const Vec<D> d = displacement(i, j);
    double head = 0.0;
    for (int a = 0; a < D; ++a) head += still_gravity_[a] * d[a];
    sum += head * static_cast<double>(assembly_.coupling(std::sqrt(squared_norm<D>(d))));
  }
  return -rho_ * sum;
}

/// What the pressures of the surface particles around add to the right side.
template <int D>
double Solver<D>::surface_source(std::size_t i, const Displacement<D>& displacement) const {
  double sum = 0.0;
  for (const std::uint32_t j : list_.of(i)) {
    if (p_.pressure[j] == 0.0 || !is_surface(j) || !assembly_.couples(p_, i, j)) continue;
    const double r = std::sqrt(squared_norm<D>(displacement(i, j)));
    sum += p_.pressure[j] * static_cast<double>(assembly_.coupling(r));
  }
  return sum;
}

/// v_j - v_i as the divergence sees it, less `fallen` times gravity for the fluid. Between fluid
/// and a slip wall, of which the normal is known, only the normal part: what slides along a wall is
/// not changed by the uneven places of the wall's particles.
template <int D>
Vec<D> Solver<D>::relative_velocity(std::size_t i, std::size_t j, double fallen) const {
  const auto velocity = [&](std::size_t k) {
    Vec<D> v = p_.velocity(k);
    if (is_fluid(k))
      for (int a = 0; a < D; ++a) v[a] -= fallen * still_gravity_[a];
    return v;
  };
  const Vec<D> own = velocity(i);
  Vec<D> v = velocity(j);
  for (int a = 0; a < D; ++a) v[a] -= own[a];
  if (wall_normal_.empty() || is_fluid(i) == is_fluid(j)) return v;
  const Vec<D>& n = wall_normal_[static_cast<std::size_t>(p_.id[is_fluid(i) ? j : i])];
  double along = 0.0;
  for (int a = 0; a < D; ++a) along += v[a] * n[a];
  for (int a = 0; a < D; ++a) v[a] = along * n[a];
  return v;
}

/// Divergence of the velocity that this step's pressure takes back, 1/s. What this step's motion
/// has made, -dt tr(grad v grad v), goes at once. The rest is what the models of divergence,
/// gradient and Laplacian, which do not belong together, have left over, and goes within
/// divergence_time_: taken back in every step it would come as pulses, the stronger the shorter the
/// step. The source is that of the MAC method (Harlow & Welch 1965, Phys. Fluids 8), the time that
/// of Baumgarte's stabilisation of constraints (1972, Comput. Methods Appl. Mech. Eng. 1).
template <int D>
double Solver<D>::divergence_to_remove(std::size_t i, double dt,
                                       const Displacement<D>& displacement) const {
  // What gravity has just added to the fluid, and not to the walls, is in still_source().
  const double fallen = params_.laplacian_of == LaplacianOf::dynamic_pressure ? dt : 0.0;
  const auto relative = [&](std::size_t j) { return relative_velocity(i, j, fallen); };
  const auto everyone = [](std::size_t) { return true; };
  const bool exact = params_.gradient == GradientModel::corrected;
  std::optional<std::array<Vec<D>, D>> gradient;
  if (exact || dt < divergence_time_)
    gradient = velocity_gradient<D>(i, list_.of(i), displacement, re_, n0_, least_pivot, relative,
                                    everyone);
  double divergence = 0.0;
  if (gradient && exact) {
    for (int a = 0; a < D; ++a) divergence += (*gradient)[a][a];
  } else {
    divergence = velocity_divergence<D>(i, list_.of(i), displacement, re_, n0_, relative, everyone);
  }
  if (dt >= divergence_time_) return divergence;
  const double made = gradient ? -dt * convected_divergence<D>(*gradient) : 0.0;
  return made + dt / divergence_time_ * (divergence - made);
}

template <int D>
void Solver<D>::solve_pressure(double dt, StepReport& report) {
  const auto scope = clock_.measure(Phase::pressure);
  const Displacement<D> displacement(p_.x, periodicity_);
  assembly_.assemble(p_, list_, displacement, unknown_, unknowns_);
  linear::PoissonSystem& system = assembly_.system();
  unknown_pressure_.resize(unknowns_);
  const auto n = static_cast<std::ptrdiff_t>(p_.size());
  loop_.each(p_.size(), [&](std::size_t i) {
    if (unknown_[i] < 0) return;
    const auto row = static_cast<std::size_t>(unknown_[i]);
    system.rhs[row] = source(i, dt, displacement);
    unknown_pressure_[row] = p_.pressure[i];
  });
  const linear::SolveReport solve = pressure_solver_.solve(system, unknown_pressure_);
  report.ppe_iterations = solve.iterations;
  report.ppe_residual = solve.residual;
  report.ppe_converged = solve.converged;
  if (!solve.converged && solve.residual > largest_residual) {
    throw Error("pressure: the solver stopped after " + std::to_string(solve.iterations) +
                " iterations at a residual of " + number_text(solve.residual) +
                ", expected at most " + number_text(params_.ppe_tolerance) +
                " (mps.ppe_max_iterations, mps.ppe_solver)");
  }
  report.ppe_setup_s = solve.setup_s;
  report.ppe_solve_s = solve.solve_s;
  const bool clip = params_.negative_pressure == NegativePressure::clip;
  long clipped = 0;
#pragma omp parallel for schedule(static, stretch) reduction(+ : clipped)
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    if (unknown_[i] < 0) continue;
    double p = unknown_pressure_[unknown_[i]];
    if (clip && p < 0.0) {
      p = 0.0;
      clipped += p_.type[i] == ParticleType::fluid ? 1 : 0;
    }
    p_.pressure[i] = p;
  }
  report.clipped = clipped;
}

// Eq. (11)
/// v' = -dt/rho grad P, and the positions that follow from it.
template <int D>
void Solver<D>::correct(double dt, StepReport& report) {
  {
    const auto scope = clock_.measure(Phase::forces);
    const Displacement<D> displacement(p_.x, periodicity_);
    find_minima(displacement);
    for_each_fluid([&](std::size_t i) {
      const Vec<D> grad = pressure_gradient(i, displacement);
      for (int a = 0; a < D; ++a) correction_[a][i] = -dt / rho_ * grad[a];
    });
    if (params_.surface_at == SurfaceAt::half_spacing) update_surface_pressure(dt, displacement);
    for_each_fluid([&](std::size_t i) {
      for (int a = 0; a < D; ++a) p_.v[a][i] += correction_[a][i];
    });
  }
  if (params_.position_update == PositionUpdate::mean_velocity) {
    // The particles have gone dt v*: from there to dt (v + v')/2, v being the velocity before
    // gravity.
    for_each_fluid([&](std::size_t i) {
      for (int a = 0; a < D; ++a) correction_[a][i] = 0.5 * (correction_[a][i] - dt * gravity_[a]);
    });
  }
  move(dt, correction_, report);
}

/// The pressure in the middle of the surface's layer, by the gradient of this step, for the next.
template <int D>
void Solver<D>::update_surface_pressure(double dt, const Displacement<D>& displacement) {
  find_concentration_gradient(displacement);
  for_each_fluid([&](std::size_t i) {
    surface_pressure_[i] = 0.0;
    // Spray falls freely, and so do tips and edges: what is outside of them is not a layer.
    if (on_free_surface(p_.density[i], edge, layer_thickness_.flat_density(n0_))) return;
    const Vec<D> inward = surface_normal(i, displacement);
    const double length = std::sqrt(squared_norm<D>(inward));
    if (length == 0.0) return;
    double slope = 0.0;  // of the pressure, inwards
    for (int a = 0; a < D; ++a) slope -= rho_ / dt * correction_[a][i] * inward[a] / length;
    const double thickness = layer_thickness_(
        i, list_.of(i), displacement, [&](std::size_t j) { return is_fluid(j) && is_surface(j); });
    surface_pressure_[i] = std::max(0.0, 0.5 * thickness * slope);
  });
}

template <int D>
void Solver<D>::find_concentration_gradient(const Displacement<D>& displacement) {
  for_each_fluid([&](std::size_t i) {
    const Vec<D> g = concentration_gradient<D>(i, list_.of(i), displacement, re_, n0_);
    for (int a = 0; a < D; ++a) concentration_gradient_[a][i] = g[a];
  });
}

/// Particles take the velocity that the fluid has where they are shifted to, v += (dx . grad) v
/// (Lind et al. 2012).
template <int D>
void Solver<D>::shift_particles(double dt, StepReport& report) {
  if (params_.shifting == 0.0) return;
  {
    const auto scope = clock_.measure(Phase::forces);
    const Displacement<D> displacement(p_.x, periodicity_);
    find_concentration_gradient(displacement);
    for_each_fluid([&](std::size_t i) {
      const Vec<D> s = shift_of(i, dt, displacement);
      const auto gradient = velocity_gradient<D>(
          i, list_.of(i), displacement, re_, n0_, least_pivot,
          [&](std::size_t j) {
            Vec<D> v = p_.velocity(j);
            for (int a = 0; a < D; ++a) v[a] -= p_.v[a][i];
            return v;
          },
          [&](std::size_t j) { return is_fluid(j); });
      for (int a = 0; a < D; ++a) {
        correction_[a][i] = s[a] / dt;
        carried_[a][i] = 0.0;
        if (!gradient) continue;
        for (int b = 0; b < D; ++b) carried_[a][i] += (*gradient)[a][b] * s[b];
      }
    });
    for_each_fluid([&](std::size_t i) {
      for (int a = 0; a < D; ++a) p_.v[a][i] += carried_[a][i];
    });
  }
  move(dt, correction_, report);
}

/// m
template <int D>
Vec<D> Solver<D>::shift_of(std::size_t i, double dt, const Displacement<D>& displacement) const {
  // Spray and edges have no inside to be evened out, nor a direction along the surface.
  if (on_free_surface(p_.density[i], edge, layer_thickness_.flat_density(n0_))) return {};
  Vec<D> g;
  for (int a = 0; a < D; ++a) g[a] = concentration_gradient_[a][i];
  Vec<D> s = shift<D>(g, surface_normal(i, displacement), params_.shifting, spacing_, v_max_ * dt);
  const double limit = dt * relative_speed<D>(i, list_.of(i), displacement, re_, p_.v,
                                              [&](std::size_t j) { return is_fluid(j); });
  const double length = std::sqrt(squared_norm<D>(s));
  if (length > limit)
    for (double& component : s) component *= limit / length;
  return s;
}

/// Mean of the concentration's gradient over the surface particles around: along the normal of the
/// surface, and smoother than that of one of them. Zero where there is no surface.
template <int D>
Vec<D> Solver<D>::surface_normal(std::size_t i, const Displacement<D>& displacement) const {
  Vec<D> sum{};
  const auto add = [&](std::size_t j, double weight) {
    for (int a = 0; a < D; ++a) sum[a] += weight * concentration_gradient_[a][j];
  };
  if (is_surface(i)) add(i, 1.0);
  for (const std::uint32_t j : list_.of(i)) {
    const double r = std::sqrt(squared_norm<D>(displacement(i, j)));
    if (r < re_ && is_fluid(j) && is_surface(j)) add(j, mps_weight(r, re_));
  }
  return sum;
}

template <int D>
void Solver<D>::find_minima(const Displacement<D>& displacement) {
  loop_.each(p_.size(), [&](std::size_t i) {
    if (!has_pressure(i)) return;
    least_[i] = neighbourhood_minimum<D>(
        i, list_.of(i), displacement, re_, [&](std::size_t j) { return p_.pressure[j]; },
        [&](std::size_t j) { return has_pressure(j); });
  });
}

/// Eq. (13), in which the neighbourhood minimum of Eq. (6) stands where the paper prints P_i, or
/// one of the other models.
template <int D>
Vec<D> Solver<D>::pressure_gradient(std::size_t i, const Displacement<D>& displacement) const {
  const auto pressure = [&](std::size_t j) { return p_.pressure[j]; };
  const auto least = [&](std::size_t j) { return least_[j]; };
  const auto counts = [&](std::size_t j) { return has_pressure(j); };
  if (params_.gradient == GradientModel::conserving)
    return conserving_gradient<D>(i, list_.of(i), displacement, re_, n0_, pressure, least, counts);
  if (params_.gradient == GradientModel::corrected) {
    if (const auto grad = corrected_gradient<D>(i, list_.of(i), displacement, re_, n0_, least_pivot,
                                                pressure, counts))
      return *grad;
  }
  return gradient<D>(i, list_.of(i), displacement, re_, n0_, least_[i], pressure, counts);
}

template <int D>
void Solver<D>::measure_speed(StepReport& report) {
  v_max_ = fastest_speed(p_);
  report.v_max = v_max_;
}

template class Solver<2>;
template class Solver<3>;

}  // namespace surge::mps
