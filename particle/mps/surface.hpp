#pragma once

#include "particle/core/prefix_sums.hpp"
#include "particle/mps/params.hpp"
#include "particle/mps/view.hpp"

namespace surge::mps {

/// The free surface: who is on it, where it faces and what pressure its particles have.
template <int D>
class Surface {
 public:
  explicit Surface(const Params& params);

  /// Numbers the particles whose pressure is unknown, -1 for the others, which get
  /// `surface_pressure` (Pa). Returns how many are unknown. On the surface is who Eq. (14) and,
  /// where it is on, the offset of the neighbours say; with WallCoupling::fluid a wall is so just
  /// where it touches no fluid.
  std::size_t find(const View<D>& view, const Field& surface_pressure,
                   AlignedVector<std::int32_t>& unknown, Field& pressure);

  /// The pressure in the middle of the surface's layer (Pa) by this step's velocity correction
  /// v' = -dt/rho grad p (m/s), for the next step. Nothing where p = 0 in the particles' centres.
  void update_pressure(const View<D>& view, double dt, const std::array<Field, D>& correction,
                       Field& surface_pressure);

  /// What normal() and concentration_gradient() go by, from what find(i) gives, 1/m.
  template <class Find>
  void set_concentration_gradient(const View<D>& view, const Find& find) {
    for (Field& field : concentration_gradient_) field.resize(view.p.size());
    view.for_each_fluid([&](std::size_t i) {
      const Vec<D> g = find(i);
      for (int a = 0; a < D; ++a) concentration_gradient_[a][i] = g[a];
    });
  }
  [[nodiscard]] Vec<D> concentration_gradient(std::size_t i) const;
  /// Mean of the concentration's gradient over the surface particles around: along the normal of
  /// the surface, inwards, and smoother than that of one of them. Zero where there is no surface.
  [[nodiscard]] Vec<D> normal(const View<D>& view, std::size_t i) const;

 private:
  void mark_neighbours(const View<D>& view);
  /// Of the surface particles alone.
  void find_concentration_gradient(const View<D>& view);
  [[nodiscard]] bool is_on_surface(const View<D>& view, std::size_t i) const;

  double beta_;
  double offset_;
  bool half_spacing_;
  bool walls_by_fluid_;
  std::array<Field, D> concentration_gradient_;  ///< 1/m
  AlignedVector<char> near_;  ///< whether a particle, or one in its list, is fluid on the surface
  PrefixSums prefix_sums_;
  AlignedVector<std::int32_t> solved_before_;  ///< unknowns before each particle
};

/// Whether a particle belongs to spray, a tip or an edge: what is outside of it is not a layer.
template <int D>
bool is_detached(const View<D>& view, std::size_t i) {
  constexpr double edge = 0.9;  // of the density under a flat surface; a corner has 0.63
  return on_free_surface(view.p.density[i], edge,
                         view.model.layer_thickness.flat_density(view.model.n0));
}

/// Whether a particle has a free surface within the radius of the number density.
template <int D>
bool near_surface(const View<D>& view, std::size_t i) {
  if (view.is_surface(i)) return true;
  const double re = view.model.re;
  for (const std::uint32_t j : view.neighbours(i))
    if (view.is_surface(j) && squared_norm<D>(view.displacement(i, j)) < re * re) return true;
  return false;
}

}  // namespace surge::mps
