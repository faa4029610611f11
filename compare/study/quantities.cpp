#include "compare/study/quantities.hpp"

#include <cmath>

namespace surge::compare {
namespace {

std::optional<double> any_scalar(const Run& run, const FrontHistory& front,
                                 const std::string& name) {
  if (name == "spacing_m") return run.spacing.value();
  if (name == "column_width_m") return run.physics.column_width().value();
  if (name == "gravity") return run.physics.gravity_magnitude();
  if (name == "impact_time_s") {
    const auto far = run.physics.far_wall();
    const auto hit = far ? impact(front, *far, run.spacing) : std::nullopt;
    return hit ? std::optional(hit->time.value()) : std::nullopt;
  }
  if (!run.manifest.is_object() || !run.manifest.contains(name)) return std::nullopt;
  const nlohmann::json& value = run.manifest[name];
  if (value.is_boolean()) return value.get<bool>() ? 1.0 : 0.0;
  if (!value.is_number()) return std::nullopt;
  return value.get<double>();
}

}  // namespace

std::optional<double> scalar(const Run& run, const FrontHistory& front, const std::string& name) {
  const std::optional<double> value = any_scalar(run, front, name);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<double> scalar(const MeasuredRun& run, const std::string& name) {
  return scalar(run.run, run.history, name);
}

std::string level_text(double level) {
  std::string text = std::to_string(level);
  text.erase(text.find_last_not_of('0') + 1);
  return text.back() == '.' ? text + "0" : text;
}

WallRule wall_rule(const Run& run, DimensionlessLength distance) {
  const auto far = run.physics.far_wall();
  WallRule rule;
  if (far) rule.far_wall = run.physics.scales().dimensionless(*far);
  rule.distance = distance;
  return rule;
}

}  // namespace surge::compare
