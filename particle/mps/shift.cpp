#include "particle/mps/shift.hpp"

#include <cmath>

#include "particle/mps/correction.hpp"
#include "particle/mps/shifting.hpp"
#include "particle/mps/velocity_divergence.hpp"

namespace surge::mps {

template <int D>
void Shift<D>::find(const View<D>& view, Surface<D>& surface, double v_max, double dt,
                    std::array<Field, D>& v, std::array<Field, D>& shift_velocity) {
  const std::size_t n = view.p.size();
  speed_.resize(n);
  for (auto& row : gradient_)
    for (Field& field : row) field.resize(n);
  surface.set_concentration_gradient(view, [&](std::size_t i) { return look_around(view, i); });
  view.for_each_fluid([&](std::size_t i) {
    const Vec<D> s = shift_of(view, surface, i, v_max, dt);
    for (int a = 0; a < D; ++a) {
      shift_velocity[a][i] = s[a] / dt;
      for (int b = 0; b < D; ++b) v[a][i] += gradient_[a][b][i] * s[b];
    }
  });
}

template <int D>
Vec<D> Shift<D>::look_around(const View<D>& view, std::size_t i) {
  const Model<D>& m = view.model;
  const Surroundings<D> found =
      surroundings<D>(i, view.neighbours(i), view.displacement, m.re, m.n0, trusted_pivot, view.p.v,
                      [&](std::size_t j) { return view.is_fluid(j); });
  for (int a = 0; a < D; ++a)
    for (int b = 0; b < D; ++b)
      gradient_[a][b][i] = found.velocity_gradient ? (*found.velocity_gradient)[a][b] : 0.0;
  speed_[i] = found.relative_speed;
  return found.concentration_gradient;
}

/// m
template <int D>
Vec<D> Shift<D>::shift_of(const View<D>& view, const Surface<D>& surface, std::size_t i,
                          double v_max, double dt) const {
  // Spray and edges have no inside to be evened out, nor a direction along the surface.
  if (is_detached(view, i)) return {};
  Vec<D> s = shift<D>(surface.concentration_gradient(i), surface.normal(view, i), share_,
                      view.model.spacing, v_max * dt);
  const double limit = dt * speed_[i];
  const double length = std::sqrt(squared_norm<D>(s));
  if (length > limit)
    for (double& component : s) component *= limit / length;
  return s;
}

template class Shift<2>;
template class Shift<3>;

}  // namespace surge::mps
