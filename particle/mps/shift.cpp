#include "particle/mps/shift.hpp"

#include <cmath>

#include "particle/mps/correction.hpp"
#include "particle/mps/shifting.hpp"
#include "particle/mps/velocity_divergence.hpp"

namespace surge::mps {

template <int D>
void Shift<D>::find(const View<D>& view, Surface<D>& surface, double v_max, double dt,
                    std::array<Field, D>& v, std::array<Field, D>& shift_velocity) {
  const Particles<D>& p = view.p;
  surface.find_concentration_gradient(view);
  for (Field& field : carried_) field.resize(p.size());
  view.for_each_fluid([&](std::size_t i) {
    const Vec<D> s = shift_of(view, surface, i, v_max, dt);
    const auto gradient = velocity_gradient<D>(
        i, view.neighbours(i), view.displacement, view.model.re, view.model.n0, trusted_pivot,
        [&](std::size_t j) {
          Vec<D> relative = p.velocity(j);
          for (int a = 0; a < D; ++a) relative[a] -= p.v[a][i];
          return relative;
        },
        [&](std::size_t j) { return view.is_fluid(j); });
    for (int a = 0; a < D; ++a) {
      shift_velocity[a][i] = s[a] / dt;
      carried_[a][i] = 0.0;
      if (!gradient) continue;
      for (int b = 0; b < D; ++b) carried_[a][i] += (*gradient)[a][b] * s[b];
    }
  });
  view.for_each_fluid([&](std::size_t i) {
    for (int a = 0; a < D; ++a) v[a][i] += carried_[a][i];
  });
}

/// m
template <int D>
Vec<D> Shift<D>::shift_of(const View<D>& view, const Surface<D>& surface, std::size_t i,
                          double v_max, double dt) const {
  // Spray and edges have no inside to be evened out, nor a direction along the surface.
  if (is_detached(view, i)) return {};
  Vec<D> s = shift<D>(surface.concentration_gradient(i), surface.normal(view, i), share_,
                      view.model.spacing, v_max * dt);
  const double limit =
      dt * relative_speed<D>(i, view.neighbours(i), view.displacement, view.model.re, view.p.v,
                             [&](std::size_t j) { return view.is_fluid(j); });
  const double length = std::sqrt(squared_norm<D>(s));
  if (length > limit)
    for (double& component : s) component *= limit / length;
  return s;
}

template class Shift<2>;
template class Shift<3>;

}  // namespace surge::mps
