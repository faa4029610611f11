#include "compare/study/observable_verdicts.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "compare/measure/stated.hpp"
#include "compare/study/curve_data.hpp"
#include "compare/study/sequences.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

bool is_time(CurveMeasure measure) {
  return measure == CurveMeasure::arrival || measure == CurveMeasure::peak_time ||
         measure == CurveMeasure::phase;
}

std::string unit_of(CurveMeasure measure, const std::string& unit) {
  if (is_time(measure)) return "s";
  if (measure != CurveMeasure::impulse) return unit;
  return unit == "1" ? "s" : unit + " s";
}

/// 95 % uncertainty of a number that every level has or has not, as a standard uncertainty.
template <class Value>
std::optional<double> refined(const StudyResult& study, const RunResult& run, const Value& value) {
  std::vector<LevelValue> levels;
  std::optional<std::size_t> own;
  for (const RunResult* level : refinements_of(study, run)) {
    const std::optional<double> found = value(*level->measured);
    if (!found) continue;
    if (level == &run) own = levels.size();
    levels.push_back({level->measured->run.spacing.value(), *found});
  }
  const auto u = own ? level_uncertainty(levels, *own) : std::nullopt;
  return u ? std::optional(*u / numerical_coverage) : std::nullopt;
}

/// A run's curve, and what is asked of it, in one window.
class Comparer {
 public:
  Comparer(const StudyResult& study, const ObservedQuantity& quantity, const RunResult& run)
      : study_(study),
        quantity_(quantity),
        asked_(study.observables[quantity.observable]),
        run_(run),
        symbols_(case_symbols(run.measured->run.physics)),
        own_(curve_of(quantity, *run.measured).curve) {
    options_.threshold = maybe(asked_.threshold, quantity.unit, "threshold");
    options_.period = maybe(asked_.period, "s", "period");
    if (asked_.window && !quantity.is_profile())
      stated_ = {{value_in((*asked_.window)[0], "s", "window"),
                  value_in((*asked_.window)[1], "s", "window")}};
  }

  CurveComparison against_run(const RunResult& other) const {
    CurveComparison out{other.study.name, other.label(), "", "", 0.0, 0.0, 0.0, {}};
    const Curve theirs = curve_of(quantity_, *other.measured).curve;
    if (!common_window(theirs, out)) return out;
    for (const CurveMeasure measure : measures()) {
      Uncertainties parts{std::nullopt, std::nullopt, 0.0, 0.0};
      parts.run = uncertainty(run_, measure, out);
      parts.reference = uncertainty(other, measure, out);
      parts.frames = std::hypot(frames(own_, measure, out), frames(theirs, measure, out));
      out.measures.push_back(measured(measure, theirs, parts, out, nullptr));
    }
    return out;
  }

  CurveComparison against_series(const ReferenceSeries& series) const {
    CurveComparison out{series.name, series.label, "", "", 0.0, 0.0, 0.0, {}};
    const Physics& physics = run_.measured->run.physics;
    const double slack = 2.0 * run_.measured->run.spacing.value();
    if (const auto why = other_case(series, physics)) out.skipped = *why;
    if (const auto why = other_place(series, physics, place(), slack); why && out.skipped.empty())
      out.skipped = *why;
    if (!out.skipped.empty()) return out;
    out.note = gate_note(series, physics);
    ReferenceCurve data = curve_for(series, physics, quantity_.unit);
    Curve theirs{data.first, data.value};
    const Curve published = theirs;
    if (data.shift_within > 0.0) {
      out.shift = clock_shift(study_, run_, series, data.shift_within);
      for (double& t : theirs.first) t += out.shift;
      out.note += (out.note.empty() ? "" : "; ") + shift_note(series, data, out.shift);
    }
    if (!common_window(theirs, out)) return out;
    for (const CurveMeasure measure : measures()) {
      Uncertainties parts{std::nullopt, 0.0, 0.0, 0.0};
      parts.run = uncertainty(run_, measure, out);
      parts.data = data_uncertainty(measure, {own_, theirs, data, out.begin, out.end, options_});
      parts.frames = frames(own_, measure, out);
      out.measures.push_back(measured(measure, theirs, parts, out, &series));
      if (data.shift_within > 0.0) out.measures.back().unshifted = unshifted(measure, published);
    }
    return out;
  }

  /// For the shift of the series' clock; empty where they are not comparable. Lives as long as
  /// this.
  [[nodiscard]] std::optional<ShiftedPair> shifted_pair(const ReferenceSeries& series) const {
    const Physics& physics = run_.measured->run.physics;
    const double slack = 2.0 * run_.measured->run.spacing.value();
    if (own_.first.size() < 2 || other_case(series, physics) ||
        other_place(series, physics, place(), slack))
      return std::nullopt;
    const ReferenceCurve data = curve_for(series, physics, quantity_.unit);
    if (data.value.empty()) return std::nullopt;
    // What is known better counts more.
    double scale = 0.0;
    for (const double limit : data.limit) scale += limit / static_cast<double>(data.limit.size());
    const auto [low, high] = std::minmax_element(data.value.begin(), data.value.end());
    if (!(scale > 0.0)) scale = usual_tolerance * (*high - *low);
    if (!(scale > 0.0)) scale = 1.0;
    return ShiftedPair{&own_, {data.first, data.value}, scale, data.shift_within};
  }

