#include <algorithm>
#include <cmath>

#include "compare/study/metrics.hpp"
#include "compare/study/quantities.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

using nlohmann::json;

json window_json(const Window& window) {
  return json::array({window.begin.value(), window.end.value()});
}

/// When the front arrived at each level, between which frames that was, and the standard
/// uncertainty that follows from it.
void add_arrivals(json& out, const DimensionlessFront& front) {
  for (const char* key : {"arrival_T", "arrival_between_T", "arrival_u_T"})
    out[key] = json::object();
  for (const double level : arrival_levels) {
    const auto moment = front.arrival_moment(DimensionlessLength(level));
    const std::string name = level_text(level);
    out["arrival_T"][name] = moment ? json(moment->time.value()) : json(nullptr);
    out["arrival_between_T"][name] =
        moment ? json::array({moment->before.value(), moment->after.value()}) : json(nullptr);
    out["arrival_u_T"][name] = moment ? json(moment->uncertainty()) : json(nullptr);
  }
}

void add_impact(json& out, const std::optional<Impact>& hit, const Scales& scales) {
  const auto in_T = [&](Seconds t) { return scales.dimensionless(t).value(); };
  out["impact_time_s"] = hit ? json(hit->time.value()) : json(nullptr);
  out["impact_between_s"] =
      hit ? json::array({hit->before.value(), hit->after.value()}) : json(nullptr);
  out["impact_u_s"] = hit ? json(hit->uncertainty()) : json(nullptr);
  out["impact_T"] = hit ? json(in_T(hit->time)) : json(nullptr);
  out["impact_between_T"] =
      hit ? json::array({in_T(hit->before), in_T(hit->after)}) : json(nullptr);
  out["impact_u_T"] = hit ? json(in_T(Seconds(hit->uncertainty()))) : json(nullptr);
}

/// What one run's files say and its own front, without any comparison.
json describe(const MeasuredRun& measured, std::size_t frames, bool with_front) {
  const Run& run = measured.run;
  json out{{"method", run.method}, {"preset", run.preset}, {"spacing_m", run.spacing.value()}};
  if (run.cells_per_width) {
    out.erase("spacing_m");
    out["cell_m"] = run.spacing.value();
    out["cells_per_L"] = *run.cells_per_width;
  }
  out["frames"] = frames;
  out["finished"] = run.manifest.is_object() && run.manifest.contains("finished")
                        ? run.manifest["finished"]
                        : json();
  for (const char* count : {"lost_particles", "nonfinite"}) {
    if (run.manifest.is_object() && run.manifest.contains(count)) out[count] = run.manifest[count];
  }
  if (!with_front) return out;
  // Frames after the leading edge was lost, in a run that broke up, are not measured.
  out["frames_measured"] = measured.history.size();
  add_arrivals(out, measured.front);
  const auto far = run.physics.far_wall();
  add_impact(out, far ? impact(measured.history, *far, run.spacing) : std::nullopt,
             run.physics.scales());
  return out;
}

/// How far the front by other choices is from the one that is used, in its own window.
void add_variants(json& out, const MeasuredRun& measured, const MetricsOptions& options) {
  if (measured.variants.empty()) return;
  out["front_sensitivity"] = json::object();
  const WallRule wall = wall_rule(measured.run, options.wall_distance);
  for (const FrontVariant& variant : measured.variants) {
    json& entry = out["front_sensitivity"][variant.name];
    try {
      const auto front = dimensionless(variant.history, measured.run.physics.scales());
      const FrontDifference d = difference(front, measured.front, wall);
      entry = {{"rms", d.rms}, {"max", d.maximum}};
    } catch (const Error& error) {
      entry = {{"reason", error.what()}};
    }
  }
}

void add_difference(json& out, const FrontDifference& d, const std::string& against) {
  out["window_T"] = window_json(d.window);
  out["rms_vs_" + against] = d.rms;
  out["max_vs_" + against] = d.maximum;
  out["max_at_T"] = d.time_of_maximum.value();
  out["bias_vs_" + against] = d.bias;
  json arrivals = json::object(), uncertainties = json::object();
  for (std::size_t k = 0; k < arrival_levels.size(); ++k) {
    const std::string name = level_text(arrival_levels[k]);
    arrivals[name] = d.arrival[k] ? json(d.arrival[k]->value()) : json(nullptr);
    uncertainties[name] =
        d.arrival_uncertainty[k] ? json(*d.arrival_uncertainty[k]) : json(nullptr);
  }
  out["arrival_T_difference"] = arrivals;
  out["arrival_u_T_difference"] = uncertainties;
}

