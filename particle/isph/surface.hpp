#pragma once

#include "particle/isph/params.hpp"
#include "particle/isph/view.hpp"

namespace surge::isph {

/// The free surface and its pressure.
template <int D>
class Surface {
 public:
  explicit Surface(const Params& params);

  /// Divergence of the positions as a share of the dimension, into p.density:
  ///   1/d sum_j V (x_j - x_i) . grad_i W_ij,
  /// 1 inside the fluid. A fluid particle below the limit is on the free surface (Lee et al. 2008,
  /// J. Comput. Phys. 227). Numbers the unknown pressures, those of walls that touch water too, and
  /// sets those that are known. Returns how many are unknown.
  std::size_t find(const View<D>& view, const Field& surface_pressure, Field& share,
                   AlignedVector<std::int32_t>& unknown, Field& pressure) const;

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
  double limit_;
  bool half_spacing_;
  std::array<Field, D> concentration_gradient_;
};

/// Share of neighbours below which a particle is spray: it has no inside, nor a surface to lie on.
/// On a flat surface it is about 0.64, on an edge of a block a third.
inline constexpr double detached_share = 0.4;

}  // namespace surge::isph
