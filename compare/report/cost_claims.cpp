#include <algorithm>
#include <cmath>
#include <set>

#include "compare/report/claim_parts.hpp"
#include "compare/study/sequences.hpp"
#include "compare/study/verdict.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

/// A quantity in which the cheaper method is compared with the other, and how that came out.
struct TimedRuns {
  std::string where;  ///< "per step with the paper's step rule"
  Count count;
};

/// Runs whose step the speed of sound limits too, or those without that limit.
Runs with_acoustic_limit(const Runs& of, bool wanted) {
  Runs runs;
  for (const RunResult* run : of) {
    const json limit = parameter_of(*run, "acoustic_courant");
    const bool has = limit.is_number() && limit.get<double>() > 0.0;
    if (has == wanted) runs.push_back(run);
  }
  return runs;
}

/// A time with the interval of one measurement.
Judged timed(double value, std::optional<double> scatter, double repeats = 1.0) {
  if (!scatter) return {value, std::nullopt};
  return {value, coverage * *scatter * value / std::sqrt(repeats)};
}

std::vector<TimedRuns> compare_whole_runs(const Judging& judging, Claim& claim) {
  const auto& [study, metrics, statement] = judging;
  const Runs cheap = complete_runs(study, statement.methods.at(0));
  const Runs dear = complete_runs(study, statement.methods.at(1));
  const auto scatter = timing_scatter(metrics);
  std::vector<TimedRuns> out;
  for (const auto& [name, unit, pointer] :
       {std::tuple{"per step", "ms per step, ", "/ms_per_step"},
        std::tuple{"per simulated second", "s per simulated s, ", "/s_per_simulated_s"}}) {
    const ValueOf value = [&table = metrics, pointer = pointer](const RunResult& run) {
      return number_of(table, "cost", run, pointer);
    };
    add_evidence(claim, unit, dear, value);
    add_evidence(claim, unit, cheap, value);
    const JudgedOf number = [&](const RunResult& run) -> std::optional<Judged> {
      const json known = value(run);
      if (!known.is_number()) return std::nullopt;
      return timed(known.get<double>(), scatter);
    };
    for (const bool acoustic : {false, true}) {
      out.push_back({std::string(name) + (acoustic ? " with an acoustic limit of the step"
                                                   : " with the paper’s step rule"),
                     count_pairs(dear, with_acoustic_limit(cheap, acoustic), number)});
    }
  }
  return out;
}

/// The largest number of fluid particles that two curves share; their points there.
std::pair<const json*, const json*> largest_common(const json& a, const json& b) {
  std::pair<const json*, const json*> found{nullptr, nullptr};
  for (const json& p : a["points"]) {
    for (const json& q : b["points"]) {
      if (p["fluid_particles"] == q["fluid_particles"]) found = {&p, &q};
    }
  }
  return found;
}

/// How often the time of a point of a curve was measured.
double repeats_of(const json& point) {
  for (const char* sample : {"window", "whole"}) {
    if (point.contains(sample) && point[sample].is_object())
      return point[sample]["repeats"].get<double>();
  }
  return 1.0;
}

/// The timed runs of both methods with the same neighbour search, at the largest common size.
std::vector<TimedRuns> compare_timed_runs(const Judging& judging, Claim& claim) {
  const json& metrics = judging.metrics;
  const std::string &cheaper = judging.statement.methods.at(0),
                    &dearer = judging.statement.methods.at(1);
  const auto scatter = timing_scatter(metrics);
  std::vector<TimedRuns> out;
  for (const auto& [dear_name, dear] : metrics["scaling"].items()) {
    for (const auto& [cheap_name, cheap] : metrics["scaling"].items()) {
      if (dear["method"] != dearer || cheap["method"] != cheaper ||
          dear["search"] != cheap["search"])
        continue;
      const auto [of_dear, of_cheap] = largest_common(dear, cheap);
      if (of_dear == nullptr) continue;
      const std::string size =
          fixed_text((*of_dear)["fluid_particles"].get<double>(), 0) + " particles";
      for (const auto& [what, name] :
           {std::pair{"ms per step, ", "ms_per_step"}, std::pair{"s in total, ", "total_s"}}) {
        const json& a = (*of_dear)[name];
        const json& b = (*of_cheap)[name];
        claim.evidence.push_back({what + size + ", " + dear["label"].get<std::string>(), a});
        claim.evidence.push_back({what + size + ", " + cheap["label"].get<std::string>(), b});
        if (!a.is_number() || !b.is_number()) continue;
        Count count;
        count.add(is_above(timed(a.get<double>(), scatter, repeats_of(*of_dear)),
                           timed(b.get<double>(), scatter, repeats_of(*of_cheap))));
        out.push_back({std::string(name == std::string("total_s") ? "in total" : "per step") +
                           " at " + size + " with the search " + dear["search"].get<std::string>(),
                       count});
      }
    }
  }
  return out;
}

}  // namespace

