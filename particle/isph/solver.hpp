#pragma once

#include "particle/case/case.hpp"
#include "particle/core/balanced_loop.hpp"
#include "particle/core/body_force.hpp"
#include "particle/core/cell_grid.hpp"
#include "particle/core/clock.hpp"
#include "particle/core/moving_walls.hpp"
#include "particle/core/neighbour_list.hpp"
#include "particle/core/step_report.hpp"
#include "particle/core/wall_collision.hpp"
#include "particle/isph/model.hpp"
#include "particle/isph/params.hpp"
#include "particle/isph/pressure_equation.hpp"
#include "particle/isph/shift.hpp"
#include "particle/isph/state.hpp"
#include "particle/isph/surface.hpp"
#include "particle/isph/view.hpp"
#include "particle/isph/viscosity.hpp"
#include "particle/linear/pressure_solver.hpp"

namespace surge::isph {

/// Incompressible SPH by projection onto velocities without divergence (Cummins & Rudman 1999,
/// J. Comput. Phys. 152), with particle shifting (Lind et al. 2012, J. Comput. Phys. 231):
///   x* = x + dt v,  v* = v + dt (nu lap v + g)  at x*,
///   lap p = rho/dt div v*,  v' = v* - dt/rho grad p,  x' = x + dt (v + v')/2,
/// then a shift, along which the velocities are carried.
template <int D>
class Solver {
 public:
  Solver(const Case& c, const Params& params, Search search);
  /// Goes on from where another solver of the same case, options and build was, as that one would.
  Solver(const Case& c, const Params& params, Search search, State<D> state);

  /// Advances by stable_step() or dt_limit (s), whichever is shorter.
  StepReport step(double dt_limit);
  /// Courant's limit, that of viscosity, and that of a moving wall, s.
  [[nodiscard]] double stable_step() const;

  [[nodiscard]] double time() const { return s_.time; }
  [[nodiscard]] const Particles<D>& particles() const { return s_.p; }
  [[nodiscard]] const State<D>& state() const { return s_; }
  [[nodiscard]] Clock& clock() { return clock_; }
  [[nodiscard]] const AnyKernel<D>& kernel() const { return model_.kernel; }
  /// h, m
  [[nodiscard]] double smoothing_length() const { return model_.h; }

 private:
  // The first line of the comment on a function that step() calls is its box in the flowchart.
  /// Positions by the old velocities, held back at walls.
  void drift(double dt, StepReport& report);
  /// Moving walls to their new places.
  void place_moving_walls(double dt);
  /// Neighbours of each particle.
  void find_neighbours();
  /// Velocities by gravity and viscosity.
  /// And by the tank's motion.
  void apply_body_forces(double dt);
  /// Free surface, where p = 0.
  void find_free_surface();
  /// Pressure Poisson equation.
  void solve_pressure(double dt, StepReport& report);
  /// New velocities, positions by the mean of both.
  void correct(double dt, StepReport& report);
  /// Particles shifted apart, along the surface near it.
  void shift_particles(double dt, StepReport& report);
  /// Fastest particle.
  void measure_speed(StepReport& report);

  /// x += dt velocity for the fluid, held back at walls.
  void move(double dt, const std::array<Field, D>& velocity, StepReport& report);
  [[nodiscard]] BodyAcceleration<D> body_acceleration(double dt) const {
    return body_force_.at(s_.time + 0.5 * dt, s_.time, s_.time + dt);
  }
  /// Kinematic viscosity, numerical or not, m2/s.
  [[nodiscard]] double viscosity() const {
    return std::max(model_.nu, params_.numerical_viscosity * model_.spacing * s_.v_max);
  }
  [[nodiscard]] View<D> view() {
    return {model_, s_.p, list_, unknown_, Displacement<D>(s_.p.x, periodicity_), loop_};
  }

  Params params_;
  TimeControl control_;
  Model<D> model_;
  State<D> s_;
  BodyForce<D> body_force_;
  MovingWalls<D> movers_;
  WallCollision<D> walls_;

  Viscosity<D> viscosity_;
  Surface<D> surface_;
  PressureEquation<D> equation_;
  Shift<D> shift_;

  std::array<Field, D> old_velocity_;       ///< m/s, at the start of the step
  std::array<Field, D> change_;             ///< m/s, by pressure; then what moves the particles
  std::array<Field, D> wall_acceleration_;  ///< m/s2; empty where no wall moves
  AlignedVector<std::int32_t> unknown_;     ///< number of a pressure unknown, -1 where p is known
  std::size_t unknowns_ = 0;
  Field unknown_pressure_;

  CellGrid<D> grid_;
  Periodicity<D> periodicity_;
  NeighbourList<D> list_;
  linear::PressureSolver pressure_solver_;
  BalancedLoop loop_;
  Clock clock_;
};

}  // namespace surge::isph