void add_against(json& out, const MeasuredRun& measured, const MeasuredRun& reference,
                 const MetricsOptions& options) {
  try {
    const WallRule wall = wall_rule(reference.run, options.wall_distance);
    add_difference(out, difference(measured.front, reference.front, wall),
                   reference.run.method == "vof" ? "vof" : "reference");
  } catch (const Error& error) {
    throw Error(measured.run.name + " against " + reference.run.name + ": " + error.what());
  }
}

json statistics_json(const SeriesDifference& d) {
  return {{"points", d.points}, {"rms", d.rms}, {"max", d.maximum}, {"bias", d.bias}};
}

json published_json(const MeasuredRun& measured, const std::vector<PublishedSeries>& published,
                    const MetricsOptions& options) {
  json out = json::object();
  for (const PublishedSeries& series : published) {
    if (const auto reason = other_case(series, measured.run.physics)) {
      out[series.name] = {{"status", "skipped"}, {"reason", *reason}};
      continue;
    }
    try {
      const SeriesComparison c =
          against_series(measured.front, series, wall_rule(measured.run, options.wall_distance));
      out[series.name] = {{"status", "passed"},
                          {"raw", statistics_json(c.raw)},
                          {"shift_T", c.shift.value()},
                          {"shifted", statistics_json(c.shifted)}};
    } catch (const Error& error) {
      out[series.name] = {{"status", "failed"}, {"reason", error.what()}};
    }
  }
  return out;
}

json timing_json(const Run& run) {
  json out = json::object();
  if (!run.manifest.is_object()) return out;
  const json& manifest = run.manifest;
  const auto copy = [&](const char* from, const char* to) {
    if (manifest.contains(from)) out[to] = manifest[from];
  };
  if (manifest.contains("wall_s")) {
    out["phases_s"] = manifest["wall_s"];
    out["wall_s"] = manifest["wall_s"].value("total", json(nullptr));
  }
  copy("steps", "steps");
  copy("threads", "threads");
  copy("cpu", "cpu");
  copy("cpu_s", "cpu_s");
  copy("simulated_s", "simulated_s");
  copy("cells", "cells");
  copy("fluid_particles", "particles");
  copy("wall_particles", "wall_particles");
  if (!out.contains("particles")) out["particles"] = nullptr;
  return out;
}

json definition_json(const std::string& reference, const MetricsOptions& options) {
  const FrontOptions& front = options.front;
  return {{"reference", reference},
          {"strip_height_m", front.strip_height.value()},
          {"strip_least_spacings", least_strip_spacings},
          {"bed_share", front.bed_share},
          {"linking_length_spacings", front.linking_length},
          {"raw_maximum", front.raw_maximum},
          {"wall_distance_L", options.wall_distance.value()},
          {"interpolation",
           "both fronts linear between their own samples; integrals exact on the union of both"},
          {"arrival_levels", arrival_levels},
          {"impact", "front within half a spacing (cell) of the far wall, linear between frames"},
          {"allowed_differences", options.allowed_differences}};
}

}  // namespace

json metrics(const std::vector<MeasuredRun>& runs, const std::string& reference,
             const std::vector<PublishedSeries>& published, const MetricsOptions& options) {
  const auto found = std::find_if(runs.begin(), runs.end(),
                                  [&](const auto& m) { return m.run.name == reference; });
  if (found == runs.end())
    throw Error("reference: " + reference + " found, the name of one of the runs expected");
  if (found->run.manifest.is_object() && !found->run.manifest.value("finished", true)) {
    throw Error("reference: " + reference +
                " did not finish (manifest.json), a finished run expected");
  }
  json out{{"definition", definition_json(reference, options)},
           {"front", json::object()},
           {"timing", json::object()},
           {"published", json::object()}};
  for (const PublishedSeries& series : published) {
    out["published"][series.name] = {{"label", series.label},
                                     {"citation", series.citation},
                                     {"kind", series.experiment ? "experiment" : "computation"},
                                     {"case", to_json(series.of)},
                                     {"uncertainty_T", series.time_uncertainty.value()},
                                     {"uncertainty_Z_over_L", series.position_uncertainty.value()}};
  }
  for (const MeasuredRun& measured : runs) {
    const std::string& name = measured.run.name;
    if (out["front"].contains(name))
      throw Error("run: " + name + " found twice, runs of different names expected");
    const PhysicsComparison physics =
        compare_physics(measured.run.physics, name, found->run.physics, reference);
    require_same_physics(physics, options.allowed_differences);
    json front = describe(measured, measured.run.frames->times().size(), options.with_front);
    front["physics_not_stated"] = physics.not_stated;
    if (options.with_front) {
      add_variants(front, measured, options);
      add_against(front, measured, *found, options);
      front["published"] = published_json(measured, published, options);
    }
    out["front"][name] = front;
    out["timing"][name] = timing_json(measured.run);
  }
  return out;
}

}  // namespace surge::compare
