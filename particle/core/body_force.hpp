#pragma once

#include "particle/case/case.hpp"
#include "particle/core/particles.hpp"

namespace surge {

/// Acceleration of the fluid by gravity and the tank's motion, in the tank's frame, at one time:
///   a(x, v) = uniform + gradient (x - centre) + turning v,
/// `uniform` from gravity and translation, `gradient` from the Euler and the centrifugal term,
/// `turning` from that of Coriolis (particle/case/motion.hpp).
template <int D>
struct BodyAcceleration {
  using Matrix = std::array<Vec<D>, D>;
  Vec<D> uniform{};    ///< m/s2
  bool turns = false;  ///< without it, `uniform` is all
  Vec<D> centre{};     ///< m
  Matrix gradient{};   ///< 1/s2
  Matrix turning{};    ///< 1/s, antisymmetric

  /// Of fluid at rest in the tank's frame at x: what a pressure can balance, m/s2.
  [[nodiscard]] Vec<D> at(const Vec<D>& x) const {
    Vec<D> a = uniform;
    if (!turns) return a;
    for (int row = 0; row < D; ++row)
      for (int k = 0; k < D; ++k) a[row] += gradient[row][k] * (x[k] - centre[k]);
    return a;
  }
};

/// Gravity and the tank's motion as a body force.
template <int D>
class BodyForce {
 public:
  /// Throws Error where the tank turns an axis that is periodic.
  explicit BodyForce(const Case& c);

  /// At `time` (s); the tank's own acceleration, q'', is its mean over [begin, end], so that the
  /// fluid gets the whole impulse of a motion that starts or stops within a step.
  [[nodiscard]] BodyAcceleration<D> at(double time, double begin, double end) const;
  /// The part of it that a pressure can balance: nothing holds what is driven along a periodic
  /// axis.
  [[nodiscard]] BodyAcceleration<D> still(BodyAcceleration<D> all) const;

 private:
  Vec<D> gravity_{};
  Point gravity3_{};
  std::array<bool, 3> periodic_{};
  TankMotion motion_;
};

/// A velocity after the time h under a body force and another acceleration f, Coriolis' term by the
/// mean of both ends:
///   v' = v + h [a(x, (v + v')/2) + f],
/// which keeps the speed of a particle that nothing else acts on, and is of second order.
template <int D>
class BodyKick {
 public:
  BodyKick(const BodyAcceleration<D>& a, double h);

  [[nodiscard]] Vec<D> operator()(const Vec<D>& x, const Vec<D>& v, const Vec<D>& f) const {
    const Vec<D> a = a_.at(x);
    Vec<D> out{};
    for (int row = 0; row < D; ++row)
      for (int k = 0; k < D; ++k)
        out[row] += turn_[row][k] * v[k] + h_ * half_[row][k] * (a[k] + f[k]);
    return out;
  }

 private:
  using Matrix = typename BodyAcceleration<D>::Matrix;
  BodyAcceleration<D> a_;
  double h_;
  Matrix half_{};  ///< (1 - W)^-1, W = h/2 turning
  Matrix turn_{};  ///< (1 - W)^-1 (1 + W): a rotation
};

}  // namespace surge
