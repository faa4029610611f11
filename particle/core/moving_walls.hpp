#pragma once

#include <vector>

#include "particle/case/case.hpp"
#include "particle/core/particles.hpp"

namespace surge {

/// The particles of the walls that move through the tank. Their places follow from the time, not
/// from their velocities, so that no error adds up.
template <int D>
class MovingWalls {
 public:
  /// `p` as initial_particles() made them with so many wall layers.
  MovingWalls(const Case& c, const Particles<D>& p, int wall_layers);

  [[nodiscard]] bool empty() const { return walls_.empty(); }
  /// Sets positions and velocities to those at `time`, s.
  void place(Particles<D>& p, double time) const;
  /// The same at `end`, and the mean acceleration of every wall particle since `begin`, m/s2; zero
  /// for all others.
  void place(Particles<D>& p, double begin, double end, std::array<Field, D>& acceleration) const;
  /// Acceleration of every wall particle at `time`, m/s2, by its index; zero where it is fixed.
  void accelerations(const Particles<D>& p, double time, std::array<Field, D>& out) const;
  /// The largest speed of any wall at both ends of [begin, end] and on average, m/s.
  [[nodiscard]] double fastest(double begin, double end) const;
  /// The longest step (s) from `time` in which no wall goes farther than `path` (m), and no longer
  /// than `dt`.
  [[nodiscard]] double step_limit(double time, double dt, double path) const;

 private:
  /// What each wall has along its direction, to its particles; zero to all others.
  void give_to_particles(const Particles<D>& p, const std::vector<double>& along,
                         std::array<Field, D>& out) const;
  /// Which wall an id belongs to; walls_.size() where to none.
  [[nodiscard]] std::size_t wall_of(std::int32_t id) const;

  std::vector<MovingWall> walls_;
  std::vector<std::int32_t> first_id_;  ///< of each wall, and one past the last
  std::vector<Vec<D>> rest_;            ///< m, at displacement zero, by id from the first one on
};

}  // namespace surge
