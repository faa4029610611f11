#include "particle/sph/solver.hpp"

#include <algorithm>
#include <cmath>

#include "particle/core/fastest_speed.hpp"
#include "particle/core/initial_particles.hpp"
#include "particle/core/time_step.hpp"
#include "particle/sph/continuity.hpp"
#include "particle/sph/momentum.hpp"
#include "particle/sph/xsph.hpp"

namespace surge::sph {
namespace {

constexpr double tiny = 1e-30;  ///< m^2, keeps 1/r finite for a particle and itself

template <int D>
std::variant<QuinticSpline<D>, WendlandC2<D>> make_kernel(Kernel kernel, double h) {
  if (kernel == Kernel::wendland_c2) return WendlandC2<D>(h);
  return QuinticSpline<D>(h);
}

template <int D>
double norm(const Vec<D>& v) {
  double sum = 0.0;
  for (const double c : v) sum += c * c;
  return std::sqrt(sum);
}

}  // namespace

template <int D>
Solver<D>::Solver(const Case& c, const Params& params, Search search)
    : params_(params),
      control_(c.time),
      spacing_(c.spacing),
      rho0_(c.density),
      nu_(c.kinematic_viscosity),
      no_slip_(c.has_tank && c.tank.wall == WallCondition::no_slip && nu_ > 0.0),
      h_(params_.h_over_l0 * c.spacing),
      c0_(params_.sound_speed_ratio * reference_speed(c)),
      alpha_c0_h_(artificial_share<D>(params_.artificial_viscosity * c0_ * h_, nu_)),
      mass_(c.density * std::pow(c.spacing, D)),
      kernel_(make_kernel<D>(params_.kernel, h_)),
      state_(c.density, c0_, params_.gamma),
      walls_(c, params_.wall_distance * c.spacing, params_.wall_restitution),
      p_(initial_particles<D>(c, wall_layers(params_))),
      grid_(search, periodicity_of<D>(c)),
      shifting_(params_.shifting != Shifting::none),
      difference_(params_.negative_pressure == NegativePressure::difference),
      surroundings_(h_, c.spacing, reference_speed(c)) {
  const auto scope = clock_.measure(Phase::setup);
  std::copy_n(c.gravity.begin(), D, gravity_.begin());
  const Point still = still_gravity(c);
  std::copy_n(still.begin(), D, still_gravity_.begin());
  const std::size_t n = p_.size();
  for (int a = 0; a < D; ++a) {
    acceleration_[a].assign(n, 0.0);
    rubbing_velocity_[a].assign(no_slip_ ? n : 0, 0.0);
    xsph_[a].assign(n, 0.0);
    xsph_old_[a].assign(n, 0.0);
  }
  density_rate_.assign(n, 0.0);
  compression_rate_.assign(params_.acoustic_damping > 0.0 ? n : 0, 0.0);
  fluid_volume_.assign(n, 0.0);
  p_over_rho2_.assign(n, 0.0);
  own_p_over_rho2_.assign(difference_ ? n : 0, 0.0);
  for (std::size_t i = 0; i < n; ++i)
    p_.density[i] =
        hydrostatic_density(state_, rho0_, norm<D>(still_gravity_),
                            initial_depth<D>(c, p_.position(i), support_of(params_.kernel) * h_));
  measure_speed();
  sort_particles(stable_step());
  update_fluid_volume();
  survey_surroundings(0.0);
  StepReport ignored;
  apply_equation_of_state(ignored);
  apply_momentum();
}

template <int D>
double Solver<D>::stable_step() const {
  double dt = courant_step(control_, spacing_, v_max_);
  if (params_.acoustic_courant > 0.0)
    dt = std::min(dt, params_.acoustic_courant * h_ / (c0_ + v_max_));
  // The pairs of the other term are stiffer by (D + 2)/D.
  const bool laplacian = params_.viscous_term == ViscousTerm::laplacian;
  dt = std::min(dt, viscous_step(laplacian ? 0.125 : 0.125 * D / (D + 2.0), h_, nu_));
  dt = std::min(dt, viscous_step(0.5, h_, params_.acoustic_damping * c0_ * h_));
  return steps_ == 0 ? std::min(dt, control_.initial_step) : dt;
}

template <int D>
StepReport Solver<D>::step(double dt_limit) {
  StepReport report;
  const double dt = std::min(stable_step(), dt_limit);
  kick(0.5 * dt);
  sort_particles(dt);
  half_drift(dt);
  apply_continuity(dt);
  survey_surroundings(dt);
  drift(dt, report);
  apply_equation_of_state(report);
  apply_momentum();
  kick(0.5 * dt);
  measure_speed();
  time_ += dt;
  ++steps_;
  report.dt = dt;
  report.v_max = v_max_;
  report.courant = v_max_ * dt / spacing_;
  return report;
}

template <int D>
template <class F>
void Solver<D>::for_each_fluid(F&& f) {
  const auto n = static_cast<std::ptrdiff_t>(p_.size());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t i = 0; i < n; ++i)
    if (is_fluid(static_cast<std::size_t>(i))) f(static_cast<std::size_t>(i));
}

