#include "compare/verification/flow_run.hpp"

#include <cmath>
#include <set>

#include "compare/read/readers.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

template <std::size_t N>
std::array<double, 2> first_two(const std::array<double, N>& values) {
  return {values[0], values[1]};
}

FlowCase read_case(const json& c) {
  FlowCase flow;
  const json& method = c.at("method");
  flow.method = method.at("name").get<std::string>();
  flow.preset = method.at("preset").get<std::string>();
  flow.spacing = c.at("spacing").get<double>();
  const json& fluid = c.at("fluid");
  flow.density = fluid.at("density").get<double>();
  flow.viscosity = fluid.at("kinematic_viscosity").get<double>();
  flow.gravity = first_two(fluid.at("gravity").get<Vec3>());
  const json& block = c.at("blocks").at(0);
  flow.lower = first_two(block.at("lower").get<Vec3>());
  flow.upper = first_two(block.at("upper").get<Vec3>());
  const auto gradient = block.at("velocity_gradient").get<std::array<Vec3, 3>>();
  flow.gradient = {first_two(gradient[0]), first_two(gradient[1])};
  flow.wave_amplitude = block.at("wave_amplitude").get<double>();
  flow.end = c.at("time").at("end").get<double>();
  return flow;
}

}  // namespace

FlowCase read_flow_case(const json& manifest, const std::string& source) {
  try {
    const json& c = manifest.at("case");
    if (c.at("dimension") != 2 || c.at("blocks").size() != 1) {
      throw Error(source + ": case: found " + c.at("dimension").dump() + " dimensions and " +
                  std::to_string(c.at("blocks").size()) + " blocks, expected 2 and 1");
    }
    return read_case(c);
  } catch (const json::exception& error) {
    throw Error(source + ": case: found " + error.what() +
                ", expected a manifest of surge-particle");
  }
}

std::vector<ParticleFrame> read_flow_frames(const std::filesystem::path& folder) {
  SourceOptions options;
  options.type_required = true;
  const auto reader = open_particle_series(list_series(folder / "particles.pvd"), options);
  std::vector<ParticleFrame> frames;
  for (std::size_t i = 0; i < reader->times().size(); ++i) {
    Frame frame = reader->read(i, {.pressure = true, .velocity = true});
    frames.push_back(std::move(std::get<ParticleFrame>(frame)));
  }
  return frames;
}

FlowSums sum_up(const ParticleFrame& frame, const FlowCase& flow) {
  FlowSums sums;
  const double mass = flow.particle_mass();
  const auto n = static_cast<double>(frame.position.size());
  sums.mass = n * mass;
  for (std::size_t i = 0; i < frame.position.size(); ++i) {
    const Vec3& x = frame.position[i];
    const Vec3& v = frame.velocity[i];
    for (std::size_t a = 0; a < 2; ++a) {
      sums.centre[a] += x[a] / n;
      sums.momentum[a] += mass * v[a];
      sums.potential_energy -= mass * flow.gravity[a] * x[a];
    }
    sums.angular_momentum += mass * (x[0] * v[1] - x[1] * v[0]);
    sums.kinetic_energy += 0.5 * mass * (v[0] * v[0] + v[1] * v[1]);
  }
  for (const Vec3& x : frame.position)
    for (std::size_t a = 0; a < 2; ++a)
      sums.spread[a] += (x[a] - sums.centre[a]) * (x[a] - sums.centre[a]) / n;
  for (double& spread : sums.spread) spread += flow.spacing * flow.spacing / 12.0;
  return sums;
}

double covered_area(const ParticleFrame& frame, double spacing) {
  const double cell = spacing / 6.0;
  const double radius = 0.75 * spacing / cell;  // in cells
  std::set<std::pair<long, long>> covered;
  for (const Vec3& p : frame.position) {
    const double x = p[0] / cell;
    const double y = p[1] / cell;
    for (auto i = std::lround(std::floor(x - radius)); i <= std::lround(x + radius); ++i)
      for (auto j = std::lround(std::floor(y - radius)); j <= std::lround(y + radius); ++j)
        if (std::hypot(static_cast<double>(i) + 0.5 - x, static_cast<double>(j) + 0.5 - y) < radius)
          covered.emplace(i, j);
  }
  return static_cast<double>(covered.size()) * cell * cell;
}

}  // namespace surge::compare
