#pragma once

#include "particle/core/particles.hpp"

namespace surge::sph {

/// All that a step leaves to the next one, so that a run can go on from a copy of it. The grid
/// follows from the positions that it was made of.
template <int D>
struct State {
  Particles<D> p;                     ///< in the order of the grid
  std::array<Field, D> acceleration;  ///< m/s2, without that of gravity and the tank's motion
  std::array<Field, D> xsph;          ///< velocity correction of Eq. (24), m/s
  std::array<Field, D> sorted_x;      ///< m, when the grid was made
  double time = 0.0;                  ///< s
  long steps = 0;
  double v_max = 0.0;             ///< m/s
  double skin = 0.0;              ///< by how much the grid reaches beyond the kernel, m
  double moved_since_sort = 0.0;  ///< bound on any particle's path since the last sort, m

  /// Calls f(name, member) for all members, for checkpoints. A new member that is left out here
  /// does not compile.
  template <class Self, class F>
  static void visit(Self& state, F&& f) {
    auto& [particles, accelerations, corrections, sorted, now, taken, fastest, reach, moved] =
        state;
    f("p", particles);
    f("acceleration", accelerations);
    f("xsph", corrections);
    f("sorted_x", sorted);
    f("time", now);
    f("steps", taken);
    f("v_max", fastest);
    f("skin", reach);
    f("moved_since_sort", moved);
  }
};

}  // namespace surge::sph
