#pragma once

#include <array>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

#include "tests/compare/synthetic.hpp"

namespace surge::compare::testing {

namespace fs = std::filesystem;

/// A column 0.1 m x 0.2 m of 200 particles 0.01 m apart, in a tank 0.4 m wide with walls, whose two
/// lowest layers reach x = 0.1 + 0.01 i m in frame i, each 0.02 s after the other. What they take
/// comes from the top, so that the particles stay as many and their centre sinks.
struct ForeignFlow {
  double scale = 1.0;  ///< of all lengths, for files in other units
  int ahead = 0;       ///< frames by which another run is ahead

  static constexpr double l0 = 0.01;
  static constexpr double interval = 0.02;
  static constexpr int frames = 6;

  static double edge(int i) { return 0.1 + l0 * i; }

  [[nodiscard]] std::vector<Vec3> fluid(int i) const {
    i += ahead;
    std::vector<Vec3> points;
    for (int row = 0; row < 20; ++row)
      for (int k = 0; k < 10; ++k)
        // The last 2 i particles of the top row and those below it lie at the front.
        if (const int from_top = 199 - (10 * row + k); from_top < 2 * i) {
          points.push_back({0.1 + l0 * (from_top / 2 + 0.5), l0 * (from_top % 2 + 0.5), 0.0});
        } else {
          points.push_back({l0 * (k + 0.5), l0 * (row + 0.5), 0.0});
        }
    return scaled(points);
  }

  [[nodiscard]] std::vector<Vec3> walls() const {
    std::vector<Vec3> points = lattice({-0.01, -0.01, 0}, {0.41, 0, 0}, l0);
    append(points, lattice({-0.01, 0, 0}, {0, 0.3, 0}, l0));
    append(points, lattice({0.4, 0, 0}, {0.41, 0.3, 0}, l0));
    return scaled(points);
  }

  [[nodiscard]] std::vector<Vec3> scaled(std::vector<Vec3> points) const {
    for (Vec3& x : points)
      for (double& c : x) c *= scale;
    return points;
  }

  /// What a program writes of a frame: fluid, then walls, with the types that it uses.
  struct Particles {
    std::vector<Vec3> position;
    std::vector<Vec3> velocity;
    std::vector<double> pressure;
    std::vector<int> type;
  };
  [[nodiscard]] Particles particles(int i, int fluid_type, std::optional<int> wall_type) const {
    Particles all;
    all.position = fluid(i);
    all.type.assign(all.position.size(), fluid_type);
    if (wall_type) {
      append(all.position, walls());
      all.type.resize(all.position.size(), *wall_type);
    }
    for (std::size_t k = 0; k < all.position.size(); ++k) {
      all.velocity.push_back({0.5, -0.25, 0.0});
      all.pressure.push_back(1000.0 + static_cast<double>(k));
    }
    return all;
  }
};

/// y and z exchanged, for programs whose plane is x-z.
inline Vec3 upright(const Vec3& x) {
  return {x[0], x[2], x[1]};
}

inline std::string padded(long number, int digits) {
  std::ostringstream out;
  out << std::setw(digits) << std::setfill('0') << number;
  return out.str();
}

inline std::string digits17(double value) {
  std::ostringstream out;
  out << std::setprecision(17) << value;
  return out.str();
}

/// Fronts of the first six frames as surge-compare measures them; the strip holds both layers.
inline FrontOptions foreign_front() {
  FrontOptions options;
  options.strip_height = Metres(0.03);
  return options;
}

/// Options that no file states.
inline SourceOptions foreign_facts() {
  SourceOptions options;
  options.spacing = Metres(ForeignFlow::l0);
  options.gravity = 9.81;
  return options;
}

/// Expects the known front; returns the notices.
inline std::vector<std::string> expect_known_front(const fs::path& source,
                                                   const SourceOptions& options,
                                                   bool has_pressure = true) {
  auto run = open_run(source, options);
  const FrontHistory front = measure_front(run, foreign_front());
  EXPECT_EQ(front.size(), static_cast<std::size_t>(ForeignFlow::frames));
  for (std::size_t i = 0; i < front.size(); ++i) {
    EXPECT_NEAR(front[i].time.value(), ForeignFlow::interval * static_cast<double>(i), 2e-6);
    EXPECT_NEAR(front[i].position.value(), ForeignFlow::edge(static_cast<int>(i)), 2e-7) << i;
  }
  EXPECT_NEAR(run.physics.gravity_magnitude(), 9.81, 1e-9);
  EXPECT_NEAR(run.physics.column_width().value(), 0.1, 2e-7);
  // Pressure and velocity come with the fluid they belong to.
  const auto frame =
      std::get<ParticleFrame>(run.frames->read(1, {.pressure = has_pressure, .velocity = true}));
  EXPECT_EQ(frame.position.size(), 200U);
  EXPECT_EQ(frame.velocity.size(), 200U);
  const auto up = static_cast<std::size_t>(run.physics.vertical_axis());
  for (std::size_t k = 0; k < frame.velocity.size(); ++k) {
    EXPECT_NEAR(frame.velocity[k][0], 0.5, 1e-6);
    EXPECT_NEAR(frame.velocity[k][up], -0.25, 1e-6);
    if (has_pressure) {
      EXPECT_NEAR(frame.pressure.at(k), 1000.0 + static_cast<double>(k), 1e-3);
    }
  }
  return run.notices;
}

}  // namespace surge::compare::testing
