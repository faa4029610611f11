#include <algorithm>
#include <cmath>

#include "compare/report/claims.hpp"
#include "compare/study/scaling.hpp"
#include "compare/study/water_differences.hpp"
#include "particle/support/table.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

json mean(const std::vector<double>& values) {
  if (values.empty()) return nullptr;
  double sum = 0.0;
  for (double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

json largest(const std::vector<double>& values) {
  return values.empty() ? json() : json(*std::max_element(values.begin(), values.end()));
}

json overlap_json(const PatternHistory& history, std::optional<Seconds> impact) {
  std::vector<double> before, after;
  for (const auto& sample : history) {
    if (!sample.overlap) continue;
    (impact && sample.time > *impact ? after : before).push_back(*sample.overlap);
  }
  return {{"before_mean", mean(before)},
          {"before_minimum",
           before.empty() ? json() : json(*std::min_element(before.begin(), before.end()))},
          {"after_mean", mean(after)},
          {"after_minimum",
           after.empty() ? json() : json(*std::min_element(after.begin(), after.end()))},
          {"frames", before.size() + after.size()}};
}

/// Means over the frames after the impact, for one strictness of the rule.
json detached_json(const PatternHistory& history, std::optional<Seconds> impact,
                   std::size_t cohesion) {
  std::vector<double> pieces, part, blurred;
  for (const auto& sample : history) {
    if (!impact || sample.time <= *impact) continue;
    pieces.push_back(static_cast<double>(sample.detached[cohesion].pieces));
    part.push_back(sample.detached[cohesion].part);
    blurred.push_back(sample.detached[cohesion].blurred);
  }
  return {{"pieces_mean", mean(pieces)},
          {"pieces_maximum", largest(pieces)},
          {"part_mean", mean(part)},
          {"part_maximum", largest(part)},
          {"blurred_mean", mean(blurred)}};
}

json distance_json(const PatternHistory& history) {
  std::vector<double> values;
  for (const auto& sample : history) {
    if (sample.smallest_distance) values.push_back(*sample.smallest_distance);
  }
  if (values.empty()) return nullptr;
  return {{"minimum", *std::min_element(values.begin(), values.end())},
          {"median", median_of(values)}};
}

json pattern_json(const StudyResult& study, const RunResult& run) {
  const PatternHistory& history = study.pattern(run);
  const auto hit = study.impact_time();
  json entry{{"label", run.label()},
             {"overlap", overlap_json(history, hit)},
             {"overlap_cell_m", overlap_cell(run.measured->run, study.reference_run().run).value()},
             {"smallest_distance_over_l0", distance_json(history)},
             {"detached", json::array()}};
  const auto& rule = run.measured->run.is_mesh() ? corner_levels : linking_lengths;
  for (std::size_t c = 0; c < cohesion_count; ++c) {
    entry["detached"].push_back(detached_json(history, hit, c));
    entry["detached"].back()[run.measured->run.is_mesh() ? "corner_level" : "linking_length"] =
        rule[c];
    entry["detached"].back()["threshold"] = rule[c];
  }
  return entry;
}

/// Means over another time than that of the runs beside it say nothing of these.
void keep_what_is_before(json& entry) {
  entry["overlap"]["after_mean"] = nullptr;
  entry["overlap"]["after_minimum"] = nullptr;
  entry["smallest_distance_over_l0"] = nullptr;
  entry["detached"] = json::array();
}

/// At each of the study's snapshot times: where only the run has water, only the reference, both.
json differences_json(const StudyResult& study, const RunResult& run) {
  json out = json::array();
  for (Seconds time : study.study.snapshot_times) {
    const auto found = water_difference(study, run, time);
    if (!found) continue;
    const auto part = found->part();
    out.push_back({{"time_s", time.value()},
                   {"unit", found->dimension == 3 ? "m3" : "m2"},
                   {"only_run", found->size_of(found->cells.only_first)},
                   {"only_reference", found->size_of(found->cells.only_second)},
                   {"both", found->size_of(found->cells.both)},
                   {"over_reference", part ? json(*part) : json()}});
  }
  return out;
}

}  // namespace

void measure_patterns(const StudyResult& study, json& metrics) {
  json& out = metrics["patterns"] = json::object();
  for (const RunResult* run : study.measured()) {
    out[run->study.name] = pattern_json(study, *run);
    if (run != &study.reference())
      out[run->study.name]["differences"] = differences_json(study, *run);
  }
  json& levels = metrics["pattern_levels"] = json::object();
  const auto end = study.reference().last_time();
  for (const RunResult* run : study.runs_of(Role::convergence)) {
    if (run->measured == nullptr || study.pattern(*run).empty()) continue;
    json entry = pattern_json(study, *run);
    if (!end || run->last_time() < *end - Seconds(1e-6)) keep_what_is_before(entry);
    levels[run->study.name] = std::move(entry);
  }
}

void measure_cost(const StudyResult& study, json& metrics) {
  json& out = metrics["cost"] = json::object();
  for (const RunResult* run : study.measured()) {
    const json& manifest = run->measured->run.manifest;
    if (run->measured->run.is_mesh() || !manifest.is_object() || !manifest.contains("wall_s"))
      continue;
    const json& wall = manifest["wall_s"];
    const auto phase = [&](const char* name) { return wall.value(name, 0.0); };
    const double solve = phase("total") - phase("setup") - phase("output");
    const double steps = manifest.value("steps", 0.0);
    const double simulated = manifest.value("simulated_s", 0.0);
    json entry{{"label", run->label()}, {"solve_s", solve}};
    entry["ms_per_step"] = steps > 0.0 ? json(1e3 * solve / steps) : json();
    entry["s_per_simulated_s"] = simulated > 0.0 ? json(solve / simulated) : json();
    for (const char* name : {"neighbours", "pressure", "forces"})
      entry["share"][name] = solve > 0.0 ? json(phase(name) / solve) : json();
    out[run->study.name] = entry;
  }
}

}  // namespace surge::compare