template <int D>
void Solver<D>::sort_particles(double dt) {
  const auto scope = clock_.measure(Phase::neighbours);
  // XSPH moves a particle by no more than the fastest one; twice the path because two may approach.
  // A shift adds half as much.
  const double path = (shifting_ ? 1.5 : 1.0) * v_max_ * dt;
  moved_since_sort_ += path;
  if (steps_ > 0 && 2.0 * moved_since_sort_ <= skin_) return;
  skin_ = std::max(0.1 * spacing_, 2.5 * path);
  moved_since_sort_ = path;
  grid_.build(p_.x, support_of(params_.kernel) * h_ + skin_, 2);
  grid_.reorder(p_);
  for (int a = 0; a < D; ++a) grid_.reorder(xsph_[a]);
  fluid_before_.resize(p_.size() + 1);
  fluid_before_[0] = 0;
  for (std::size_t i = 0; i < p_.size(); ++i)
    fluid_before_[i + 1] = fluid_before_[i] + (is_fluid(i) ? 1 : 0);
}

template <int D>
bool Solver<D>::near_fluid(std::size_t cell) const {
  bool found = false;
  grid_.for_each_segment(
      cell, [&](const auto& s) { found = found || fluid_before_[s.end] > fluid_before_[s.begin]; });
  return found;
}

template <int D>
void Solver<D>::kick(double dt) {
  const auto scope = clock_.measure(Phase::forces);
  for_each_fluid([&](std::size_t i) {
    for (int a = 0; a < D; ++a) p_.v[a][i] += dt * (acceleration_[a][i] + gravity_[a]);
  });
}

template <int D>
void Solver<D>::half_drift(double dt) {
  const auto scope = clock_.measure(Phase::forces);
  for (int a = 0; a < D; ++a) xsph_old_[a].swap(xsph_[a]);
  for_each_fluid([&](std::size_t i) {
    for (int a = 0; a < D; ++a)
      p_.x[a][i] += 0.5 * dt * (p_.v[a][i] + params_.xsph_epsilon * xsph_old_[a][i]);
  });
}

template <int D>
void Solver<D>::apply_continuity(double dt) {
  const auto scope = clock_.measure(Phase::forces);
  update_fluid_volume();
  std::visit(
      [&](const auto& kernel) {
        using K = std::decay_t<decltype(kernel)>;
        if (params_.density_diffusion > 0.0)
          continuity_pass<K, true>(kernel);
        else
          continuity_pass<K, false>(kernel);
      },
      kernel_);
  const auto n = static_cast<std::ptrdiff_t>(p_.size());
  const bool walls_too = params_.wall_density == WallDensity::continuity;
  const bool damping = params_.acoustic_damping > 0.0;
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const bool moves = walls_too || is_fluid(static_cast<std::size_t>(i));
    if (moves) p_.density[i] += dt * density_rate_[i];
    // The rate itself will be overwritten by that of the shift, which isn't motion of the fluid.
    if (damping) compression_rate_[i] = moves ? density_rate_[i] : 0.0;
  }
}

