#include "particle/isph/solver.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "particle/core/fastest_speed.hpp"
#include "particle/core/initial_particles.hpp"
#include "particle/core/move_fluid.hpp"
#include "particle/core/time_step.hpp"
#include "particle/core/wall_normals.hpp"
#include "particle/isph/gradient.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::isph {
namespace {

/// A pressure whose equation holds to no more than this is none: the run ends.
constexpr double largest_residual = 0.1;

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

/// Normals of the walls where they are smooth.
template <int D>
std::vector<Vec<D>> smooth_normals(const Case& c, const Params& params, const Model<D>& model) {
  if (model.no_slip) return {};
  return wall_normals<D>(c, initial_particles<D>(c, wall_layers(params)));
}

}  // namespace

template <int D>
Solver<D>::Solver(const Case& c, const Params& params, Search search)
    : Solver(c, params, search, initial_state<D>(c, params)) {
  const auto scope = clock_.measure(Phase::setup);
  find_free_surface();
}

template <int D>
Solver<D>::Solver(const Case& c, const Params& params, Search search, State<D> state)
    : params_(params),
      control_(c.time),
      model_(c, params),
      s_(std::move(state)),
      body_force_(c),
      movers_(c, initial_particles<D>(c, wall_layers(params)), wall_layers(params)),
      walls_(c, params.wall_distance * c.spacing, params.wall_restitution),
      surface_(params),
      equation_(model_, smooth_normals<D>(c, params, model_)),
      shift_(params.shifting),
      grid_(search, periodicity_of<D>(c)),
      periodicity_(periodicity_of<D>(c)),
      pressure_solver_({params.ppe_solver, params.ppe_tolerance, params.ppe_max_iterations,
                        support_of(params.kernel) * params.h_over_l0}) {
  const auto scope = clock_.measure(Phase::setup);
  const std::size_t n = s_.p.size();
  for (int a = 0; a < D; ++a) {
    change_[a].assign(n, 0.0);
    old_velocity_[a].assign(n, 0.0);
    wall_acceleration_[a].assign(movers_.empty() ? 0 : n, 0.0);
    equation_.system().period[a] = periodicity_.length[a];
  }
  unknown_.assign(n, -1);
  // Neighbours are found anew where they were found last, from which the particles have moved on.
  s_.p.x.swap(s_.found_x);
  std::array<Field, D> now = s_.found_x;
  find_neighbours();
  for (int a = 0; a < D; ++a) grid_.reorder(now[a]);
  s_.p.x = std::move(now);
}

template <int D>
double Solver<D>::stable_step() const {
  // The pairs of the viscous term are stiffer than those of the Laplacian by (D + 2)/D.
  double dt = std::min(courant_step(control_, model_.spacing, s_.v_max),
                       viscous_step(0.125 * D / (D + 2.0), model_.h, viscosity()));
  if (!movers_.empty()) dt = movers_.step_limit(s_.time, dt, control_.courant * model_.spacing);
  return s_.steps == 0 ? std::min(dt, control_.initial_step) : dt;
}

template <int D>
StepReport Solver<D>::step(double dt_limit) {
  StepReport report;
  const double dt = std::min(stable_step(), dt_limit);
  drift(dt, report);
  if (!movers_.empty()) place_moving_walls(dt);
  find_neighbours();
  apply_body_forces(dt);
  find_free_surface();
  solve_pressure(dt, report);
  correct(dt, report);
  if (params_.shifting > 0.0) shift_particles(dt, report);
  measure_speed(report);
  s_.time += dt;
  ++s_.steps;
  report.dt = dt;
  report.courant = s_.v_max * dt / model_.spacing;
  return report;
}

template <int D>
void Solver<D>::drift(double dt, StepReport& report) {
  walls_.move_walls(s_.time, s_.time + dt);
  move(dt, s_.p.v, report);
  walls_.move_walls(s_.time + dt, s_.time + dt);
}

template <int D>
void Solver<D>::place_moving_walls(double dt) {
  movers_.place(s_.p, s_.time, s_.time + dt, wall_acceleration_);
}

template <int D>
void Solver<D>::move(double dt, const std::array<Field, D>& velocity, StepReport& report) {
  const auto scope = clock_.measure(Phase::forces);
  move_fluid<D>(s_.p, walls_, dt, velocity, report);
}

