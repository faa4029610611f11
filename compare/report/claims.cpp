#include "compare/report/claims.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "compare/figures/table.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

/// In Z/L: a third of the uncertainty of the experiments (0.15), and beyond what mesh and Courant
/// number change in the VOF solution (0.01 to 0.03).
constexpr double good_agreement = 0.05;
constexpr double alike = 0.9;         ///< overlap of the fluid regions
constexpr double quadratic = 0.15;    ///< deviation of the exponent from two
constexpr double fragmented = 0.005;  ///< part of the water that is detached after the impact

const char* const reproduced = "reproduced";
const char* const not_reproduced = "not reproduced";
const char* const not_measured = "not measured";

using Runs = std::vector<const RunResult*>;

/// Complete runs of a method that the reference is not.
Runs runs_of(const StudyResult& study, const std::string& method) {
  Runs runs;
  for (const RunResult* run : study.measured()) {
    if (run != &study.reference() && run->status == RunStatus::complete && run->note.empty() &&
        run->measured->run.method == method)
      runs.push_back(run);
  }
  return runs;
}

json number_at(const json& metrics, const json::json_pointer& pointer) {
  return metrics.contains(pointer) ? metrics.at(pointer) : json();
}

json::json_pointer of_run(const char* table, const RunResult& run, const std::string& rest) {
  json::json_pointer pointer;
  pointer /= table;
  pointer /= run.study.name;
  return pointer / json::json_pointer(rest);
}

std::string verdict_of(std::size_t met, std::size_t all, const std::string& condition) {
  if (all == 0) return not_measured;
  if (met == all) return reproduced;
  return met == 0 ? not_reproduced : "depends on " + condition;
}

std::string upper_name(const std::string& method) {
  return method == "mps" ? "MPS" : "SPH";
}

std::string rms_name(const StudyResult& study) {
  return std::string("/rms_vs_") +
         (study.reference_run().run.method == "vof" ? "vof" : "reference");
}

Claim agreement_claim(const StudyResult& study, const json& metrics, const std::string& method) {
  Claim claim{"leading_edge_" + method,
              "The leading edge of " + upper_name(method) + " is in good agreement with VOF.",
              "Section 5.1, Fig. 8",
              "RMS of the difference in Z/L before the far wall at most " +
                  fixed_text(good_agreement, 2) + " in every complete run of the method",
              "",
              {}};
  std::size_t met = 0;
  const Runs runs = runs_of(study, method);
  for (const RunResult* run : runs) {
    const json rms = number_at(metrics, of_run("front", *run, rms_name(study)));
    met += rms.is_number() && rms.get<double>() <= good_agreement ? 1 : 0;
    claim.evidence.push_back({"RMS, " + run->label(), rms});
  }
  claim.verdict = verdict_of(met, runs.size(), "the formulation: not all of the runs meet it");
  return claim;
}

/// One evidence per run of both methods; `better` counts the pairs where MPS and SPH are as said.
Claim pair_claim(const StudyResult& study, const json& metrics, Claim claim,
                 const std::vector<std::pair<std::string, json::json_pointer>>& quantities,
                 const std::string& condition,
                 const std::function<json(const RunResult&, const json::json_pointer&)>& value,
                 const std::function<bool(double, double)>& as_said) {
  const Runs mps = runs_of(study, "mps"), sph = runs_of(study, "sph");
  std::size_t met = 0, all = 0;
  for (const auto& [name, pointer] : quantities) {
    for (const Runs& runs : {mps, sph}) {
      for (const RunResult* run : runs)
        claim.evidence.push_back({name + ", " + run->label(), value(*run, pointer)});
    }
    for (const RunResult* a : mps) {
      for (const RunResult* b : sph) {
        const json of_mps = value(*a, pointer), of_sph = value(*b, pointer);
        if (!of_mps.is_number() || !of_sph.is_number()) continue;
        ++all;
        met += as_said(of_mps.get<double>(), of_sph.get<double>()) ? 1 : 0;
      }
    }
  }
  static_cast<void>(metrics);
  claim.verdict = verdict_of(met, all, condition);
  return claim;
}

Claim accuracy_claim(const StudyResult& study, const json& metrics) {
  return pair_claim(
      study, metrics,
      {"mps_more_accurate",
       "MPS is more accurate than SPH in the leading edge.",
       "Section 5.1, Fig. 8",
       "RMS of every MPS run below that of every SPH run",
       "",
       {}},
      {{"RMS", json::json_pointer(rms_name(study))}}, "the formulation",
      [&](const RunResult& run, const json::json_pointer& pointer) {
        return number_at(metrics, of_run("front", run, pointer.to_string()));
      },
      [](double mps, double sph) { return mps < sph; });
}

