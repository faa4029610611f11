#include <algorithm>
#include <cmath>

#include "compare/study/sequences.hpp"
#include "particle/support/table.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

/// Standard numerical uncertainty of a quantity of a sequence's finest level; empty where there
/// were not three levels.
std::optional<double> numerical(const json& metrics, const std::string& group,
                                const std::string& quantity) {
  for (const json& sequence : metrics["convergence"]["sequences"]) {
    if (sequence["group"] != group || !sequence["quantities"].contains(quantity)) continue;
    const json& result = sequence["quantities"][quantity]["result"];
    if (!result.is_null()) return result["uncertainty"].get<double>() / numerical_coverage;
  }
  return std::nullopt;
}

std::string at_name(double t) {
  return "Z_over_L_at_T_" + fixed_text(t, 2);
}

/// Root of the mean square of the uncertainties at the followed times: that of an RMS over them, if
/// the errors went together.
std::optional<double> numerical_rms(const json& metrics, const std::string& group) {
  double squares = 0.0;
  for (const double t : convergence_times) {
    const auto u = numerical(metrics, group, at_name(t));
    if (!u) return std::nullopt;
    squares += *u * *u;
  }
  return std::sqrt(squares / static_cast<double>(convergence_times.size()));
}

/// E with u_val and the interval that it has to leave to be a difference.
json difference_json(double e, const std::optional<double>& u_num,
                     const std::optional<double>& u_d) {
  json out{{"E", e}, {"u_num", nullptr}, {"u_D", nullptr}, {"U", nullptr}, {"beyond", nullptr}};
  if (u_num) out["u_num"] = *u_num;
  if (u_d) out["u_D"] = *u_d;
  if (!u_num || !u_d) return out;
  const double interval = coverage * std::hypot(*u_num, *u_d);
  out["U"] = interval;
  out["beyond"] = std::abs(e) > interval;
  return out;
}

json against_vof(const StudyResult& study, const Sequence& sequence, const Sequence& vof,
                 const json& metrics) {
  const MeasuredRun& run = sequence.finest();
  const MeasuredRun& reference = vof.finest();
  json out{{"label", sequence.levels.front().run->label()}, {"rows", json::array()}};
  for (const double t : convergence_times) {
    const auto s = run.front.at(DimensionlessTime(t));
    const auto d = reference.front.at(DimensionlessTime(t));
    if (!s || !d) continue;
    json row = difference_json((*s - *d).value(), numerical(metrics, sequence.group, at_name(t)),
                               numerical(metrics, vof.group, at_name(t)));
    row["T"] = t;
    row["time_s"] = run.run.physics.scales().dimensional(DimensionlessTime(t)).value();
    row["S"] = s->value();
    row["D"] = d->value();
    out["rows"].push_back(std::move(row));
  }
  out["rms"] =
      difference_json(difference(run.front, reference.front, study.wall()).rms,
                      numerical(metrics, sequence.group, "rms"), numerical_rms(metrics, vof.group));
  return out;
}

/// dZ/dT of a front, over the width of a tenth.
double slope_at(const DimensionlessFront& front, DimensionlessTime t) {
  const DimensionlessTime half(0.05);
  const auto before = front.at(t - half), after = front.at(t + half);
  return before && after ? (*after - *before).value() / (2.0 * half.value()) : 0.0;
}

}  // namespace

double published_uncertainty(const PublishedSeries& series, const DimensionlessFront& front,
                             DimensionlessTime t) {
  return std::hypot(series.position_uncertainty.value(),
                    slope_at(front, t) * series.time_uncertainty.value()) /
         coverage;
}

double published_uncertainty_rms(const PublishedSeries& series, const DimensionlessFront& front,
                                 DimensionlessTime shift) {
  double squares = 0.0, n = 0.0;
  for (const auto& sample : series.front.samples) {
    if (!front.at(sample.time + shift)) continue;
    const double u = published_uncertainty(series, front, sample.time + shift);
    squares += u * u;
    n += 1.0;
  }
  return n > 0.0 ? std::sqrt(squares / n) : 0.0;
}

namespace {

json against_experiment(const StudyResult& study, const PublishedSeries& series,
                        const Sequence& vof, const json& metrics) {
  const DimensionlessFront& front = vof.finest().front;
  const SeriesComparison fit = against_series(front, series, study.wall());
  json out{{"label", series.label}, {"shift_T", fit.shift.value()}, {"rows", json::array()}};
  const auto u_rms = numerical_rms(metrics, vof.group);
  out["rms"]["raw"] = difference_json(
      fit.raw.rms, u_rms, published_uncertainty_rms(series, front, DimensionlessTime(0.0)));
  out["rms"]["shifted"] =
      difference_json(fit.shifted.rms, u_rms, published_uncertainty_rms(series, front, fit.shift));
  for (const double t : convergence_times) {
    const DimensionlessTime time(t);
    const auto s = front.at(time);
    if (!s) continue;
    json row{{"T", t},
             {"time_s", vof.finest().run.physics.scales().dimensional(time).value()},
             {"S", s->value()},
             {"raw", nullptr},
             {"shifted", nullptr}};
    const auto u_num = numerical(metrics, vof.group, at_name(t));
    const auto add = [&](const char* name, DimensionlessTime shift) {
      const auto d = series.front.at(time - shift);
      if (!d) return;
      row[name] =
          difference_json((*s - *d).value(), u_num, published_uncertainty(series, front, time));
      row[name]["D"] = d->value();
    };
    add("raw", DimensionlessTime(0.0));
    add("shifted", fit.shift);
    out["rows"].push_back(std::move(row));
  }
  return out;
}

}  // namespace

void measure_differences(const StudyResult& study, const std::vector<Sequence>& sequences,
                         json& metrics) {
  json& out = metrics["uncertainty"];
  out = {{"numerical_coverage", numerical_coverage},
         {"coverage", coverage},
         {"u_input", 0.0},
         {"against_vof", json::array()},
         {"experiments", json::array()}};
  const RunResult* finest = finest_vof_run(sequences);
  if (finest == nullptr) return;
  const Sequence& vof = *std::find_if(sequences.begin(), sequences.end(), [&](const auto& s) {
    return s.over_spacing && s.levels.front().run == finest;
  });
  for (const Sequence& sequence : sequences) {
    if (sequence.over_spacing && &sequence != &vof)
      out["against_vof"].push_back(against_vof(study, sequence, vof, metrics));
  }
  for (const PublishedSeries& series : study.published) {
    // A series of another case says nothing about VOF, as metrics.json tells.
    if (series.experiment && !other_case(series, vof.finest().run.physics))
      out["experiments"].push_back(against_experiment(study, series, vof, metrics));
  }
}

}  // namespace surge::compare
