#pragma once

#include <vector>

#include "particle/core/body_force.hpp"
#include "particle/isph/params.hpp"
#include "particle/isph/view.hpp"
#include "particle/linear/poisson_system.hpp"

namespace surge::isph {

/// The pressure Poisson equation of the projection (Cummins & Rudman 1999, J. Comput. Phys. 152):
///   lap p = rho/dt div v*,  lap p = sum_j 2 V (p_i - p_j) (x_i - x_j) . grad_i W_ij / r^2,
/// for what is left of p without the hydrostatic part: a pair has the difference
///   p_j - p_i - rho g . (x_j - x_i),
/// so that still water solves it exactly wherever the particles lie. Every wall particle that
/// touches water takes its pressure from it, sum_f weight (p_w - p_f - rho (g - a_w) . (x_w - x_f))
/// = 0: the boundary condition dp/dn = rho (g - a_w) . n in the sense of Adami, Hu & Adams (2012),
/// J. Comput. Phys. 231, as rows of the same symmetric system.
template <int D>
class PressureEquation {
 public:
  /// wall_normal: unit normals of wall particles by id; they slide, so that only the normal part of
  /// a velocity difference across a wall counts. Empty where walls rub.
  PressureEquation(const Model<D>& model, std::vector<Vec<D>> wall_normal);

  /// Assembles the rows of the unknown pressures after a step dt (s). `still`: what of the fluid's
  /// acceleration in this step a pressure can balance; wall_acceleration: m/s2, empty where no wall
  /// moves.
  const linear::PoissonSystem& assemble(const View<D>& view, std::size_t unknowns,
                                        const BodyAcceleration<D>& still,
                                        const std::array<Field, D>& wall_acceleration, double dt);

  [[nodiscard]] linear::PoissonSystem& system() { return system_; }

 private:
  /// Whether two neighbours have an entry in the equations.
  [[nodiscard]] static bool couples(const View<D>& view, std::size_t i, std::size_t j) {
    return view.is_fluid(i) || view.is_fluid(j);
  }
  void number_entries(const View<D>& view, std::size_t unknowns);
  template <class K>
  void fill_row(const View<D>& view, const K& kernel, std::size_t i,
                const BodyAcceleration<D>& still, const std::array<Field, D>& wall_acceleration,
                double dt);
  template <class K>
  [[nodiscard]] double divergence_to_remove(const View<D>& view, const K& kernel, std::size_t i,
                                            const BodyAcceleration<D>& still,
                                            const std::array<Field, D>& wall_acceleration,
                                            double dt) const;

  std::vector<Vec<D>> wall_normal_;
  linear::PoissonSystem system_;
};

}  // namespace surge::isph
