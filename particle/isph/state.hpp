#pragma once

#include "particle/core/particles.hpp"

namespace surge::isph {

/// All that a step leaves to the next one, so that a run can go on from a copy of it. Grid and
/// neighbour list follow from the positions that they were made of.
template <int D>
struct State {
  Particles<D> p;                ///< in the order of the grid
  Field surface_pressure;        ///< Pa, of each particle if it is on the surface
  std::array<Field, D> found_x;  ///< m, at the last search for neighbours
  double time = 0.0;             ///< s
  long steps = 0;
  double v_max = 0.0;  ///< m/s

  /// Calls f(name, member) for all members, for checkpoints. A new member that is left out here
  /// does not compile.
  template <class Self, class F>
  static void visit(Self& state, F&& f) {
    auto& [particles, surface, found, now, taken, fastest] = state;
    f("p", particles);
    f("surface_pressure", surface);
    f("found_x", found);
    f("time", now);
    f("steps", taken);
    f("v_max", fastest);
  }
};

}  // namespace surge::isph
