#include "particle/mps/solver.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>

#include "particle/core/fastest_speed.hpp"
#include "particle/core/initial_particles.hpp"
#include "particle/core/move_fluid.hpp"
#include "particle/core/parallel_for.hpp"
#include "particle/core/wall_normals.hpp"
#include "particle/mps/number_density.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::mps {
namespace {

/// A pressure whose equation holds to no more than this is none: the run ends.
constexpr double largest_residual = 0.1;

/// Normals of the walls where they are smooth.
template <int D>
std::vector<Vec<D>> smooth_normals(const Case& c, const Params& params, const Model<D>& model) {
  if (params.wall_coupling != WallCoupling::fluid || model.no_slip) return {};
  return wall_normals<D>(c, initial_particles<D>(c, wall_layers(params)));
}

template <int D>
State<D> initial_state(const Case& c, const Params& params) {
  State<D> s;
  s.p = initial_particles<D>(c, wall_layers(params));
  s.surface_pressure.assign(s.p.size(), 0.0);
  MovingWalls<D>(c, s.p, wall_layers(params)).place(s.p, 0.0);
  s.v_max = fastest_speed(s.p);
  s.found_x = s.p.x;
  return s;
}

}  // namespace

template <int D>
Solver<D>::Solver(const Case& c, const Params& params, Search search)
    : Solver(c, params, search, initial_state<D>(c, params)) {
  const auto scope = clock_.measure(Phase::setup);
  list_neighbours(true);  // walls that no water ever meets keep this number density
  compute_number_density();
}

template <int D>
Solver<D>::Solver(const Case& c, const Params& params, Search search, State<D> state)
    : params_(params),
      initial_step_(c.time.initial_step),
      limits_(c, params),
      model_(c, params),
      s_(std::move(state)),
      body_force_(c),
      movers_(c, initial_particles<D>(c, wall_layers(params)), wall_layers(params)),
      walls_(c, params.wall_distance * c.spacing, params.collision_restitution),
      collision_(params.collision_distance * c.spacing, params.collision_restitution),
      viscosity_(params.viscous_term),
      surface_(params),
      source_(params, smooth_normals<D>(c, params, model_)),
      pressure_correction_(params.gradient),
      shift_(params.shifting),
      dry_walls_count_(params.wall_coupling == WallCoupling::all || !movers_.empty() ||
                       search == Search::all_pairs),
      grid_(search, periodicity_of<D>(c)),
      periodicity_(periodicity_of<D>(c)),
      assembly_(model_.re_laplacian, model_.laplacian_factor, c.spacing,
                params.wall_coupling == WallCoupling::all),
      pressure_solver_({params.ppe_solver, params.ppe_tolerance, params.ppe_max_iterations,
                        params.re_laplacian}) {
  const auto scope = clock_.measure(Phase::setup);
  // The neighbours of both sums are looked for within the Laplacian's radius.
  if (params_.re_gradient > params_.re_laplacian) {
    throw Error("mps.re_gradient: found " + number_text(params_.re_gradient) +
                ", expected at most mps.re_laplacian = " + number_text(params_.re_laplacian));
  }
  for (int a = 0; a < D; ++a) {
    correction_[a].assign(s_.p.size(), 0.0);
    old_velocity_[a].assign(s_.p.size(), 0.0);
    wall_acceleration_[a].assign(movers_.empty() ? 0 : s_.p.size(), 0.0);
    assembly_.system().period[a] = periodicity_.length[a];
  }
  unknown_.assign(s_.p.size(), -1);
  // Neighbours are found anew where they were found last, from which the particles have moved on.
  s_.p.x.swap(s_.found_x);
  std::array<Field, D> now = s_.found_x;
  find_neighbours();
  for (int a = 0; a < D; ++a) grid_.reorder(now[a]);
  s_.p.x = std::move(now);
}

template <int D>
double Solver<D>::stable_step() const {
  const Vec<D> g = body_force_.still(body_force_.at(s_.time, s_.time, s_.time)).uniform;
  double dt = limits_(s_.v_max, std::sqrt(squared_norm<D>(g)));
  if (!movers_.empty()) dt = movers_.step_limit(s_.time, dt, limits_.courant() * model_.spacing);
  return s_.steps == 0 ? std::min(dt, initial_step_) : dt;
}

