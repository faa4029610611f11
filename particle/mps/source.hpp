#pragma once

#include <vector>

#include "particle/core/body_force.hpp"
#include "particle/core/neighbour_lanes.hpp"
#include "particle/mps/params.hpp"
#include "particle/mps/pressure_poisson.hpp"
#include "particle/mps/view.hpp"

namespace surge::mps {

/// Right side of the pressure equation, Pa/m^2, with the sign of the Laplacian turned: the number
/// density of Eq. (12) or the divergence of the velocity (Tanaka & Masunaga 2010), and what
/// gravity and the pressures of the surface add where these are told apart from the unknown.
template <int D>
class PressureSource {
 public:
  /// wall_normal: by id; empty where walls are not smooth
  PressureSource(const Params& params, std::vector<Vec<D>> wall_normal);

  /// The slope of the pressure (Pa/m) that the assembly leaves out of the unknowns for a body of
  /// the density rho (kg/m3): rho g where gravity is told apart and the same everywhere, else zero.
  [[nodiscard]] Vec<D> even_slope(double rho, const BodyAcceleration<D>& still,
                                  const std::array<Field, D>& wall_acceleration) const;

  /// Adds to rhs[unknown[i]] after a step dt (s) in which the fluid was accelerated. `still`: what
  /// of that acceleration a pressure can balance. wall_acceleration: of walls in this step, m/s2,
  /// empty where none moves: dp/dn = rho (g - a_w) . n.
  void fill(const View<D>& view, const PoissonAssembly<D>& assembly,
            const BodyAcceleration<D>& still, const std::array<Field, D>& wall_acceleration,
            double dt, Field& rhs);

 private:
  /// What this step has just added to the velocities of fluid and walls, and stands in the pairs.
  struct Added {
    BodyAcceleration<D> fallen;
    const std::array<Field, D>* wall = nullptr;
  };
  void take_back(const View<D>& view, double dt, const Added& added);
  template <bool Exact, bool Smooth>
  [[nodiscard]] double divergence_to_remove(const View<D>& view, std::size_t i, double dt) const;
  template <bool Smooth>
  [[nodiscard]] std::array<Simd, D> relative_velocities(const View<D>& view, std::size_t i,
                                                        const LaneIndices& j) const;

  Source source_;
  double density_share_;
  double relaxation_;
  bool dynamic_;  ///< without the hydrostatic part
  bool exact_;    ///< divergence by the corrected gradient
  std::vector<Vec<D>> wall_normal_;
  std::array<Field, D> before_;  ///< m/s, velocities without what this step has added
};

}  // namespace surge::mps
