#include "particle/isph/shift.hpp"

#include "particle/core/projection.hpp"
#include "particle/isph/gradient.hpp"

namespace surge::isph {
namespace {

/// Root mean square of the velocities of the fluid around a particle relative to it, m/s.
template <int D, class K>
double relative_speed(const View<D>& view, const K& kernel, std::size_t i) {
  double sum = 0.0;
  double weights = 0.0;
  view.for_each_neighbour(i, [&](std::size_t j, const Vec<D>&, double r) {
    if (!view.is_fluid(j)) return;
    const double weight = kernel.value(r);
    weights += weight;
    for (int a = 0; a < D; ++a) sum += weight * std::pow(view.p.v[a][j] - view.p.v[a][i], 2);
  });
  return weights > 0.0 ? std::sqrt(sum / weights) : 0.0;
}

}  // namespace

template <int D>
void Shift<D>::find(const View<D>& view, Surface<D>& surface, double v_max, double dt,
                    std::array<Field, D>& v, std::array<Field, D>& shift_velocity) {
  surface.find_concentration_gradient(view);
  for (Field& field : carried_) field.resize(view.p.size());
  with_kernel(view.model, [&](const auto& kernel) {
    view.for_each_fluid([&](std::size_t i) {
      const Vec<D> s = shift_of(view, kernel, surface, i, v_max, dt);
      const auto gradient = velocity_gradient_around(view, kernel, i);
      for (int a = 0; a < D; ++a) {
        shift_velocity[a][i] = s[a] / dt;
        carried_[a][i] = 0.0;
        for (int b = 0; gradient && b < D; ++b) carried_[a][i] += (*gradient)[a][b] * s[b];
      }
    });
  });
  view.for_each_fluid([&](std::size_t i) {
    for (int a = 0; a < D; ++a) v[a][i] += carried_[a][i];
  });
}

/// m
template <int D>
template <class K>
Vec<D> Shift<D>::shift_of(const View<D>& view, const K& kernel, const Surface<D>& surface,
                          std::size_t i, double v_max, double dt) const {
  if (view.p.density[i] < detached_lambda) return {};
  Vec<D> s = surface.concentration_gradient(i);
  for (double& component : s) component *= -share_ * view.model.h * v_max * dt;
  s = without_part_along(s, surface.normal(view, i));
  const double limit = dt * relative_speed(view, kernel, i);
  const double length = std::sqrt(squared_norm<D>(s));
  if (length > limit)
    for (double& component : s) component *= limit / length;
  return s;
}

template class Shift<2>;
template class Shift<3>;

}  // namespace surge::isph
