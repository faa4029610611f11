#pragma once

#include <optional>
#include <vector>

#include "particle/case/case.hpp"
#include "particle/core/pressure_sampler.hpp"

namespace surge {

/// The force of the water's pressure on the solid surfaces that a case names:
///   F = -sum_k p_k n_k A_k
/// over patches of about l0 across that cover the surface, n_k pointing from the solid into the
/// tank, p_k what a sensor in the middle of the patch feels (PressureSampler). Friction is not
/// part of it. N in 3D, N per m in 2D.
template <int D>
class SurfaceForces {
 public:
  explicit SurfaceForces(const Case& c);

  /// N (2D: N/m), in the order of the case's force surfaces, at a time in s.
  const std::vector<Point>& measure(const Particles<D>& particles, double time);

 private:
  struct Surface {
    std::vector<Vec<D>> area;  ///< n A of each patch, m2 (2D: m)
    PressureSampler<D> sampler;
    std::optional<std::size_t> wall;  ///< that it moves with
  };
  std::vector<MovingWall> walls_;
  std::vector<Surface> surfaces_;
  std::vector<Point> force_;
};

}  // namespace surge
