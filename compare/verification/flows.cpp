#include "compare/verification/flows.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "compare/verification/exact.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {

namespace {

using Frames = std::vector<ParticleFrame>;
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

double magnitude(const std::array<double, 2>& v) {
  return std::hypot(v[0], v[1]);
}

/// Frames of the last quarter of a run.
std::vector<const ParticleFrame*> last_quarter(const FlowCase& flow, const Frames& frames) {
  std::vector<const ParticleFrame*> late;
  for (const auto& frame : frames)
    if (frame.time.value() >= 0.75 * flow.end - 1e-9) late.push_back(&frame);
  return late;
}

void require(bool holds, const std::string& found, const std::string& expected) {
  if (!holds) throw Error("case: found " + found + ", expected " + expected);
}

/// RMS over particles and the frames of the last quarter of p - rho g (H - y), over rho g H, and
/// of what it fluctuates about each particle's mean.
FlowResult measure_hydrostatic(const FlowCase& flow, const Frames& frames) {
  const double g = -flow.gravity[1];
  require(flow.gravity[0] == 0.0 && g > 0.0, "gravity not along -y", "gravity along -y");
  const double scale = flow.density * g * flow.height();
  const auto depth = [&](const Vec3& x) { return (flow.upper[1] - x[1]) / flow.height(); };
  const auto late = last_quarter(flow, frames);
  const std::size_t n = late.front()->position.size();
  std::vector<double> mean(n, 0.0);
  double square = 0.0;
  for (const ParticleFrame* frame : late) {
    require(frame->position.size() == n, "particles that left", "as many in every frame");
    for (std::size_t i = 0; i < n; ++i) {
      square += std::pow(frame->pressure[i] / scale - depth(frame->position[i]), 2);
      mean[i] += frame->pressure[i] / scale / static_cast<double>(late.size());
    }
  }
  double noise = 0.0;
  for (const ParticleFrame* frame : late)
    for (std::size_t i = 0; i < n; ++i) noise += std::pow(frame->pressure[i] / scale - mean[i], 2);
  const auto samples = static_cast<double>(n * late.size());
  FlowResult result;
  result.error = std::sqrt(square / samples);
  result.measures = {{"noise", std::sqrt(noise / samples)}};
  FlowCurve curve{"pressure", {}};
  const ParticleFrame& last = frames.back();
  for (std::size_t i = 0; i < last.position.size(); ++i) {
    const double d = depth(last.position[i]);
    curve.points.push_back({d, last.pressure[i] / scale, d});
  }
  result.curves = {curve};
  const FlowSums begin = sum_up(frames.front(), flow);
  const FlowSums end = sum_up(last, flow);
  const double weight = end.mass * g * flow.height();
  result.momentum = magnitude(end.momentum) / (end.mass * std::sqrt(g * flow.height()));
  result.energy =
      (end.kinetic_energy + end.potential_energy - begin.kinetic_energy - begin.potential_energy) /
      weight;
  result.volume = 2.0 * (end.centre[1] - flow.lower[1]) / flow.height() - 1.0;
  return result;
}

/// Largest relative error of either semi-axis until the end. The semi-axes of a uniform ellipse are
/// twice the root of its mean x^2 and y^2.
FlowResult measure_drop(const FlowCase& flow, const Frames& frames) {
  const double rate = flow.gradient[1][1];
  require(rate > 0.0 && flow.gradient[0][0] == -rate, "another velocity", "(-A x, A y), A > 0");
  const double radius = 0.5 * flow.width();
  FlowResult result;
  FlowCurve shorter{"a", {}};
  FlowCurve longer{"b", {}};
  double first_product = 0.0;
  for (const ParticleFrame& frame : frames) {
    const double t = frame.time.value();
    const FlowSums sums = sum_up(frame, flow);
    const double a = 2.0 * std::sqrt(sums.spread[0]) / radius;
    const double b = 2.0 * std::sqrt(sums.spread[1]) / radius;
    const DropAxes exact = drop_axes(rate, t);
    shorter.points.push_back({rate * t, a, exact.x});
    longer.points.push_back({rate * t, b, exact.y});
    result.error =
        std::max({result.error, std::abs(a / exact.x - 1.0), std::abs(b / exact.y - 1.0)});
    if (first_product == 0.0) first_product = a * b;
    result.volume = a * b / first_product - 1.0;
  }
  const auto last_error = [](const FlowCurve& curve) {
    return curve.points.back().measured / curve.points.back().exact - 1.0;
  };
  result.measures = {{"short_axis_at_end", last_error(shorter)},
                     {"long_axis_at_end", last_error(longer)}};
  result.curves = {shorter, longer};
  const FlowSums begin = sum_up(frames.front(), flow);
  const FlowSums end = sum_up(frames.back(), flow);
  result.momentum = magnitude(end.momentum) / (end.mass * rate * radius);
  result.energy = end.kinetic_energy / begin.kinetic_energy - 1.0;
  return result;
}

/// The surface's amplitude over time, (2/L) int int cos kx dA: with the flat part of the surface,
/// whose integral is zero, it needs no surface to be found.
FlowResult measure_wave(const FlowCase& flow, const Frames& frames) {
  require(flow.wave_amplitude > 0.0, "no wave", "wave_amplitude above 0");
  const double k = std::numbers::pi / flow.width();
  const double h = flow.height();
  const double omega = wave_frequency(-flow.gravity[1], k, h);
  const double decay = wave_decay(flow.viscosity, k);
  std::vector<double> times, amplitudes;
  FlowResult result;
  FlowCurve curve{"amplitude", {}};
  for (const ParticleFrame& frame : frames) {
    const double t = frame.time.value();
    double sum = 0.0;
    for (const Vec3& x : frame.position) sum += std::cos(k * (x[0] - flow.lower[0]));
    const double amplitude = 2.0 * flow.spacing * flow.spacing / flow.width() * sum;
    times.push_back(t);
    amplitudes.push_back(amplitude);
    curve.points.push_back({omega * t / (2.0 * std::numbers::pi), amplitude / flow.wave_amplitude,
                            std::exp(-decay * t) * std::sin(omega * t)});
  }
  const DampedWave fit = fit_damped_wave(times, amplitudes, omega);
  const double period = omega / fit.omega - 1.0;
  result.error = flow.viscosity > 0.0 ? std::abs(fit.decay / decay - 1.0) : std::abs(period);
  result.measures = {{"period", period},
                     {"decay_per_s", fit.decay},
                     {"exact_decay_per_s", decay},
                     {"amplitude", fit.amplitude / flow.wave_amplitude - 1.0}};
  result.curves = {curve};
  const FlowSums begin = sum_up(frames.front(), flow);
  const FlowSums end = sum_up(frames.back(), flow);
  result.energy =
      (end.kinetic_energy + end.potential_energy - begin.potential_energy) / begin.kinetic_energy -
      std::exp(-2.0 * decay * frames.back().time.value());
  // The wave itself lifts the centre by its amplitude squared over 4 H.
  const double lifted = std::pow(amplitudes.back() / h, 2) / 2.0;
  result.volume = 2.0 * (end.centre[1] - flow.lower[1]) / h - 1.0 - lifted;
  return result;
}

/// c of I/I0 = 1 + c (omega t)^2 + d (omega t)^4, least squares over the frames to omega t = 0.5.
double spreading(const FlowCurve& curve) {
  double m44 = 0.0, m46 = 0.0, m66 = 0.0, r2 = 0.0, r4 = 0.0;
  for (const auto& point : curve.points) {
    if (point.x > 0.5 + 1e-9) continue;
    const double s = point.x * point.x;
    m44 += s * s, m46 += s * s * s, m66 += s * s * s * s;
    r2 += s * (point.measured - 1.0), r4 += s * s * (point.measured - 1.0);
  }
  return (r2 * m66 - r4 * m46) / (m44 * m66 - m46 * m46);
}

/// Distance from the centre of the four particles that were farthest at time zero, over what it
/// was.
double corner_distance(const ParticleFrame& first, const ParticleFrame& frame) {
  double farthest = 0.0;
  for (const Vec3& x : first.position) farthest = std::max(farthest, std::hypot(x[0], x[1]));
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < first.position.size(); ++i) {
    if (std::hypot(first.position[i][0], first.position[i][1]) < (1.0 - 1e-5) * farthest) continue;
    sum += std::hypot(frame.position[i][0], frame.position[i][1]) / farthest;
    count += 1.0;
  }
  return sum / count;
}

