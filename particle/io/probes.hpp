#pragma once

#include <vector>

#include "particle/case/case.hpp"
#include "particle/core/pressure_sampler.hpp"

namespace surge {

/// Pressures at the probes of a case. A probe with a diameter is flush with the nearest solid face
/// and reads the mean over its area: over places in the plane of that face, half a spacing apart at
/// most. (In 2D a sensor is a strip across the plane.)
template <int D>
class Probes {
 public:
  explicit Probes(const Case& c);

  /// Pa, in the order of the case's probes.
  const std::vector<double>& measure(const Particles<D>& particles);

 private:
  std::vector<std::size_t> first_;  ///< place of each probe, and one past the last
  PressureSampler<D> sampler_;
  std::vector<double> pressure_;
};

}  // namespace surge
