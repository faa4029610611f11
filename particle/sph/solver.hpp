#pragma once

#include <variant>

#include "particle/case/case.hpp"
#include "particle/core/cell_grid.hpp"
#include "particle/core/clock.hpp"
#include "particle/core/particles.hpp"
#include "particle/core/step_report.hpp"
#include "particle/core/symmetric_pair_loop.hpp"
#include "particle/core/wall_collision.hpp"
#include "particle/kernel/quintic_spline.hpp"
#include "particle/kernel/wendland_c2.hpp"
#include "particle/sph/equation_of_state.hpp"
#include "particle/sph/params.hpp"
#include "particle/sph/shifting.hpp"

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

  /// Advances by stable_step() or dt_limit (s), whichever is shorter.
  StepReport step(double dt_limit);
  /// Time step, Eq. (25).
  /// Also dt <= acoustic_courant h / (c0 + v_max) where that limit is on, and the limit of
  /// viscosity, dt <= 0.125 h^2 / nu (Morris, Fox & Zhu 1997); and of the damping of sound, dt <=
  /// 0.5 h^2 / zeta, which is longer than that of sound for zeta <= 2 c0 h.
  [[nodiscard]] double stable_step() const;

  [[nodiscard]] double time() const { return time_; }
  [[nodiscard]] const Particles<D>& particles() const { return p_; }
  [[nodiscard]] Clock& clock() { return clock_; }
  [[nodiscard]] double sound_speed() const { return c0_; }
  [[nodiscard]] double particle_mass() const { return mass_; }
  using Kernel = std::variant<QuinticSpline<D>, WendlandC2<D>>;
  [[nodiscard]] const Kernel& kernel() const { return kernel_; }
  /// h, m
  [[nodiscard]] double smoothing_length() const { return h_; }

 private:
  /// Reads x, v, volume (and density); sums XSPH and the rate of density.
  template <bool Diffusion>
  using ContinuityLoop = SymmetricPairLoop<D, Diffusion ? 2 * D + 2 : 2 * D + 1, D + 1>;
  /// Reads x, p/rho^2 (and v, density, volume) (and what stands for p/rho^2 of the particle
  /// itself); sums the acceleration without gravity.
  template <bool Viscous, bool Difference>
  using MomentumLoop =
      SymmetricPairLoop<D, (Viscous ? 2 * D + 3 : D + 1) + (Difference ? 1 : 0), D>;

  // The first line of the comment on a function that step() calls is its box in the flowchart.
  /// Particles sorted into cells of neighbours.
  void sort_particles(double dt);
  /// Velocities by half a step, gravity too.
  void kick(double dt);
  /// Positions by half a step.
  void half_drift(double dt);
  /// Density by continuity, Eq. (20).
  void apply_continuity(double dt);
  template <class K, bool Diffusion>
  void continuity_pass(const K& kernel);
  void update_fluid_volume();
  /// Surface and shifting velocity; density by the shift.
  void survey_surroundings(double dt);
  /// Positions with XSPH, held back at walls, Eq. (24).
  void drift(double dt, StepReport& report);
  /// Pressure by the equation of state, Eq. (21).
  /// With what damps sound where that is on.
  void apply_equation_of_state(StepReport& report);
  template <class K>
  void extrapolate_to_walls(const K& kernel);
  template <class K>
  void extrapolate_velocity(const K& kernel);
  /// Accelerations by pressure, Eqs. (22), (23).
  void apply_momentum();
  template <class K, bool Viscous, bool Difference>
  void momentum_pass(const K& kernel);
  /// Fastest particle.
  void measure_speed();
  [[nodiscard]] bool near_fluid(std::size_t cell) const;
  [[nodiscard]] bool is_fluid(std::size_t i) const { return p_.type[i] == ParticleType::fluid; }
  template <class F>
  void for_each_fluid(F&& f);

  Params params_;
  TimeControl control_;
  double spacing_;
  double rho0_;
  double nu_;
  bool no_slip_;  ///< walls that rub: only with viscosity
  Vec<D> gravity_{};
  Vec<D> still_gravity_{};  ///< what a hydrostatic pressure balances
  double h_;
  double c0_;
  double alpha_c0_h_;  ///< of the artificial viscosity, m2/s
  double mass_;
  Kernel kernel_;
  EquationOfState state_;
  WallCollision<D> walls_;

  Particles<D> p_;
  std::array<Field, D> acceleration_;
  std::array<Field, D> rubbing_velocity_;  ///< m/s, of walls as the viscous term sees them
  std::array<Field, D> xsph_;              ///< velocity correction of Eq. (24)
  std::array<Field, D> xsph_old_;          ///< the one before, which the half drift used
  Field density_rate_;
  Field compression_rate_;  ///< that of continuity, kg/m3/s, where sound is damped
  Field fluid_volume_;      ///< m/rho of fluid particles, 0 for walls
  Field p_over_rho2_;
  Field own_p_over_rho2_;  ///< what stands for it in the sum of the particle itself
  std::vector<std::uint32_t> fluid_before_;  ///< number of fluid particles before each index

  CellGrid<D> grid_;
  bool shifting_;
  bool difference_;  ///< negative pressures inside act by differences
  Surroundings<D> surroundings_;
  ContinuityLoop<false> continuity_loop_;
  ContinuityLoop<true> diffusion_loop_;
  MomentumLoop<false, false> momentum_loop_;
  MomentumLoop<true, false> viscous_loop_;
  MomentumLoop<true, true> difference_loop_;
  std::vector<TileBuffer<D, D + 3>> wall_tiles_;
  std::vector<TileBuffer<D, 2 * D + 1>> rubbing_tiles_;

  double time_ = 0.0;
  long steps_ = 0;
  double v_max_ = 0.0;
  double skin_ = 0.0;              ///< by how much the grid reaches beyond the kernel, m
  double moved_since_sort_ = 0.0;  ///< bound on any particle's path since the last sort, m
  Clock clock_;
};

}  // namespace surge::sph
