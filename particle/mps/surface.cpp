#include "particle/mps/surface.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "particle/mps/shifting.hpp"

namespace surge::mps {

template <int D>
Surface<D>::Surface(const Params& params)
    : beta_(params.beta),
      offset_(params.surface_offset),
      half_spacing_(params.surface_at == SurfaceAt::half_spacing),
      walls_by_fluid_(params.wall_coupling == WallCoupling::fluid) {}

template <int D>
bool Surface<D>::is_on_surface(const View<D>& view, std::size_t i) const {
  const Model<D>& m = view.model;
  if (walls_by_fluid_ && !view.is_fluid(i)) {
    const auto neighbours = view.neighbours(i);
    return std::none_of(neighbours.begin(), neighbours.end(),
                        [&](std::uint32_t j) { return view.is_fluid(j); });
  }
  const double n = view.p.density[i];
  if (!on_free_surface(n, beta_, m.n0)) return false;
  if (offset_ == 0.0 || on_free_surface(n, thin_sheet, m.n0)) return true;
  return neighbour_offset<D>(i, view.neighbours(i), view.displacement, m.re, m.n0, m.spacing) >
         offset_;
}

template <int D>
std::size_t Surface<D>::find(const View<D>& view, const Field& surface_pressure,
                             AlignedVector<std::int32_t>& unknown, Field& pressure) {
  view.for_each([&](std::size_t i) {
    const bool solved = view.has_pressure(i) && !is_on_surface(view, i);
    unknown[i] = solved ? 0 : -1;
    if (!solved) pressure[i] = surface_pressure[i];
  });
  solved_before_.resize(unknown.size() + 1);
  const std::int32_t unknowns = prefix_sums_(
      unknown.size(), [&](std::size_t i) { return unknown[i] + 1; }, solved_before_.data());
  view.for_each([&](std::size_t i) {
    if (unknown[i] == 0) unknown[i] = solved_before_[i];
  });
  mark_neighbours(view);
  return static_cast<std::size_t>(unknowns);
}

/// Few particles are on the surface: what follows asks nothing of those that are far from it.
template <int D>
void Surface<D>::mark_neighbours(const View<D>& view) {
  near_.assign(view.p.size(), 0);
  const auto mark = [&](std::size_t i) {
    std::atomic_ref<char>(near_[i]).store(1, std::memory_order_relaxed);
  };
  view.for_each_fluid([&](std::size_t i) {
    if (!view.is_surface(i)) return;
    mark(i);
    for (const std::uint32_t j : view.neighbours(i)) mark(j);
  });
}

template <int D>
void Surface<D>::update_pressure(const View<D>& view, double dt,
                                 const std::array<Field, D>& correction, Field& surface_pressure) {
  if (!half_spacing_) return;
  find_concentration_gradient(view);
  view.for_each_fluid([&](std::size_t i) {
    surface_pressure[i] = 0.0;
    if (near_[i] == 0 || is_detached(view, i)) return;
    const Vec<D> inward = normal(view, i);
    const double length = std::sqrt(squared_norm<D>(inward));
    if (length == 0.0) return;
    double slope = 0.0;  // of the pressure, inwards
    for (int a = 0; a < D; ++a)
      slope -= view.model.rho / dt * correction[a][i] * inward[a] / length;
    const double thickness = view.model.layer_thickness(
        i, view.neighbours(i), view.displacement,
        [&](std::size_t j) { return view.is_fluid(j) && view.is_surface(j); });
    surface_pressure[i] = std::max(0.0, 0.5 * thickness * slope);
  });
}

template <int D>
void Surface<D>::find_concentration_gradient(const View<D>& view) {
  const Model<D>& m = view.model;
  set_concentration_gradient(view, [&](std::size_t i) {
    if (!view.is_surface(i)) return Vec<D>{};
    return mps::concentration_gradient<D>(i, view.neighbours(i), view.displacement, m.re, m.n0);
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
  const double re = view.model.re;
  Vec<D> sum{};
  if (near_[i] == 0) return sum;
  const auto add = [&](std::size_t j, double weight) {
    for (int a = 0; a < D; ++a) sum[a] += weight * concentration_gradient_[a][j];
  };
  if (view.is_surface(i)) add(i, 1.0);
  for (const std::uint32_t j : view.neighbours(i)) {
    if (!view.is_surface(j) || !view.is_fluid(j)) continue;
    const double r = std::sqrt(squared_norm<D>(view.displacement(i, j)));
    if (r < re) add(j, mps_weight(r, re));
  }
  return sum;
}

template class Surface<2>;
template class Surface<3>;

}  // namespace surge::mps