/// Adds the timed runs of both methods with the same neighbour search, at the largest number of
/// fluid particles that both have; whether SPH is the cheaper in all of them.
bool compare_timed_runs(const json& metrics, Claim& claim) {
  bool always = true;
  const json& curves = metrics["scaling"];
  for (const auto& [mps_name, mps] : curves.items()) {
    for (const auto& [sph_name, sph] : curves.items()) {
      if (mps["method"] != "mps" || sph["method"] != "sph" || mps["search"] != sph["search"])
        continue;
      const json* of_mps = nullptr;
      const json* of_sph = nullptr;
      for (const json& a : mps["points"]) {
        for (const json& b : sph["points"]) {
          if (a["fluid_particles"] != b["fluid_particles"]) continue;
          of_mps = &a;
          of_sph = &b;
        }
      }
      if (of_mps == nullptr) continue;
      const std::string size =
          fixed_text((*of_mps)["fluid_particles"].get<double>(), 0) + " particles, ";
      for (const auto& [what, name] :
           {std::pair{"ms per step, ", "ms_per_step"}, std::pair{"s in total, ", "total_s"}}) {
        const json& a = (*of_mps)[name];
        const json& b = (*of_sph)[name];
        claim.evidence.push_back({what + size + mps["label"].get<std::string>(), a});
        claim.evidence.push_back({what + size + sph["label"].get<std::string>(), b});
        if (a.is_number() && b.is_number()) always = always && b.get<double>() < a.get<double>();
      }
    }
  }
  return always;
}

Claim cost_claim(const StudyResult& study, const json& metrics) {
  Claim claim = pair_claim(
      study, metrics,
      {"sph_cheaper",
       "SPH costs less than MPS.",
       "Section 5.2, Fig. 9",
       "every SPH run below every MPS run, per step and per simulated second, setup and output "
       "left "
       "out. Preset paper-bare steps as the paper says, preset paper has an acoustic limit as well",
       "",
       {}},
      {{"ms per step", json::json_pointer("/ms_per_step")},
       {"s per simulated s", json::json_pointer("/s_per_simulated_s")}},
      "the time step of SPH and the pressure solver of MPS",
      [&](const RunResult& run, const json::json_pointer& pointer) {
        return number_at(metrics, of_run("cost", run, pointer.to_string()));
      },
      [](double mps, double sph) { return sph < mps; });
  const bool always = compare_timed_runs(metrics, claim);
  if (!always && claim.verdict == reproduced)
    claim.verdict = "depends on the neighbour search and the time step of SPH";
  return claim;
}

Claim pressure_claim(const StudyResult& study, const json& metrics) {
  Claim claim{"poisson_dominates",
              "MPS costs more because it solves a linear system for the pressure.",
              "Section 5.2",
              "the pressure takes more than half of the solving time of every MPS run",
              "",
              {}};
  std::size_t met = 0;
  const Runs runs = runs_of(study, "mps");
  for (const RunResult* run : runs) {
    const json share = number_at(metrics, of_run("cost", *run, "/share/pressure"));
    met += share.is_number() && share.get<double>() > 0.5 ? 1 : 0;
    claim.evidence.push_back({"part of the time, " + run->label(), share});
  }
  claim.verdict = verdict_of(met, runs.size(), "the pressure solver");
  return claim;
}

Claim pattern_claim(const StudyResult& study, const json& metrics) {
  Claim claim{
      "patterns_alike",
      "The flow patterns of MPS, SPH and VOF are very similar.",
      "Section 5.1, Fig. 7",
      "fluid regions at least half full on a common grid; common part over union, mean over "
      "time, at least " +
          fixed_text(alike, 1) + " in every run before and after the impact",
      "",
      {}};
  std::size_t met = 0, all = 0;
  for (const char* when : {"before", "after"}) {
    for (const char* method : {"mps", "sph"}) {
      for (const RunResult* run : runs_of(study, method)) {
        const json mean =
            number_at(metrics, of_run("patterns", *run, std::string("/overlap/") + when + "_mean"));
        claim.evidence.push_back({std::string(when) + " impact, " + run->label(), mean});
        if (!mean.is_number()) continue;
        ++all;
        met += mean.get<double>() >= alike ? 1 : 0;
      }
    }
  }
  claim.verdict = verdict_of(met, all, "the time and the formulation: see the numbers");
  return claim;
}

/// Whether MPS, and only MPS, fragments at one strictness; empty where a method is missing.
std::optional<bool> only_mps_fragments(const StudyResult& study, const json& metrics,
                                       std::size_t cohesion) {
  const std::string part = "/detached/" + std::to_string(cohesion) + "/part_mean";
  const auto fragments = [&](const RunResult& run) -> std::optional<bool> {
    const json value = number_at(metrics, of_run("patterns", run, part));
    if (!value.is_number()) return std::nullopt;
    return value.get<double>() >= fragmented;
  };
  const Runs mps = runs_of(study, "mps"), sph = runs_of(study, "sph");
  const auto reference = fragments(study.reference());
  if (mps.empty() || sph.empty() || !reference) return std::nullopt;
  const auto yes = [&](const RunResult* run) { return fragments(*run).value_or(false); };
  return std::all_of(mps.begin(), mps.end(), yes) && std::none_of(sph.begin(), sph.end(), yes) &&
         !*reference;
}