template <int D>
void Solver<D>::update_fluid_volume() {
  const auto n = static_cast<std::ptrdiff_t>(p_.size());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t i = 0; i < n; ++i)
    fluid_volume_[i] = p_.type[i] == ParticleType::fluid ? mass_ / p_.density[i] : 0.0;
}

/// Continuity, Eq. (20), with density diffusion where it is on, and the sums of XSPH, Eq. (24).
template <int D>
template <class K, bool Diffusion>
void Solver<D>::continuity_pass(const K& kernel) {
  using Loop = ContinuityLoop<Diffusion>;
  typename Loop::Sources fields;
  typename Loop::Sums sums;
  for (int a = 0; a < D; ++a) {
    fields[a] = p_.x[a].data();
    fields[D + a] = p_.v[a].data();
    sums[a] = xsph_[a].data();
  }
  fields[2 * D] = fluid_volume_.data();
  if constexpr (Diffusion) fields[2 * D + 1] = p_.density.data();
  sums[D] = density_rate_.data();
  const double diffusion = params_.density_diffusion * h_ * c0_;
  // Without gravity the hydrostatic part is zero: the same sum for both choices.
  Vec<D> still_gravity{};
  if (params_.diffusion_of == DiffusionOf::dynamic_density) still_gravity = still_gravity_;

  const auto pair = [&](const auto& i, const auto& j) {
    std::array<Simd, D> dx;
    std::array<Simd, D> dv;
    Simd r2 = tiny;
    for (int a = 0; a < D; ++a) {
      dx[a] = j[a] - i[a];
      dv[a] = j[D + a] - i[D + a];
      r2 += dx[a] * dx[a];
    }
    const Simd r = root(r2);
    const Simd value = kernel.value(r);
    const Simd slope = kernel.derivative(r) / r;
    const Simd volume_i = i[2 * D];
    const Simd volume_j = j[2 * D];
    PairTerms<D + 1> terms;
    const Simd weight_i = xsph_weight(volume_j, value);
    const Simd weight_j = xsph_weight(volume_i, value);
    for (int a = 0; a < D; ++a) {
      terms.to_i[a] = weight_i * dv[a];
      terms.to_j[a] = -weight_j * dv[a];
    }
    const Simd rate = Simd(mass_) * continuity<Simd, D>(dv, dx, slope);
    terms.to_i[D] = rate;
    terms.to_j[D] = rate;
    if constexpr (Diffusion) {
      const Simd rho_i = i[2 * D + 1];
      const Simd rho_j = j[2 * D + 1];
      Simd head = 0.0;
      for (int a = 0; a < D; ++a) head += Simd(still_gravity[a]) * dx[a];
      const Simd still = hydrostatic_difference<Simd>(head, Simd(0.5) * (rho_i + rho_j), rho0_, c0_,
                                                      params_.gamma);
      Simd diffused =
          Simd(diffusion) * density_diffusion<Simd>(rho_j - rho_i - still, Simd(1.0), slope);
      // Walls have no volume here: they neither give nor take.
      stdx::where(volume_i * volume_j == 0.0, diffused) = 0.0;
      terms.to_i[D] += diffused * volume_j;
      terms.to_j[D] -= diffused * volume_i;
    }
    return terms;
  };
  const bool walls_too = params_.wall_density == WallDensity::continuity;
  const auto needed = [&](std::size_t i) { return walls_too || is_fluid(i); };
  const auto any_fluid = [&](std::size_t begin, std::size_t end) {
    return fluid_before_[end] > fluid_before_[begin];
  };
  if constexpr (Diffusion)
    diffusion_loop_(grid_, fields, sums, needed, any_fluid, pair);
  else
    continuity_loop_(grid_, fields, sums, needed, any_fluid, pair);
}

template <int D>
void Solver<D>::survey_surroundings(double dt) {
  if (!shifting_ && !difference_) return;
  const auto scope = clock_.measure(Phase::forces);
  std::visit(
      [&](const auto& kernel) {
        surroundings_.survey(kernel, grid_, p_, fluid_volume_, fluid_before_, 0.5 * v_max_);
        if (shifting_)
          surroundings_.density_rate(kernel, grid_, p_, fluid_volume_, fluid_before_,
                                     density_rate_);
      },
      kernel_);
  if (!shifting_) return;
  // Where the kernel is cut off by the surface, the sums are one-sided.
  for_each_fluid([&](std::size_t i) {
    if (!surroundings_.near_surface(i)) p_.density[i] += dt * density_rate_[i];
  });
}

