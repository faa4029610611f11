#include "compare/study/sequences.hpp"

#include <algorithm>
#include <cmath>

#include "compare/study/convergence.hpp"
#include "compare/study/quantities.hpp"
#include "compare/study/verdict.hpp"
#include "particle/support/json.hpp"
#include "particle/support/table.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

double number(const json& from, const char* name) {
  return from.is_object() && from.contains(name) && from[name].is_number()
             ? from[name].get<double>()
             : 0.0;
}

/// "MPS paper" of "MPS paper, l0 = 5 mm".
std::string method_label(const RunResult& run) {
  const std::string label = run.label();
  return label.substr(0, label.find(", "));
}

double mean_step(const RunResult& run) {
  const double steps = number(run.manifest, "steps");
  const double simulated = number(run.manifest, "simulated_s");
  return steps > 0.0 ? simulated / steps : 0.0;
}

/// What is refined, and from this the sizes.
void set_sizes(Sequence& sequence) {
  const auto spacing = [](const SequenceLevel& level) {
    return level.run->measured->run.spacing.value();
  };
  auto& levels = sequence.levels;
  sequence.over_spacing =
      levels.size() < 2 || std::any_of(levels.begin() + 1, levels.end(), [&](const auto& level) {
        return !same_level(spacing(level), spacing(levels.front()));
      });
  for (auto* list : {&sequence.levels, &sequence.others}) {
    for (auto& level : *list)
      level.size = sequence.over_spacing ? spacing(level) : mean_step(*level.run);
    std::stable_sort(list->begin(), list->end(),
                     [](const auto& a, const auto& b) { return a.size < b.size; });
  }
}

struct Followed {
  std::string name, title;
  std::vector<std::optional<double>> values;  ///< by level
};

/// Of the paper's flow the dimensionless time that it uses; of any other the time.
std::string moment_text(const StudyResult& study, double t) {
  if (study.judges_paper()) return "T = " + fixed_text(t, 2);
  const Scales scales = study.reference_run().run.physics.scales();
  return "t = " + fixed_text(scales.dimensional(DimensionlessTime(t)).value(), 3) + " s";
}

std::vector<Followed> followed(const StudyResult& study, const Sequence& sequence,
                               const RunResult* finest) {
  std::vector<Followed> all;
  all.reserve(std::size(convergence_times) + 2);
  for (const double t : convergence_times)
    all.push_back({"Z_over_L_at_T_" + fixed_text(t, 2), "Z/L at " + moment_text(study, t), {}});
  all.push_back({"impact_time_s", "Impact, s", {}});
  // The finest run of a sequence has no difference to itself, and so the sequence no such values.
  const bool itself = finest == nullptr || finest == sequence.levels.front().run;
  if (!itself) all.push_back({"rms", "RMS of Z/L to the finest VOF", {}});
  for (const SequenceLevel& level : sequence.levels) {
    const MeasuredRun& run = *level.run->measured;
    std::size_t i = 0;
    for (const double t : convergence_times) {
      const auto z = run.front.at(DimensionlessTime(t));
      all[i++].values.push_back(z ? std::optional(z->value()) : std::nullopt);
    }
    all[i++].values.push_back(scalar(run, "impact_time_s"));
    if (!itself)
      all[i].values.push_back(difference(run.front, finest->measured->front, study.wall()).rms);
  }
  return all;
}

json quantity_json(const Followed& quantity, const Sequence& sequence) {
  json out{{"title", quantity.title}, {"result", nullptr}, {"values", json::array()}};
  std::vector<Level> levels;
  for (std::size_t i = 0; i < quantity.values.size(); ++i) {
    out["values"].push_back(json_or_null(quantity.values[i]));
    if (quantity.values[i] && sequence.levels[i].size > 0.0)
      levels.push_back({sequence.levels[i].size, *quantity.values[i]});
  }
  const auto chosen = systematic_levels(levels);
  // The value that stands for the sequence must be that of its finest level.
  if (!chosen || chosen->front().h != sequence.levels.front().size) return out;
  std::erase_if(levels, [&](const Level& level) {
    return std::any_of(chosen->begin(), chosen->end(),
                       [&](const Level& used) { return used.h == level.h; });
  });
  const GridConvergence found = grid_convergence(*chosen, levels);
  json& result = out["result"];
  result = {{"approach", approach_text(found.approach)},
            {"r21", found.r21},
            {"r32", found.r32},
            {"order", json_or_null(found.order)},
            {"extrapolated", json_or_null(found.extrapolated)},
            {"gci21", json_or_null(found.gci21)},
            {"gci32", json_or_null(found.gci32)},
            {"index_ratio", json_or_null(found.index_ratio)},
            {"uncertainty", found.uncertainty},
            {"asymptotic", found.asymptotic()},
            {"doubts", ""},
            {"sizes", json::array()}};
  for (const Level& level : found.levels) result["sizes"].push_back(level.h);
  std::string doubts;
  for (const std::string& doubt : found.doubts) doubts += (doubts.empty() ? "" : "; ") + doubt;
  result["doubts"] = doubts;
  return out;
}

/// RMS to the finest VOF that the recommended presets are to reach at a spacing, m.
constexpr std::array<std::pair<double, double>, 2> bars{{{0.005, 0.02}, {0.0025, 0.01}}};