template <int D>
void Solver<D>::find_neighbours() {
  const auto scope = clock_.measure(Phase::neighbours);
  grid_.build(s_.p.x, model_.radius, 2);
  grid_.reorder(s_.p);
  grid_.reorder(s_.surface_pressure);
  for (int a = 0; a < D; ++a) {
    if (!wall_acceleration_[a].empty()) grid_.reorder(wall_acceleration_[a]);
    s_.found_x[a].assign(s_.p.x[a].begin(), s_.p.x[a].end());
  }
  list_.build(grid_, s_.p.x, model_.radius, [](std::size_t) { return true; });
}

template <int D>
void Solver<D>::apply_body_forces(double dt) {
  const auto scope = clock_.measure(Phase::forces);
  Particles<D>& p = s_.p;
  for (int a = 0; a < D; ++a) old_velocity_[a].assign(p.v[a].begin(), p.v[a].end());
  if (viscosity() > 0.0) viscosity_.add(view(), viscosity(), dt, p.v);
  const BodyKick<D> kick(body_acceleration(dt), dt);
  view().for_each_fluid([&](std::size_t i) {
    const Vec<D> v = kick(p.position(i), p.velocity(i), {});
    for (int a = 0; a < D; ++a) p.v[a][i] = v[a];
  });
}

template <int D>
void Solver<D>::find_free_surface() {
  const auto scope = clock_.measure(Phase::pressure);
  unknowns_ =
      surface_.find(view(), walls_, s_.surface_pressure, s_.p.density, unknown_, s_.p.pressure);
}

template <int D>
void Solver<D>::solve_pressure(double dt, StepReport& report) {
  const auto scope = clock_.measure(Phase::pressure);
  const View<D> now = view();
  const linear::PoissonSystem& system = equation_.assemble(
      now, unknowns_, body_force_.still(body_acceleration(dt)), wall_acceleration_, dt);
  unknown_pressure_.resize(unknowns_);
  now.for_each([&](std::size_t i) {
    if (unknown_[i] >= 0)
      unknown_pressure_[static_cast<std::size_t>(unknown_[i])] = s_.p.pressure[i];
  });
  const linear::SolveReport solve = pressure_solver_.solve(system, unknown_pressure_);
  report.ppe_iterations = solve.iterations;
  report.ppe_residual = solve.residual;
  report.ppe_converged = solve.converged;
  report.ppe_setup_s = solve.setup_s;
  report.ppe_solve_s = solve.solve_s;
  if (!solve.converged && solve.residual > largest_residual) {
    throw Error("pressure: the solver stopped after " + std::to_string(solve.iterations) +
                " iterations at a residual of " + number_text(solve.residual) +
                ", expected at most " + number_text(params_.ppe_tolerance) +
                " (isph.ppe_max_iterations, isph.ppe_solver)");
  }
  now.for_each([&](std::size_t i) {
    if (unknown_[i] >= 0)
      s_.p.pressure[i] = unknown_pressure_[static_cast<std::size_t>(unknown_[i])];
  });
}

template <int D>
void Solver<D>::correct(double dt, StepReport& report) {
  Particles<D>& p = s_.p;
  {
    const auto scope = clock_.measure(Phase::forces);
    const View<D> now = view();
    const auto has_pressure = [&](std::size_t j) { return unknown_[j] >= 0 || now.is_fluid(j); };
    with_kernel(model_, [&](const auto& kernel) {
      now.for_each_fluid([&](std::size_t i) {
        const Vec<D> slope = gradient(
            now, kernel, i, [&](std::size_t j) { return p.pressure[j] - p.pressure[i]; },
            has_pressure);
        for (int a = 0; a < D; ++a) change_[a][i] = -dt / model_.rho * slope[a];
      });
    });
    surface_.find_concentration_gradient(now);
    surface_.update_pressure(now, dt, change_, s_.surface_pressure);
    now.for_each_fluid([&](std::size_t i) {
      for (int a = 0; a < D; ++a) {
        p.v[a][i] += change_[a][i];
        // The particles have gone dt v: from there to dt (v + v')/2.
        change_[a][i] = 0.5 * (p.v[a][i] - old_velocity_[a][i]);
      }
    });
  }
  move(dt, change_, report);
}

template <int D>
void Solver<D>::shift_particles(double dt, StepReport& report) {
  {
    const auto scope = clock_.measure(Phase::forces);
    shift_.find(view(), surface_, s_.v_max, dt, s_.p.v, change_);
  }
  move(dt, change_, report);
}

template <int D>
void Solver<D>::measure_speed(StepReport& report) {
  s_.v_max = fastest_speed(s_.p);
  report.v_max = s_.v_max;
}

template class Solver<2>;
template class Solver<3>;

}  // namespace surge::isph