template <int D>
void Solver<D>::drift(double dt, StepReport& report) {
  const auto scope = clock_.measure(Phase::forces);
  const auto n = static_cast<std::ptrdiff_t>(p_.size());
  long collisions = 0;
  long lost = 0;
#pragma omp parallel for schedule(static) reduction(+ : collisions, lost)
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    if (p_.type[i] != ParticleType::fluid) continue;
    Vec<D> start;
    Vec<D> end;
    Vec<D> v;
    for (int a = 0; a < D; ++a) {
      v[a] = p_.v[a][i];
      start[a] = p_.x[a][i] - 0.5 * dt * (v[a] + params_.xsph_epsilon * xsph_old_[a][i]);
      end[a] = start[a] + dt * (v[a] + params_.xsph_epsilon * xsph_[a][i]);
      if (shifting_) end[a] += dt * surroundings_.shift()[a][i];
    }
    if (walls_.apply(start, end, v)) {
      ++collisions;
      for (int a = 0; a < D; ++a) p_.v[a][i] = v[a];
    }
    for (int a = 0; a < D; ++a) p_.x[a][i] = end[a];
    if (walls_.is_lost(end)) ++lost;
  }
  report.wall_collisions = collisions;
  report.lost = lost;
}

template <int D>
void Solver<D>::apply_equation_of_state(StepReport& report) {
  const auto scope = clock_.measure(Phase::pressure);
  const auto n = static_cast<std::ptrdiff_t>(p_.size());
  const bool clip = params_.negative_pressure == NegativePressure::clip;
  const double damping = params_.acoustic_damping * c0_ * h_;
  long clipped = 0;
#pragma omp parallel for schedule(static) reduction(+ : clipped)
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    double p = state_.pressure(p_.density[i]);
    if (damping > 0.0) p += acoustic_damper(damping, compression_rate_[i]);
    if (p < 0.0 && (clip || (difference_ && surroundings_.on_surface(k)))) {
      // What is detached has no pressure to follow from, only what its density has drifted by.
      if (difference_ && surroundings_.is_detached(k)) p_.density[i] = rho0_;
      p = 0.0;
      clipped += p_.type[i] == ParticleType::fluid ? 1 : 0;
    }
    p_.pressure[i] = p;
  }
  report.clipped = clipped;
  if (params_.wall_density == WallDensity::extrapolated)
    std::visit([&](const auto& kernel) { extrapolate_to_walls(kernel); }, kernel_);
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t i = 0; i < n; ++i)
    p_over_rho2_[i] = p_.pressure[i] / (p_.density[i] * p_.density[i]);
  if (!difference_) return;
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t i = 0; i < n; ++i)
    own_p_over_rho2_[i] =
        without_tension(p_over_rho2_[i], surroundings_.near_surface(static_cast<std::size_t>(i)));
}

/// Pressure of a wall particle from the fluid around it, with the hydrostatic difference (Adami, Hu
/// & Adams 2012, J. Comput. Phys. 231, for a wall at rest):
///   p_w = sum_f [ p_f + rho_f g . (x_w - x_f) ] W_wf / sum_f W_wf,
/// and its density from the equation of state. Negative values are set to zero: walls do not suck.
template <int D>
template <class K>
void Solver<D>::extrapolate_to_walls(const K& kernel) {
  constexpr int fields = D + 3;
  std::array<const double*, fields> source;
  for (int a = 0; a < D; ++a) source[a] = p_.x[a].data();
  source[D] = p_.pressure.data();
  source[D + 1] = p_.density.data();
  source[D + 2] = fluid_volume_.data();
  const auto body = [&](std::size_t i, const Tile<fields>& tile) {
    if (is_fluid(i)) return;
    std::array<Simd, D> xi;
    for (int a = 0; a < D; ++a) xi[a] = p_.x[a][i];
    Simd weights = 0.0;
    Simd pressures = 0.0;
    for (std::size_t j = 0; j < tile.count; j += simd_width) {
      Simd r2 = tiny;
      Simd head = 0.0;
      for (int a = 0; a < D; ++a) {
        const Simd dx = load(tile.field[a] + j) - xi[a];
        r2 += dx * dx;
        head -= Simd(still_gravity_[a]) * dx;
      }
      Simd weight = kernel.value(Simd(root(r2)));
      stdx::where(load(tile.field[D + 2] + j) == 0.0, weight) = 0.0;
      weights += weight;
      pressures += weight * (load(tile.field[D] + j) + load(tile.field[D + 1] + j) * head);
    }
    const double sum = stdx::reduce(weights);
    p_.pressure[i] = sum > 0.0 ? std::max(0.0, stdx::reduce(pressures) / sum) : 0.0;
    p_.density[i] = state_.density(p_.pressure[i]);
  };
  pair_loop<D, fields>(
      grid_, wall_tiles_, source, [&](std::size_t cell) { return near_fluid(cell); }, body);
}

