#pragma once

#include "particle/case/case.hpp"
#include "particle/core/balanced_loop.hpp"
#include "particle/core/cell_grid.hpp"
#include "particle/core/clock.hpp"
#include "particle/core/neighbour_list.hpp"
#include "particle/core/particles.hpp"
#include "particle/core/step_report.hpp"
#include "particle/core/wall_collision.hpp"
#include "particle/linear/pressure_solver.hpp"
#include "particle/mps/collision.hpp"
#include "particle/mps/free_surface.hpp"
#include "particle/mps/params.hpp"
#include "particle/mps/pressure_poisson.hpp"

namespace surge::mps {

/// The MPS method as in the paper, Fig. 3: gravity and an explicit move to temporal positions, then
/// the pressure that brings the number density back to n0, then velocities and positions corrected
/// by its gradient.
template <int D>
class Solver {
 public:
  Solver(const Case& c, const Params& params, Search search);

  /// Advances by stable_step() or dt_limit (s), whichever is shorter.
  StepReport step(double dt_limit);
  /// Time step, Eq. (25).
  /// Not above the limit of the explicit viscous term.
  [[nodiscard]] double stable_step() const;

  [[nodiscard]] double time() const { return time_; }
  [[nodiscard]] const Particles<D>& particles() const { return p_; }
  [[nodiscard]] Clock& clock() { return clock_; }
  [[nodiscard]] double reference_density() const { return n0_; }
  /// Radii of the interaction: of gradient and number density, and of the Laplacian, m.
  [[nodiscard]] double radius() const { return re_; }
  [[nodiscard]] double laplacian_radius() const { return re_laplacian_; }
  /// The pressure equation of the last step.
  [[nodiscard]] const linear::PoissonSystem& system() { return assembly_.system(); }

 private:
  // The first line of the comment on a function that step() calls is its box in the flowchart.
  /// Temporal velocities by gravity.
  void apply_body_forces(double dt);
  /// Temporal positions, held back at walls.
  void move(double dt, const std::array<Field, D>& velocity, StepReport& report);
  /// Neighbours of each particle.
  void find_neighbours();
  /// Collisions between particles.
  void collide(double dt, StepReport& report);
  /// Particle number density, Eq. (4).
  void compute_number_density();
  /// Free surface, where p = 0, Eq. (14).
  void find_free_surface();
  /// Pressure Poisson equation, Eqs. (7), (12).
  void solve_pressure(double dt, StepReport& report);
  [[nodiscard]] bool is_on_surface(std::size_t i, const Displacement<D>& displacement) const;
  [[nodiscard]] double source(std::size_t i, double dt, const Displacement<D>& displacement) const;
  /// New velocities and positions, Eqs. (11), (13).
  void correct(double dt, StepReport& report);
  /// Particles moved apart, along the surface near it.
  void shift_particles(double dt, StepReport& report);
  void update_surface_pressure(double dt, const Displacement<D>& displacement);
  void find_concentration_gradient(const Displacement<D>& displacement);
  [[nodiscard]] double surface_source(std::size_t i, const Displacement<D>& displacement) const;
  [[nodiscard]] Vec<D> surface_normal(std::size_t i, const Displacement<D>& displacement) const;
  [[nodiscard]] bool near_surface(std::size_t i, const Displacement<D>& displacement) const;
  void find_wall_normals(const Case& c);
  [[nodiscard]] Vec<D> relative_velocity(std::size_t i, std::size_t j, double fallen) const;
  [[nodiscard]] double still_source(std::size_t i, const Displacement<D>& displacement) const;
  [[nodiscard]] Vec<D> shift_of(std::size_t i, double dt,
                                const Displacement<D>& displacement) const;
  [[nodiscard]] double divergence_to_remove(std::size_t i, double dt,
                                            const Displacement<D>& displacement) const;
  void find_minima(const Displacement<D>& displacement);
  [[nodiscard]] Vec<D> pressure_gradient(std::size_t i, const Displacement<D>& displacement) const;
  /// Fastest particle.
  void measure_speed(StepReport& report);
  /// Kinematic viscosity, numerical or not, m2/s.
  [[nodiscard]] double viscosity() const {
    return std::max(nu_, params_.numerical_viscosity * spacing_ * v_max_);
  }
  void add_viscosity(double dt);
  [[nodiscard]] Vec<D> viscous_acceleration(std::size_t i,
                                            const Displacement<D>& displacement) const;
  void extrapolate_to_walls(const Displacement<D>& displacement);

  [[nodiscard]] bool is_fluid(std::size_t i) const { return p_.type[i] == ParticleType::fluid; }
  [[nodiscard]] bool has_pressure(std::size_t i) const { return p_.type[i] != ParticleType::dummy; }
  /// p = 0, by Eq. (14).
  [[nodiscard]] bool is_surface(std::size_t i) const { return has_pressure(i) && unknown_[i] < 0; }
  template <class F>
  void for_each_fluid(F&& f);

  Params params_;
  TimeControl control_;
  double spacing_;
  double rho_;
  double nu_;
  bool no_slip_;
  Vec<D> gravity_{};
  Vec<D> still_gravity_{};  ///< what a hydrostatic pressure balances
  double re_;               ///< of gradient and number density, m
  double re_laplacian_;     ///< m
  double n0_;               ///< Eq. (9), at re
  double laplacian_factor_;
  LayerThickness<D> layer_thickness_;
  double divergence_time_;  ///< s
  double viscous_lambda_;   ///< m2; the lattice's, whatever the pressure equation has
  CollisionModel<D> collision_;
  WallCollision<D> walls_;

  Particles<D> p_;
  std::array<Field, D> correction_;              ///< v' of Eq. (11), m/s
  std::array<Field, D> rubbing_velocity_;        ///< m/s, what neighbours show to the viscous term
  std::array<Field, D> concentration_gradient_;  ///< 1/m, of shifting
  std::vector<Vec<D>> wall_normal_;              ///< by id; empty where walls are not smooth
  std::array<Field, D> carried_;                 ///< m/s, of the velocity by shifting
  Field surface_pressure_;                       ///< Pa, where a particle is on the surface
  Field least_;                                  ///< Pa, the neighbourhood minimum of Eq. (6)
  AlignedVector<std::int32_t>
      unknown_;  ///< number of a particle's pressure unknown, -1 where p = 0
  std::size_t unknowns_ = 0;
  Field unknown_pressure_;

  CellGrid<D> grid_;
  Periodicity<D> periodicity_;
  NeighbourList<D> list_;
  PoissonAssembly<D> assembly_;
  linear::PressureSolver pressure_solver_;
  BalancedLoop loop_;

  double time_ = 0.0;
  long steps_ = 0;
  double v_max_ = 0.0;
  Clock clock_;
};

}  // namespace surge::mps
