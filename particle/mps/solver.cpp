#include "particle/mps/solver.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "particle/core/fastest_speed.hpp"
#include "particle/core/initial_particles.hpp"
#include "particle/core/time_step.hpp"
#include "particle/mps/free_surface.hpp"
#include "particle/mps/gradient.hpp"
#include "particle/mps/laplacian.hpp"
#include "particle/mps/number_density.hpp"
#include "particle/mps/velocity_divergence.hpp"
#include "particle/support/error.hpp"

namespace surge::mps {
namespace {

constexpr int wall_layers = 3;  ///< the paper's; the inner one carries pressure

template <int D>
double factor_of(const Params& params, double l0) {
  return laplacian_factor<D>(reference_number_density<D>(params.re_laplacian),
                             laplacian_lambda<D>(params.lambda, params.re_laplacian, l0));
}

}  // namespace

template <int D>
Solver<D>::Solver(const Case& c)
    : params_(std::get<Params>(c.method)),
      control_(c.time),
      spacing_(c.spacing),
      rho_(c.density),
      nu_(c.kinematic_viscosity),
      no_slip_(c.has_tank && c.tank.wall == WallCondition::no_slip),
      re_(params_.re_gradient * c.spacing),
      re_laplacian_(params_.re_laplacian * c.spacing),
      n0_(reference_number_density<D>(params_.re_gradient)),
      laplacian_factor_(factor_of<D>(params_, c.spacing)),
      viscous_lambda_(laplacian_lambda<D>(Lambda::lattice, params_.re_laplacian, c.spacing)),
      collision_(params_.collision_distance * c.spacing, params_.collision_restitution),
      walls_(c, params_.wall_distance * c.spacing, params_.collision_restitution),
      p_(initial_particles<D>(c, wall_layers)),
      grid_(c.search, periodicity_of<D>(c)),
      periodicity_(periodicity_of<D>(c)),
      assembly_(re_laplacian_, laplacian_factor_, c.spacing),
      pressure_solver_(params_) {
  const auto scope = clock_.measure(Phase::setup);
  std::copy_n(c.gravity.begin(), D, gravity_.begin());
  for (int a = 0; a < D; ++a) correction_[a].assign(p_.size(), 0.0);
  for (int a = 0; a < D; ++a) {
    rubbing_velocity_[a].assign(p_.size(), 0.0);
    assembly_.system().period[a] = periodicity_.length[a];
  }
  least_.assign(p_.size(), 0.0);
  unknown_.assign(p_.size(), -1);
  find_neighbours();
  compute_number_density();
  StepReport ignored;
  measure_speed(ignored);
}

template <int D>
double Solver<D>::stable_step() const {
  const double dt = std::min(courant_step(control_, spacing_, v_max_),
                             viscous_step(0.25 / (D + 2), std::sqrt(viscous_lambda_), nu_));
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
  const auto n = static_cast<std::ptrdiff_t>(p_.size());
#pragma omp parallel for schedule(static, stretch)
  for (std::ptrdiff_t i = 0; i < n; ++i)
    if (is_fluid(static_cast<std::size_t>(i))) f(static_cast<std::size_t>(i));
}

/// Temporal velocity v* = v + dt (g + nu lap v).
template <int D>
void Solver<D>::apply_body_forces(double dt) {
  const auto scope = clock_.measure(Phase::forces);
  if (nu_ > 0.0) add_viscosity(dt);
  for_each_fluid([&](std::size_t i) {
    for (int a = 0; a < D; ++a) p_.v[a][i] += dt * gravity_[a];
  });
}

/// The viscous term with the neighbours of the step before. A no-slip wall counts, a slip wall does
/// not. Two neighbours' sums bound the eigenvalues, by which stable_step() is half the stable one.
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
      nu_ * laplacian_factor<D>(reference_number_density<D>(params_.re_laplacian), viscous_lambda_);
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
/// 231, Eqs. 22 and 23, there for SPH).
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
  // Only the viscous term asks who is near a dummy.
  const bool all = no_slip_ && nu_ > 0.0;
  list_.build(grid_, p_.x, re_laplacian_, [&](std::size_t i) { return all || has_pressure(i); });
}

