#include <algorithm>
#include <cmath>

#include "compare/figures/axis_range.hpp"
#include "compare/figures/figures.hpp"
#include "compare/figures/style.hpp"
#include "compare/study/levels.hpp"

namespace surge::compare {

namespace {

/// The level whose curve is drawn: the one that the flow's bar is at, or the middle one.
const FlowResult& drawn_level(const KnownFlow& known, const FlowLevels& sequence) {
  for (const auto& level : sequence.levels) {
    if (std::abs(level.result->flow.per_length() - known.bar_per_length) < 1e-6)
      return *level.result;
  }
  return *sequence.levels[sequence.levels.size() / 2].result;
}

std::vector<FlowCurve::Point> by_x(std::vector<FlowCurve::Point> points) {
  std::stable_sort(points.begin(), points.end(),
                   [](const auto& a, const auto& b) { return a.x < b.x; });
  return points;
}

Table curve_table(const std::string& name, const KnownFlow& known,
                  const std::vector<FlowLevels>& sequences) {
  Table table{name, {"preset", "curve", "x", "measured", "exact"}, {}};
  for (const FlowLevels& sequence : sequences) {
    for (const FlowCurve& curve : drawn_level(known, sequence).curves) {
      for (const auto& point : by_x(curve.points))
        table.add({sequence.label, curve.name, point.x, point.measured, point.exact});
    }
  }
  return table;
}

Table error_table(const std::string& name, const std::vector<FlowLevels>& sequences) {
  Table table{name, {"preset", "particles_over_L", "error"}, {}};
  for (const FlowLevels& sequence : sequences) {
    for (const auto& level : sequence.levels)
      table.add({sequence.label, level.result->flow.per_length(), level.result->error});
  }
  return table;
}

std::string rows(const std::string& file, const std::string& preset, const std::string& curve,
                 const std::string& y) {
  return "\"" + file + ".csv\" using (strcol(1) eq " + plot_string(preset) + " && strcol(2) eq " +
         plot_string(curve) + " ? column(\"x\") : NaN):(column(\"" + y + "\"))";
}

std::string curve_panel(const std::string& file, const KnownFlow& known,
                        const std::vector<FlowLevels>& sequences) {
  std::string plots;
  const auto add = [&](const std::string& plot) {
    plots += (plots.empty() ? "" : ", \\\n     ") + plot;
  };
  for (std::size_t i = 0; i < sequences.size(); ++i) {
    bool titled = false;
    for (const FlowCurve& curve : drawn_level(known, sequences[i]).curves) {
      const LineStyle style = run_style(i);
      const std::string look = known.points ? "with points " + point_spec(style, 0.25)
                                            : "with lines " + line_spec(style, 1.2);
      add(rows(file, sequences[i].label, curve.name, "measured") + " " + look +
          (titled ? " notitle" : " title " + plot_string(sequences[i].label)));
      titled = true;
    }
  }
  bool titled = false;
  for (const FlowCurve& curve : drawn_level(known, sequences.front()).curves) {
    add(rows(file, sequences.front().label, curve.name, "exact") + " with lines " +
        line_spec(reference_style(), 1.0) + (titled ? " notitle" : " title \"exact\""));
    titled = true;
  }
  return "plot " + plots + "\n";
}

std::string error_panel(const std::string& file, const std::vector<FlowLevels>& sequences) {
  std::string plots;
  for (std::size_t i = 0; i < sequences.size(); ++i) {
    const LineStyle style = run_style(i);
    plots += (i == 0 ? "" : ", \\\n     ") + std::string("\"") + file +
             ".csv\" using (strcol(1) eq " + plot_string(sequences[i].label) +
             " ? column(\"particles_over_L\") : NaN):(column(\"error\")) with linespoints " +
             line_spec(style, 1.2) + " pt " + std::to_string(style.point) + " ps 0.4 notitle";
  }
  return "plot " + plots + "\n";
}

Figure flow_figure(const KnownFlow& known, const std::vector<FlowLevels>& sequences) {
  Figure figure;
  figure.name = "verification_" + known.group;
  figure.title = known.title;
  figure.width_mm = double_column_mm;
  figure.height_mm = 85.0;
  const std::string errors = figure.name + "_error";
  figure.tables = {curve_table(figure.name, known, sequences), error_table(errors, sequences)};
  const double shown = drawn_level(known, sequences.front()).flow.per_length();
  figure.caption = "Left: at " + fixed_text(shown, 0) + " particles over L. Right: " + known.error +
                   ", over the number of particles over L.";
  figure.script =
      "set multiplot layout 1,2\nset key above left Left reverse maxcols 3\nset xlabel " +
      plot_label(known.x_axis) + "\nset ylabel " + plot_label(known.y_axis) + "\n" +
      axis_range("y", figure.tables[0], {3, 4}) + curve_panel(figure.name, known, sequences) +
      "set logscale xy\nset xtics (10, 20, 40, 60, 80)\nset format y \"10^{%T}\"\n"
      "set xrange [8:100]\n" +
      axis_range("y", figure.tables[1], {2}) +
      "set xlabel \"particles over L\"\n"
      "set ylabel \"error\"\n" +
      error_panel(errors, sequences) + "unset multiplot\n";
  return figure;
}

}  // namespace

std::vector<Figure> verification_figures(const StudyResult& study) {
  std::vector<Figure> figures;
  for (const KnownFlow& known : known_flows()) {
    const auto sequences = levels_of(study, known.group);
    if (!sequences.empty()) figures.push_back(flow_figure(known, sequences));
  }
  return figures;
}

}  // namespace surge::compare
