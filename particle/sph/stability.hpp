#pragma once

#include <vector>

#include "particle/sph/model.hpp"

namespace surge::sph {

/// What the sums over neighbours do to plane waves exp(i k.x) on the square (cubic) lattice: the
/// linear stability of a step follows from it.
///
/// With the speed c, the step dt = N h/c, and for one wave
///   g = h |sum_j V sin(k.x) grad W|, the gradient, and l = h^2 sum_j 2 V (-W'/r) (1 - cos k.x),
///   the Laplacian of the density diffusion,
/// a step of the scheme (density by the velocity half-way, velocity by the new density: leap-frog)
/// is, in r = c drho/rho0 and v along k,
///   r' = (1 - q) r + m v,  v' = v - m r' - d D',   D' = D + s (v - D),
///   m = g N, q = delta l N, d = zeta g^2 N,
/// delta being the density diffusion and zeta the acoustic damping, both over c h, and s the share
/// of the new rate of compression in what the damper sees. The wave that grows first changes its
/// sign in every step; there the damper sees s/(2 - s) of it, and nothing grows while
///   m^2 + 2 q + 2 d s/(2 - s) <= 4.
/// (A term -q d is left out, on the safe side. d = q = 0: the m <= 2 of the leap-frog.)
class LatticeWaves {
 public:
  template <int D>
  explicit LatticeWaves(const Model<D>& model);

  /// The largest stable N for these coefficients, by the condition above.
  [[nodiscard]] double courant_limit(double diffusion, double damping, double share) const;
  /// The largest share, at most 1, for which N is stable.
  [[nodiscard]] double damper_share(double diffusion, double damping, double courant) const;

 private:
  struct Wave {
    double gradient2;  ///< g^2
    double laplacian;  ///< l
  };
  std::vector<Wave> waves_;
};

/// Eigenvalues of sums over disordered neighbours are larger than those of the lattice by up to a
/// fifth: steps are chosen as if they were this much longer.
inline constexpr double disorder = 1.2;

}  // namespace surge::sph
