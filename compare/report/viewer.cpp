#include "compare/report/viewer.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "compare/figures/figures.hpp"
#include "compare/figures/style.hpp"
#include "compare/report/viewer_encoding.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

constexpr std::size_t most_times = 100;
/// A film of fewer pictures is none: rather a run less.
constexpr std::size_t fewest_times = 26;
constexpr std::size_t most_runs = 6;
/// Squares on which water of a mesh is shown, per L.
constexpr double squares_per_length = 20.0;
/// The part of the reference's water that the panels must show; drops above are marked.
constexpr double shown_part = 0.98;

/// Edge of the squares of a mesh run, over L.
double square_edge(const Run& run) {
  return std::max(1.0 / squares_per_length, run.spacing / run.physics.column_width());
}

/// Bytes of one time in the page; on a mesh an estimate for thoroughly splashed water.
double bytes_per_time(const RunResult& result) {
  const Run& run = result.measured->run;
  double bytes = 0.0;
  if (run.is_mesh()) {
    const auto up = static_cast<std::size_t>(run.physics.vertical_axis());
    const Extent& column = run.physics.column;
    const double height =
        (column.upper[up] - column.lower[up]) / run.physics.column_width().value();
    const double edge = square_edge(run);
    const double surface = 20.0 / (run.spacing / run.physics.column_width());
    bytes = 7.0 * 2.0 * height / (edge * edge) + 8.0 * surface;
  } else {
    bytes =
        6.0 * double(water_picture(run.frames->read(0, {.pressure = true}), run).patches.size());
  }
  return bytes * 4.0 / 3.0;
}

/// The reference and the first of each other method and preset.
std::vector<const RunResult*> candidates(const StudyResult& study) {
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

/// Of the run that lasts longest, of several the one with the fewest frames: the last time and
/// every stride-th before it, but not the start, for which no program has computed a pressure.
std::vector<Seconds> times_of(const std::vector<const RunResult*>& runs, std::size_t most) {
  const std::vector<Seconds>* longest = nullptr;
  for (const RunResult* run : runs) {
    const auto& times = run->measured->run.frames->times();
    const double later = longest ? (times.back() - longest->back()).value() : 1.0;
    // Times of different programs differ by rounding.
    const bool as_late = std::abs(later) < 1e-6;
    if (as_late ? times.size() < longest->size() : later > 0.0) longest = &times;
  }
  const std::size_t steps = longest->size() - 1;
  const std::size_t stride = std::max<std::size_t>(1, (steps + most - 1) / most);
  std::vector<Seconds> times;
  for (std::size_t i = steps; i > 0; i -= std::min(i, stride)) times.push_back((*longest)[i]);
  std::reverse(times.begin(), times.end());
  return times;
}

/// Z/L of a run at a time of the viewer; null where it has no leading edge any more.
json front_at(const MeasuredRun& run, DimensionlessTime time) {
  const auto& last = run.front.samples.back();
  // Times of different programs differ by rounding.
  if (std::abs((time - last.time).value()) < 1e-6) return last.position.value();
  const auto position = run.front.at(time);
  return position ? json(position->value()) : json();
}

/// gnuplot's dash as lengths for a drawing on the screen.
json dash_lengths(const std::string& dash) {
  json lengths = json::array();
  if (dash == "solid") return lengths;
  for (char c : dash) {
    if (c != '-' && c != '.' && c != '_') continue;
    lengths.push_back(c == '-' ? 6.0 : c == '_' ? 11.0 : 1.5);
    lengths.push_back(3.0);
  }
  return lengths;
}

/// As in Fig. 8.
LineStyle style_of(const StudyResult& study, const RunResult* shown) {
  std::size_t index = 0;
  for (const RunResult* run : study.measured()) {
    if (run == shown) break;
    if (run != &study.reference()) ++index;
  }
  return shown == &study.reference() ? reference_style() : run_style(index);
}

struct Shown {  // NOLINT(bugprone-exception-escape): what json destroys throws nothing
  json run;
  json surface;
  double height = 0.0;  ///< that the water needs, over L
};

Shown encode(const StudyResult& study, const ViewerPlan& plan, const RunResult* result) {
  const Run& run = result->measured->run;
  WaterTrack water(run.is_mesh());
  SurfaceTrack surface;
  Shown shown;
  for (Seconds time : plan.times) {
    auto index = frame_near(run.frames->times(), time);
    if (index == std::size_t{0}) index = run.frames->times().size() > 1 ? 1 : 0;  // as in times_of
    const WaterPicture picture =
        index ? water_picture(run.frames->read(*index, {.pressure = true, .velocity = true}), run)
              : WaterPicture{};
    water.add(run.is_mesh() ? coarse_cells(picture.patches, square_edge(run)) : picture.patches);
    surface.add(picture.surface);
    shown.height = std::max(shown.height, picture.height_of(shown_part));
  }
  shown.run = water.encoded();
  const LineStyle style = style_of(study, result);
  shown.run["name"] = result->study.name;
  shown.run["label"] = result->label();
  shown.run["note"] = result->note;
  shown.run["colour"] = style.colour.hex();
  shown.run["dash"] = dash_lengths(style.dash);
  if (run.is_mesh()) shown.surface = surface.encoded();
  return shown;
}

std::string palette() {
  std::vector<std::uint8_t> bytes;
  for (int i = 0; i < 256; ++i) {
    const Colour colour = viridis(i / 255.0);
    bytes.insert(bytes.end(), {colour.red, colour.green, colour.blue});
  }
  return base64(bytes);
}

json page_data(const StudyResult& study, const ViewerPlan& plan, const json& metrics) {
  json data{{"metrics", metrics.at("viewer")},
            {"palette", palette()},
            {"runs", json::array()},
            {"surface", nullptr}};
  const auto end = window_end(study);
  data["window_end"] = end ? json(end->value()) : json();
  double width = 1.0;
  if (const auto wall = study.wall().far_wall) width = wall->value();
  double height = 1.0;
  for (const RunResult* run : plan.runs) {
    Shown shown = encode(study, plan, run);
    const bool reference = run == &study.reference();
    if (!study.wall().far_wall) width = std::max(width, shown.run["x"][1].get<double>());
    if (reference) height = shown.height;
    if (!shown.surface.is_null() && (reference || data["surface"].is_null())) {
      data["surface"] = std::move(shown.surface);
    }
    data["runs"].push_back(std::move(shown.run));
  }
  data["view"] = {{"width", width}, {"height", std::ceil(2.0 * (height + 0.05)) / 2.0}};
  return data;
}

}  // namespace

ViewerPlan plan_viewer(const StudyResult& study, double budget) {
  ViewerPlan plan;
  plan.runs = candidates(study);
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
  out["colour_range"] = {0.0, 1.0};
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

json viewer_json(const StudyResult& study, const json& metrics) {
  const ViewerPlan plan = plan_viewer(study);
  json left_out = json::array();
  for (const RunResult* run : plan.left_out) left_out.push_back(run->study.name);
  return {{"data", page_data(study, plan, metrics)}, {"left_out", left_out}};
}

}  // namespace surge::compare