std::optional<double> timing_scatter(const json& metrics) {
  double squares = 0.0, freedom = 0.0;
  for (const auto& curve : metrics.value("scaling", json::object())) {
    for (const json& point : curve["points"]) {
      for (const char* sample : {"window", "whole"}) {
        if (!point.contains(sample) || !point[sample].is_object()) continue;
        const double more = point[sample]["repeats"].get<double>() - 1.0;
        if (more <= 0.0) continue;
        squares += more * std::pow(point[sample]["scatter"].get<double>(), 2);
        freedom += more;
      }
    }
  }
  return freedom > 0.0 ? std::optional(std::sqrt(squares / freedom)) : std::nullopt;
}

Claim judge_cost(const Judging& judging) {
  Claim claim = claim_of(judging.statement);
  std::vector<TimedRuns> all = compare_whole_runs(judging, claim);
  for (TimedRuns& timed_runs : compare_timed_runs(judging, claim))
    all.push_back(std::move(timed_runs));
  claim.evidence.push_back(
      {"scatter of repeated timings, a standard deviation over the median",
       timing_scatter(judging.metrics) ? json(*timing_scatter(judging.metrics)) : json()});
  Count sum;
  std::string fails;
  for (const TimedRuns& comparison : all) {
    sum += comparison.count;
    if (comparison.count.met < comparison.count.all)
      fails += (fails.empty() ? "" : ", ") + comparison.where;
  }
  claim.verdict = verdict_of(sum, judging.statement.condition + " " + fails);
  return claim;
}

Claim judge_pressure(const Judging& judging) {
  const auto& [study, metrics, statement] = judging;
  Claim claim = claim_of(statement);
  const Runs runs = complete_runs(study, statement);
  const ValueOf share = [&table = metrics](const RunResult& run) {
    return number_of(table, "cost", run, "/share/pressure");
  };
  add_evidence(claim, "part of the time, ", runs, share);
  const auto scatter = timing_scatter(metrics);
  const JudgedOf number = [&](const RunResult& run) -> std::optional<Judged> {
    const json known = share(run);
    if (!known.is_number()) return std::nullopt;
    // a / (a + b) with the scatter of a and of b, independent of each other
    const double part = known.get<double>();
    if (!scatter) return Judged{part, std::nullopt};
    return Judged{part, coverage * std::sqrt(2.0) * *scatter * part * (1.0 - part)};
  };
  claim.verdict =
      verdict_of(count_above(runs, number, statement.numbers.at("share")), statement.condition);
  return claim;
}

Claim judge_growth(const Judging& judging) {
  const Statement& statement = judging.statement;
  Claim claim = claim_of(statement);
  const double wanted = statement.numbers.at("exponent"), within = statement.numbers.at("within");
  Count count;
  std::set<std::string> methods;
  for (const auto& [name, curve] : judging.metrics["scaling"].items()) {
    const json exponent = number_at(curve, json::json_pointer("/fit_per_step/exponent"));
    const json half_width = number_at(curve, json::json_pointer("/fit_per_step/half_width"));
    claim.evidence.push_back({"exponent, " + curve["label"].get<std::string>(), exponent});
    if (curve["search"] != "all_pairs" || !exponent.is_number()) continue;
    methods.insert(curve["method"].get<std::string>());
    const std::optional<double> interval =
        half_width.is_number() ? std::optional(half_width.get<double>()) : std::nullopt;
    switch (decide(exponent.get<double>() - wanted, within, interval)) {
      case Outcome::agrees:
        count.add(Answer::yes);
        break;
      case Outcome::differs:
        count.add(Answer::no);
        break;
      case Outcome::undecided:
        count.add(Answer::open);
        break;
    }
  }
  const bool all = std::all_of(statement.methods.begin(), statement.methods.end(),
                               [&](const std::string& method) { return methods.contains(method); });
  claim.verdict = all ? verdict_of(count, statement.condition) : not_measured;
  return claim;
}

}  // namespace surge::compare