 private:
  /// The one shift of all series of a clock for one run.
  static double clock_shift(const StudyResult& study, const RunResult& run,
                            const ReferenceSeries& series, double within) {
    const std::vector<ObservedQuantity> quantities = observed_quantities(study);
    std::vector<std::unique_ptr<Comparer>> owners;
    std::vector<ShiftedPair> pairs;
    for (const ObservedQuantity& quantity : quantities)
      for (const ReferenceSeries* other : series_of(study, quantity)) {
        const bool same =
            other == &series || (!series.clock.empty() && other->clock == series.clock);
        if (!same || !other->shift_within) continue;
        owners.push_back(std::make_unique<Comparer>(study, quantity, run));
        auto pair = owners.back()->shifted_pair(*other);
        if (!pair) continue;
        within = std::min(within, pair->within);
        pairs.push_back(std::move(*pair));
      }
    return best_shift(pairs, within);
  }

  static std::string shift_note(const ReferenceSeries& series, const ReferenceCurve& data,
                                double shift) {
    std::string note = "its times are shifted";
    if (!series.clock.empty()) note += ", like all of its clock " + series.clock;
    if (std::abs(shift) > 0.9995 * data.shift_within) note += ", by as much as is allowed";
    return note;
  }

  [[nodiscard]] double value_in(const std::string& text, const std::string& unit,
                                const char* key) const {
    return evaluate_in(text, unit, symbols_, asked_.place + "." + key);
  }
  [[nodiscard]] std::optional<double> maybe(const std::optional<std::string>& text,
                                            const std::string& unit, const char* key) const {
    return text ? std::optional(value_in(*text, unit, key)) : std::nullopt;
  }
  [[nodiscard]] std::vector<CurveMeasure> measures() const {
    if (quantity_.is_profile()) return {CurveMeasure::rms};
    return asked_.compare;
  }

  /// Where the observable is, for kinds that are at a place.
  [[nodiscard]] std::optional<Vec3> place() const {
    const auto find = [&](const char* key) { return asked_.parameters.find(key); };
    if (const auto name = find("name"); name != asked_.parameters.end()) {
      for (const char* list : {"probes", "gauges"})
        for (const StatedPlace& stated : stated_places(run_.measured->run, list))
          if (stated.name == name->second) return stated.place;
    }
    if (find("x") == asked_.parameters.end()) return std::nullopt;
    Vec3 at{};
    for (std::size_t a = 0; a < 3; ++a)
      if (const auto x = find(std::string(1, "xyz"[a]).c_str()); x != asked_.parameters.end())
        at[a] = value_in(x->second, "m", "parameters");
    return at;
  }

  static std::string gate_note(const ReferenceSeries& series, const Physics& physics) {
    const auto walls = [](const Physics& p) { return p.moving_walls ? p.moving_walls->size() : 0; };
    if (walls(series.of) > 0 && walls(physics) == 0)
      return "the series' case has a wall that is moved away, the run has none";
    return "";
  }

  bool common_window(const Curve& theirs, CurveComparison& out) const {
    if (own_.first.size() < 2 || theirs.first.size() < 2) {
      out.skipped = "no curve of " + (own_.first.size() < 2 ? run_.study.name : out.against);
      return false;
    }
    out.begin = std::max(own_.first.front(), theirs.first.front());
    out.end = std::min(own_.first.back(), theirs.first.back());
    if (stated_) {
      out.begin = std::max(out.begin, (*stated_)[0]);
      out.end = std::min(out.end, (*stated_)[1]);
    }
    if (out.end > out.begin) return true;
    out.skipped = "no time in common with it" + std::string(stated_ ? " in the window" : "");
    return false;
  }

  /// Standard uncertainty of a run's measure by its refinements, all in the same window.
  [[nodiscard]] std::optional<double> uncertainty(const RunResult& run, CurveMeasure measure,
                                                  const CurveComparison& in) const {
    const auto covering = [&](const MeasuredRun& level) -> std::optional<Curve> {
      const Curve curve = curve_of(quantity_, level).curve;
      const double slack = 1e-6 * (in.end - in.begin);
      if (curve.empty() || curve.first.front() > in.begin + slack ||
          curve.first.back() < in.end - slack)
        return std::nullopt;
      return curve;
    };
    if (measure != CurveMeasure::rms)
      return refined(study_, run, [&](const MeasuredRun& level) -> std::optional<double> {
        const auto curve = covering(level);
        return curve ? curve_value(measure, curve->within(in.begin, in.end), options_)
                     : std::nullopt;
      });
    double squares = 0.0;
    const auto moments = followed_moments(in.begin, in.end);
    for (const double at : moments) {
      const auto u = curve_uncertainty(study_, quantity_, run, at);
      if (!u) return std::nullopt;
      squares += *u * *u;
    }
    return std::sqrt(squares / static_cast<double>(moments.size()));
  }

