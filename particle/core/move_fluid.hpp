#pragma once

#include "particle/core/step_report.hpp"
#include "particle/core/wall_collision.hpp"

namespace surge {

/// x += dt velocity (m/s) for the fluid, each path held back at walls; counts those that met one,
/// and those that are lost now.
template <int D>
void move_fluid(Particles<D>& p, const WallCollision<D>& walls, double dt,
                const std::array<Field, D>& velocity, StepReport& report) {
  const auto n = static_cast<std::ptrdiff_t>(p.size());
  long collisions = 0;
  long lost = 0;
#pragma omp parallel for schedule(static, stretch) reduction(+ : collisions, lost)
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    if (p.type[i] != ParticleType::fluid) continue;
    Vec<D> start;
    Vec<D> end;
    Vec<D> v;
    for (int a = 0; a < D; ++a) {
      start[a] = p.x[a][i];
      end[a] = start[a] + dt * velocity[a][i];
      v[a] = p.v[a][i];
    }
    if (walls.apply(start, end, v)) {
      ++collisions;
      for (int a = 0; a < D; ++a) p.v[a][i] = v[a];
    }
    for (int a = 0; a < D; ++a) p.x[a][i] = end[a];
    if (walls.is_lost(end)) ++lost;
  }
  report.wall_collisions += collisions;
  report.lost = lost;
}

}  // namespace surge
