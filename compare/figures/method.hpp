#pragma once

#include <optional>

#include "compare/figures/figures.hpp"
#include "compare/read/method_sheet.hpp"

namespace surge::compare {

/// A run that says what it computed with.
struct SheetRun {
  const RunResult* run = nullptr;
  MethodSheet sheet;
};

/// The first measured run of a method ("mps", "sph") with a method.json, one of preset "paper"
/// before others. Empty where there is none.
[[nodiscard]] std::optional<SheetRun> sheet_run(const StudyResult& study,
                                                const std::string& method);

/// A figure of which there is nothing to draw, and why.
[[nodiscard]] Figure empty_figure(const std::string& name, const std::string& title,
                                  const std::string& why);

/// One particle of a real frame and those that it interacts with.
struct Interaction {
  const RunResult* run = nullptr;
  Seconds time;
  std::vector<double> radii_over_l0;    ///< decreasing
  std::vector<std::size_t> neighbours;  ///< fluid particles within each radius
  struct Point {
    double x = 0, y = 0, distance = 0;  ///< from the particle, over l0
  };
  std::vector<Point> points;  ///< all near it, the particle itself first
  Vec3 position{};            ///< of the particle, m
};
/// From the MPS run (else the SPH run) of sheet_run at the study's second snapshot time (the last
/// one before it that the run has): the fluid particle nearest to the centre of mass of the water.
/// Empty where there is no such run.
[[nodiscard]] std::optional<Interaction> find_interaction(const StudyResult& study);

}  // namespace surge::compare
