#pragma once

#include "particle/case/case.hpp"
#include "particle/core/body_force.hpp"
#include "particle/core/cell_grid.hpp"
#include "particle/core/clock.hpp"
#include "particle/core/moving_walls.hpp"
#include "particle/core/step_report.hpp"
#include "particle/core/wall_collision.hpp"
#include "particle/sph/cluster_lists.hpp"
#include "particle/sph/density_pass.hpp"
#include "particle/sph/model.hpp"
#include "particle/sph/momentum_pass.hpp"
#include "particle/sph/params.hpp"
#include "particle/sph/shifting.hpp"
#include "particle/sph/stability.hpp"
#include "particle/sph/state.hpp"
#include "particle/sph/view.hpp"
#include "particle/sph/wall_extrapolation.hpp"

namespace surge::sph {

/// Weakly compressible SPH as in the paper, Fig. 5, advanced by the leap-frog scheme.
///
/// One step from t to t + dt, with a the acceleration at the start:
///   v += dt/2 a                                   (kick)
///   rho += dt D rho/Dt at the half step           (continuity, Eq. 20)
///   x += dt (v + XSPH), held back at walls        (drift, Eq. 24)
///   p from the equation of state                  (Eq. 21)
///   a from pressure, viscosity and gravity        (Eqs. 22, 23)
///   v += dt/2 a                                   (kick)
/// Positions and densities are staggered against velocities, so the scheme is second order and adds
/// no dissipation of its own (Adami, Hu & Adams 2012 use the same staggering).
template <int D>
class Solver {
 public:
  Solver(const Case& c, const Params& params, Search search);
  /// Goes on from where another solver of the same case, options and build was, as that one would.
  Solver(const Case& c, const Params& params, Search search, State<D> state);

  /// Advances by stable_step() or dt_limit (s), whichever is shorter.
  StepReport step(double dt_limit);
  /// Time step, Eq. (25).
  /// Also dt <= acoustic_courant h / (c0 + v_max) where that limit is on, and the limit of
  /// viscosity, dt <= 0.125 h^2 / nu (Morris, Fox & Zhu 1997); and of the damping of sound, dt <=
  /// 0.5 h^2 / zeta, which is longer than that of sound for zeta <= 2 c0 h; and that of a moving
  /// wall.
  [[nodiscard]] double stable_step() const;

  [[nodiscard]] double time() const { return s_.time; }
  [[nodiscard]] const Particles<D>& particles() const { return s_.p; }
  [[nodiscard]] const State<D>& state() const { return s_; }
  [[nodiscard]] Clock& clock() { return clock_; }
  [[nodiscard]] double sound_speed() const { return model_.c0; }
  [[nodiscard]] double particle_mass() const { return model_.mass; }
  [[nodiscard]] const AnyKernel<D>& kernel() const { return model_.kernel; }
  /// h, m
  [[nodiscard]] double smoothing_length() const { return model_.h; }

 private:
  // The first line of the comment on a function that step() calls is its box in the flowchart.
  /// Particles sorted into cells of neighbours.
  /// Again where they have moved so far that their lists may lack a neighbour.
  void sort_particles();
  /// Velocities by half a step, gravity too.
  /// And the tank's motion: at `time`, its own acceleration as its mean over [begin, end].
  void kick(double time, double begin, double end);
  /// Positions by half a step.
  void half_drift(double dt);
  /// Moving walls to where they are at that time.
  void place_moving_walls(double time);
  /// Density by continuity, Eq. (20).
  void apply_continuity(double dt);
  /// Surface and shifting velocity; density by the shift.
  void survey_surroundings(double dt);
  /// Positions with XSPH, held back at walls, Eq. (24).
  void drift(double dt, StepReport& report);
  /// Pressure by the equation of state, Eq. (21).
  /// With what damps sound where that is on.
  void apply_equation_of_state(double time, StepReport& report);
  /// Accelerations by pressure, Eqs. (22), (23).
  void apply_momentum();
  /// Fastest particle.
  void measure_speed();

  void sort();
  /// Shift and surface are kept while the flow goes a fraction of h, see Surroundings.
  [[nodiscard]] bool survey_is_due(double dt) const {
    const double path = (s_.since_survey + dt) * std::max(reference_speed_, s_.v_max);
    return s_.steps == 0 || path > params_.survey_interval * model_.h;
  }
  void update_fluid_volume();
  void set_pressures(StepReport& report);
  [[nodiscard]] View<D> view() { return {model_, lists_, s_.p, fluid_volume_}; }
  [[nodiscard]] bool is_fluid(std::size_t i) const { return s_.p.type[i] == ParticleType::fluid; }

  Params params_;
  TimeControl control_;
  Model<D> model_;
  State<D> s_;
  BodyForce<D> body_force_;
  MovingWalls<D> movers_;
  WallCollision<D> walls_;

  std::array<Field, D> rubbing_velocity_;   ///< m/s, of walls as the viscous term sees them
  std::array<Field, D> xsph_old_;           ///< XSPH's correction that the half drift used
  std::array<Field, D> wall_acceleration_;  ///< m/s2; empty where no wall moves
  Field density_rate_;
  Field fluid_volume_;  ///< m/rho of fluid particles, 0 for walls
  Field p_over_rho2_;
  Field own_p_over_rho2_;  ///< what stands for it in the sum of the particle itself

  CellGrid<D> grid_;
  ClusterLists<D> lists_;
  LatticeWaves waves_;
  bool shifting_;
  bool difference_;  ///< negative pressures inside act by differences
  Surroundings<D> surroundings_;
  double reference_speed_;  ///< m/s
  DensityPass<D> density_pass_;
  MomentumPass<D> momentum_pass_;
  WallExtrapolation<D> wall_extrapolation_;
  Clock clock_;
};

}  // namespace surge::sph
