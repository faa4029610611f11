#pragma once

#include <cmath>

namespace surge::sph {

// Eq. (21)
/// Equation of state of Batchelor (1967) as used by Monaghan (1994), J. Comput. Phys. 110:
///   p = B [ (rho/rho0)^gamma - 1 ],  B = c0^2 rho0 / gamma.
class EquationOfState {
 public:
  /// rho0: kg/m3; c0: speed of sound at rho0, m/s; gamma: 7 for water
  EquationOfState(double rho0, double c0, double gamma)
      : rho0_(rho0), gamma_(gamma), b_(c0 * c0 * rho0 / gamma), is_seven_(gamma == 7.0) {}

  /// Pa, from kg/m3
  [[nodiscard]] double pressure(double rho) const {
    const double ratio = rho / rho0_;
    if (!is_seven_) return b_ * (std::pow(ratio, gamma_) - 1.0);
    const double cube = ratio * ratio * ratio;
    return b_ * (cube * cube * ratio - 1.0);
  }

  /// The density (kg/m3) at which the pressure is p (Pa): the inverse of pressure().
  [[nodiscard]] double density(double p) const {
    return rho0_ * std::pow(1.0 + p / b_, 1.0 / gamma_);
  }

 private:
  double rho0_;
  double gamma_;
  double b_;
  bool is_seven_;
};

// Eq. (26)
/// Density at which the equation of state gives the hydrostatic pressure rho0 g (H - y), `depth`
/// being H - y (m), g > 0 (m/s2).
inline double hydrostatic_density(const EquationOfState& state, double rho0, double g,
                                  double depth) {
  return state.density(rho0 * g * depth);
}

}  // namespace surge::sph
