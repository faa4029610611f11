#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "compare/report/sections.hpp"
#include "compare/study/observed_curves.hpp"
#include "compare/study/sequences.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

constexpr std::size_t most_rows = 5;         ///< besides the reference
constexpr std::size_t most_title_words = 5;  ///< of an observable that a sentence can name

/// What the runs are ranked by: the leading edge, or the first observable that is compared.
struct RankedQuantity {
  std::string key;  ///< "leading_edge", or that of metrics["observables"]
  std::string measure = "rms";
  std::string title;
  std::string unit;
};

const json& entry_at(const json& from, const json::json_pointer& pointer) {
  static const json none;
  return from.contains(pointer) ? from.at(pointer) : none;
}

json::json_pointer pointer_to(std::initializer_list<std::string> parts) {
  json::json_pointer pointer;
  for (const std::string& part : parts) pointer /= part;
  return pointer;
}

json value_of(const json& entry, const char* name) {
  return entry.is_object() && entry.contains(name) ? entry.at(name) : json();
}

/// The verdict on a run in a quantity; null where there is none.
const json& verdict_of(const StudyResult& study, const json& metrics,
                       const RankedQuantity& quantity, const std::string& run) {
  const std::string& reference = study.study.reference;
  if (quantity.key == "leading_edge")
    return entry_at(metrics, pointer_to({"verdicts", "runs", run, "leading_edge", reference}));
  return entry_at(metrics, pointer_to({"observables", quantity.key, "runs", run, "against",
                                       reference, "measures", quantity.measure}));
}

/// The first observable, in the study's order, of which a run has the measure, or, where none is
/// named, any: the root of the mean square before others.
std::optional<RankedQuantity> observable_with(const StudyResult& study, const json& metrics,
                                              const std::string& measure) {
  std::optional<RankedQuantity> found;
  for (const ObservedQuantity& observed : observed_quantities(study)) {
    for (const RunResult* run : study.measured()) {
      const json& measures =
          entry_at(metrics, pointer_to({"observables", observed.key, "runs", run->study.name,
                                        "against", study.study.reference, "measures"}));
      if (!measures.is_object()) continue;
      for (const auto& [word, one] : measures.items()) {
        const RankedQuantity here{observed.key, word, observed.title, one.value("unit", "")};
        // A moment is the run's own; the runs are ranked by their difference.
        const bool is_known = value_of(one, measure.empty() ? "E" : "run").is_number();
        if (is_known && word == (measure.empty() ? "rms" : measure)) return here;
        if (measure.empty() && !found && value_of(one, "E").is_number()) found = here;
      }
    }
  }
  return found;
}

std::optional<RankedQuantity> ranking_quantity(const StudyResult& study, const json& metrics) {
  if (study.has_front) return RankedQuantity{"leading_edge", "rms", "Leading edge Z/L", "1"};
  return observable_with(study, metrics, "");
}

/// "MPS paper" of "MPS paper, l0 = 5 mm"; of files that do not say their method, their name.
std::string short_name(const RunResult& run) {
  if (run.measured == nullptr || run.study.is_files()) return run.study.name;
  const std::string label = run.label();
  return label.substr(0, label.find(", "));
}

using Kind = std::tuple<std::string, std::string, std::string, std::string>;
Kind kind_of(const RunResult& run) {
  const Run& measured = run.measured->run;
  // Files of another program are each their own method, whatever they are called.
  return {run.study.program, run.study.is_files() ? run.study.name : run.study.case_path.string(),
          measured.method, measured.preset};
}

/// The complete runs besides the reference: of each kind the finest. Runs of the reference's own
/// kind are its coarser levels; they count where nothing else is compared.
std::vector<const RunResult*> finest_of_each_kind(const StudyResult& study) {
  std::vector<const RunResult*> own, others;
  std::map<Kind, std::size_t> seen;
  for (const RunResult* run : study.measured()) {
    if (run == &study.reference() || run->status != RunStatus::complete) continue;
    if (kind_of(*run) == kind_of(study.reference())) {
      own.push_back(run);
      continue;
    }
    const auto [at, is_new] = seen.emplace(kind_of(*run), others.size());
    if (is_new)
      others.push_back(run);
    else if (run->measured->run.spacing < others[at->second]->measured->run.spacing)
      others[at->second] = run;
  }
  return others.empty() ? own : others;
}

class AnswerSection {
 public:
  AnswerSection(const StudyResult& study, const json& metrics) : study_(study), metrics_(metrics) {}

  json made() {
    const auto quantity = ranking_quantity(study_, metrics_);
    json out{{"quantity", nullptr}, {"rows", json::array()}, {"nearest", nullptr},
             {"next", nullptr},     {"order", nullptr},      {"moment", nullptr}};
    std::vector<const RunResult*> runs = finest_of_each_kind(study_);
    const std::vector<const RunResult*> measured = study_.measured();
    const auto complete =
        std::count_if(measured.begin(), measured.end(), [&](const RunResult* run) {
          return run != &study_.reference() && run->status == RunStatus::complete;
        });
    if (quantity) {
      out["quantity"] = {{"key", quantity->key},
                         {"measure", quantity->measure},
                         {"title", quantity->title},
                         {"unit", quantity->unit},
                         {"short", words_in(quantity->title) <= most_title_words ? quantity->title
                                                                                 : quantity->key}};
      keep_nearest(runs, *quantity);
    } else if (runs.size() > most_rows) {
      runs.resize(most_rows);
    }
    find_moment(out);
    for (const RunResult* run : runs) out["rows"].push_back(row_of(*run, quantity));
    out["rows"].push_back(row_of(study_.reference(), std::nullopt));
    make_names_unique(out["rows"]);
    out["more"] = static_cast<std::size_t>(complete) - runs.size();
    out["reference_row"] = runs.size();
    if (quantity) rank(out);
    return out;
  }