/// What a no-slip wall at rest shows the viscous term, so that the line of no motion lies on its
/// surface: v_w = -sum_f v_f W_wf / sum_f W_wf (Adami, Hu & Adams 2012).
template <int D>
template <class K>
void Solver<D>::extrapolate_velocity(const K& kernel) {
  constexpr int fields = 2 * D + 1;
  std::array<const double*, fields> source;
  for (int a = 0; a < D; ++a) {
    source[a] = p_.x[a].data();
    source[D + a] = p_.v[a].data();
    std::copy(p_.v[a].begin(), p_.v[a].end(), rubbing_velocity_[a].begin());
  }
  source[2 * D] = fluid_volume_.data();
  const auto body = [&](std::size_t i, const Tile<fields>& tile) {
    if (is_fluid(i)) return;
    std::array<Simd, D> sum{};
    Simd weights = 0.0;
    for (std::size_t j = 0; j < tile.count; j += simd_width) {
      Simd r2 = tiny;
      for (int a = 0; a < D; ++a) {
        const Simd dx = load(tile.field[a] + j) - Simd(p_.x[a][i]);
        r2 += dx * dx;
      }
      Simd weight = kernel.value(Simd(stdx::sqrt(r2)));
      stdx::where(load(tile.field[2 * D] + j) == 0.0, weight) = 0.0;
      weights += weight;
      for (int a = 0; a < D; ++a) sum[a] += weight * load(tile.field[D + a] + j);
    }
    const double total = stdx::reduce(weights);
    for (int a = 0; a < D; ++a)
      rubbing_velocity_[a][i] = total > 0.0 ? -stdx::reduce(sum[a]) / total : 0.0;
  };
  pair_loop<D, fields>(
      grid_, rubbing_tiles_, source, [&](std::size_t cell) { return near_fluid(cell); }, body);
}

template <int D>
void Solver<D>::apply_momentum() {
  const auto scope = clock_.measure(Phase::forces);
  if (no_slip_) std::visit([&](const auto& kernel) { extrapolate_velocity(kernel); }, kernel_);
  const bool viscous = alpha_c0_h_ > 0.0 || nu_ > 0.0;
  std::visit(
      [&](const auto& kernel) {
        using K = std::decay_t<decltype(kernel)>;
        if (difference_)
          momentum_pass<K, true, true>(kernel);
        else if (viscous)
          momentum_pass<K, true, false>(kernel);
        else
          momentum_pass<K, false, false>(kernel);
      },
      kernel_);
}

