#pragma once

#include "particle/isph/view.hpp"

namespace surge::isph {

/// The viscous term by the rate of deformation, pairwise along the line between the particles
/// (Monaghan & Gingold 1983, J. Comput. Phys. 52):
///   nu (d + 2) sum_j 2 V (-W'/r) [(v_j - v_i) . e] e,  e = (x_j - x_i)/r,
/// right at a free surface too (Colagrossi et al. 2011, Phys. Rev. E 84). A no-slip wall counts and
/// shows v_w = 2 v_wall - sum_f V v_f W / sum_f V W (Adami, Hu & Adams 2012); a slip wall does not.
template <int D>
class Viscosity {
 public:
  /// v += dt times the term, for the fluid; nu in m2/s.
  void add(const View<D>& view, double nu, double dt, std::array<Field, D>& v);

 private:
  template <class K>
  void extrapolate_to_walls(const View<D>& view, const K& kernel);

  std::array<Field, D> shown_;  ///< m/s, what neighbours show to the term
};

}  // namespace surge::isph
