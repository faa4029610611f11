#pragma once

#include "particle/core/wall_collision.hpp"
#include "particle/isph/params.hpp"
#include "particle/isph/view.hpp"

namespace surge::isph {

/// The free surface and its pressure.
template <int D>
class Surface {
 public:
  explicit Surface(const Params& params);

  /// Smallest eigenvalue lambda of
  ///   M_i = sum_j V (x_j - x_i) (x) grad_i W_ij
  /// over fluid and wet walls, into p.density: 1 inside the fluid, 1/2 on a flat surface in any
  /// dimension, 0 for a particle alone. A fluid particle below the limit is on the free surface
  /// (Marrone, Colagrossi, Le Touze & Graziani 2010, J. Comput. Phys. 229). A wall that no water
  /// touches fills nothing: a particle at the contact line is on the surface as its neighbours are.
  /// Numbers the unknown pressures, those of walls that touch water too, and sets those that are
  /// known. Returns how many are unknown.
  std::size_t find(const View<D>& view, const WallCollision<D>& walls,
                   const Field& surface_pressure, Field& lambda,
                   AlignedVector<std::int32_t>& unknown, Field& pressure);

  /// Gradient of the concentration sum_j V W_ij, 1/m, of the fluid: towards where particles are.
  void find_concentration_gradient(const View<D>& view);
  [[nodiscard]] Vec<D> concentration_gradient(std::size_t i) const;
  /// Inward normal of the surface near a particle, of any length: the mean of the concentration's
  /// gradient over the surface particles within the kernel. Zero where none is near.
  [[nodiscard]] Vec<D> normal(const View<D>& view, std::size_t i) const;

  /// Pressure in the centres of the surface particles of the next step, Pa: what half a spacing of
  /// water above makes of the pressure's slope along the inward normal n, -rho dv/dt . n with
  /// dv = `change` in dt by pressure. Not below zero; zero for spray.
  void update_pressure(const View<D>& view, double dt, const std::array<Field, D>& change,
                       Field& surface_pressure);

 private:
  /// Whether water lies within a spacing of the point of the walls' surface nearest to a wall
  /// particle. Water beside that point is half a spacing from it, in the next row sideways 1.1.
  [[nodiscard]] static bool is_wet(const View<D>& view, const WallCollision<D>& walls,
                                   std::size_t wall);
  template <class K>
  [[nodiscard]] double lambda_of(const View<D>& view, const K& kernel, std::size_t i) const;

  AlignedVector<char> fills_;  ///< whether a particle is fluid or a wet wall
  double limit_;
  bool half_spacing_;
  std::array<Field, D> concentration_gradient_;
};

/// Least lambda of a particle that has an inside, and a surface to lie on; below it is spray. It is
/// 1/4 on the edge of a block.
inline constexpr double detached_lambda = 0.4;

}  // namespace surge::isph
