#include <cmath>
#include <set>

#include "compare/report/claim_parts.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

constexpr double quadratic = 0.15;  ///< deviation of the exponent from two

/// A quantity in which SPH is compared with MPS, and how that came out.
struct Comparison {
  std::string where;  ///< "per step with the paper's step rule"
  Count count;
};

/// SPH runs whose step the speed of sound limits too, or those without that limit.
Runs with_acoustic_limit(const Runs& sph, bool wanted) {
  Runs runs;
  for (const RunResult* run : sph) {
    const json limit = parameter_of(*run, "acoustic_courant");
    const bool has = limit.is_number() && limit.get<double>() > 0.0;
    if (has == wanted) runs.push_back(run);
  }
  return runs;
}

std::vector<Comparison> compare_whole_runs(const StudyResult& study, const json& metrics,
                                           Claim& claim) {
  const Runs mps = complete_runs(study, "mps"), sph = complete_runs(study, "sph");
  std::vector<Comparison> out;
  for (const auto& [name, unit, pointer] :
       {std::tuple{"per step", "ms per step, ", "/ms_per_step"},
        std::tuple{"per simulated second", "s per simulated s, ", "/s_per_simulated_s"}}) {
    const auto value = [&, pointer = pointer](const RunResult& run) {
      return number_of(metrics, "cost", run, pointer);
    };
    add_evidence(claim, unit, mps, value);
    add_evidence(claim, unit, sph, value);
    for (const bool acoustic : {false, true}) {
      const Count count =
          count_pairs(mps, with_acoustic_limit(sph, acoustic), value, std::greater<>());
      out.push_back({std::string(name) + (acoustic ? " with an acoustic limit of the step"
                                                   : " with the paper’s step rule"),
                     count});
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

/// The timed runs of both methods with the same neighbour search, at the largest common size.
std::vector<Comparison> compare_timed_runs(const json& metrics, Claim& claim) {
  std::vector<Comparison> out;
  for (const auto& [mps_name, mps] : metrics["scaling"].items()) {
    for (const auto& [sph_name, sph] : metrics["scaling"].items()) {
      if (mps["method"] != "mps" || sph["method"] != "sph" || mps["search"] != sph["search"])
        continue;
      const auto [of_mps, of_sph] = largest_common(mps, sph);
      if (of_mps == nullptr) continue;
      const std::string size =
          fixed_text((*of_mps)["fluid_particles"].get<double>(), 0) + " particles";
      for (const auto& [what, name] :
           {std::pair{"ms per step, ", "ms_per_step"}, std::pair{"s in total, ", "total_s"}}) {
        const json& a = (*of_mps)[name];
        const json& b = (*of_sph)[name];
        claim.evidence.push_back({what + size + ", " + mps["label"].get<std::string>(), a});
        claim.evidence.push_back({what + size + ", " + sph["label"].get<std::string>(), b});
        if (!a.is_number() || !b.is_number()) continue;
        out.push_back({std::string(name == std::string("total_s") ? "in total" : "per step") +
                           " at " + size + " with the search " + mps["search"].get<std::string>(),
                       {b.get<double>() < a.get<double>() ? 1U : 0U, 1U}});
      }
    }
  }
  return out;
}

}  // namespace

Claim cost_claim(const StudyResult& study, const json& metrics) {
  Claim claim{"sph_cheaper",
              "SPH costs less than MPS.",
              "Section 5.2, Fig. 9",
              "every SPH run below every MPS run, per step and per simulated second, with the "
              "paper’s step rule and with a limit by the speed of sound besides, setup and output "
              "left out; and so the timed runs of the same size and search",
              "",
              {}};
  std::vector<Comparison> all = compare_whole_runs(study, metrics, claim);
  for (Comparison& timed : compare_timed_runs(metrics, claim)) all.push_back(std::move(timed));
  Count sum;
  std::string fails;
  for (const Comparison& comparison : all) {
    sum += comparison.count;
    if (comparison.count.met < comparison.count.all)
      fails += (fails.empty() ? "" : ", ") + comparison.where;
  }
  claim.verdict = verdict_of(sum, "the quantity: not so " + fails);
  return claim;
}

Claim pressure_claim(const StudyResult& study, const json& metrics) {
  Claim claim{"poisson_dominates",
              "MPS costs more because it solves a linear system for the pressure.",
              "Section 5.2",
              "the pressure takes more than half of the solving time of every MPS run",
              "",
              {}};
  const Runs runs = complete_runs(study, "mps");
  const ValueOf share = [&](const RunResult& run) {
    return number_of(metrics, "cost", run, "/share/pressure");
  };
  add_evidence(claim, "part of the time, ", runs, share);
  claim.verdict =
      verdict_of(count_runs(runs, share, [](double x) { return x > 0.5; }), "the pressure solver");
  return claim;
}

Claim growth_claim(const json& metrics) {
  Claim claim{"grows_quadratically",
              "Without a neighbour search the time grows as the square of the number of particles.",
              "Section 5.2",
              "exponent of the time per step over the number of all particles within " +
                  fixed_text(quadratic, 2) +
                  " of two for both methods with the all-pairs search: over a range of sizes of 25 "
                  "that much changes the time by a factor of 1.6",
              "",
              {}};
  Count count;
  std::set<std::string> methods;
  for (const auto& [name, curve] : metrics["scaling"].items()) {
    const json exponent = number_at(curve, json::json_pointer("/fit_per_step/exponent"));
    claim.evidence.push_back({"exponent, " + curve["label"].get<std::string>(), exponent});
    if (curve["search"] != "all_pairs" || !exponent.is_number()) continue;
    methods.insert(curve["method"].get<std::string>());
    count.add(std::abs(exponent.get<double>() - 2.0) <= quadratic);
  }
  claim.verdict = methods.size() < 2 ? not_measured : verdict_of(count, "the method");
  return claim;
}

}  // namespace surge::compare
