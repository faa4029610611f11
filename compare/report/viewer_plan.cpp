#include <algorithm>
#include <cmath>
#include <set>

#include "compare/figures/solids.hpp"
#include "compare/report/viewer.hpp"
#include "compare/report/viewer_encoding.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

constexpr std::size_t most_times = 1000;
/// A film of fewer pictures is none: rather a run less.
constexpr std::size_t fewest_times = 26;
constexpr std::size_t most_runs = 6;
/// Squares on which water of a mesh is shown, per L.
constexpr double squares_per_length = 20.0;

/// Bytes of one particle at one time in the page, before base64: three for its place in 2D, of
/// which smooth flow needs half, and one for each of pressure and speed. On a mesh, of a square.
constexpr double bytes_per_particle = 3.2, bytes_per_particle_in_space = 4.2;
constexpr double bytes_per_square = 1.5;
constexpr double bytes_per_surface_cell = 2.0;

/// Bytes of one time in the page, of thoroughly splashed water.
double bytes_per_time(const RunResult& result) {
  const Run& run = result.measured->run;
  const bool in_space = run.physics.dimension == 3;
  const double length = run.physics.column_width().value();
  const Extent& column = run.physics.column;
  const auto up = static_cast<std::size_t>(run.physics.vertical_axis());
  double bytes = bytes_per_surface_cell * 20.0 * length / run.spacing.value();
  if (run.is_mesh()) {
    const double edge = viewer_square(run);
    double squares = 2.0 * (column.upper[up] - column.lower[up]) / length / (edge * edge);
    if (in_space) squares *= (column.upper[3 - up] - column.lower[3 - up]) / (length * edge);
    bytes += bytes_per_square * squares;
  } else {
    const Frame frame = run.frames->read(0, {});
    bytes += (in_space ? bytes_per_particle_in_space : bytes_per_particle) *
             double(std::get<ParticleFrame>(frame).position.size());
  }
  return bytes * 4.0 / 3.0;
}

/// The reference and the first of each other method and preset.
std::vector<const RunResult*> first_of_each_method(const StudyResult& study) {
  const auto kind = [](const RunResult& run) {
    return std::pair(run.measured->run.method, run.measured->run.preset);
  };
  std::set<std::pair<std::string, std::string>> seen{kind(study.reference())};
  std::size_t others = 0;
  std::vector<const RunResult*> runs;
  for (const RunResult* run : study.measured()) {
    const bool reference = run == &study.reference();
    if (!reference && (others + 1 == most_runs || !seen.insert(kind(*run)).second)) continue;
    if (!reference) ++others;
    runs.push_back(run);
  }
  return runs;
}

/// Those of the run that lasts longest, of several the one with the fewest frames.
const std::vector<Seconds>& all_times(const std::vector<const RunResult*>& runs) {
  const std::vector<Seconds>* longest = nullptr;
  for (const RunResult* run : runs) {
    const auto& times = run->measured->run.frames->times();
    const double later = longest ? (times.back() - longest->back()).value() : 1.0;
    // Times of different programs differ by rounding.
    const bool as_late = std::abs(later) < 1e-6;
    if (as_late ? times.size() < longest->size() : later > 0.0) longest = &times;
  }
  return *longest;
}

/// The first, the last and every stride-th before it, so that there are not many more than `most`.
std::vector<Seconds> times_of(const std::vector<const RunResult*>& runs, std::size_t most) {
  const std::vector<Seconds>& all = all_times(runs);
  const std::size_t steps = all.size() - 1;
  const std::size_t stride = std::max<std::size_t>(1, (steps + most - 1) / most);
  std::vector<Seconds> times;
  std::size_t i = steps;
  for (; i > 0; i -= std::min(i, stride)) times.push_back(all[i]);
  times.push_back(all.front());
  std::reverse(times.begin(), times.end());
  return times;
}

/// Z/L of a run at a time of the viewer; null where it has no leading edge any more.
json front_at(const MeasuredRun& run, DimensionlessTime time) {
  if (run.front.samples.empty()) return nullptr;
  const auto& last = run.front.samples.back();
  // Times of different programs differ by rounding.
  if (std::abs((time - last.time).value()) < 1e-6) return last.position.value();
  const auto position = run.front.at(time);
  return position ? json(position->value()) : json();
}

}  // namespace

double viewer_square(const Run& run) {
  return std::max(1.0 / squares_per_length, run.spacing / run.physics.column_width());
}

const Run& viewer_solid_run(const StudyResult& study, const ViewerPlan& plan) {
  const Run& reference = study.reference_run().run;
  if (reference.physics.obstacles) return reference;
  for (const RunResult* run : plan.runs)
    if (run->measured->run.physics.obstacles) return run->measured->run;
  return reference;
}

ViewerPlan plan_viewer(const StudyResult& study, double budget) {
  ViewerPlan plan;
  plan.runs = first_of_each_method(study);
  std::vector<double> bytes;
  for (const RunResult* run : plan.runs) bytes.push_back(bytes_per_time(*run));
  const auto affordable = [&] {
    double sum = 0.0;
    for (double b : bytes) sum += b;
    return static_cast<std::size_t>(budget / sum);
  };
  while (plan.runs.size() > 1 && affordable() < fewest_times) {
    std::size_t largest = plan.runs.front() == &study.reference() ? 1 : 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      if (plan.runs[i] != &study.reference() && bytes[i] > bytes[largest]) largest = i;
    }
    plan.runs.erase(plan.runs.begin() + static_cast<std::ptrdiff_t>(largest));
    bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(largest));
  }
  for (const RunResult* run : study.measured()) {
    if (std::find(plan.runs.begin(), plan.runs.end(), run) == plan.runs.end()) {
      plan.left_out.push_back(run);
    }
  }
  plan.times = times_of(plan.runs, std::clamp<std::size_t>(affordable(), 2, most_times));
  return plan;
}

void measure_viewer(const StudyResult& study, json& metrics) {
  const ViewerPlan plan = plan_viewer(study);
  const Scales scales = study.reference_run().run.physics.scales();
  json& out = metrics["viewer"];
  const Run& reference = study.reference_run().run;
  const PictureScale scale(reference);
  out["colour_range"] = {0.0, 1.0};
  out["frames_of_the_runs"] = all_times(plan.runs).size();
  out["slice"] = nullptr;
  if (scale.three_dimensional)
    out["slice"] = {{"axis", std::string(1, "xyz"[scale.depth])}, {"at_m", scale.middle}};
  out["position_error_over_spacing"] = 0.5 / steps_per_spacing;
  const Solids solids = solids_of(viewer_solid_run(study, plan));
  out["tank_moves"] = solids.tank_moves;
  out["walls_not_drawn"] = solids.not_drawn;
  for (Seconds time : plan.times) {
    out["times_s"].push_back(time.value());
    out["T"].push_back(scales.dimensionless(time).value());
  }
  for (const RunResult* run : plan.runs) {
    json& front = out["Z_over_L"][run->study.name];
    for (Seconds time : plan.times) {
      front.push_back(front_at(*run->measured, scales.dimensionless(time)));
    }
  }
}

}  // namespace surge::compare
