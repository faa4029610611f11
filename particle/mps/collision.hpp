#pragma once

#include <array>

#include "particle/core/neighbour_lanes.hpp"

namespace surge::mps {

/// Collisions between particles that are closer than `distance` and approach each other, as in the
/// MPS method since Koshizuka & Oka (1996): a pair of fluid particles leaves with `restitution`
/// times its normal relative speed, momentum unchanged; a fixed particle takes up any momentum.
/// All pairs are judged by the velocities at the start, so the order of particles does not matter.
template <int D>
class CollisionModel {
 public:
  /// distance: m; restitution: 0 to 1
  CollisionModel(double distance, double restitution)
      : distance2_(distance * distance), restitution_(restitution) {}

  /// Change of the velocity of fluid particle i; counts the collisions it takes part in. Pairs that
  /// approach at less than `least` (m/s) do not collide: that much is left to the pressure.
  template <class Fixed>
  Vec<D> velocity_change(std::size_t i, std::span<const std::uint32_t> neighbours,
                         const Displacement<D>& displacement, const std::array<Field, D>& v,
                         Fixed&& fixed, double least, long& collisions) const {
    Vec<D> change{};
    for_each_lanes<D>(i, neighbours, displacement,
                      [&](const LaneIndices& lanes, const std::array<Simd, D>& offset, Simd squares)
                          SURGE_INLINE {
                            if (stdx::none_of(squares < distance2_)) return;  // nearly always
                            for (std::size_t k = 0; k < simd_width; ++k) {
                              const double r2 = squares[k];
                              if (r2 >= distance2_ || r2 == 0.0) continue;
                              const std::size_t j = lanes[k];
                              double approach = 0.0;
                              for (int a = 0; a < D; ++a)
                                approach += (v[a][j] - v[a][i]) * offset[a][k];
                              if (approach >= 0.0 || approach * approach < least * least * r2)
                                continue;
                              const double share = fixed(j) ? 1.0 : 0.5;
                              for (int a = 0; a < D; ++a)
                                change[a] +=
                                    share * (1.0 + restitution_) * approach / r2 * offset[a][k];
                              ++collisions;
                            }
                          });
    return change;
  }

 private:
  double distance2_;
  double restitution_;
};

}  // namespace surge::mps
