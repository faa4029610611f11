#pragma once

#include "particle/isph/surface.hpp"
#include "particle/isph/view.hpp"

namespace surge::isph {

/// Particle shifting by Fick's law (Lind, Xu, Stansby & Rogers 2012, J. Comput. Phys. 231) with the
/// diffusivity of Skillen, Lind, Stansby & Rogers (2013), Comput. Methods Appl. Mech. Eng. 265:
///   dx_i = -A h (v_max dt) grad C_i,
/// no faster than the velocities about a particle differ; near a free surface only along it.
/// Inside the fluid particles take the velocity that it has where they are shifted to, v += (dx .
/// grad) v. The gradient is that of the neighbours' velocities alone: with v_j - v_i a particle of
/// its own speed sees a gradient towards its neighbours wherever they are on one side, is shifted
/// away from them, and grows the faster the faster it is. At surfaces and walls, where neighbours
/// are on one side, and in spray particles keep their velocities.
template <int D>
class Shift {
 public:
  explicit Shift(double share) : share_(share) {}

  /// Adds to the velocities v and gives the shift as a velocity over dt, both m/s.
  void find(const View<D>& view, Surface<D>& surface, double v_max, double dt,
            std::array<Field, D>& v, std::array<Field, D>& shift_velocity);

 private:
  template <class K>
  [[nodiscard]] Vec<D> shift_of(const View<D>& view, const K& kernel, const Surface<D>& surface,
                                std::size_t i, double v_max, double dt) const;

  double share_;                  ///< A
  std::array<Field, D> carried_;  ///< m/s
};

}  // namespace surge::isph