template <int D>
void Solver<D>::collide(double dt, StepReport& report) {
  long collisions = 0;
  {
    const auto scope = clock_.measure(Phase::forces);
    const Displacement<D> displacement(p_.x, periodicity_);
    const auto n = static_cast<std::ptrdiff_t>(p_.size());
#pragma omp parallel for schedule(static, stretch) reduction(+ : collisions)
    for (std::ptrdiff_t k = 0; k < n; ++k) {
      const auto i = static_cast<std::size_t>(k);
      if (!is_fluid(i)) continue;
      const Vec<D> change = collision_.velocity_change(
          i, list_.of(i), displacement, p_.v, [&](std::size_t j) { return !is_fluid(j); },
          collisions);
      for (int a = 0; a < D; ++a) correction_[a][i] = change[a];
    }
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
  const auto n = static_cast<std::ptrdiff_t>(p_.size());
#pragma omp parallel for schedule(static, stretch)
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (has_pressure(i)) p_.density[i] = number_density<D>(i, list_.of(i), displacement, re_);
  }
}

template <int D>
bool Solver<D>::is_on_surface(std::size_t i, const Displacement<D>& displacement) const {
  if (!on_free_surface(p_.density[i], params_.beta, n0_)) return false;
  if (params_.surface_offset == 0.0 || on_free_surface(p_.density[i], thin_sheet, n0_)) return true;
  return neighbour_offset<D>(i, list_.of(i), displacement, re_, n0_, spacing_) >
         params_.surface_offset;
}

/// Numbers the particles whose pressure is unknown; the others get p = 0.
template <int D>
void Solver<D>::find_free_surface() {
  const auto scope = clock_.measure(Phase::pressure);
  unknowns_ = 0;
  const Displacement<D> displacement(p_.x, periodicity_);
  const auto n = static_cast<std::ptrdiff_t>(p_.size());
#pragma omp parallel for schedule(static, stretch)
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const bool solved = has_pressure(i) && !is_on_surface(i, displacement);
    unknown_[i] = solved ? 0 : -1;
    if (!solved) p_.pressure[i] = 0.0;
  }
  for (std::ptrdiff_t i = 0; i < n; ++i)
    if (unknown_[i] == 0) unknown_[i] = static_cast<std::int32_t>(unknowns_++);
}

/// Pa/m^2, with the sign of the Laplacian turned.
template <int D>
double Solver<D>::source(std::size_t i, double dt, const Displacement<D>& displacement) const {
  if (params_.source == Source::number_density)
    return poisson_source(p_.density[i], n0_, rho_, dt, params_.source_relaxation);
  const double divergence = velocity_divergence<D>(i, list_.of(i), displacement, re_, n0_, p_.v,
                                                   [](std::size_t) { return true; });
  return params_.source_relaxation *
         mixed_source(divergence, p_.density[i], n0_, rho_, dt, params_.density_share);
}

template <int D>
void Solver<D>::solve_pressure(double dt, StepReport& report) {
  const auto scope = clock_.measure(Phase::pressure);
  const Displacement<D> displacement(p_.x, periodicity_);
  assembly_.assemble(p_, list_, displacement, unknown_, unknowns_);
  PoissonSystem& system = assembly_.system();
  unknown_pressure_.resize(unknowns_);
  const auto n = static_cast<std::ptrdiff_t>(p_.size());
#pragma omp parallel for schedule(static, stretch)
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    if (unknown_[i] < 0) continue;
    system.rhs[unknown_[i]] = source(static_cast<std::size_t>(i), dt, displacement);
    unknown_pressure_[unknown_[i]] = p_.pressure[i];
  }
  const SolveReport solve = pressure_solver_.solve(system, unknown_pressure_);
  report.ppe_iterations = solve.iterations;
  report.ppe_residual = solve.residual;
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
/// v' = -dt/rho grad P.
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
    for_each_fluid([&](std::size_t i) {
      for (int a = 0; a < D; ++a) p_.v[a][i] += correction_[a][i];
    });
  }
  move(dt, correction_, report);
}

template <int D>
void Solver<D>::find_minima(const Displacement<D>& displacement) {
  const auto n = static_cast<std::ptrdiff_t>(p_.size());
#pragma omp parallel for schedule(static, stretch)
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (!has_pressure(i)) continue;
    least_[i] = neighbourhood_minimum<D>(
        i, list_.of(i), displacement, re_, [&](std::size_t j) { return p_.pressure[j]; },
        [&](std::size_t j) { return has_pressure(j); });
  }
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
  if (params_.gradient == GradientModel::corrected && p_.density[i] >= thin_sheet * n0_) {
    if (const auto grad =
            corrected_gradient<D>(i, list_.of(i), displacement, re_, n0_, 0.3, pressure, counts))
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
