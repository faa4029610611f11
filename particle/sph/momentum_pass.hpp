#pragma once

#include "particle/sph/params.hpp"
#include "particle/sph/view.hpp"

namespace surge::sph {

// Eq. (23)
/// D v/Dt by the pressure term, Eq. (22), and viscous terms where they are on; gravity, which the
/// paper adds in words, is added where velocities change.
template <int D>
class MomentumPass {
 public:
  MomentumPass(const Params& params, const Model<D>& model);

  /// The fields of the pressure term: p/rho^2, and what stands for it in the sum of the particle
  /// itself, which is read only where negative pressures act by differences.
  struct Pressures {
    const Field& p_over_rho2;
    const Field& own_p_over_rho2;
  };
  /// velocity: as the viscous terms see it, m/s; acceleration: m/s2.
  void operator()(const View<D>& view, const Pressures& pressures,
                  const std::array<Field, D>& velocity, std::array<Field, D>& acceleration);

 private:
  enum class Rubbing { none, laplacian, deformation };
  template <class K, bool Viscous, bool Difference>
  void pass(const K& kernel, const View<D>& view, const Pressures& pressures,
            const std::array<Field, D>& velocity, std::array<Field, D>& acceleration);

  bool difference_;
  bool viscous_;
  Rubbing rubbing_;
};

}  // namespace surge::sph
