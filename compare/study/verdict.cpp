#include "compare/study/verdict.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "compare/study/convergence.hpp"
#include "compare/study/levels_ahead.hpp"
#include "compare/study/quantities.hpp"
#include "compare/study/sequences.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

const double uniform = 1.0 / std::sqrt(3.0);  ///< standard deviation over half the width

bool refines(const RunResult& other, const RunResult& run) {
  if (other.measured == nullptr || other.status != RunStatus::complete) return false;
  if (other.study.role != Role::comparison && other.study.role != Role::convergence) return false;
  if (!may_be_levels(other.study, run.study)) return false;
  if (!run.study.group.empty() && other.study.group == run.study.group) return true;
  // Of files the tables do not say it.
  return other.measured->run.method == run.measured->run.method &&
         other.measured->run.preset == run.measured->run.preset;
}

/// 95 % uncertainty of a value of a run, taken of all its refinements that have it.
template <class Value>
std::optional<double> run_uncertainty(const std::vector<const RunResult*>& refinements,
                                      const RunResult& run, const Value& value) {
  std::vector<LevelValue> levels;
  std::optional<std::size_t> own;
  for (const RunResult* level : refinements) {
    const std::optional<double> found = value(*level->measured);
    if (!found) continue;
    if (level == &run) own = levels.size();
    levels.push_back({level->measured->run.spacing.value(), *found});
  }
  return own ? level_uncertainty(levels, *own) : std::nullopt;
}

/// By how much a front may pass its straight line between two frames: the bound dt^2/8 |Z''|, with
/// Z'' from three frames, is taken as half the width of a uniform distribution; root of the mean
/// square over the frames in the window.
double frame_uncertainty(const DimensionlessFront& front, const Window& window) {
  double squares = 0.0, n = 0.0;
  const auto& samples = front.samples;
  for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
    if (samples[i].time < window.begin || samples[i + 1].time > window.end) continue;
    const double second =
        (samples[i + 1].position - 2.0 * samples[i].position + samples[i - 1].position).value();
    squares += std::pow(second / 8.0 * uniform, 2);
    n += 1.0;
  }
  return n > 0.0 ? std::sqrt(squares / n) : 0.0;
}

std::optional<double> impact_of(const MeasuredRun& run) {
  const auto far = run.run.physics.far_wall();
  const auto hit = far ? impact(run.history, *far, run.run.spacing) : std::nullopt;
  if (!hit) return std::nullopt;
  return run.run.physics.scales().dimensionless(hit->time).value();
}

/// Half of the time between the frames before and after the impact, as a standard uncertainty.
double impact_bracket(const MeasuredRun& run) {
  const auto hit = impact(run.history, *run.run.physics.far_wall(), run.run.spacing);
  return 0.5 * run.run.physics.scales().dimensionless(hit->after - hit->before).value() * uniform;
}

std::optional<double> standard(std::optional<double> uncertainty) {
  return uncertainty ? std::optional(*uncertainty / numerical_coverage) : std::nullopt;
}

std::optional<double> impact_uncertainty(const StudyResult& study, const RunResult& run) {
  return standard(run_uncertainty(refinements_of(study, run), run, impact_of));
}

std::string what_is_missing(const StudyResult& study, const RunResult& run,
                            const Uncertainties& parts) {
  if (run.status != RunStatus::complete) return run.study.name + " is not complete";
  if (!parts.reference) return why_no_uncertainty(study, study.reference());
  if (!parts.run) return why_no_uncertainty(study, run);
  return "";
}

Verdict judged(const StudyResult& study, const RunResult& run, Verdict verdict) {
  verdict.run = run.study.name;
  verdict.settle(what_is_missing(study, run, verdict.parts));
  return verdict;
}

Verdict front_verdict(const StudyResult& study, const RunResult& run) {
  const MeasuredRun& reference = study.reference_run();
  const FrontDifference d = difference(run.measured->front, reference.front, study.wall());
  Verdict verdict;
  verdict.quantity = "leading_edge";
  verdict.against = study.study.reference;
  verdict.difference = d.rms;
  verdict.tolerance = front_tolerance;
  verdict.parts = {front_uncertainty(study, run), front_uncertainty(study, study.reference()), 0.0,
                   std::hypot(frame_uncertainty(run.measured->front, d.window),
                              frame_uncertainty(reference.front, d.window))};
  return judged(study, run, verdict);
}