template <int D>
StepReport Solver<D>::step(double dt_limit) {
  StepReport report;
  const double dt = std::min(stable_step(), dt_limit);
  apply_body_forces(dt);
  if (!movers_.empty()) place_moving_walls(dt);  // if moving_walls
  move(dt, s_.p.v, report);
  walls_.move_walls(s_.time + dt, s_.time + dt);
  collide(dt, report);
  find_neighbours();
  compute_number_density();
  find_free_surface();
  solve_pressure(dt, report);
  correct(dt, report);
  if (params_.shifting > 0.0) shift_particles(dt, report);  // if shifting
  measure_speed(report);
  s_.time += dt;
  ++s_.steps;
  report.dt = dt;
  report.courant = s_.v_max * dt / model_.spacing;
  return report;
}

template <int D>
void Solver<D>::apply_body_forces(double dt) {
  const auto scope = clock_.measure(Phase::forces);
  Particles<D>& p = s_.p;
  for (int a = 0; a < D; ++a) old_velocity_[a].assign(p.v[a].begin(), p.v[a].end());
  const double nu = limits_.viscosity(s_.v_max);
  if (nu > 0.0) viscosity_.add(view(), nu, dt, p.v);
  const BodyAcceleration<D> g = body_acceleration(dt);
  if (!g.turns) {
    view().for_each_fluid([&](std::size_t i) {
      for (int a = 0; a < D; ++a) p.v[a][i] += dt * g.uniform[a];
    });
    return;
  }
  const BodyKick<D> kick(g, dt);
  view().for_each_fluid([&](std::size_t i) {
    Vec<D> middle = p.position(i);
    for (int a = 0; a < D; ++a) middle[a] += 0.5 * dt * p.v[a][i];
    const Vec<D> v = kick(middle, p.velocity(i), {});
    for (int a = 0; a < D; ++a) p.v[a][i] = v[a];
  });
}

template <int D>
void Solver<D>::place_moving_walls(double dt) {
  movers_.place(s_.p, s_.time, s_.time + dt, wall_acceleration_);
  walls_.move_walls(s_.time, s_.time + dt);
}

template <int D>
void Solver<D>::move(double dt, const std::array<Field, D>& velocity, StepReport& report) {
  const auto scope = clock_.measure(Phase::forces);
  move_fluid<D>(s_.p, walls_, dt, velocity, report);
}

template <int D>
void Solver<D>::find_neighbours() {
  const auto scope = clock_.measure(Phase::neighbours);
  grid_.build(s_.p.x, model_.re_laplacian, 2);
  grid_.reorder(s_.p);
  grid_.reorder(s_.surface_pressure);
  for (int a = 0; a < D; ++a) {
    grid_.reorder(old_velocity_[a]);
    if (!movers_.empty()) grid_.reorder(wall_acceleration_[a]);
  }
  for (int a = 0; a < D; ++a) s_.found_x[a].assign(s_.p.x[a].begin(), s_.p.x[a].end());
  list_neighbours(dry_walls_count_);
}

template <int D>
void Solver<D>::list_neighbours(bool of_dry_walls) {
  // Only the viscous term asks who is near a dummy.
  const bool all = model_.no_slip;
  const auto wanted = [&](std::size_t i) { return all || s_.p.type[i] != ParticleType::dummy; };
  if (of_dry_walls) {
    list_.build(grid_, s_.p.x, model_.re_laplacian, wanted);
    return;
  }
  fluid_before_.resize(s_.p.size() + 1);
  prefix_sums_(
      s_.p.size(), [&](std::size_t i) { return s_.p.type[i] == ParticleType::fluid ? 1 : 0; },
      fluid_before_.data());
  const auto near_fluid = [&](std::size_t cell) {
    bool found = false;
    grid_.for_each_segment(cell, [&](const auto& s) {
      found = found || fluid_before_[s.end] > fluid_before_[s.begin];
    });
    return found;
  };
  list_.build(grid_, s_.p.x, model_.re_laplacian, near_fluid, wanted);
}

/// Whether two particles that are now within `reach` (m) of each other were so near when neighbours
/// were last listed that each is in the list of the other.
template <int D>
bool Solver<D>::lists_all_within(double reach) const {
  const auto n = static_cast<std::ptrdiff_t>(s_.p.size());
  const auto look = [&](std::ptrdiff_t i, double& furthest2) {
    double square = 0.0;
    for (int a = 0; a < D; ++a) square += std::pow(s_.p.x[a][i] - s_.found_x[a][i], 2);
    furthest2 = std::max(furthest2, square);
  };
  const double furthest2 = parallel_reduce(n, worth_sharing, 0.0, look, larger);
  return reach + 2.0 * std::sqrt(furthest2) < model_.re_laplacian;
}

