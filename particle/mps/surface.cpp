#include "particle/mps/surface.hpp"

#include <algorithm>
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
                             AlignedVector<std::int32_t>& unknown, Field& pressure) const {
  view.for_each([&](std::size_t i) {
    const bool solved = view.has_pressure(i) && !is_on_surface(view, i);
    unknown[i] = solved ? 0 : -1;
    if (!solved) pressure[i] = surface_pressure[i];
  });
  std::size_t unknowns = 0;
  for (std::int32_t& number : unknown)
    if (number == 0) number = static_cast<std::int32_t>(unknowns++);
  return unknowns;
}

template <int D>
void Surface<D>::update_pressure(const View<D>& view, double dt,
                                 const std::array<Field, D>& correction, Field& surface_pressure) {
  if (!half_spacing_) return;
  find_concentration_gradient(view);
  view.for_each_fluid([&](std::size_t i) {
    surface_pressure[i] = 0.0;
    if (is_detached(view, i)) return;
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
  for (Field& field : concentration_gradient_) field.resize(view.p.size());
  view.for_each_fluid([&](std::size_t i) {
    const Vec<D> g =
        mps::concentration_gradient<D>(i, view.neighbours(i), view.displacement, m.re, m.n0);
    for (int a = 0; a < D; ++a) concentration_gradient_[a][i] = g[a];
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
  const auto add = [&](std::size_t j, double weight) {
    for (int a = 0; a < D; ++a) sum[a] += weight * concentration_gradient_[a][j];
  };
  if (view.is_surface(i)) add(i, 1.0);
  for (const std::uint32_t j : view.neighbours(i)) {
    const double r = std::sqrt(squared_norm<D>(view.displacement(i, j)));
    if (r < re && view.is_fluid(j) && view.is_surface(j)) add(j, mps_weight(r, re));
  }
  return sum;
}

template class Surface<2>;
template class Surface<3>;

}  // namespace surge::mps