std::optional<Verdict> impact_verdict(const StudyResult& study, const RunResult& run) {
  const MeasuredRun& reference = study.reference_run();
  const auto ours = impact_of(*run.measured), theirs = impact_of(reference);
  if (!ours || !theirs) return std::nullopt;
  Verdict verdict;
  verdict.quantity = "impact";
  verdict.against = study.study.reference;
  verdict.difference = *ours - *theirs;
  verdict.tolerance = impact_tolerance;
  verdict.parts = {impact_uncertainty(study, run), impact_uncertainty(study, study.reference()),
                   0.0, std::hypot(impact_bracket(*run.measured), impact_bracket(reference))};
  return judged(study, run, verdict);
}

std::optional<Verdict> experiment_verdict(const StudyResult& study, const RunResult& run,
                                          const PublishedSeries& series) {
  // A series of another case says nothing about this run, as metrics.json tells.
  if (other_case(series, run.measured->run.physics)) return std::nullopt;
  Verdict verdict;
  try {
    verdict.difference = against_series(run.measured->front, series, study.wall()).raw.rms;
  } catch (const Error&) {
    return std::nullopt;  // its points are not in the run's window, as metrics.json says
  }
  verdict.quantity = "leading_edge";
  verdict.against = series.name;
  verdict.tolerance = front_tolerance;
  verdict.parts = {front_uncertainty(study, run), 0.0,
                   published_uncertainty_rms(series, run.measured->front, DimensionlessTime(0.0)),
                   0.0};
  return judged(study, run, verdict);
}

}  // namespace

std::string outcome_text(Outcome outcome) {
  constexpr std::array names{"agrees", "differs", "not decidable"};
  return names.at(static_cast<std::size_t>(outcome));
}

std::optional<double> Uncertainties::combined() const {
  double squares = 0.0;
  for (const auto& part : {run, reference, data, frames}) {
    if (!part) return std::nullopt;
    squares += *part * *part;
  }
  return std::sqrt(squares);
}

std::optional<double> Verdict::interval() const {
  const auto u = parts.combined();
  return u ? std::optional(coverage * *u) : std::nullopt;
}

void Verdict::settle(const std::string& unknown) {
  why = unknown;
  if (!why.empty()) return;
  outcome = decide(difference, tolerance, interval());
  if (outcome != Outcome::undecided) return;
  const std::array<std::pair<double, std::string>, 4> all{
      {{parts.run.value_or(0.0), "the resolution of " + run},
       {parts.reference.value_or(0.0), "the resolution of " + against},
       {parts.data.value_or(0.0), "what is known of the published values"},
       {parts.frames.value_or(0.0), "the time between frames"}}};
  why = "the tolerance lies within the uncertainty, most of which is due to " +
        std::max_element(all.begin(), all.end())->second;
}

Outcome decide(double difference, double tolerance, std::optional<double> interval) {
  if (!interval || !std::isfinite(*interval) || !std::isfinite(difference))
    return Outcome::undecided;
  if (std::abs(difference) + *interval <= tolerance) return Outcome::agrees;
  if (std::abs(difference) - *interval > tolerance) return Outcome::differs;
  return Outcome::undecided;
}

std::optional<double> level_uncertainty(const std::vector<LevelValue>& levels, std::size_t own) {
  std::vector<Level> all;
  for (const LevelValue& level : levels) all.push_back({level.size, level.value});
  const auto chosen = systematic_levels(all);
  if (!chosen) return std::nullopt;
  std::vector<Level> others = all;
  std::erase_if(others, [&](const Level& level) {
    return std::any_of(chosen->begin(), chosen->end(),
                       [&](const Level& used) { return used.h == level.h; });
  });
  const GridConvergence found = grid_convergence(*chosen, others);
  return std::abs(levels.at(own).value - chosen->front().value) + found.uncertainty;
}

