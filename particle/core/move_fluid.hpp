#pragma once

#include "particle/core/parallel_for.hpp"
#include "particle/core/step_report.hpp"
#include "particle/core/wall_collision.hpp"

namespace surge {

/// Particles that met a wall on their way, and those that are lost at its end.
struct MetWalls {
  long collisions = 0;
  long lost = 0;
  static void join(MetWalls& all, const MetWalls& own) {
    all.collisions += own.collisions;
    all.lost += own.lost;
  }
};

/// x += dt velocity (m/s) for the fluid, each path held back at walls; counts those that met one,
/// and those that are lost now.
template <int D>
void move_fluid(Particles<D>& p, const WallCollision<D>& walls, double dt,
                const std::array<Field, D>& velocity, StepReport& report) {
  const auto n = static_cast<std::ptrdiff_t>(p.size());
  const auto move = [&](std::ptrdiff_t i, MetWalls& met) {
    if (p.type[i] != ParticleType::fluid) return;
    Vec<D> start;
    Vec<D> end;
    Vec<D> v;
    for (int a = 0; a < D; ++a) {
      start[a] = p.x[a][i];
      end[a] = start[a] + dt * velocity[a][i];
      v[a] = p.v[a][i];
    }
    if (walls.apply(start, end, v)) {
      ++met.collisions;
      for (int a = 0; a < D; ++a) p.v[a][i] = v[a];
    }
    for (int a = 0; a < D; ++a) p.x[a][i] = end[a];
    if (walls.is_lost(end)) ++met.lost;
  };
  const MetWalls met = parallel_reduce(n, stretch, MetWalls{}, move, MetWalls::join);
  report.wall_collisions += met.collisions;
  report.lost = met.lost;
}

}  // namespace surge
