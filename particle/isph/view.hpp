#pragma once

#include <cmath>
#include <variant>

#include "particle/core/balanced_loop.hpp"
#include "particle/core/neighbour_list.hpp"
#include "particle/core/particles.hpp"
#include "particle/isph/model.hpp"

namespace surge::isph {

/// What the terms of a step read: particles, who is near whom, and which pressures are unknown.
template <int D>
struct View {
  const Model<D>& model;
  const Particles<D>& p;
  const NeighbourList<D>& list;
  /// Number of a pressure unknown; -1 where p is known: on the surface, or in walls without water.
  const AlignedVector<std::int32_t>& unknown;
  Displacement<D> displacement;
  BalancedLoop& loop;

  [[nodiscard]] bool is_fluid(std::size_t i) const { return p.type[i] == ParticleType::fluid; }
  [[nodiscard]] bool is_surface(std::size_t i) const { return is_fluid(i) && unknown[i] < 0; }
  [[nodiscard]] auto neighbours(std::size_t i) const { return list.of(i); }

  template <class F>
  void for_each(const F& f) const {
    loop.each(p.size(), f);
  }
  template <class F>
  void for_each_fluid(const F& f) const {
    loop.each(p.size(), [&](std::size_t i) {
      if (is_fluid(i)) f(i);
    });
  }

  /// f(j, x_j - x_i, r) for the neighbours within the kernel.
  template <class F>
  void for_each_neighbour(std::size_t i, F&& f) const {
    for (const std::uint32_t j : list.of(i)) {
      const Vec<D> d = displacement(i, j);
      const double r2 = squared_norm<D>(d);
      if (r2 >= model.reach2 || r2 == 0.0) continue;
      f(std::size_t{j}, d, std::sqrt(r2));
    }
  }
};

/// f(kernel) with the kernel as its own type.
template <int D, class F>
decltype(auto) with_kernel(const Model<D>& model, F&& f) {
  return std::visit(std::forward<F>(f), model.kernel);
}

/// Weight of a pair at the distance r in gradients, -V W'(r)/r in 1/m^2: with it
/// grad phi = sum (phi_j - phi_i) (x_j - x_i) weight on the lattice.
template <int D, class K>
double gradient_weight(const Model<D>& model, const K& kernel, double r) {
  return -model.volume * kernel.derivative(r) / r;
}

}  // namespace surge::isph