Claim fragmentation_claim(const StudyResult& study, const json& metrics) {
  Claim claim{"only_mps_fragments",
              "After the impact only MPS shows fragmentation.",
              "Section 5.1, Fig. 7; section 6",
              "at least " + fixed_text(fragmented, 3) +
                  " of the water detached from the main body, mean over the time after the impact: "
                  "so in MPS and in no other, whatever the linking length (particles, in "
                  "spacings) or the volume fraction at the corners (mesh)",
              "",
              {}};
  std::size_t met = 0, all = 0;
  for (std::size_t c = 0; c < cohesion_count; ++c) {
    if (const auto said = only_mps_fragments(study, metrics, c)) {
      ++all;
      met += *said ? 1 : 0;
    }
    for (const RunResult* run : study.measured()) {
      const bool mesh = run->measured->run.is_mesh();
      const std::string at = "/detached/" + std::to_string(c);
      const std::string rule = mesh ? "level " + fixed_text(corner_levels[c], 2)
                                    : "linking length " + fixed_text(linking_lengths[c], 1);
      claim.evidence.push_back({"part of the water, " + rule + ", " + run->label(),
                                number_at(metrics, of_run("patterns", *run, at + "/part_mean"))});
      claim.evidence.push_back({"pieces, " + rule + ", " + run->label(),
                                number_at(metrics, of_run("patterns", *run, at + "/pieces_mean"))});
    }
  }
  claim.verdict = verdict_of(met, all, "how strictly water must hang together to be one piece");
  return claim;
}

Claim growth_claim(const json& metrics) {
  Claim claim{"grows_quadratically",
              "Without a neighbour search the time grows as the square of the number of particles.",
              "Section 5.2",
              "exponent of the time per step over the number of all particles within " +
                  fixed_text(quadratic, 2) + " of two for both methods with the all-pairs search",
              "",
              {}};
  std::size_t met = 0, all = 0;
  for (const auto& [name, curve] : metrics["scaling"].items()) {
    const json exponent = number_at(curve, json::json_pointer("/fit_per_step/exponent"));
    claim.evidence.push_back({"exponent, " + curve["label"].get<std::string>(), exponent});
    if (curve["search"] != "all_pairs" || !exponent.is_number()) continue;
    ++all;
    met += std::abs(exponent.get<double>() - 2.0) <= quadratic ? 1 : 0;
  }
  claim.verdict = verdict_of(met, all, "the method");
  return claim;
}

Claim clustering_claim(const StudyResult& study, const json& metrics) {
  Claim claim = pair_claim(
      study, metrics,
      {"no_clustering",
       "The weight function that grows without bound prevents clustering.",
       "Section 3.1",
       "median over time of the smallest distance of two particles, over l0: every MPS run above "
       "every SPH run, whose kernel is bounded",
       "",
       {}},
      {{"median smallest distance", json::json_pointer("/smallest_distance_over_l0/median")},
       {"smallest distance ever", json::json_pointer("/smallest_distance_over_l0/minimum")}},
      "the formulation",
      [&](const RunResult& run, const json::json_pointer& pointer) {
        return number_at(metrics, of_run("patterns", run, pointer.to_string()));
      },
      [](double mps, double sph) { return mps > sph; });
  bool helped = false;
  for (const RunResult* run : runs_of(study, "mps")) {
    const json collisions =
        number_at(run->measured->run.manifest, json::json_pointer("/particle_collisions"));
    helped = helped || (collisions.is_number() && collisions.get<double>() > 0.0);
    claim.evidence.push_back({"collisions of particles, " + run->label(), collisions});
  }
  if (claim.verdict == reproduced && helped) {
    claim.verdict = "depends on the collision model, which acted as well";
  }
  return claim;
}

Claim robustness_claim(const StudyResult& study) {
  Claim claim{"large_deformation",
              "MPS and SPH are effective in dealing with large deformations of the free surface.",
              "Section 6",
              "every run comes to its end without a lost or non-finite particle",
              "",
              {}};
  std::size_t met = 0, all = 0;
  for (const RunResult* run : study.measured()) {
    if (run->measured->run.is_mesh()) continue;
    const json& manifest = run->measured->run.manifest;
    const json lost = number_at(manifest, json::json_pointer("/lost_particles"));
    const json nonfinite = number_at(manifest, json::json_pointer("/nonfinite"));
    ++all;
    met += run->status == RunStatus::complete && lost == 0 && nonfinite == 0 ? 1 : 0;
    claim.evidence.push_back({"lost, " + run->label(), lost});
    claim.evidence.push_back({"non-finite, " + run->label(), nonfinite});
  }
  claim.verdict = verdict_of(met, all, "the formulation");
  return claim;
}

}  // namespace

std::vector<Claim> find_claims(const StudyResult& study, const json& metrics) {
  return {agreement_claim(study, metrics, "mps"), agreement_claim(study, metrics, "sph"),
          accuracy_claim(study, metrics),         pattern_claim(study, metrics),
          fragmentation_claim(study, metrics),    cost_claim(study, metrics),
          pressure_claim(study, metrics),         growth_claim(metrics),
          clustering_claim(study, metrics),       robustness_claim(study)};
}

}  // namespace surge::compare