// Eq. (23)
/// D v/Dt = pressure term, Eq. (22), + gravity, which the paper adds in words, + viscous terms
/// where they are on.
template <int D>
template <class K, bool Viscous, bool Difference>
void Solver<D>::momentum_pass(const K& kernel) {
  using Loop = MomentumLoop<Viscous, Difference>;
  typename Loop::Sources fields;
  typename Loop::Sums sums;
  for (int a = 0; a < D; ++a) {
    fields[a] = p_.x[a].data();
    sums[a] = acceleration_[a].data();
  }
  fields[D] = p_over_rho2_.data();
  if constexpr (Viscous) {
    const auto& velocity = no_slip_ ? rubbing_velocity_ : p_.v;
    for (int a = 0; a < D; ++a) fields[D + 1 + a] = velocity[a].data();
    fields[2 * D + 1] = p_.density.data();
    fields[2 * D + 2] = fluid_volume_.data();
  }
  if constexpr (Difference) fields[2 * D + 3] = own_p_over_rho2_.data();
  const double h2 = h_ * h_;
  const bool deformation = params_.viscous_term == ViscousTerm::deformation;

  const auto pair = [&](const auto& i, const auto& j) {
    std::array<Simd, D> dx;
    Simd r2 = tiny;
    for (int a = 0; a < D; ++a) {
      dx[a] = j[a] - i[a];
      r2 += dx[a] * dx[a];
    }
    const Simd r = root(r2);
    const Simd slope = kernel.derivative(r) / r;
    Simd factor = pressure_term(i[D], j[D], slope);
    PairTerms<D> terms;
    if constexpr (Viscous) {
      std::array<Simd, D> dv;
      Simd approach = 0.0;
      for (int a = 0; a < D; ++a) {
        dv[a] = j[D + 1 + a] - i[D + 1 + a];
        approach += dv[a] * dx[a];
      }
      // Padding has no density.
      const Simd rho_i = stdx::max(i[2 * D + 1], Simd(1e-3));
      const Simd rho_j = stdx::max(j[2 * D + 1], Simd(1e-3));
      Simd volume_i = i[2 * D + 2];
      Simd volume_j = j[2 * D + 2];
      Simd artificial =
          artificial_viscosity(approach, r2, Simd(0.5) * (rho_i + rho_j), alpha_c0_h_, h2) * slope;
      // Slip walls exert no friction.
      stdx::where(volume_i * volume_j == 0.0, artificial) = 0.0;
      factor += artificial;
      const Simd pressure = Simd(mass_) * factor;
      for (int a = 0; a < D; ++a) {
        terms.to_i[a] = pressure * dx[a];
        terms.to_j[a] = -terms.to_i[a];
      }
      if constexpr (Difference) {
        // Each by its own pressure: only what differs from the sum of both is left to add.
        const Simd more_to_i = Simd(mass_) * (i[2 * D + 3] - i[D]) * slope;
        const Simd more_to_j = Simd(mass_) * (j[2 * D + 3] - j[D]) * slope;
        for (int a = 0; a < D; ++a) {
          terms.to_i[a] += more_to_i * dx[a];
          terms.to_j[a] -= more_to_j * dx[a];
        }
      }
      if (nu_ > 0.0) {
        if (no_slip_) {
          volume_i = Simd(mass_) / rho_i;
          volume_j = Simd(mass_) / rho_j;
        }
        // What is to be multiplied with the other's volume.
        const Simd one = 1.0;
        const Simd rub = deformation ? deformation_viscosity<D>(approach, r2, slope, one, nu_)
                                     : laminar_viscosity(r2, slope, one, nu_, h2);
        const auto& along = deformation ? dx : dv;
        for (int a = 0; a < D; ++a) {
          terms.to_i[a] += rub * volume_j * along[a];
          terms.to_j[a] -= rub * volume_i * along[a];
        }
      }
    } else {
      factor *= Simd(mass_);
      for (int a = 0; a < D; ++a) {
        terms.to_i[a] = factor * dx[a];
        terms.to_j[a] = -terms.to_i[a];
      }
    }
    return terms;
  };
  const auto needed = [&](std::size_t i) { return is_fluid(i); };
  const auto any_fluid = [&](std::size_t begin, std::size_t end) {
    return fluid_before_[end] > fluid_before_[begin];
  };
  if constexpr (Difference)
    difference_loop_(grid_, fields, sums, needed, any_fluid, pair);
  else if constexpr (Viscous)
    viscous_loop_(grid_, fields, sums, needed, any_fluid, pair);
  else
    momentum_loop_(grid_, fields, sums, needed, any_fluid, pair);
}

template <int D>
void Solver<D>::measure_speed() {
  v_max_ = fastest_speed(p_);
}

template class Solver<2>;
template class Solver<3>;

}  // namespace surge::sph
