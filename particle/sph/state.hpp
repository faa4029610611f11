#pragma once

#include "particle/core/particles.hpp"
#include "particle/sph/shifting.hpp"

namespace surge::sph {

/// All that a step leaves to the next one, so that a run can go on from a copy of it. The grid
/// and its lists follow from the positions that they were made of.
template <int D>
struct State {
  Particles<D> p;                     ///< in the order of the grid
  std::array<Field, D> acceleration;  ///< m/s2, without that of gravity and the tank's motion
  std::array<Field, D> xsph;          ///< velocity correction of Eq. (24), m/s
  Field compression_rate;             ///< what the damper of sound sees, kg/m3/s
  Survey<D> survey;                   ///< the last one
  std::array<Field, D> sorted_x;      ///< m, when the grid was made
  double time = 0.0;                  ///< s
  long steps = 0;
  double v_max = 0.0;         ///< m/s
  double since_survey = 0.0;  ///< s

  /// Calls f(name, member) for all members, for checkpoints. A new member that is left out here
  /// does not compile.
  template <class Self, class F>
  static void visit(Self& state, F&& f) {
    auto& [particles, accelerations, corrections, compression, surroundings, sorted, now, taken,
           fastest, surveyed] = state;
    f("p", particles);
    f("acceleration", accelerations);
    f("xsph", corrections);
    f("compression_rate", compression);
    f("survey", surroundings);
    f("sorted_x", sorted);
    f("time", now);
    f("steps", taken);
    f("v_max", fastest);
    f("since_survey", surveyed);
  }
};

}  // namespace surge::sph