 private:
  static std::size_t words_in(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), ' ')) + 1;
  }

  [[nodiscard]] std::optional<double> distance(const RunResult& run,
                                               const RankedQuantity& quantity) const {
    const json e = value_of(verdict_of(study_, metrics_, quantity, run.study.name), "E");
    return e.is_number() ? std::optional(std::abs(e.get<double>())) : std::nullopt;
  }

  /// The nearest most_rows, in the study's order; none that cannot be told before one that can.
  void keep_nearest(std::vector<const RunResult*>& runs, const RankedQuantity& quantity) const {
    if (runs.size() <= most_rows) return;
    std::vector<const RunResult*> by_distance = runs;
    const auto key = [&](const RunResult* run) {
      return distance(*run, quantity).value_or(std::numeric_limits<double>::infinity());
    };
    std::stable_sort(by_distance.begin(), by_distance.end(),
                     [&](const auto* a, const auto* b) { return key(a) < key(b); });
    by_distance.resize(most_rows);
    std::erase_if(runs, [&](const RunResult* run) {
      return std::find(by_distance.begin(), by_distance.end(), run) == by_distance.end();
    });
  }

  /// The impact on the far wall, else the arrival of the first observable that has one.
  void find_moment(json& out) {
    for (const RunResult* run : study_.measured())
      if (value_of(entry_at(metrics_, pointer_to({"front", run->study.name})), "impact_time_s")
              .is_number())
        moment_ = RankedQuantity{"impact", "", "Impact on the far wall", "s"};
    if (!moment_) moment_ = observable_with(study_, metrics_, "arrival");
    if (moment_) out["moment"] = {{"key", moment_->key}, {"title", moment_->title}};
  }

  [[nodiscard]] json moment_of(const RunResult& run) const {
    const std::string& name = run.study.name;
    if (!moment_) return nullptr;
    if (moment_->key == "impact")
      return value_of(entry_at(metrics_, pointer_to({"front", name})), "impact_time_s");
    if (&run != &study_.reference())
      return value_of(verdict_of(study_, metrics_, *moment_, name), "run");
    for (const RunResult* other : study_.measured()) {
      const json value =
          value_of(verdict_of(study_, metrics_, *moment_, other->study.name), "reference");
      if (value.is_number()) return value;
    }
    return nullptr;
  }

  [[nodiscard]] json row_of(const RunResult& run,
                            const std::optional<RankedQuantity>& quantity) const {
    const json& timing = entry_at(metrics_, pointer_to({"timing", run.study.name}));
    json row{{"run", run.study.name},
             {"label", run.label()},
             {"short", short_name(run)},
             {"moment_s", moment_of(run)},
             {"wall_s", value_of(timing, "wall_s")},
             {"threads", value_of(timing, "threads")},
             {"alone", run.study.timed}};
    static const json none;
    const json& verdict = quantity ? verdict_of(study_, metrics_, *quantity, run.study.name) : none;
    for (const char* name : {"E", "U", "u_run", "u_frames", "tolerance", "verdict", "why"})
      row[name] = value_of(verdict, name);
    return row;
  }

  /// Two that would be called the same are called by their runs.
  static void make_names_unique(json& rows) {
    std::map<std::string, int> count;
    for (const json& row : rows) ++count[row["short"]];
    for (json& row : rows)
      if (count[row["short"]] > 1) row["short"] = row["run"];
  }

  /// Which is nearest, which comes next, and whether the order of the two is more than their own
  /// uncertainties (that of the reference is in both alike).
  static void rank(json& out) {
    std::vector<std::size_t> order;
    const auto distance = [&](std::size_t k) {
      return std::abs(out["rows"][k]["E"].get<double>());
    };
    for (std::size_t k = 0; k + 1 < out["rows"].size(); ++k)
      if (out["rows"][k]["E"].is_number()) order.push_back(k);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
    if (order.empty()) return;
    out["nearest"] = order[0];
    if (order.size() < 2) return;
    out["next"] = order[1];
    double sum = 0.0;
    bool known = true;
    for (const std::size_t k : {order[0], order[1]})
      for (const char* name : {"u_run", "u_frames"}) {
        const json& u = out["rows"][k][name];
        known = known && u.is_number();
        if (known) sum += u.get<double>() * u.get<double>();
      }
    out["gap"] = distance(order[1]) - distance(order[0]);
    out["gap_U"] = known ? json(coverage * std::sqrt(sum)) : json();
    out["order"] = !known ? "unknown" : out["gap"] > out["gap_U"] ? "sure" : "open";
  }

  const StudyResult& study_;
  const json& metrics_;
  std::optional<RankedQuantity> moment_;
};

}  // namespace

void measure_answer(const StudyResult& study, json& metrics) {
  metrics["answer"] = AnswerSection(study, metrics).made();
}

}  // namespace surge::compare