  [[nodiscard]] double frames(const Curve& curve, CurveMeasure measure,
                              const CurveComparison& in) const {
    return sampling_uncertainty(measure, curve.within(in.begin, in.end));
  }

  [[nodiscard]] double tolerance(CurveMeasure measure, const Curve& theirs,
                                 const CurveComparison& in) const {
    const auto stated = asked_.tolerance.find(measure);
    if (stated != asked_.tolerance.end()) {
      // An impulse's unit is a product that no observable has.
      const std::string unit = measure == CurveMeasure::impulse && quantity_.unit != "1"
                                   ? "(" + quantity_.unit + ")*s"
                                   : unit_of(measure, quantity_.unit);
      return value_in(stated->second, unit, "tolerance");
    }
    if (is_time(measure))
      return usual_tolerance * std::sqrt(symbols_.at("L").value / (2.0 * symbols_.at("g").value));
    const Curve cut = theirs.within(in.begin, in.end);
    const auto [least, most] = std::minmax_element(cut.value.begin(), cut.value.end());
    const double range = *most - *least;
    return usual_tolerance * range * (measure == CurveMeasure::impulse ? in.end - in.begin : 1.0);
  }

  [[nodiscard]] std::string missing(const Uncertainties& parts) const {
    if (run_.status != RunStatus::complete) return run_.study.name + " is not complete";
    if (!parts.reference) return why_no_uncertainty(study_, study_.reference());
    if (!parts.run) return why_no_uncertainty(study_, run_);
    return "";
  }

  /// Run minus reference in a window, and what it is made of; empty, with the reason, where one of
  /// them has no such measure.
  std::optional<double> difference(CurveMeasure measure, const Curve& theirs, bool points,
                                   const CurveComparison& in, Comparison& out) const {
    const Curve x = own_.within(in.begin, in.end), y = theirs.within(in.begin, in.end);
    if (measure == CurveMeasure::rms) return root_mean_square(x, y, points, out);
    out.run = curve_value(measure, x, options_);
    out.reference = curve_value(measure, y, options_);
    if (!out.run || !out.reference) {
      out.why = (out.run ? in.against : run_.study.name) + " has none in the window";
      return std::nullopt;
    }
    const double plain = *out.run - *out.reference;
    return measure == CurveMeasure::phase ? std::remainder(plain, *options_.period) : plain;
  }

  [[nodiscard]] std::optional<double> unshifted(CurveMeasure measure,
                                                const Curve& published) const {
    CurveComparison window;
    Comparison ignored;
    if (!common_window(published, window)) return std::nullopt;
    return difference(measure, published, true, window, ignored);
  }

  Comparison measured(CurveMeasure measure, const Curve& theirs, const Uncertainties& parts,
                      const CurveComparison& in, const ReferenceSeries* series) const {
    Comparison out;
    out.measure = measure;
    out.unit = unit_of(measure, quantity_.unit);
    const auto found = difference(measure, theirs, series != nullptr, in, out);
    if (!found) return out;
    Verdict verdict;
    verdict.run = run_.study.name;
    verdict.quantity = quantity_.key;
    verdict.against = in.against;
    verdict.difference = *found;
    verdict.tolerance = tolerance(measure, theirs, in);
    verdict.parts = parts;
    verdict.settle(series != nullptr && series->kind == ReferenceKind::computation
                       ? "a computation that states no uncertainty"
                       : missing(parts));
    out.verdict = verdict;
    return out;
  }

  /// At the points of a series, over time of a run.
  static std::optional<double> root_mean_square(const Curve& x, const Curve& y, bool points,
                                                Comparison& out) {
    const auto keep = [&](const auto& found) {
      out.maximum = found.maximum;
      out.bias = found.bias;
      return std::optional(found.rms);
    };
    if (!points) {
      if (const auto found = curve_difference(x, y)) return keep(*found);
    } else if (const auto found = point_difference(x, y)) {
      out.points = found->points;
      return keep(*found);
    }
    out.why = "fewer than two points in common";
    return std::nullopt;
  }

  const StudyResult& study_;
  const ObservedQuantity& quantity_;
  const StudyObservable& asked_;
  const RunResult& run_;
  Symbols symbols_;
  Curve own_;
  CurveOptions options_;
  std::optional<std::array<double, 2>> stated_;
};

}  // namespace

std::optional<double> curve_uncertainty(const StudyResult& study, const ObservedQuantity& quantity,
                                        const RunResult& run, double at) {
  return refined(study, run,
                 [&](const MeasuredRun& level) { return curve_of(quantity, level).curve.at(at); });
}

std::vector<CurveComparison> compare_curve(const StudyResult& study,
                                           const ObservedQuantity& quantity, const RunResult& run) {
  const Comparer comparer(study, quantity, run);
  std::vector<CurveComparison> all;
  if (&run != &study.reference()) all.push_back(comparer.against_run(study.reference()));
  for (const ReferenceSeries* series : series_of(study, quantity))
    all.push_back(comparer.against_series(*series));
  return all;
}

}  // namespace surge::compare
