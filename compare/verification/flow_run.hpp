#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "compare/read/run.hpp"

namespace surge::compare {

/// What the manifest of a run says about its flow: that of surge-particle, two-dimensional, with
/// one block of fluid. SI units.
struct FlowCase {
  std::string method, preset;
  double spacing = 0.0;
  double density = 0.0;
  double viscosity = 0.0;
  std::array<double, 2> gravity{};
  std::array<double, 2> lower{}, upper{};           ///< of the block
  std::array<std::array<double, 2>, 2> gradient{};  ///< of the block's velocity, 1/s
  double wave_amplitude = 0.0;
  double end = 0.0;  ///< s

  [[nodiscard]] double width() const { return upper[0] - lower[0]; }
  [[nodiscard]] double height() const { return upper[1] - lower[1]; }
  /// Particles over the width of the block, the length L of its flow.
  [[nodiscard]] double per_length() const { return width() / spacing; }
  [[nodiscard]] double particle_mass() const { return density * spacing * spacing; }  ///< kg/m
};

/// Throws Error with the key that is missing or not as above.
[[nodiscard]] FlowCase read_flow_case(const nlohmann::json& manifest, const std::string& source);

/// All frames of a run's folder, in time, particles in the order of their ids.
[[nodiscard]] std::vector<ParticleFrame> read_flow_frames(const std::filesystem::path& folder);

/// Sums over the fluid of one frame; the mass is that of all particles, kg/m.
struct FlowSums {
  double mass = 0.0;
  std::array<double, 2> centre{};    ///< m
  std::array<double, 2> momentum{};  ///< kg/s
  double angular_momentum = 0.0;     ///< about the origin, kg m/s
  double kinetic_energy = 0.0;       ///< J/m
  double potential_energy = 0.0;     ///< J/m, zero at the origin
  /// Mean of (x - centre)^2 and (y - centre)^2, each particle a square of side l0, m^2
  std::array<double, 2> spread{};
};
[[nodiscard]] FlowSums sum_up(const ParticleFrame& frame, const FlowCase& flow);

/// Area (m^2) of what lies within 3/4 of a spacing of a particle, by squares of a sixth of a
/// spacing: the lattice covers itself, and gaps that open in it are seen.
[[nodiscard]] double covered_area(const ParticleFrame& frame, double spacing);

}  // namespace surge::compare
