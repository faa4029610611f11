#pragma once

#include "particle/mps/surface.hpp"
#include "particle/mps/view.hpp"

namespace surge::mps {

/// Particle shifting as a pass over the fluid (particle/mps/shifting.hpp). Particles take the
/// velocity that the fluid has where they are shifted to, v += (dx . grad) v (Lind et al. 2012).
template <int D>
class Shift {
 public:
  /// share: of l0 by which particles move apart while the fastest moves by l0
  explicit Shift(double share) : share_(share) {}

  /// Adds to the velocities v and gives the shift as a velocity over dt, both m/s.
  void find(const View<D>& view, Surface<D>& surface, double v_max, double dt,
            std::array<Field, D>& v, std::array<Field, D>& shift_velocity);

 private:
  /// Gives the gradient of the concentration and keeps the rest of surroundings().
  Vec<D> look_around(const View<D>& view, std::size_t i);
  [[nodiscard]] Vec<D> shift_of(const View<D>& view, const Surface<D>& surface, std::size_t i,
                                double v_max, double dt) const;

  double share_;
  Field speed_;                                   ///< the fastest shift, m/s
  std::array<std::array<Field, D>, D> gradient_;  ///< of the velocity, row by component, 1/s
};

}  // namespace surge::mps
