#include "particle/core/moving_walls.hpp"

#include <algorithm>
#include <cmath>

#include "particle/core/initial_particles.hpp"
#include "particle/core/parallel_for.hpp"

namespace surge {

template <int D>
MovingWalls<D>::MovingWalls(const Case& c, const Particles<D>& p, int wall_layers)
    : walls_(c.moving_walls), first_id_(moving_wall_ids<D>(c, wall_layers, p.size())) {
  if (walls_.empty()) return;
  rest_.resize(static_cast<std::size_t>(first_id_.back() - first_id_.front()));
  for (std::size_t i = 0; i < p.size(); ++i)
    if (wall_of(p.id[i]) < walls_.size())
      rest_[static_cast<std::size_t>(p.id[i] - first_id_.front())] = p.position(i);
}

template <int D>
std::size_t MovingWalls<D>::wall_of(std::int32_t id) const {
  if (walls_.empty() || id < first_id_.front() || id >= first_id_.back()) return walls_.size();
  const auto next = std::upper_bound(first_id_.begin(), first_id_.end(), id);
  return static_cast<std::size_t>(next - first_id_.begin()) - 1;
}

template <int D>
void MovingWalls<D>::place(Particles<D>& p, double time) const {
  if (walls_.empty()) return;
  std::vector<MotionState> state(walls_.size());
  for (std::size_t k = 0; k < walls_.size(); ++k) state[k] = motion_at(walls_[k].law, time);
  const auto n = static_cast<std::ptrdiff_t>(p.size());
  parallel_for(n, worth_sharing, [&](std::ptrdiff_t i) {
    const std::size_t k = wall_of(p.id[i]);
    if (k == walls_.size()) return;
    const Vec<D>& rest = rest_[static_cast<std::size_t>(p.id[i] - first_id_.front())];
    for (std::size_t a = 0; a < D; ++a) {
      p.x[a][i] = rest[a] + state[k].displacement * walls_[k].direction[a];
      p.v[a][i] = state[k].velocity * walls_[k].direction[a];
    }
  });
}

template <int D>
void MovingWalls<D>::place(Particles<D>& p, double begin, double end,
                           std::array<Field, D>& acceleration) const {
  place(p, end);
  std::vector<double> mean(walls_.size());
  for (std::size_t k = 0; k < walls_.size(); ++k)
    mean[k] = (motion_at(walls_[k].law, end).velocity - motion_at(walls_[k].law, begin).velocity) /
              (end - begin);
  give_to_particles(p, mean, acceleration);
}

template <int D>
void MovingWalls<D>::accelerations(const Particles<D>& p, double time,
                                   std::array<Field, D>& out) const {
  std::vector<double> q(walls_.size());
  for (std::size_t k = 0; k < walls_.size(); ++k)
    q[k] = motion_at(walls_[k].law, time).acceleration;
  give_to_particles(p, q, out);
}

template <int D>
void MovingWalls<D>::give_to_particles(const Particles<D>& p, const std::vector<double>& along,
                                       std::array<Field, D>& out) const {
  const auto n = static_cast<std::ptrdiff_t>(p.size());
  parallel_for(n, worth_sharing, [&](std::ptrdiff_t i) {
    const std::size_t k = wall_of(p.id[i]);
    for (std::size_t a = 0; a < D; ++a)
      out[a][i] = k == walls_.size() ? 0.0 : along[k] * walls_[k].direction[a];
  });
}

template <int D>
double MovingWalls<D>::fastest(double begin, double end) const {
  double speed = 0.0;
  for (const MovingWall& wall : walls_) {
    const MotionState a = motion_at(wall.law, begin);
    const MotionState b = motion_at(wall.law, end);
    speed = std::max({speed, std::abs(a.velocity), std::abs(b.velocity)});
    if (end > begin)
      speed = std::max(speed, std::abs(b.displacement - a.displacement) / (end - begin));
  }
  return speed;
}

template <int D>
double MovingWalls<D>::step_limit(double time, double dt, double path) const {
  // A wall that starts within the step is faster at its end: again for the shorter step.
  for (int k = 0; k < 20 && fastest(time, time + dt) * dt > path * (1.0 + 1e-9); ++k)
    dt = path / fastest(time, time + dt);
  return dt;
}

template class MovingWalls<2>;
template class MovingWalls<3>;

}  // namespace surge
