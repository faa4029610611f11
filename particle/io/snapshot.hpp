#pragma once

#include <omp.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "particle/core/particles.hpp"

namespace surge {

/// A copy of what a frame shows, in the order of the particles' ids, so that a frame can be written
/// while the solver goes on. Places in double precision, because seven digits do not tell particles
/// apart that are far from the origin; the rest in single, more than a picture or the comparator
/// resolves, at half the size.
struct Snapshot {
  double time = 0.0;             ///< s
  std::vector<double> position;  ///< m, three per particle
  std::vector<float> velocity;   ///< m/s, three per particle
  std::vector<float> pressure;   ///< Pa
  std::vector<float> density;    ///< kg/m3, or the number density
  std::vector<std::uint8_t> type;
  std::vector<std::int32_t> id;

  [[nodiscard]] std::size_t size() const { return id.size(); }
};

namespace detail {

/// Indices of particles in the order of their ids; O(N) because ids are small whole numbers.
inline std::vector<std::size_t> order_by_id(const AlignedVector<std::int32_t>& id) {
  constexpr auto nobody = static_cast<std::size_t>(-1);
  if (id.empty()) return {};
  const auto largest = static_cast<std::size_t>(*std::max_element(id.begin(), id.end()));
  std::vector<std::size_t> order(largest + 1, nobody);
  for (std::size_t i = 0; i < id.size(); ++i) order[static_cast<std::size_t>(id[i])] = i;
  std::erase(order, nobody);
  return order;
}

}  // namespace detail

template <int D>
Snapshot take_snapshot(const Particles<D>& particles, double time) {
  Snapshot s;
  s.time = time;
  const std::size_t n = particles.size();
  s.position.assign(3 * n, 0.0);
  s.velocity.assign(3 * n, 0.0F);
  s.pressure.resize(n);
  s.density.resize(n);
  s.type.resize(n);
  s.id.resize(n);
  std::size_t k = 0;
  for (const std::size_t i : detail::order_by_id(particles.id)) {
    for (std::size_t a = 0; a < D; ++a) {
      s.position[3 * k + a] = particles.x[a][i];
      s.velocity[3 * k + a] = static_cast<float>(particles.v[a][i]);
    }
    s.pressure[k] = static_cast<float>(particles.pressure[i]);
    s.density[k] = static_cast<float>(particles.density[i]);
    s.type[k] = static_cast<std::uint8_t>(particles.type[i]);
    s.id[k] = particles.id[i];
    ++k;
  }
  return s;
}

/// Number of values that are infinite or not a number. Looks at the exponent bits, in whole-number
/// arithmetic that the compiler vectorises, because it runs after every step.
inline std::size_t count_nonfinite(const Field& values) {
  constexpr std::uint64_t exponent = 0x7ff0000000000000;
  const auto count_in = [&](std::size_t begin, std::size_t end) {
    std::size_t count = 0;
    for (std::size_t i = begin; i < end; ++i)
      count += (std::bit_cast<std::uint64_t>(values[i]) & exponent) == exponent ? 1 : 0;
    return count;
  };
  const std::size_t n = values.size();
  constexpr std::size_t worth_a_team = 65536;
  if (n < worth_a_team) return count_in(0, n);
  std::size_t count = 0;
#pragma omp parallel reduction(+ : count)
  {
    const auto t = static_cast<std::size_t>(omp_get_thread_num());
    const auto team = static_cast<std::size_t>(omp_get_num_threads());
    count += count_in(n * t / team, n * (t + 1) / team);
  }
  return count;
}

/// Number of non-finite values among positions, velocities, pressures and densities.
template <int D>
std::size_t count_nonfinite(const Particles<D>& particles) {
  std::size_t count = count_nonfinite(particles.pressure) + count_nonfinite(particles.density);
  for (std::size_t a = 0; a < D; ++a) {
    count += count_nonfinite(particles.x[a]) + count_nonfinite(particles.v[a]);
  }
  return count;
}

}  // namespace surge
