#include <algorithm>
#include <optional>

#include "compare/report/claim_parts.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

constexpr double alike = 0.9;         ///< overlap of the fluid regions
constexpr double fragmented = 0.005;  ///< part of the water that is detached after the impact
constexpr double apart = 0.25;        ///< smallest distance of particles that do not cluster, l0

/// Whether MPS, and only MPS, fragments at one strictness; empty where a method is missing.
std::optional<bool> only_mps_fragments(const StudyResult& study, const json& metrics,
                                       std::size_t cohesion) {
  const std::string part = "/detached/" + std::to_string(cohesion) + "/part_mean";
  const auto fragments = [&](const RunResult& run) -> std::optional<bool> {
    const json value = number_of(metrics, "patterns", run, part);
    if (!value.is_number()) return std::nullopt;
    return value.get<double>() >= fragmented;
  };
  const Runs mps = complete_runs(study, "mps"), sph = complete_runs(study, "sph");
  const auto reference = fragments(study.reference());
  if (mps.empty() || sph.empty() || !reference) return std::nullopt;
  const auto yes = [&](const RunResult* run) { return fragments(*run).value_or(false); };
  return std::all_of(mps.begin(), mps.end(), yes) && std::none_of(sph.begin(), sph.end(), yes) &&
         !*reference;
}

/// Runs without particle collisions: of the comparison or of the sensitivity, however they ended.
Runs runs_without_collisions(const StudyResult& study) {
  Runs runs;
  for (const Role role : {Role::comparison, Role::sensitivity}) {
    for (const RunResult* run : study.runs_of(role)) {
      if (run->measured && run->measured->run.method == "mps" &&
          parameter_of(*run, "collision_distance") == 0.0)
        runs.push_back(run);
    }
  }
  return runs;
}

json closest(const json& metrics, const RunResult& run, const char* when) {
  return number_of(metrics, "patterns", run, std::string("/smallest_distance_over_l0/") + when);
}

/// What happens in the runs in which nothing but the weight function keeps particles apart; empty
/// where they stay apart to the end.
std::string without_collisions(const json& metrics, const Runs& alone, Claim& claim) {
  std::string happens;
  for (const RunResult* run : alone) {
    const json ever = number_of(metrics, "without_collisions", *run, "/smallest_distance_over_l0");
    const json last = number_of(metrics, "without_collisions", *run, "/last_s");
    claim.evidence.push_back(
        {"smallest distance ever without collisions, " + run->study.name, ever});
    claim.evidence.push_back({"s simulated until its end, " + run->study.name, last});
    if (!ever.is_number() || ever.get<double>() < apart) return "without them they cluster";
    if (run->status != RunStatus::complete) happens = "without them the run breaks up";
  }
  return happens;
}

}  // namespace

void measure_runs_without_collisions(const StudyResult& study, json& metrics) {
  json& out = metrics["without_collisions"] = json::object();
  for (const RunResult* run : runs_without_collisions(study)) {
    std::optional<double> least;
    for (const PatternSample& sample : study.pattern(*run)) {
      if (sample.smallest_distance)
        least = std::min(least.value_or(*sample.smallest_distance), *sample.smallest_distance);
    }
    const auto last = run->last_time();
    out[run->study.name] = {{"smallest_distance_over_l0", least ? json(*least) : json()},
                            {"last_s", last ? json(last->value()) : json()},
                            {"status", status_text(run->status)}};
  }
}

Claim pattern_claim(const StudyResult& study, const json& metrics) {
  Claim claim{
      "patterns_alike",
      "The flow patterns of MPS, SPH and VOF are very similar.",
      "Section 5.1, Fig. 7",
      "fluid regions at least half full on a common grid; common part over union, mean over "
      "time, at least " +
          fixed_text(alike, 1) +
          " in every run before and after the impact: what is left of the column where its "
          "outline, 4 L of it, is displaced by a cell of 20 per L",
      "",
      {}};
  Count count;
  for (const char* when : {"before", "after"}) {
    const ValueOf mean = [&](const RunResult& run) {
      return number_of(metrics, "patterns", run, std::string("/overlap/") + when + "_mean");
    };
    for (const char* method : {"mps", "sph"}) {
      const Runs runs = complete_runs(study, method);
      add_evidence(claim, std::string(when) + " impact, ", runs, mean);
      count += count_runs(runs, mean, [](double x) { return x >= alike; });
    }
  }
  claim.verdict = verdict_of(count, "the time and the formulation: see the numbers");
  return claim;
}

