#pragma once

#include "particle/core/parallel_for.hpp"
#include "particle/core/particles.hpp"
#include "particle/sph/cluster_lists.hpp"
#include "particle/sph/model.hpp"

namespace surge::sph {

/// What the terms of a step read.
template <int D>
struct View {
  const Model<D>& model;
  ClusterLists<D>& lists;
  const Particles<D>& p;      ///< in the grid's order
  const Field& fluid_volume;  ///< m/rho of fluid particles, 0 for walls
};

/// f(i) for the fluid.
template <int D, class F>
void for_each_fluid(const Particles<D>& p, F&& f) {
  const auto n = static_cast<std::ptrdiff_t>(p.size());
  parallel_for(n, 1024, [&](std::ptrdiff_t i) {
    if (p.type[i] == ParticleType::fluid) f(static_cast<std::size_t>(i));
  });
}

}  // namespace surge::sph
