#pragma once

#include <functional>
#include <optional>

#include "compare/report/claims.hpp"
#include "particle/support/table.hpp"

namespace surge::compare {

// What the claims of all groups are found with.

inline constexpr const char* reproduced = "reproduced";
inline constexpr const char* not_reproduced = "not reproduced";
inline constexpr const char* not_measured = "not measured";
inline constexpr const char* not_decidable = "not decidable";

using Runs = std::vector<const RunResult*>;

/// Whether the publication's statements are about such a run: those of its presets and the meshes,
/// not the formulations that came since.
[[nodiscard]] bool is_of_the_paper(const StudyResult& study, const RunResult& run);
/// Runs of role comparison that have a front and is_of_the_paper().
[[nodiscard]] Runs judged_runs(const StudyResult& study);
/// Those that are complete and of a method, without the reference.
[[nodiscard]] Runs complete_runs(const StudyResult& study, const std::string& method);
/// Of all methods of a statement, in its order.
[[nodiscard]] Runs complete_runs(const StudyResult& study, const Statement& statement);

/// Null where the pointer leads nowhere.
[[nodiscard]] nlohmann::json number_at(const nlohmann::json& from,
                                       const nlohmann::json::json_pointer& pointer);
/// The number of a run in a table of the metrics that has an entry per run; null where it is not
/// there.
[[nodiscard]] nlohmann::json number_of(const nlohmann::json& metrics, const char* table,
                                       const RunResult& run, const std::string& pointer);
/// A resolved parameter of the run's method; null where the run does not state it.
[[nodiscard]] nlohmann::json parameter_of(const RunResult& run, const std::string& name);

enum class Answer { yes, no, open };

/// How many of how many meet a criterion, and of how many that cannot be decided.
struct Count {
  std::size_t met = 0, all = 0, open = 0;
  void add(bool meets) {
    met += meets ? 1 : 0;
    ++all;
  }
  void add(Answer answer) {
    if (answer == Answer::open)
      ++open;
    else
      add(answer == Answer::yes);
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
/// A number with the half width of its 95 % interval, empty where that is not known.
struct Judged {
  double value = 0.0;
  std::optional<double> interval;
};
/// Whether a > b; open where their intervals are not known or leave it open.
[[nodiscard]] Answer is_above(const Judged& a, const Judged& b);

/// The number of a run with what its refinements say of its uncertainty, as for a leading edge: see
/// level_uncertainty(). Empty where the number is not known.
[[nodiscard]] std::optional<Judged> judged_by_levels(const StudyResult& study, const RunResult& run,
                                                     const ValueOf& value);
/// The scatter of repeated timings, a standard deviation over the median, of all repeats in
/// metrics["scaling"]; empty where nothing was timed twice.
[[nodiscard]] std::optional<double> timing_scatter(const nlohmann::json& metrics);

using JudgedOf = std::function<std::optional<Judged>(const RunResult&)>;
/// The runs whose number is known, and how many are above the threshold.
[[nodiscard]] Count count_above(const Runs& runs, const JudgedOf& number, double threshold);
/// Every run of the one with every run of the other for which the numbers are known: how many of
/// the one are above.
[[nodiscard]] Count count_pairs(const Runs& above, const Runs& below, const JudgedOf& number);

/// The claim without its verdict: words of the publication, the criterion with its numbers.
[[nodiscard]] Claim claim_of(const Statement& statement);

/// What a rule is given.
struct Judging {
  const StudyResult& study;
  const nlohmann::json& metrics;
  const Statement& statement;
};
[[nodiscard]] Claim judge_agreement(const Judging& judging);
[[nodiscard]] Claim judge_accuracy(const Judging& judging);
[[nodiscard]] Claim judge_patterns(const Judging& judging);
[[nodiscard]] Claim judge_fragmentation(const Judging& judging);
[[nodiscard]] Claim judge_clustering(const Judging& judging);
[[nodiscard]] Claim judge_robustness(const Judging& judging);
[[nodiscard]] Claim judge_cost(const Judging& judging);
[[nodiscard]] Claim judge_pressure(const Judging& judging);
[[nodiscard]] Claim judge_growth(const Judging& judging);

}  // namespace surge::compare