Claim fragmentation_claim(const StudyResult& study, const json& metrics) {
  Claim claim{"only_mps_fragments",
              "After the impact only MPS shows fragmentation.",
              "Section 5.1, Fig. 7; section 6",
              "at least " + fixed_text(fragmented, 3) +
                  " of the water detached from the main body, mean over the time after the impact "
                  "(eight of the paper’s 1682 particles: fewer are single drops): so in MPS and in "
                  "no other, whatever the linking length (particles, in spacings) or the volume "
                  "fraction at the corners (mesh)",
              "",
              {}};
  Count count;
  for (std::size_t c = 0; c < cohesion_count; ++c) {
    if (const auto said = only_mps_fragments(study, metrics, c)) count.add(*said);
    for (const RunResult* run : judged_runs(study)) {
      const bool mesh = run->measured->run.is_mesh();
      const std::string at = "/detached/" + std::to_string(c);
      const std::string rule = mesh ? "level " + fixed_text(corner_levels[c], 2)
                                    : "linking length " + fixed_text(linking_lengths[c], 1);
      claim.evidence.push_back({"part of the water, " + rule + ", " + run->label(),
                                number_of(metrics, "patterns", *run, at + "/part_mean")});
      claim.evidence.push_back({"pieces, " + rule + ", " + run->label(),
                                number_of(metrics, "patterns", *run, at + "/pieces_mean")});
    }
  }
  claim.verdict = verdict_of(count, "how strictly water must hang together to be one piece");
  return claim;
}

Claim clustering_claim(const StudyResult& study, const json& metrics) {
  Claim claim{
      "no_clustering",
      "The weight function that grows without bound prevents clustering.",
      "Section 3.1",
      "median over time of the smallest distance of two particles, over l0, in every MPS "
      "run above that in every SPH run, whose kernel is bounded; and without the collisions "
      "between particles, which keep them apart as well, an MPS run comes to its end with "
      "no two particles ever closer than " +
          fixed_text(apart, 2) + " l0, half the distance at which collisions act",
      "",
      {}};
  const Runs mps = complete_runs(study, "mps"), sph = complete_runs(study, "sph");
  for (const char* when : {"median", "minimum"}) {
    const std::string what =
        std::string(when) == "median" ? "median smallest distance, " : "smallest distance ever, ";
    for (const Runs& runs : {mps, sph})
      add_evidence(claim, what, runs,
                   [&](const RunResult& run) { return closest(metrics, run, when); });
  }
  add_evidence(claim, "collisions of particles, ", mps, [](const RunResult& run) {
    return number_at(run.manifest, json::json_pointer("/particle_collisions"));
  });
  const Count count = count_pairs(
      mps, sph, [&](const RunResult& run) { return closest(metrics, run, "median"); },
      std::greater<>());
  const Runs alone = runs_without_collisions(study);
  const std::string happens = without_collisions(metrics, alone, claim);
  claim.verdict = verdict_of(count, "the formulation");
  if (claim.verdict != reproduced) return claim;
  if (alone.empty())
    claim.verdict = "depends on the collisions between particles: no run of this study is without";
  else if (!happens.empty())
    claim.verdict = "depends on the collisions between particles: " + happens;
  return claim;
}

Claim robustness_claim(const StudyResult& study) {
  Claim claim{"large_deformation",
              "MPS and SPH are effective in dealing with large deformations of the free surface.",
              "Section 6",
              "every run comes to its end without a lost or non-finite particle",
              "",
              {}};
  Count count;
  for (const RunResult* run : judged_runs(study)) {
    if (run->measured->run.is_mesh() || run == &study.reference()) continue;
    const json lost = number_at(run->manifest, json::json_pointer("/lost_particles"));
    const json nonfinite = number_at(run->manifest, json::json_pointer("/nonfinite"));
    count.add(run->status == RunStatus::complete && lost == 0 && nonfinite == 0);
    claim.evidence.push_back({"lost, " + run->label(), lost});
    claim.evidence.push_back({"non-finite, " + run->label(), nonfinite});
  }
  claim.verdict = verdict_of(count, "the formulation");
  return claim;
}

}  // namespace surge::compare
