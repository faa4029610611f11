#pragma once

#include "particle/core/balanced_loop.hpp"
#include "particle/core/neighbour_list.hpp"
#include "particle/core/particles.hpp"
#include "particle/mps/model.hpp"

namespace surge::mps {

/// What the terms of a step read: particles, who is near whom, and which pressures are unknown.
template <int D>
struct View {
  const Model<D>& model;
  const Particles<D>& p;
  const NeighbourList<D>& list;
  const AlignedVector<std::int32_t>&
      unknown;  ///< number of a pressure unknown, -1 where p is known
  Displacement<D> displacement;
  BalancedLoop& loop;

  [[nodiscard]] bool is_fluid(std::size_t i) const { return p.type[i] == ParticleType::fluid; }
  [[nodiscard]] bool has_pressure(std::size_t i) const { return p.type[i] != ParticleType::dummy; }
  /// p = 0, by Eq. (14).
  [[nodiscard]] bool is_surface(std::size_t i) const { return has_pressure(i) && unknown[i] < 0; }
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
};

}  // namespace surge::mps
