#include "particle/core/body_force.hpp"

#include <algorithm>
#include <cmath>

#include "particle/support/error.hpp"

namespace surge {
namespace {

using Matrix3 = std::array<Point, 3>;

/// [e]x, for which [e]x v = e x v.
Matrix3 cross_matrix(const Point& e) {
  return {Point{0.0, -e[2], e[1]}, Point{e[2], 0.0, -e[0]}, Point{-e[1], e[0], 0.0}};
}

template <std::size_t N>
std::array<std::array<double, N>, N> product(const std::array<std::array<double, N>, N>& a,
                                             const std::array<std::array<double, N>, N>& b) {
  std::array<std::array<double, N>, N> c{};
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j < N; ++j)
      for (std::size_t k = 0; k < N; ++k) c[i][j] += a[i][k] * b[k][j];
  return c;
}

/// R^T v of a rotation by `angle` about the unit vector e (Rodrigues).
Point turned_back(const Point& v, const Point& e, double angle) {
  const Matrix3 k = cross_matrix(e);
  const Matrix3 k2 = product(k, k);
  Point out = v;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      out[i] += (-std::sin(angle) * k[i][j] + (1.0 - std::cos(angle)) * k2[i][j]) * v[j];
  return out;
}

}  // namespace

template <int D>
BodyForce<D>::BodyForce(const Case& c) : gravity3_(c.gravity), motion_(c.motion) {
  std::copy_n(c.gravity.begin(), D, gravity_.begin());
  if (c.has_tank) periodic_ = c.tank.periodic;
}

template <int D>
BodyAcceleration<D> BodyForce<D>::at(double time, double begin, double end) const {
  BodyAcceleration<D> a;
  a.uniform = gravity_;
  if (motion_.kind == TankMotion::Kind::none) return a;
  const MotionState q = motion_at(motion_.law, time);
  const double mean =
      end > begin
          ? (motion_at(motion_.law, end).velocity - motion_at(motion_.law, begin).velocity) /
                (end - begin)
          : q.acceleration;
  const Point& e = motion_.direction;
  if (motion_.kind == TankMotion::Kind::translation) {
    for (std::size_t k = 0; k < D; ++k) a.uniform[k] -= mean * e[k];
    return a;
  }
  const Point g = turned_back(gravity3_, e, q.displacement);
  std::copy_n(g.begin(), D, a.uniform.begin());
  std::copy_n(motion_.centre.begin(), D, a.centre.begin());
  a.turns = true;
  const Matrix3 k = cross_matrix(e);
  const Matrix3 k2 = product(k, k);
  for (std::size_t i = 0; i < D; ++i)
    for (std::size_t j = 0; j < D; ++j) {
      a.gradient[i][j] = -mean * k[i][j] - q.velocity * q.velocity * k2[i][j];
      a.turning[i][j] = -2.0 * q.velocity * k[i][j];
    }
  return a;
}

template <int D>
BodyAcceleration<D> BodyForce<D>::still(BodyAcceleration<D> all) const {
  for (std::size_t a = 0; a < D; ++a)
    if (periodic_[a]) all.uniform[a] = 0.0;
  return all;
}

// W is antisymmetric, so W^3 = -s W with s the square of its axial vector, and
// (1 - W)^-1 = 1 + (W + W^2)/(1 + s).
template <int D>
BodyKick<D>::BodyKick(const BodyAcceleration<D>& a, double h) : a_(a), h_(h) {
  Matrix w{};
  double s = 0.0;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) {
      w[i][j] = 0.5 * h * a.turning[i][j];
      s += 0.5 * w[i][j] * w[i][j];
    }
  const Matrix w2 = product(w, w);
  Matrix one_plus_w = w;
  for (int i = 0; i < D; ++i) {
    one_plus_w[i][i] += 1.0;
    for (int j = 0; j < D; ++j)
      half_[i][j] = (i == j ? 1.0 : 0.0) + (w[i][j] + w2[i][j]) / (1.0 + s);
  }
  turn_ = product(half_, one_plus_w);
}

template struct BodyAcceleration<2>;
template struct BodyAcceleration<3>;
template class BodyForce<2>;
template class BodyForce<3>;
template class BodyKick<2>;
template class BodyKick<3>;

}  // namespace surge