std::array<double, 8> followed_moments(double begin, double end) {
  std::array<double, 8> moments{};
  const auto count = static_cast<double>(moments.size());
  for (std::size_t k = 0; k < moments.size(); ++k)
    moments[k] = begin + (static_cast<double>(k) + 0.5) / count * (end - begin);
  return moments;
}

std::vector<const RunResult*> refinements_of(const StudyResult& study, const RunResult& run) {
  std::vector<const RunResult*> found{&run};
  for (const auto* list : {&study.runs, &study.others}) {
    for (const RunResult& other : *list) {
      if (!refines(other, run)) continue;
      const bool known = std::any_of(found.begin(), found.end(), [&](const RunResult* level) {
        return same_level(level->measured->run.spacing.value(),
                          other.measured->run.spacing.value());
      });
      if (!known) found.push_back(&other);
    }
  }
  return found;
}

std::string why_no_uncertainty(const StudyResult& study, const RunResult& run) {
  std::vector<Level> levels;
  for (const RunResult* level : refinements_of(study, run))
    levels.push_back({level->measured->run.spacing.value(), 0.0});
  const std::string unknown = ", so that its u is unknown";
  if (levels.size() < 3) return run.study.name + " at two more resolutions is not there" + unknown;
  if (!systematic_levels(levels))
    return "three resolutions of " + run.study.name + " that differ by factors of " +
           number_text(smallest_ratio) + " or more are not there" + unknown;
  return "not every resolution of " + run.study.name + " has this" + unknown;
}

std::optional<double> front_uncertainty(const StudyResult& study, const RunResult& run) {
  const std::vector<const RunResult*> refinements = refinements_of(study, run);
  const Window window =
      difference(run.measured->front, study.reference_run().front, study.wall()).window;
  double squares = 0.0, n = 0.0;
  for (const double t : followed_moments(window.begin.value(), window.end.value())) {
    const auto value = [&](const MeasuredRun& level) -> std::optional<double> {
      const auto z = level.front.at(DimensionlessTime(t));
      return z ? std::optional(z->value()) : std::nullopt;
    };
    if (!value(*run.measured)) continue;
    const auto u = run_uncertainty(refinements, run, value);
    if (!u) return std::nullopt;
    squares += *u * *u;
    n += 1.0;
  }
  return n > 0.0 ? standard(std::sqrt(squares / n)) : std::nullopt;
}

std::vector<Verdict> find_verdicts(const StudyResult& study) {
  std::vector<Verdict> verdicts;
  if (!study.has_front) return verdicts;
  const auto add = [&](std::optional<Verdict> verdict) {
    if (verdict) verdicts.push_back(std::move(*verdict));
  };
  for (const RunResult* run : study.measured()) {
    if (run != &study.reference()) {
      add(front_verdict(study, *run));
      add(impact_verdict(study, *run));
    }
    for (const PublishedSeries& series : study.published)
      if (series.experiment) add(experiment_verdict(study, *run, series));
  }
  return verdicts;
}

void measure_verdicts(const StudyResult& study, json& metrics) {
  json& out = metrics["verdicts"];
  out = {{"coverage", coverage},
         {"numerical_coverage", numerical_coverage},
         {"front_tolerance", front_tolerance},
         {"impact_tolerance", impact_tolerance},
         {"runs", json::object()}};
  for (const Verdict& verdict : find_verdicts(study)) {
    out["runs"][verdict.run][verdict.quantity][verdict.against] = {
        {"E", verdict.difference},
        {"U", json_or_null(verdict.interval())},
        {"u_val", json_or_null(verdict.parts.combined())},
        {"u_run", json_or_null(verdict.parts.run)},
        {"u_reference", json_or_null(verdict.parts.reference)},
        {"u_data", json_or_null(verdict.parts.data)},
        {"u_frames", json_or_null(verdict.parts.frames)},
        {"tolerance", verdict.tolerance},
        {"verdict", outcome_text(verdict.outcome)},
        {"why", verdict.why}};
  }
}

}  // namespace surge::compare
