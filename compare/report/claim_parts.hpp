#pragma once

#include <functional>

#include "compare/report/claims.hpp"
#include "particle/support/table.hpp"

namespace surge::compare {

// What the claims of all groups are found with.

inline constexpr const char* reproduced = "reproduced";
inline constexpr const char* not_reproduced = "not reproduced";
inline constexpr const char* not_measured = "not measured";
inline constexpr const char* not_decidable = "not decidable";

using Runs = std::vector<const RunResult*>;

/// Whether the paper's statements are about such a run: meshes, programs that name no preset, and
/// the presets of the paper, but not the formulations that came since.
[[nodiscard]] bool is_of_the_paper(const RunResult& run);
/// Runs of role comparison that have a front and is_of_the_paper().
[[nodiscard]] Runs judged_runs(const StudyResult& study);
/// Those that are complete and of a method, without the reference.
[[nodiscard]] Runs complete_runs(const StudyResult& study, const std::string& method);

/// Null where the pointer leads nowhere.
[[nodiscard]] nlohmann::json number_at(const nlohmann::json& from,
                                       const nlohmann::json::json_pointer& pointer);
/// The number of a run in a table of the metrics that has an entry per run; null where it is not
/// there.
[[nodiscard]] nlohmann::json number_of(const nlohmann::json& metrics, const char* table,
                                       const RunResult& run, const std::string& pointer);
/// A resolved parameter of the run's method; null where the run does not state it.
[[nodiscard]] nlohmann::json parameter_of(const RunResult& run, const std::string& name);

/// "MPS", "SPH"
[[nodiscard]] std::string upper_name(const std::string& method);

/// How many of how many meet a criterion, and of how many that cannot be decided.
struct Count {
  std::size_t met = 0, all = 0, open = 0;
  void add(bool meets) {
    met += meets ? 1 : 0;
    ++all;
  }
  Count& operator+=(const Count& other) {
    met += other.met;
    all += other.all;
    open += other.open;
    return *this;
  }
};
/// reproduced, not reproduced, "depends on CONDITION", not decidable where one is open, or not
/// measured where there is none at all.
[[nodiscard]] std::string verdict_of(const Count& count, const std::string& condition);

/// A number of a run; null where it is not known.
using ValueOf = std::function<nlohmann::json(const RunResult&)>;
/// The runs' numbers as evidence, each called `what` and the run's label.
void add_evidence(Claim& claim, const std::string& what, const Runs& runs, const ValueOf& value);
/// The runs whose number is known.
[[nodiscard]] Count count_runs(const Runs& runs, const ValueOf& value,
                               const std::function<bool(double)>& meets);
/// Every MPS run with every SPH run for which the numbers are known.
[[nodiscard]] Count count_pairs(const Runs& mps, const Runs& sph, const ValueOf& value,
                                const std::function<bool(double mps, double sph)>& as_said);

[[nodiscard]] Claim agreement_claim(const StudyResult& study, const nlohmann::json& metrics,
                                    const std::string& method);
[[nodiscard]] Claim accuracy_claim(const StudyResult& study, const nlohmann::json& metrics);
[[nodiscard]] Claim pattern_claim(const StudyResult& study, const nlohmann::json& metrics);
[[nodiscard]] Claim fragmentation_claim(const StudyResult& study, const nlohmann::json& metrics);
[[nodiscard]] Claim clustering_claim(const StudyResult& study, const nlohmann::json& metrics);
[[nodiscard]] Claim robustness_claim(const StudyResult& study);
[[nodiscard]] Claim cost_claim(const StudyResult& study, const nlohmann::json& metrics);
[[nodiscard]] Claim pressure_claim(const StudyResult& study, const nlohmann::json& metrics);
[[nodiscard]] Claim growth_claim(const nlohmann::json& metrics);

}  // namespace surge::compare