FlowResult measure_patch(const FlowCase& flow, const Frames& frames) {
  const double omega = flow.gradient[1][0];
  require(omega > 0.0 && flow.gradient[0][1] == -omega, "another velocity", "a rotation");
  FlowResult result;
  FlowCurve curve{"moment", {}};
  const double exact = patch_spreading();
  const FlowSums begin = sum_up(frames.front(), flow);
  const double moment = begin.spread[0] + begin.spread[1];
  for (const ParticleFrame& frame : frames) {
    const FlowSums sums = sum_up(frame, flow);
    const double x = omega * frame.time.value();
    curve.points.push_back({x, (sums.spread[0] + sums.spread[1]) / moment,
                            x < 0.5 + 1e-9 ? 1.0 + exact * x * x : unknown});
  }
  const double c = spreading(curve);
  result.error = std::abs(c - exact);
  const FlowSums end = sum_up(frames.back(), flow);
  const double turn = omega * frames.back().time.value();
  result.measures = {
      {"spreading", c},
      {"exact_spreading", exact},
      {"corner_distance",
       corner_distance(frames.front(), frames.back()) / std::sqrt(1.0 + turn * turn) - 1.0},
      {"angular_momentum", end.angular_momentum / begin.angular_momentum - 1.0}};
  result.curves = {curve};
  result.momentum = magnitude(end.momentum) / (end.mass * omega * flow.width());
  result.energy = end.kinetic_energy / begin.kinetic_energy - 1.0;
  result.volume =
      covered_area(frames.back(), flow.spacing) / covered_area(frames.front(), flow.spacing) - 1.0;
  return result;
}