json bars_json(const StudyResult& study, const std::vector<Sequence>& sequences,
               const RunResult* finest) {
  json out = json::array();
  for (const Sequence& sequence : sequences) {
    const std::string& preset = sequence.finest().run.preset;
    if (finest == nullptr || !sequence.over_spacing ||
        (preset != "improved" && preset != "delta-plus"))
      continue;
    for (const SequenceLevel& level : sequence.levels) {
      for (const auto& [spacing, bar] : bars) {
        if (!same_level(level.size, spacing)) continue;
        const double rms =
            difference(level.run->measured->front, finest->measured->front, study.wall()).rms;
        out.push_back(
            {{"label", level.run->label()}, {"bar", bar}, {"rms", rms}, {"reached", rms <= bar}});
      }
    }
  }
  return out;
}

/// How many quantities approach in which way; Celik et al. ask for the share that oscillates.
json counts_json(const json& sequences) {
  json counts{{"all", 0}, {"asymptotic", 0}};
  for (const Approach approach :
       {Approach::monotone, Approach::oscillating, Approach::diverging, Approach::constant})
    counts[approach_text(approach)] = 0;
  for (const json& sequence : sequences) {
    for (const json& quantity : sequence["quantities"]) {
      const json& result = quantity["result"];
      if (result.is_null()) continue;
      const auto add = [&](const std::string& name) { counts[name] = counts[name].get<int>() + 1; };
      add("all");
      add(result["approach"]);
      if (result["asymptotic"].get<bool>()) add("asymptotic");
    }
  }
  return counts;
}

}  // namespace

namespace {

/// The runs of the comparison that are levels too, of spacings that the group's own runs do not
/// have. A group of one spacing refines the time step, and has none.
void add_compared_runs(const StudyResult& study, Sequence& sequence) {
  const auto spacing = [](const SequenceLevel& level) {
    return level.run->measured->run.spacing.value();
  };
  const bool over_spacing =
      std::any_of(sequence.levels.begin(), sequence.levels.end(), [&](const auto& level) {
        return !same_level(spacing(level), spacing(sequence.levels.front()));
      });
  if (!over_spacing) return;
  for (const RunResult* run : refinements_of(study, *sequence.levels.front().run)) {
    const bool known = std::any_of(
        sequence.levels.begin(), sequence.levels.end(), [&](const SequenceLevel& level) {
          return same_level(spacing(level), run->measured->run.spacing.value());
        });
    if (!known) sequence.levels.push_back({run, 0.0});
  }
}

}  // namespace

std::vector<Sequence> sequences_of(const StudyResult& study) {
  std::vector<Sequence> sequences;
  for (const RunResult* run : study.runs_of(Role::convergence)) {
    if (run->status != RunStatus::complete || run->measured == nullptr) continue;
    auto place = std::find_if(sequences.begin(), sequences.end(),
                              [&](const auto& s) { return s.group == run->study.group; });
    if (place == sequences.end()) {
      place = sequences.insert(sequences.end(), Sequence{});
      place->group = run->study.group;
      place->label = method_label(*run);
      place->vof = run->measured->run.method == "vof";
    }
    (run->study.threads == 1 ? place->levels : place->others).push_back({run, 0.0});
  }
  std::erase_if(sequences, [](const Sequence& s) { return s.levels.empty(); });
  for (Sequence& sequence : sequences) add_compared_runs(study, sequence);
  for (Sequence& sequence : sequences) set_sizes(sequence);
  return sequences;
}

const RunResult* finest_vof_run(const std::vector<Sequence>& sequences) {
  const SequenceLevel* finest = nullptr;
  for (const Sequence& sequence : sequences) {
    if (!sequence.vof || !sequence.over_spacing) continue;
    if (finest == nullptr || sequence.levels.front().size < finest->size)
      finest = &sequence.levels.front();
  }
  return finest ? finest->run : nullptr;
}

void measure_sequences(const StudyResult& study, const std::vector<Sequence>& sequences,
                       json& metrics) {
  json& out = metrics["convergence"];
  const RunResult* finest = finest_vof_run(sequences);
  out = {{"safety_factor", safety_factor},
         {"smallest_ratio", smallest_ratio},
         {"order_least", lowest_formal_order - order_margin},
         {"order_most", formal_order + order_margin},
         {"finest_label", nullptr},
         {"sequences", json::array()}};
  if (finest) out["finest_label"] = finest->label();
  for (const Sequence& sequence : sequences) {
    json entry{{"group", sequence.group},
               {"label", sequence.label},
               {"refined", sequence.over_spacing ? "spacing" : "time step"},
               {"levels", json::array()},
               {"quantities", json::object()}};
    for (const SequenceLevel& level : sequence.levels) {
      entry["levels"].push_back(
          {{"run", level.run->study.name}, {"size", level.size}, {"size_milli", 1e3 * level.size}});
    }
    for (const Followed& quantity : followed(study, sequence, finest))
      entry["quantities"][quantity.name] = quantity_json(quantity, sequence);
    out["sequences"].push_back(std::move(entry));
  }
  out["counts"] = counts_json(out["sequences"]);
  out["bars"] = bars_json(study, sequences, finest);
}

void measure_convergence(const StudyResult& study, json& metrics) {
  metrics["convergence"] = json::object();
  metrics["uncertainty"] = json::object();
  const std::vector<Sequence> sequences = sequences_of(study);
  if (sequences.empty()) return;
  measure_sequences(study, sequences, metrics);
  measure_differences(study, sequences, metrics);
}

}  // namespace surge::compare
