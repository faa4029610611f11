#pragma once

#include <vector>

#include "particle/case/case.hpp"
#include "particle/core/particles.hpp"

namespace surge {

/// Pressure of the fluid at many places at once, as a small flush sensor at each would feel it:
///   p = sum_i w_i p_i l0^D / max(sum_i w_i l0^D, wet W),  w_i = (1 - r_i/2l0)^2 for r_i < 2 l0,
/// over the fluid particles, W = int w dV over what is not solid within 2 l0, wet = 3/4. Where
/// water covers the place that is the mean of Shepard (1968), right at walls too. Where it covers
/// less, the rest is dry and counts with p = 0: the first drops on a wall are no load on all of it.
/// Next to a surface that does not follow the lattice, W is no more than the sum of weights over
/// the places of the lattice that it leaves to the fluid.
template <int D>
class PressureSampler {
 public:
  PressureSampler(const Case& c, std::vector<Vec<D>> points);

  /// Pa, in the order of the points, all of which have moved by `shift` (m).
  const std::vector<double>& measure(const Particles<D>& particles, const Vec<D>& shift = {});

 private:
  void sort_points();
  void add(const Vec<D>& x, double pressure);
  /// Calls f(x) for the images of a place along periodic axes that lie near the points.
  template <class F>
  void for_each_image(const Vec<D>& x, F&& f) const;
  [[nodiscard]] double weight(double r) const;
  template <class Walls>
  [[nodiscard]] double weight_of_the_open(const Walls& walls, double spacing,
                                          const Vec<D>& point) const;
  template <class Walls>
  [[nodiscard]] double weight_of_the_lattice(const Walls& walls, const Case& c,
                                             const Vec<D>& point) const;

  double radius_;                   ///< m
  std::array<double, D> period_{};  ///< m; zero for an axis that is not periodic
  std::vector<Vec<D>> points_;
  std::vector<double> wet_;  ///< sum of weights from which on a place is covered by water
  // Points by cells of the radius' size.
  Vec<D> lower_{};
  Vec<D> upper_{};
  std::array<int, D> cells_{};
  std::vector<std::size_t> cell_begin_;
  std::vector<std::size_t> sorted_;
  std::vector<double> sum_, weights_, pressure_;
  struct Near {
    Vec<D> x;         ///< m
    double pressure;  ///< Pa
  };
  std::vector<std::vector<Near>> near_;  ///< particles near the points, of each thread's stretch
};

}  // namespace surge
