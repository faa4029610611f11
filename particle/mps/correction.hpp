#pragma once

#include "particle/mps/params.hpp"
#include "particle/mps/view.hpp"

namespace surge::mps {

inline constexpr double trusted_pivot = 0.3;  ///< of a corrected gradient; 1 on the full lattice

// Eq. (11)
/// v' = -dt/rho grad P for the fluid, m/s, by Eq. (13), in which the neighbourhood minimum of Eq.
/// (6) stands where the paper prints P_i, or by one of the other models of the gradient.
template <int D>
class PressureCorrection {
 public:
  explicit PressureCorrection(GradientModel model) : model_(model) {}
  void find(const View<D>& view, double dt, std::array<Field, D>& correction);

 private:
  [[nodiscard]] static double minimum(const View<D>& view, std::size_t i);

  GradientModel model_;
  Field least_;  ///< Pa, the neighbourhood minimum of Eq. (6), where the model sums it
};

}  // namespace surge::mps