/// RMS over the fluid of the velocity's error at the end, over the steady speed in the middle.
FlowResult measure_channel(const FlowCase& flow, const Frames& frames) {
  const double force = flow.gravity[0];
  require(force > 0.0 && flow.viscosity > 0.0, "no force along x or no viscosity", "both");
  const double h = flow.height();
  const double top = force * h * h / (8.0 * flow.viscosity);
  const auto exact = [&](double y, double t) {
    return channel_speed(force, flow.viscosity, h, y - flow.lower[1], t);
  };
  FlowResult result;
  double largest_across = 0.0;
  for (const double part : {0.25, 1.0}) {
    const auto index =
        static_cast<std::size_t>(std::lround(part * static_cast<double>(frames.size() - 1)));
    const ParticleFrame& frame = frames[index];
    const double t = frame.time.value();
    FlowCurve curve{part < 1.0 ? "early" : "end", {}};
    double square = 0.0;
    for (std::size_t i = 0; i < frame.position.size(); ++i) {
      const double y = frame.position[i][1];
      const double u = exact(y, t);
      const Vec3& v = frame.velocity[i];
      square += std::pow(v[0] - u, 2) + v[1] * v[1];
      if (part == 1.0) largest_across = std::max(largest_across, std::abs(v[1]));
      curve.points.push_back({(y - flow.lower[1]) / h, v[0] / top, u / top});
    }
    result.error = std::sqrt(square / static_cast<double>(frame.position.size())) / top;
    result.curves.push_back(std::move(curve));
  }
  result.measures = {{"largest_speed_across", largest_across / top}};
  const FlowSums end = sum_up(frames.back(), flow);
  constexpr int slices = 400;
  double mean = 0.0;
  double square = 0.0;
  for (int i = 0; i < slices; ++i) {
    const double u = exact(flow.lower[1] + (i + 0.5) * h / slices, frames.back().time.value());
    mean += u / slices;
    square += u * u / slices;
  }
  result.momentum = end.momentum[0] / end.mass / mean - 1.0;
  result.energy = 2.0 * end.kinetic_energy / end.mass / square - 1.0;
  return result;
}

}  // namespace

