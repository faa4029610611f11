#include <algorithm>
#include <cmath>

#include "compare/reference/series.hpp"
#include "particle/support/table.hpp"

namespace surge::compare {
namespace {

constexpr double tolerance = 0.02;  ///< of L

std::string unlike(const std::string& what, const std::string& series, const std::string& run) {
  return "of another case: " + what + ": " + series + " in the series, " + run + " in the run";
}

/// A length over L that the run states, against the one of the series.
std::optional<std::string> unlike(const std::string& what, double series, double run) {
  if (!std::isfinite(run)) return unlike(what, fixed_text(series, 2) + " L", "not stated");
  if (std::abs(series - run) <= tolerance) return std::nullopt;
  return unlike(what, fixed_text(series, 2) + " L", fixed_text(run, 2) + " L");
}

}  // namespace

std::optional<std::string> other_case(const PublishedSeries& series, const Physics& physics) {
  const auto up = static_cast<std::size_t>(physics.vertical_axis());
  const double length = physics.column_width().value();
  const double height = physics.column.upper[up] - physics.floor();
  if (auto reason = unlike("height of the column", series.of.column_height, height / length))
    return reason;
  if (series.of.tank_width) {
    const auto far = physics.far_wall();
    if (!far) return unlike("far wall", fixed_text(*series.of.tank_width, 2) + " L", "not stated");
    if (auto reason = unlike("far wall", *series.of.tank_width, far->value() / length))
      return reason;
  }
  // A source that states no bed has shown its column alone at the start, or no front.
  const double bed = physics.bed_depth().value_or(Metres(0.0)).value();
  if (auto reason = unlike("water in the tank", series.of.bed_depth, bed / length)) return reason;
  const std::size_t bodies = physics.blocks ? physics.blocks->size() : 1;
  if (bodies > 1 && !(bed > 0.0)) return unlike("bodies of water", "1", std::to_string(bodies));
  if (physics.obstacles && !physics.obstacles->empty())
    return unlike("obstacles", "none", std::to_string(physics.obstacles->size()));
  const auto moves = [](const WaterBody& body) { return body.velocity != Vec3{}; };
  if (physics.blocks && std::any_of(physics.blocks->begin(), physics.blocks->end(), moves))
    return unlike("water at the start", "at rest", "moving");
  return std::nullopt;
}

nlohmann::json to_json(const PublishedCase& of) {
  return {{"column_height", of.column_height},
          {"tank_width", of.tank_width ? nlohmann::json(*of.tank_width) : nlohmann::json(nullptr)},
          {"bed_depth", of.bed_depth},
          {"gate", of.gate},
          {"axes", of.axes}};
}

}  // namespace surge::compare