template <int D>
void Solver<D>::collide(double dt, StepReport& report) {
  // Who meets now was near in the step before: the list made there tells, and what the collisions
  // move needs no second one.
  if (!lists_all_within(params_.collision_distance * model_.spacing)) find_neighbours();
  std::atomic<long> collisions = 0;
  {
    const auto scope = clock_.measure(Phase::forces);
    const View<D> now = view();
    now.for_each_fluid([&](std::size_t i) {
      long met = 0;
      const Vec<D> change = collision_.velocity_change(
          i, list_.of(i), now.displacement, s_.p.v, [&](std::size_t j) { return !now.is_fluid(j); },
          params_.collision_speed * s_.v_max, met);
      for (int a = 0; a < D; ++a) correction_[a][i] = change[a];
      if (met > 0) collisions.fetch_add(met, std::memory_order_relaxed);
    });
    if (collisions == 0) return;
    now.for_each_fluid([&](std::size_t i) {
      for (int a = 0; a < D; ++a) s_.p.v[a][i] += correction_[a][i];
    });
  }
  report.particle_collisions = collisions;
  move(dt, correction_, report);
}

template <int D>
void Solver<D>::compute_number_density() {
  const auto scope = clock_.measure(Phase::pressure);
  const View<D> now = view();
  now.for_each([&](std::size_t i) {
    // A wall without a list has no water near it: what stands there was found without any.
    const bool dry = !now.is_fluid(i) && list_.of(i).empty();
    if (now.has_pressure(i) && !dry)
      s_.p.density[i] = number_density<D>(i, list_.of(i), now.displacement, model_.re);
  });
}

template <int D>
void Solver<D>::find_free_surface() {
  const auto scope = clock_.measure(Phase::pressure);
  unknowns_ = surface_.find(view(), s_.surface_pressure, unknown_, s_.p.pressure);
}

template <int D>
void Solver<D>::solve_pressure(double dt, StepReport& report) {
  const auto scope = clock_.measure(Phase::pressure);
  const View<D> now = view();
  const BodyAcceleration<D> still = body_force_.still(body_acceleration(dt));
  assembly_.assemble(s_.p, list_, now.displacement, unknown_, unknowns_,
                     source_.even_slope(model_.rho, still, wall_acceleration_));
  linear::PoissonSystem& system = assembly_.system();
  source_.fill(now, assembly_, still, wall_acceleration_, dt, system.rhs);
  unknown_pressure_.resize(unknowns_);
  now.for_each([&](std::size_t i) {
    if (unknown_[i] >= 0)
      unknown_pressure_[static_cast<std::size_t>(unknown_[i])] = s_.p.pressure[i];
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
  take_pressures(report);
}

template <int D>
void Solver<D>::take_pressures(StepReport& report) {
  const auto n = static_cast<std::ptrdiff_t>(s_.p.size());
  const bool clip = params_.negative_pressure == NegativePressure::clip;
  const auto take = [&](std::ptrdiff_t i, long& clipped) {
    if (unknown_[i] < 0) return;
    double p = unknown_pressure_[unknown_[i]];
    if (clip && p < 0.0) {
      p = 0.0;
      clipped += s_.p.type[i] == ParticleType::fluid ? 1 : 0;
    }
    s_.p.pressure[i] = p;
  };
  report.clipped =
      parallel_reduce(n, worth_sharing, 0L, take, [](long& all, long own) { all += own; });
}

template <int D>
void Solver<D>::correct(double dt, StepReport& report) {
  Particles<D>& p = s_.p;
  {
    const auto scope = clock_.measure(Phase::forces);
    const View<D> now = view();
    pressure_correction_.find(now, dt, correction_);
    surface_.update_pressure(now, dt, correction_, s_.surface_pressure);
    now.for_each_fluid([&](std::size_t i) {
      for (int a = 0; a < D; ++a) p.v[a][i] += correction_[a][i];
    });
  }
  if (params_.position_update == PositionUpdate::mean_velocity) {
    // The particles have gone dt v*, v* = v' - correction: from there to dt (v + v')/2, v being the
    // velocity at the start of the step, before gravity, viscosity and collisions.
    view().for_each_fluid([&](std::size_t i) {
      for (int a = 0; a < D; ++a) correction_[a][i] += 0.5 * (old_velocity_[a][i] - p.v[a][i]);
    });
  }
  move(dt, correction_, report);
}

template <int D>
void Solver<D>::shift_particles(double dt, StepReport& report) {
  {
    const auto scope = clock_.measure(Phase::forces);
    shift_.find(view(), surface_, s_.v_max, dt, s_.p.v, correction_);
  }
  move(dt, correction_, report);
}

template <int D>
void Solver<D>::measure_speed(StepReport& report) {
  s_.v_max = fastest_speed(s_.p);
  report.v_max = s_.v_max;
}

template class Solver<2>;
template class Solver<3>;

}  // namespace surge::mps
