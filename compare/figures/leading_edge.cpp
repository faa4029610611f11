#include <algorithm>
#include <cmath>

#include "compare/figures/figures.hpp"
#include "compare/figures/style.hpp"
#include "compare/study/sequences.hpp"
#include "compare/study/verdict.hpp"

namespace surge::compare {

namespace {

/// Of the differences: what the runs that agree stay within, so that their differences can be seen.
constexpr double near_limit = 0.06;
constexpr double reference_width = 0.8, run_width = 1.3;

struct FrontCurve {
  const RunResult* run;
  LineStyle style;
  std::string label;  ///< in the legend

  [[nodiscard]] const std::string& key() const { return run->study.name; }  ///< in the CSV files
};

std::vector<FrontCurve> curves_of(const StudyResult& study) {
  std::vector<FrontCurve> curves;
  std::size_t index = 0;
  for (const RunResult* run : study.measured()) {
    const bool reference = run == &study.reference();
    const LineStyle style = reference ? reference_style() : run_style(index);
    if (!reference) ++index;
    std::string label = run->label();
    if (!run->note.empty()) label += " (" + run->note + ")";
    curves.push_back({run, style, label});
  }
  return curves;
}

/// `"file.csv" using x:y` of the rows of one series; NaN where it has none.
std::string filtered(const Table& table, const std::string& key, const std::string& columns) {
  const std::string rows = plotted_rows(table, {key});
  return rows.empty() ? "NaN" : rows + " using " + columns;
}

/// Shift in time per published series; none where it is shown as measured.
std::vector<double> shifts_of(const StudyResult& study, bool shifted) {
  std::vector<double> shifts;
  for (const auto& series : study.published) {
    shifts.push_back(
        shifted ? against_series(study.reference_run().front, series, study.wall()).shift.value()
                : 0.0);
  }
  return shifts;
}

std::string series_label(const PublishedSeries& series, double shift) {
  if (shift == 0.0) return series.label;
  const std::string sign = shift < 0.0 ? "−" : "+";
  return series.label + ", T " + sign + " " + fixed_text(std::abs(shift), 2);
}

Table front_table(const std::string& name, const StudyResult& study,
                  const std::vector<FrontCurve>& curves, const std::vector<double>& shifts) {
  Table table{name, {"series", "kind", "time_s", "T", "Z_over_L", "dT", "dZ"}, {}};
  for (const auto& curve : curves) {
    const MeasuredRun& measured = *curve.run->measured;
    for (std::size_t i = 0; i < measured.front.samples.size(); ++i) {
      const auto& sample = measured.front.samples[i];
      table.add({curve.key(), "computed", measured.history[i].time.value(), sample.time.value(),
                 sample.position.value(), 0.0, 0.0});
    }
  }
  const Scales scales = study.reference_run().run.physics.scales();
  for (std::size_t i = 0; i < study.published.size(); ++i) {
    const auto& series = study.published[i];
    for (const auto& sample : series.front.samples) {
      const DimensionlessTime time = sample.time + DimensionlessTime(shifts[i]);
      table.add({series.name, "published", scales.dimensional(time).value(), time.value(),
                 sample.position.value(), series.time_uncertainty.value(),
                 series.position_uncertainty.value()});
    }
  }
  return table;
}

/// Z/L of each run minus the reference's at the run's own times, inside the common window.
Table difference_table(const std::string& name, const StudyResult& study,
                       const std::vector<FrontCurve>& curves) {
  Table table{name, {"series", "T", "dZ_over_L"}, {}};
  const DimensionlessFront& reference = study.reference_run().front;
  for (const auto& curve : curves) {
    if (curve.run == &study.reference()) continue;
    const DimensionlessFront& front = curve.run->measured->front;
    const Window window = common_window(front, reference, study.wall());
    for (const auto& sample : front.samples) {
      if (sample.time < window.begin || sample.time > window.end) continue;
      const auto other = reference.at(sample.time);
      if (other) {
        table.add({curve.key(), sample.time.value(), (sample.position - *other).value()});
      }
    }
  }
  return table;
}

std::string window_mark(const StudyResult& study, const std::string& lower,
                        const std::string& upper) {
  const auto end = window_end(study);
  if (!end) return "";
  const std::string t = fixed_text(end->value(), 4);
  return "set arrow 1 from " + t + "," + lower + " to " + t + "," + upper +
         " nohead lw 0.8 dt '_' lc rgb \"#808080\"\n";
}

struct Axes {
  double t_end, z_end;
};

/// The axes end a little after the fronts are at the far wall; without a wall, where the data end.
Axes axes_of(const StudyResult& study) {
  Axes axes{0.0, 0.0};
  const auto wall = study.wall().far_wall;
  for (const RunResult* run : study.measured()) {
    const auto& samples = run->measured->front.samples;
    const auto arrival = wall ? run->measured->front.arrival(*study.wall().limit()) : std::nullopt;
    axes.t_end = std::max(axes.t_end, arrival ? arrival->value() : samples.back().time.value());
    for (const auto& s : samples) axes.z_end = std::max(axes.z_end, s.position.value());
  }
  if (wall) {
    // A run that never gets there must not stretch the axis over the whole run.
    const auto end = window_end(study);
    if (end) axes.t_end = std::min(axes.t_end, end->value() + 1.5);
    axes.z_end = wall->value();
  }
  return {std::ceil(2.0 * (axes.t_end + 0.1)) / 2.0, axes.z_end + 0.15};
}

std::string one_plot(const std::vector<std::string>& plots) {
  std::string text = "plot ";
  for (std::size_t i = 0; i < plots.size(); ++i) text += (i ? ", \\\n     " : "") + plots[i];
  return text + "\n";
}

/// The reference's front with its 95 % interval; no rows where refining it does not say one.
Table band_table(const std::string& name, const StudyResult& study) {
  Table table{name + "_band", {"T", "low", "high"}, {}};
  const auto u = front_uncertainty(study, study.reference());
  if (!u) return table;
  for (const auto& sample : study.reference_run().front.samples)
    table.add({sample.time.value(), sample.position.value() - coverage * *u,
               sample.position.value() + coverage * *u});
  return table;
}

constexpr const char* band_style = "fs transparent solid 0.25 noborder fc rgb \"#707070\"";

/// The reference with its band and the published series first, so that the runs lie over them.
std::string plots_of(const Table& fronts, const StudyResult& study,
                     const std::vector<FrontCurve>& curves, const std::vector<double>& shifts) {
  std::vector<std::string> plots;
  if (front_uncertainty(study, study.reference()))
    plots.push_back("\"" + fronts.name + "_band.csv\" using 1:2:3 with filledcurves " + band_style +
                    " title \"95 % interval of the reference\"");
  const auto add_curve = [&](const FrontCurve& curve, double width) {
    plots.push_back(filtered(fronts, curve.key(), "4:5") + " with lines " +
                    line_spec(curve.style, width) + " title " + plot_string(curve.label));
  };
  for (const auto& curve : curves)
    if (curve.run == &study.reference()) add_curve(curve, reference_width);
  for (std::size_t i = 0; i < study.published.size(); ++i) {
    const PublishedSeries& series = study.published[i];
    const bool bars = series.position_uncertainty.value() > 0.0;
    plots.push_back(
        filtered(fronts, series.name, bars ? "4:5:6:7 with xyerrorbars " : "4:5 with points ") +
        point_spec(published_style(i), 0.45) + " title " +
        plot_string(series_label(series, shifts[i])));
  }
  for (const auto& curve : curves)
    if (curve.run != &study.reference()) add_curve(curve, run_width);
  return one_plot(plots);
}

std::string upper_panel(const Table& fronts, const StudyResult& study,
                        const std::vector<FrontCurve>& curves, const std::vector<double>& shifts) {
  const Axes axes = axes_of(study);
  std::string script = "set xrange [0:" + fixed_text(axes.t_end, 2) +
                       "]\nset yrange [0.9:" + fixed_text(axes.z_end, 3) +
                       "]\nset ytics 0.5\nset xtics 0.5\n" +
                       window_mark(study, "graph 0", "graph 1");
  if (const auto end = window_end(study)) {
    script += "set label 1 \"end of window\" at " + fixed_text(end->value(), 4) +
              ", graph 0.02 rotate by 90 offset character -0.6,0 font \",5.6\" "
              "textcolor rgb \"#606060\"\n";
  }
  return script + "set format x \"\"\nset ylabel \"{/:Italic Z}/{/:Italic L}\" offset 1.2\n" +
         plots_of(fronts, study, curves, shifts) + "unset label 1\n";
}

/// 1, 2 or 5 times a power of ten, of which two to four make up `limit`.
double tic_step(double limit) {
  const double power = std::pow(10.0, std::floor(std::log10(limit / 2.0)));
  double step = power;
  for (const double factor : {2.0, 5.0})
    if (factor * power <= limit / 2.0) step = factor * power;
  return step;
}

/// The largest difference of a run; zero where it has none.
double farthest(const Table& differences, const FrontCurve& curve) {
  double most = 0.0;
  for (const auto& row : differences.rows)
    if (std::get<std::string>(row[0]) == curve.key())
      most = std::max(most, std::abs(std::get<double>(row[2])));
  return most;
}

/// Differences up to a limit, of these runs.
std::string difference_panel(const Table& differences, const StudyResult& study,
                             const std::vector<FrontCurve>& curves, double limit, bool last) {
  std::string script = "unset object\n" + window_mark(study, "graph 0", "graph 1");
  const auto u = front_uncertainty(study, study.reference());
  if (u) {
    const std::string half = plot_number(std::min(coverage * *u, limit));
    script += "set object 1 rectangle from graph 0, first -" + half + " to graph 1, first " + half +
              " behind " + band_style + "\n";
  }
  script += std::string(last ? "set format x \"%g\"\nset xlabel \"{/:Italic T} = {/:Italic t} "
                               "√(2{/:Italic g}/{/:Italic L})\" offset 0,0.4\n"
                             : "set format x \"\"\nunset xlabel\n") +
            "set yrange [-" + fixed_text(limit, 3) + ":" + fixed_text(limit, 3) + "]\nset ytics " +
            fixed_text(tic_step(limit), 6) +
            "\nset key off\nset ylabel \"Δ{/:Italic Z}/{/:Italic L}\" offset 1.2\n";
  std::vector<std::string> plots{"0 " + line_spec(reference_style(), reference_width)};
  for (const auto& curve : curves)
    plots.push_back(filtered(differences, curve.key(), "2:3") + " with lines " +
                    line_spec(curve.style, run_width));
  return script + one_plot(plots);
}

/// Panels from the top, in mm, and the legend under them with a line per curve.
std::string panel_margins(double top, double bottom, double height) {
  return "set tmargin at screen " + fixed_text(1.0 - top / height, 4) + "\nset bmargin at screen " +
         fixed_text(1.0 - bottom / height, 4) + "\n";
}

/// For a closer look: the published series as they are shown, and the runs.
void add_plotted(Figure& figure, const StudyResult& study, const std::vector<FrontCurve>& curves,
                 const std::vector<double>& shifts) {
  for (const auto& curve : curves)
    figure.curves.push_back(
        {figure.name, curve.key(), "T", "Z_over_L", curve.label, curve.style.colour.hex()});
  for (std::size_t i = 0; i < study.published.size(); ++i)
    figure.curves.push_back({figure.name, study.published[i].name, "T", "Z_over_L",
                             series_label(study.published[i], shifts[i]),
                             published_style(i).colour.hex(), true});
  figure.x_label = "T = t √(2g/L)";
  figure.y_label = "Z/L";
}

Figure make(const StudyResult& study, const std::string& name, bool shifted) {
  const auto curves = curves_of(study);
  const auto shifts = shifts_of(study, shifted);
  Figure figure;
  figure.name = name;
  figure.tables.push_back(front_table(name, study, curves, shifts));
  figure.tables.push_back(difference_table(name + "_difference", study, curves));
  const Table fronts = figure.tables.front(), differences = figure.tables.back();
  Table band = band_table(name, study);
  const bool has_band = !band.rows.empty();
  if (has_band) figure.tables.push_back(std::move(band));
  // Those that leave the panel of small differences have one of their own.
  std::vector<FrontCurve> others, far;
  double limit = near_limit;
  for (const FrontCurve& curve : curves) {
    if (curve.run == &study.reference()) continue;
    others.push_back(curve);
    const double most = farthest(differences, curve);
    if (most > near_limit) far.push_back(curve);
    limit = std::max(limit, 1.1 * most);
  }
  const double end = far.empty() ? 84.0 : 108.0;
  const std::size_t lines = curves.size() + study.published.size() + (has_band ? 1 : 0);
  figure.height_mm = end + 12.5 + 3.9 * static_cast<double>(lines);
  const std::string legend = fixed_text(1.0 - (end + 10.5) / figure.height_mm, 4);
  figure.script =
      "set multiplot\nset lmargin at screen 0.175\nset rmargin at screen 0.97\n"
      "set key at screen 0.05," +
      legend + " left top vertical maxcols 1 Left reverse\n" +
      panel_margins(2.0, 56.0, figure.height_mm) + upper_panel(fronts, study, curves, shifts) +
      panel_margins(59.0, 84.0, figure.height_mm) +
      difference_panel(differences, study, others, near_limit, far.empty());
  if (!far.empty())
    figure.script += panel_margins(87.0, 108.0, figure.height_mm) +
                     difference_panel(differences, study, far, limit, true);
  figure.script += "unset multiplot\n";
  add_plotted(figure, study, curves, shifts);
  return figure;
}

/// What the panels below show.
std::string caption_of_differences(const StudyResult& study) {
  std::string text = " Below: difference to the reference " + study.reference().label() +
                     ", inside the window that both runs share before the far wall; runs that "
                     "differ by more than " +
                     fixed_text(near_limit, 2) + " have a panel of their own.";
  if (front_uncertainty(study, study.reference()))
    text += " Grey band: 95 % interval of the reference, from its refinement.";
  return text;
}

}  // namespace

Figure leading_edge_figure(const StudyResult& study) {
  Figure figure = make(study, "fig8", false);
  figure.title = "Fig. 8. Motion of the leading edge";
  figure.caption =
      "Leading edge Z/L over T. Lines: computed; markers: published series as printed, with the "
      "uncertainty of the experiments as bars." +
      caption_of_differences(study);
  return figure;
}

Figure shifted_leading_edge_figure(const StudyResult& study) {
  Figure figure = make(study, "fig8_shifted", true);
  figure.title = "Fig. 8, with the published series shifted in time";
  figure.caption =
      "As before, but each published series is moved by one constant time, stated in the legend, "
      "that fits it best to the reference " +
      study.reference().label() +
      ". The gate of the experiments takes time to leave; a computation has none.";
  return figure;
}

}  // namespace surge::compare
