#include "particle/sph/solver.hpp"

#include <algorithm>
#include <cmath>

#include "particle/core/fastest_speed.hpp"
#include "particle/core/initial_particles.hpp"
#include "particle/core/move_fluid.hpp"
#include "particle/core/parallel_for.hpp"
#include "particle/core/time_step.hpp"
#include "particle/sph/largest_approach.hpp"
#include "particle/sph/momentum.hpp"

namespace surge::sph {
namespace {

/// At rest or with the case's velocities, under the hydrostatic pressure of Eq. (26).
template <int D>
State<D> initial_state(const Case& c, const Params& params) {
  const Model<D> model(c, params);
  State<D> s;
  s.p = initial_particles<D>(c, wall_layers(params));
  const std::size_t n = s.p.size();
  const double g = length(still_gravity(c));
  for (std::size_t i = 0; i < n; ++i)
    s.p.density[i] = hydrostatic_density(
        model.state, model.rho0, g,
        initial_depth<D>(c, s.p.position(i), support_of(params.kernel) * model.h));
  for (int a = 0; a < D; ++a) {
    s.acceleration[a].assign(n, 0.0);
    s.xsph[a].assign(n, 0.0);
  }
  s.compression_rate.assign(n, 0.0);
  s.survey = Survey<D>(n);
  MovingWalls<D>(c, s.p, wall_layers(params)).place(s.p, 0.0);
  s.v_max = fastest_speed(s.p);
  return s;
}

/// By how much the lists of neighbours reach beyond the kernel, in spacings: the more, the longer
/// they are and the less often they are made.
constexpr double skin = 0.4;

}  // namespace

template <int D>
Solver<D>::Solver(const Case& c, const Params& params, Search search)
    : Solver(c, params, search, initial_state<D>(c, params)) {
  const auto scope = clock_.measure(Phase::setup);
  sort();
  update_fluid_volume();
  if (shifting_ || difference_) survey_surroundings(0.0);
  StepReport ignored;
  apply_equation_of_state(0.0, ignored);
  apply_momentum();
}

template <int D>
Solver<D>::Solver(const Case& c, const Params& params, Search search, State<D> state)
    : params_(params),
      control_(c.time),
      model_(c, params),
      s_(std::move(state)),
      body_force_(c),
      movers_(c, initial_particles<D>(c, wall_layers(params)), wall_layers(params)),
      walls_(c, params.wall_distance * c.spacing, params.wall_restitution),
      grid_(search, periodicity_of<D>(c)),
      waves_(model_),
      shifting_(params_.shifting != Shifting::none),
      difference_(params_.negative_pressure == NegativePressure::difference),
      surroundings_(model_.h, c.spacing, reference_speed(c)),
      reference_speed_(reference_speed(c)),
      density_pass_(params),
      momentum_pass_(params, model_) {
  const auto scope = clock_.measure(Phase::setup);
  const std::size_t n = s_.p.size();
  for (int a = 0; a < D; ++a) {
    rubbing_velocity_[a].assign(model_.no_slip ? n : 0, 0.0);
    xsph_old_[a].assign(n, 0.0);
    wall_acceleration_[a].assign(movers_.empty() ? 0 : n, 0.0);
  }
  density_rate_.assign(n, 0.0);
  fluid_volume_.assign(n, 0.0);
  p_over_rho2_.assign(n, 0.0);
  own_p_over_rho2_.assign(difference_ ? n : 0, 0.0);
  if (s_.steps == 0) return;
  // The grid is made of what it was made of last, from which the particles have moved on.
  s_.p.x.swap(s_.sorted_x);
  std::array<Field, D> now = s_.sorted_x;
  sort();
  for (int a = 0; a < D; ++a) grid_.reorder(now[a]);
  s_.p.x = std::move(now);
}

template <int D>
double Solver<D>::stable_step() const {
  const double h = model_.h;
  double dt = courant_step(control_, model_.spacing, s_.v_max);
  if (params_.acoustic_courant > 0.0)
    dt = std::min(dt, params_.acoustic_courant * h / (model_.c0 + s_.v_max));
  // The pairs of the other term are stiffer by (D + 2)/D.
  const bool laplacian = params_.viscous_term == ViscousTerm::laplacian;
  dt = std::min(dt, viscous_step(laplacian ? 0.125 : 0.125 * D / (D + 2.0), h, model_.nu));
  if (!movers_.empty()) dt = movers_.step_limit(s_.time, dt, control_.courant * model_.spacing);
  return s_.steps == 0 ? std::min(dt, control_.initial_step) : dt;
}

template <int D>
StepReport Solver<D>::step(double dt_limit) {
  StepReport report;
  const double dt = std::min(stable_step(), dt_limit);
  const double start = s_.time;
  const double middle = start + 0.5 * dt;
  const double end = start + dt;
  kick(start, start, middle);
  half_drift(dt);
  if (!movers_.empty()) place_moving_walls(middle);  // if moving_walls
  sort_particles();
  apply_continuity(dt);
  if (shifting_ || difference_)
    survey_surroundings(dt);  // if shifting or negative_pressure=difference
  drift(dt, report);
  if (!movers_.empty()) place_moving_walls(end);  // if moving_walls
  sort_particles();
  apply_equation_of_state(end, report);
  apply_momentum();
  kick(end, middle, end);
  measure_speed();
  s_.time += dt;
  ++s_.steps;
  report.dt = dt;
  report.v_max = s_.v_max;
  report.courant = s_.v_max * dt / model_.spacing;
  return report;
}

template <int D>
void Solver<D>::sort_particles() {
  const auto scope = clock_.measure(Phase::neighbours);
  if (largest_approach<D>(s_.p.x, s_.sorted_x) <= skin * model_.spacing) return;
  sort();
  if (params_.wall_density != WallDensity::extrapolated) return;
  // What water has left shows nothing of it any more.
  const auto n = static_cast<std::ptrdiff_t>(s_.p.size());
  parallel_for(n, worth_sharing, [&](std::ptrdiff_t i) {
    if (s_.p.type[i] != ParticleType::fluid) s_.p.density[i] = model_.rho0;
  });
}

template <int D>
void Solver<D>::sort() {
  const double radius = support_of(params_.kernel) * model_.h + skin * model_.spacing;
  grid_.build(s_.p.x, radius, 2);
  grid_.reorder(s_.p);
  for (int a = 0; a < D; ++a) {
    if (params_.xsph_epsilon > 0.0) {
      grid_.reorder(s_.xsph[a]);
      grid_.reorder(xsph_old_[a]);
    }
    grid_.reorder(s_.acceleration[a]);
    s_.sorted_x[a].assign(s_.p.x[a].begin(), s_.p.x[a].end());
  }
  if (params_.acoustic_damping > 0.0) grid_.reorder(s_.compression_rate);
  if (shifting_ || difference_)
    for (Field* field : s_.survey.fields()) grid_.reorder(*field);
  // Walls at rest give each other's density no rate.
  lists_.build(grid_, s_.p, radius,
               params_.wall_density == WallDensity::continuity && !movers_.empty());
}

template <int D>
void Solver<D>::kick(double time, double begin, double end) {
  const auto scope = clock_.measure(Phase::forces);
  const double dt = end - begin;
  Particles<D>& p = s_.p;
  const BodyAcceleration<D> g = body_force_.at(time, begin, end);
  if (!g.turns) {
    for_each_fluid(p, [&](std::size_t i) {
      for (int a = 0; a < D; ++a) p.v[a][i] += dt * (s_.acceleration[a][i] + g.uniform[a]);
    });
    return;
  }
  const BodyKick<D> turn(g, dt);
  for_each_fluid(p, [&](std::size_t i) {
    Vec<D> f;
    for (int a = 0; a < D; ++a) f[a] = s_.acceleration[a][i];
    const Vec<D> v = turn(p.position(i), p.velocity(i), f);
    for (int a = 0; a < D; ++a) p.v[a][i] = v[a];
  });
}

template <int D>
void Solver<D>::half_drift(double dt) {
  const auto scope = clock_.measure(Phase::forces);
  if (params_.xsph_epsilon > 0.0)
    for (int a = 0; a < D; ++a) xsph_old_[a].swap(s_.xsph[a]);
  for_each_fluid(s_.p, [&](std::size_t i) {
    for (int a = 0; a < D; ++a)
      s_.p.x[a][i] += 0.5 * dt * (s_.p.v[a][i] + params_.xsph_epsilon * xsph_old_[a][i]);
  });
}

template <int D>
void Solver<D>::place_moving_walls(double time) {
  movers_.place(s_.p, time);
}

template <int D>
void Solver<D>::apply_continuity(double dt) {
  const auto scope = clock_.measure(Phase::forces);
  update_fluid_volume();
  const double middle = s_.time + 0.5 * dt;
  const bool walls_too = params_.wall_density == WallDensity::continuity;
  if (walls_too) std::fill(density_rate_.begin(), density_rate_.end(), 0.0);
  density_pass_(view(), body_force_.still(body_force_.at(middle, middle, middle)), density_rate_,
                s_.xsph);
  const auto n = static_cast<std::ptrdiff_t>(s_.p.size());
  const bool damping = params_.acoustic_damping > 0.0;
  const double share =
      damping ? waves_.damper_share(params_.density_diffusion, params_.acoustic_damping,
                                    disorder * dt * (model_.c0 + s_.v_max) / model_.h)
              : 0.0;
  parallel_for(n, worth_sharing, [&](std::ptrdiff_t i) {
    if (!walls_too && !is_fluid(static_cast<std::size_t>(i))) return;
    s_.p.density[i] += dt * density_rate_[i];
    if (damping) s_.compression_rate[i] += share * (density_rate_[i] - s_.compression_rate[i]);
  });
}

template <int D>
void Solver<D>::update_fluid_volume() {
  const auto n = static_cast<std::ptrdiff_t>(s_.p.size());
  parallel_for(n, worth_sharing, [&](std::ptrdiff_t i) {
    fluid_volume_[i] = s_.p.type[i] == ParticleType::fluid ? model_.mass / s_.p.density[i] : 0.0;
  });
}

template <int D>
void Solver<D>::survey_surroundings(double dt) {
  const auto scope = clock_.measure(Phase::forces);
  if (survey_is_due(dt)) {
    s_.since_survey = 0.0;
    std::visit(
        [&](const auto& kernel) {
          surroundings_.survey(kernel, lists_, s_.p, fluid_volume_, 0.5 * s_.v_max, s_.survey);
          if (shifting_) surroundings_.find_density_rate(kernel, lists_, s_.p, s_.survey);
        },
        model_.kernel);
  }
  s_.since_survey += dt;
  if (!shifting_) return;
  for_each_fluid(s_.p, [&](std::size_t i) { s_.p.density[i] += dt * s_.survey.density_rate[i]; });
}

template <int D>
void Solver<D>::drift(double dt, StepReport& report) {
  const auto scope = clock_.measure(Phase::forces);
  Particles<D>& p = s_.p;
  walls_.move_walls(s_.time, s_.time + dt);
  const auto n = static_cast<std::ptrdiff_t>(p.size());
  const auto move = [&](std::ptrdiff_t i, MetWalls& met) {
    if (p.type[i] != ParticleType::fluid) return;
    Vec<D> start;
    Vec<D> end;
    Vec<D> v;
    for (int a = 0; a < D; ++a) {
      v[a] = p.v[a][i];
      start[a] = p.x[a][i] - 0.5 * dt * (v[a] + params_.xsph_epsilon * xsph_old_[a][i]);
      end[a] = start[a] + dt * (v[a] + params_.xsph_epsilon * s_.xsph[a][i]);
      if (shifting_) end[a] += dt * s_.survey.shift[a][i];
    }
    if (walls_.apply(start, end, v)) {
      ++met.collisions;
      for (int a = 0; a < D; ++a) p.v[a][i] = v[a];
    }
    for (int a = 0; a < D; ++a) p.x[a][i] = end[a];
    if (walls_.is_lost(end)) ++met.lost;
  };
  const MetWalls met = parallel_reduce(n, 1024, MetWalls{}, move, MetWalls::join);
  report.wall_collisions = met.collisions;
  report.lost = met.lost;
}

template <int D>
void Solver<D>::apply_equation_of_state(double time, StepReport& report) {
  const auto scope = clock_.measure(Phase::pressure);
  set_pressures(report);
  if (params_.wall_density == WallDensity::extrapolated) {
    if (!movers_.empty()) movers_.accelerations(s_.p, time, wall_acceleration_);
    wall_extrapolation_.pressure(view(), body_force_.still(body_force_.at(time, time, time)),
                                 wall_acceleration_, s_.p.pressure, s_.p.density);
  }
  const auto n = static_cast<std::ptrdiff_t>(s_.p.size());
  parallel_for(n, worth_sharing, [&](std::ptrdiff_t i) {
    p_over_rho2_[i] = s_.p.pressure[i] / (s_.p.density[i] * s_.p.density[i]);
  });
  if (!difference_) return;
  parallel_for(n, worth_sharing, [&](std::ptrdiff_t i) {
    own_p_over_rho2_[i] =
        without_tension(p_over_rho2_[i], s_.survey.near_surface(static_cast<std::size_t>(i)));
  });
}

template <int D>
void Solver<D>::set_pressures(StepReport& report) {
  const auto n = static_cast<std::ptrdiff_t>(s_.p.size());
  const bool clip = params_.negative_pressure == NegativePressure::clip;
  const double damping = model_.damping;
  const auto set = [&](std::ptrdiff_t i, long& clipped) {
    const auto k = static_cast<std::size_t>(i);
    double p = model_.state.pressure(s_.p.density[i]);
    if (damping > 0.0) p += acoustic_damper(damping, s_.compression_rate[i]);
    if (p < 0.0 && (clip || (difference_ && s_.survey.on_surface(k)))) {
      // What is detached has no pressure to follow from, only what its density has drifted by.
      if (difference_ && s_.survey.is_detached(k)) s_.p.density[i] = model_.rho0;
      p = 0.0;
      clipped += s_.p.type[i] == ParticleType::fluid ? 1 : 0;
    }
    s_.p.pressure[i] = p;
  };
  report.clipped = parallel_reduce(n, 1024, 0L, set, [](long& all, long own) { all += own; });
}

template <int D>
void Solver<D>::apply_momentum() {
  const auto scope = clock_.measure(Phase::forces);
  if (model_.no_slip) wall_extrapolation_.velocity(view(), rubbing_velocity_);
  momentum_pass_(view(), {p_over_rho2_, own_p_over_rho2_},
                 model_.no_slip ? rubbing_velocity_ : s_.p.v, s_.acceleration);
}

template <int D>
void Solver<D>::measure_speed() {
  s_.v_max = fastest_speed(s_.p);
}

template class Solver<2>;
template class Solver<3>;

}  // namespace surge::sph
