#pragma once

#include <memory>

#include "tests/compare/foam_case_writer.hpp"

namespace surge::compare::testing {

/// Column of width 0.1 m in a tank of 0.4 m x 0.2 m, cells of 0.01 m, whose front is known at every
/// time: water below half the tank's height up to x = foam_edge(t), as much of it as at the start.
inline double foam_edge(double time) {
  return 0.1 + 1.013 * time;
}

/// The height that keeps the volume: the water's top is level, between the faces of cells.
inline double foam_height(double time) {
  return 0.1 * 0.1 / foam_edge(time);
}

inline double foam_part(double low, double high, double end) {
  return std::clamp((end - low) / (high - low), 0.0, 1.0);
}

inline double foam_water(Vec3 low, Vec3 high, double time) {
  return foam_part(low[0], high[0], foam_edge(time)) *
         foam_part(low[1], high[1], foam_height(time));
}

inline FoamTestTank foam_tank(int layers = 1, const FoamTestTank::Refined& refined = {}) {
  return {{40, 20, layers}, 0.01, layers == 1 ? std::size_t{2} : std::size_t{3}, refined};
}

/// The fronts of a case, expected to be those of foam_edge at the times of `run`, less `start`.
inline void expect_foam_front(const std::filesystem::path& path, std::size_t frames,
                              const SourceOptions& options = {}, double start = 0.0) {
  Run run = open_run(path, options);
  ASSERT_EQ(run.frames->times().size(), frames);
  EXPECT_NEAR(run.physics.column_width().value(), foam_edge(start), 1e-12);
  FrontOptions front;
  for (const FrontSample& sample : measure_front(run, front)) {
    EXPECT_NEAR(sample.position.value(), foam_edge(sample.time.value() + start), 1e-9)
        << sample.time.value();
  }
}

}  // namespace surge::compare::testing
