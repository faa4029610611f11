#include "particle/isph/surface.hpp"

#include <algorithm>

#include "particle/core/smallest_eigenvalue.hpp"

namespace surge::isph {

template <int D>
Surface<D>::Surface(const Params& params)
    : limit_(params.surface_lambda), half_spacing_(params.surface_at == SurfaceAt::half_spacing) {}

template <int D>
bool Surface<D>::is_wet(const View<D>& view, const WallCollision<D>& walls, std::size_t wall) {
  bool near = false;
  view.for_each_neighbour(
      wall, [&](std::size_t j, const Vec<D>&, double) { near = near || view.is_fluid(j); });
  if (!near) return false;
  const Vec<D> x = view.p.position(wall);
  const auto surface = walls.free_surface_of_wall(x);
  if (!surface) return false;
  const double reach2 = view.model.spacing * view.model.spacing;
  bool wet = false;
  view.for_each_neighbour(wall, [&](std::size_t j, Vec<D> d, double) {
    if (!view.is_fluid(j)) return;
    for (int a = 0; a < D; ++a) d[a] -= (*surface)[a] - x[a];
    wet = wet || squared_norm<D>(d) < reach2;
  });
  return wet;
}

template <int D>
template <class K>
double Surface<D>::lambda_of(const View<D>& view, const K& kernel, std::size_t i) const {
  std::array<double, symmetric_entries<D>> moment{};
  view.for_each_neighbour(i, [&](std::size_t j, const Vec<D>& d, double r) {
    if (fills_[j] == 0) return;
    const double weight = gradient_weight(view.model, kernel, r);
    std::size_t entry = 0;
    for (int a = 0; a < D; ++a)
      for (int b = a; b < D; ++b) moment[entry++] += weight * d[a] * d[b];
  });
  return smallest_eigenvalue<D>(moment);
}

template <int D>
std::size_t Surface<D>::find(const View<D>& view, const WallCollision<D>& walls,
                             const Field& surface_pressure, Field& lambda,
                             AlignedVector<std::int32_t>& unknown, Field& pressure) {
  fills_.resize(view.p.size());
  view.for_each(
      [&](std::size_t i) { fills_[i] = view.is_fluid(i) || is_wet(view, walls, i) ? 1 : 0; });
  with_kernel(view.model, [&](const auto& kernel) {
    view.for_each([&](std::size_t i) {
      bool solved = false;
      if (view.is_fluid(i)) {
        lambda[i] = lambda_of(view, kernel, i);
        solved = lambda[i] >= limit_;
      } else {
        lambda[i] = 1.0;
        view.for_each_neighbour(
            i, [&](std::size_t j, const Vec<D>&, double) { solved = solved || view.is_fluid(j); });
      }
      unknown[i] = solved ? 0 : -1;
      if (!solved) pressure[i] = view.is_fluid(i) ? surface_pressure[i] : 0.0;
    });
  });
  std::size_t unknowns = 0;
  for (std::int32_t& number : unknown)
    if (number == 0) number = static_cast<std::int32_t>(unknowns++);
  return unknowns;
}

template <int D>
void Surface<D>::find_concentration_gradient(const View<D>& view) {
  for (Field& field : concentration_gradient_) field.resize(view.p.size());
  with_kernel(view.model, [&](const auto& kernel) {
    view.for_each_fluid([&](std::size_t i) {
      Vec<D> sum{};
      view.for_each_neighbour(i, [&](std::size_t, const Vec<D>& d, double r) {
        const double weight = gradient_weight(view.model, kernel, r);
        for (int a = 0; a < D; ++a) sum[a] += weight * d[a];
      });
      for (int a = 0; a < D; ++a) concentration_gradient_[a][i] = sum[a];
    });
  });
}

template <int D>
Vec<D> Surface<D>::concentration_gradient(std::size_t i) const {
  Vec<D> g;
  for (int a = 0; a < D; ++a) g[a] = concentration_gradient_[a][i];
  return g;
}

template <int D>
Vec<D> Surface<D>::normal(const View<D>& view, std::size_t i) const {
  Vec<D> sum{};
  const auto add = [&](std::size_t j, double weight) {
    for (int a = 0; a < D; ++a) sum[a] += weight * concentration_gradient_[a][j];
  };
  with_kernel(view.model, [&](const auto& kernel) {
    if (view.is_surface(i)) add(i, view.model.self_volume);
    view.for_each_neighbour(i, [&](std::size_t j, const Vec<D>&, double r) {
      if (view.is_surface(j)) add(j, view.model.volume * kernel.value(r));
    });
  });
  return sum;
}

template <int D>
void Surface<D>::update_pressure(const View<D>& view, double dt, const std::array<Field, D>& change,
                                 Field& surface_pressure) {
  if (!half_spacing_) return;
  view.for_each_fluid([&](std::size_t i) {
    surface_pressure[i] = 0.0;
    if (view.p.density[i] < detached_lambda) return;
    const Vec<D> inward = normal(view, i);
    const double length = std::sqrt(squared_norm<D>(inward));
    if (length == 0.0) return;
    double slope = 0.0;  // of the pressure, inwards
    for (int a = 0; a < D; ++a) slope -= view.model.rho / dt * change[a][i] * inward[a] / length;
    surface_pressure[i] = std::max(0.0, 0.5 * view.model.spacing * slope);
  });
}

template class Surface<2>;
template class Surface<3>;

}  // namespace surge::isph