std::span<const KnownFlow> known_flows() {
  static const std::array<KnownFlow, 6> flows{{
      {"hydrostatic_tank", "Still water",
       "A tank filled to H, from rest to 2 s. Exact: p = ρ g (H − y), nothing moves. L is the "
       "width "
       "of the water.",
       "RMS over all particles in the last quarter of the time of p − ρ g (H − y), over ρ g H",
       "depth/H", "p/(ρ g H)", 0.02, 20.0, true, measure_hydrostatic},
      {"stretching_drop", "Stretching drop",
       "A circle with the velocity (−A x, A y), free of gravity and walls, to A t = 0.8 "
       "(Monaghan 1994). Exact: an ellipse whose axes follow an ordinary differential equation. "
       "The axes come from the second moments of the particles. L is the diameter.",
       "Largest relative error of either axis up to the end", "A t", "semi-axes over the radius",
       0.01, 40.0, false, measure_drop},
      {"standing_wave", "Standing wave",
       "Half a wave of small amplitude between frictionless walls on water of depth L/2, for three "
       "periods, without viscosity. Exact: ω² = g k tanh kH (Lamb, Art. 228), no decay. The "
       "amplitude is the surface’s Fourier component, taken as an integral over the "
       "particles; period and decay are those of a damped sine fitted to it. L is the width, half "
       "a wave.",
       "Relative error of the period", "t over the exact period", "amplitude over the initial one",
       0.01, 40.0, false, measure_wave},
      {"viscous_wave", "Standing wave with viscosity",
       "The same wave with a kinematic viscosity. Exact: the amplitude decays with 2 ν k² (Lamb, "
       "Art. 348).",
       "Relative error of the rate of decay, numerical dissipation included",
       "t over the exact period", "amplitude over the initial one", std::nullopt, 0.0, false,
       measure_wave},
      {"rotating_patch", "Rotating square patch",
       "A square in rigid rotation, free of gravity and walls, to ω t = 2 (Colagrossi 2005). The "
       "pressure inside is negative. Exact: the polar moment of inertia grows at first as "
       "1 + c (ω t)², with c from the double sine series of the initial pressure; momentum, "
       "angular "
       "momentum and energy stay. A cloud of particles that do not feel each other has c = 1.",
       "Error of c, fitted to ω t = 0.5", "ω t", "moment of inertia over the initial one",
       std::nullopt, 0.0, false, measure_patch},
      {"channel", "Flow between plates",
       "A channel between plates at rest, periodic along its axis, driven by a constant force from "
       "time zero; Reynolds number 10. Exact: a series (Morris, Fox & Zhu 1997). L is the width "
       "of the channel.",
       "RMS over all particles at the end of the error of the velocity, over the steady speed in "
       "the middle",
       "y/H", "speed over the steady speed in the middle", std::nullopt, 0.0, true,
       measure_channel},
  }};
  return flows;
}

FlowResult measure_flow(const std::string& group, const std::filesystem::path& folder,
                        const nlohmann::json& manifest) {
  for (const KnownFlow& known : known_flows()) {
    if (known.group != group) continue;
    const FlowCase flow = read_flow_case(manifest, (folder / "manifest.json").string());
    const Frames frames = read_flow_frames(folder);
    if (frames.size() < 4)
      throw Error(folder.string() + ": found " + std::to_string(frames.size()) +
                  " frames, expected at least 4");
    try {
      FlowResult result = known.measure(flow, frames);
      result.flow = flow;
      return result;
    } catch (const Error& error) {
      throw Error((folder / "manifest.json").string() + ": " + error.what());
    }
  }
  std::string names;
  for (const KnownFlow& known : known_flows()) names += (names.empty() ? "" : ", ") + known.group;
  throw Error("group: found \"" + group + "\", expected one of " + names);
}

std::optional<double> observed_order(double coarse_spacing, double coarse_error,
                                     double fine_spacing, double fine_error) {
  if (!(coarse_error > 0.0) || !(fine_error > 0.0) || !(coarse_spacing > fine_spacing))
    return std::nullopt;
  return std::log(coarse_error / fine_error) / std::log(coarse_spacing / fine_spacing);
}

}  // namespace surge::compare
