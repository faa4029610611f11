#pragma once

#include "particle/core/balanced_loop.hpp"
#include "particle/core/neighbour_lanes.hpp"
#include "particle/core/neighbour_list.hpp"
#include "particle/core/prefix_sums.hpp"
#include "particle/kernel/mps_weight.hpp"
#include "particle/linear/poisson_system.hpp"
#include "particle/mps/laplacian.hpp"

namespace surge::mps {

// Eq. (12)
/// Right side of the pressure Poisson equation with its sign turned, Pa/m^2:
///   -<lap P>_i = rho/dt^2 (n*_i - n0)/n0, times a relaxation factor (1 in the paper).
inline double poisson_source(double n, double n0, double rho, double dt, double relaxation) {
  return relaxation * rho / (dt * dt) * (n - n0) / n0;
}

/// Assembles Eq. (12) with the Laplacian model of Eq. (7) for the particles with an unknown
/// pressure
/// (`unknown[i]` >= 0 numbers them, in the order of i). Neighbours on the free surface have p = 0
/// and stay in the diagonal only; dummy particles have no pressure and are left out.
template <int D>
class PoissonAssembly {
 public:
  /// re: effective radius of the Laplacian, m; factor: laplacian_factor(), 1/m^2
  /// walls_couple: whether wall particles are neighbours of each other
  PoissonAssembly(double re, double factor, double spacing, bool walls_couple = true)
      : re_(re), factor_(factor), walls_couple_(walls_couple) {
    system_.dimension = D;
    system_.spacing = spacing;
    system_.mean_square = laplacian_lambda<D>(Lambda::lattice, re / spacing, spacing) / D;
  }

  /// Fills rows, coordinates and diagonal. The right side (rhs[unknown[i]]) gets what the known
  /// pressures of neighbours and an even slope (Pa/m) that is left out of the unknowns add to it,
  ///   sum_j w [p_j - slope . (x_j - x_i)];
  /// sources are the caller's to add.
  const linear::PoissonSystem& assemble(const Particles<D>& p, const NeighbourList<D>& list,
                                        const Displacement<D>& displacement,
                                        const AlignedVector<std::int32_t>& unknown,
                                        std::size_t unknowns, const Vec<D>& slope = {});

  [[nodiscard]] linear::PoissonSystem& system() { return system_; }

  /// What a pair of neighbours at the distance r (m) adds to the equations, 1/m^2, as it is stored.
  [[nodiscard]] float coupling(double r) const {
    return static_cast<float>(factor_ * mps_weight(r, re_));
  }

  /// The same for whole vectors of squared distances, m^2; zero for a particle and itself.
  [[nodiscard]] Simd coupling(Simd r2) const {
    return in_single_precision(factor_ * mps_weights(r2, re_));
  }

  /// Whether two neighbours have an entry in the equations.
  [[nodiscard]] bool couples(const Particles<D>& p, std::size_t i, std::size_t j) const {
    if (p.type[i] == ParticleType::dummy || p.type[j] == ParticleType::dummy) return false;
    return walls_couple_ || p.type[i] == ParticleType::fluid || p.type[j] == ParticleType::fluid;
  }

 private:
  double re_;
  double factor_;
  bool walls_couple_;
  linear::PoissonSystem system_;
  BalancedLoop loop_;
  PrefixSums prefix_sums_;
};

}  // namespace surge::mps
