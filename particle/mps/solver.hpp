#pragma once

#include "particle/case/case.hpp"
#include "particle/core/balanced_loop.hpp"
#include "particle/core/body_force.hpp"
#include "particle/core/cell_grid.hpp"
#include "particle/core/clock.hpp"
#include "particle/core/moving_walls.hpp"
#include "particle/core/neighbour_list.hpp"
#include "particle/core/prefix_sums.hpp"
#include "particle/core/step_report.hpp"
#include "particle/core/wall_collision.hpp"
#include "particle/linear/pressure_solver.hpp"
#include "particle/mps/collision.hpp"
#include "particle/mps/correction.hpp"
#include "particle/mps/model.hpp"
#include "particle/mps/params.hpp"
#include "particle/mps/pressure_poisson.hpp"
#include "particle/mps/shift.hpp"
#include "particle/mps/source.hpp"
#include "particle/mps/stability.hpp"
#include "particle/mps/state.hpp"
#include "particle/mps/surface.hpp"
#include "particle/mps/view.hpp"
#include "particle/mps/viscosity.hpp"

namespace surge::mps {

/// The MPS method as in the paper, Fig. 3: gravity and an explicit move to temporal positions, then
/// the pressure that brings the number density back to n0, then velocities and positions corrected
/// by its gradient.
template <int D>
class Solver {
 public:
  Solver(const Case& c, const Params& params, Search search);
  /// Goes on from where another solver of the same case, options and build was, as that one would.
  Solver(const Case& c, const Params& params, Search search, State<D> state);

  /// Advances by stable_step() or dt_limit (s), whichever is shorter.
  StepReport step(double dt_limit);
  /// Time step, Eq. (25).
  /// Not above the limits of StepLimits, nor that of a moving wall.
  [[nodiscard]] double stable_step() const;

  [[nodiscard]] double time() const { return s_.time; }
  [[nodiscard]] const Particles<D>& particles() const { return s_.p; }
  [[nodiscard]] const State<D>& state() const { return s_; }
  [[nodiscard]] Clock& clock() { return clock_; }
  [[nodiscard]] double reference_density() const { return model_.n0; }
  /// Radii of the interaction: of gradient and number density, and of the Laplacian, m.
  [[nodiscard]] double radius() const { return model_.re; }
  [[nodiscard]] double laplacian_radius() const { return model_.re_laplacian; }
  /// The pressure equation of the last step.
  [[nodiscard]] const linear::PoissonSystem& system() { return assembly_.system(); }

 private:
  // The first line of the comment on a function that step() calls is its box in the flowchart.
  /// Temporal velocities by gravity.
  /// And by the tank's motion, and viscosity: v* = v + dt (g + nu lap v).
  void apply_body_forces(double dt);
  /// Moving walls to their new places.
  void place_moving_walls(double dt);
  /// Temporal positions, held back at walls.
  /// x += dt velocity for the fluid.
  void move(double dt, const std::array<Field, D>& velocity, StepReport& report);
  /// Collisions between particles.
  void collide(double dt, StepReport& report);
  /// Neighbours of each particle.
  /// But of walls that no water is near, where no term asks for them.
  void find_neighbours();
  /// Particle number density, Eq. (4).
  void compute_number_density();
  /// Free surface, where p = 0, Eq. (14).
  void find_free_surface();
  /// Pressure Poisson equation, Eqs. (7), (12).
  void solve_pressure(double dt, StepReport& report);
  /// New velocities and positions, Eqs. (11), (13).
  void correct(double dt, StepReport& report);
  /// Particles moved apart, along the surface near it.
  void shift_particles(double dt, StepReport& report);
  /// Fastest particle.
  void measure_speed(StepReport& report);

  void list_neighbours(bool of_dry_walls);
  [[nodiscard]] bool lists_all_within(double reach) const;
  void take_pressures(StepReport& report);
  [[nodiscard]] BodyAcceleration<D> body_acceleration(double dt) const {
    return body_force_.at(s_.time + 0.5 * dt, s_.time, s_.time + dt);
  }
  [[nodiscard]] View<D> view() {
    return {model_, s_.p, list_, unknown_, Displacement<D>(s_.p.x, periodicity_), loop_};
  }

  Params params_;
  double initial_step_;  ///< s
  StepLimits limits_;
  Model<D> model_;
  State<D> s_;
  BodyForce<D> body_force_;
  MovingWalls<D> movers_;
  WallCollision<D> walls_;
  CollisionModel<D> collision_;

  Viscosity<D> viscosity_;
  Surface<D> surface_;
  PressureSource<D> source_;
  PressureCorrection<D> pressure_correction_;
  Shift<D> shift_;

  std::array<Field, D> old_velocity_;       ///< m/s, at the start of the step
  std::array<Field, D> correction_;         ///< v' of Eq. (11), m/s
  std::array<Field, D> wall_acceleration_;  ///< m/s2; empty where no wall moves
  AlignedVector<std::int32_t>
      unknown_;  ///< number of a particle's pressure unknown, -1 where p = 0
  std::size_t unknowns_ = 0;
  Field unknown_pressure_;

  bool dry_walls_count_;  ///< in the pressure equation, or because they come nearer
  PrefixSums prefix_sums_;
  std::vector<std::uint32_t> fluid_before_;  ///< number of fluid particles before each index
  CellGrid<D> grid_;
  Periodicity<D> periodicity_;
  NeighbourList<D> list_;
  PoissonAssembly<D> assembly_;
  linear::PressureSolver pressure_solver_;
  BalancedLoop loop_;
  Clock clock_;
};

}  // namespace surge::mps
