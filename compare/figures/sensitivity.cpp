#include <algorithm>
#include <cmath>

#include "compare/figures/axis_range.hpp"
#include "compare/figures/method.hpp"
#include "compare/figures/style.hpp"
#include "compare/study/sensitivity.hpp"
#include "particle/support/json.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

/// A row per run, the base on top; rows of one choice stand together, with a gap below each.
Table table_of(const std::string& name, const json& method) {
  Table table{name,
              {"row", "choice", "value", "rms", "bias", "max", "rms_vs_base", "cost_over_base",
               "window_end_T", "run"},
              {}};
  double y = 0.0;
  std::string last = "base";
  const auto add = [&](const json& run, const std::string& choice, const std::string& value) {
    if (choice != last) y -= 0.5;
    last = choice;
    table.add({y, choice, value, json_or_gap(run["rms"]), json_or_gap(run["bias"]),
               json_or_gap(run["max"]), json_or_gap(run["rms_vs_base"]),
               json_or_gap(run["cost_ratio"]), json_or_gap(run["window_end_T"]),
               run["run"].get<std::string>()});
    y -= 1.0;
  };
  add(method["base"], "base", "");
  for (const json& run : method["runs"])
    add(run, run["choice"].get<std::string>(), run["value"].get<std::string>());
  return table;
}

/// Labels of the rows: the choice where it begins, and the value.
std::string row_labels(const Table& table) {
  std::string tics, last;
  for (const auto& row : table.rows) {
    const std::string& choice = std::get<std::string>(row[1]);
    const std::string& value = std::get<std::string>(row[2]);
    std::string label = choice == last ? value : choice + (value.empty() ? "" : "  " + value);
    last = choice;
    tics += (tics.empty() ? "" : ", ") + plot_string(label) + " " +
            fixed_text(std::get<double>(row[0]), 1);
  }
  return "set ytics (" + tics + ") scale 0 noenhanced\n";
}

/// A vertical line at the base's value.
std::string base_line(int tag, double x) {
  if (!std::isfinite(x)) return "";
  return "set arrow " + std::to_string(tag) + " from " + plot_number(x) + ", graph 0 to " +
         plot_number(x) + ", graph 1 nohead lw 0.8 dt '-' lc rgb \"#909090\" back\n";
}

/// Half the width of the left panel. A run that broke up may be anywhere: what lies beyond stands
/// at the edge, so that the others can still be told apart.
double half_width(const Table& table) {
  double widest = 0.01;
  for (const auto& row : table.rows) {
    for (const std::size_t column : {3U, 4U}) {
      const double x = std::abs(std::get<double>(row[column]));
      if (std::isfinite(x)) widest = std::max(widest, 1.1 * x);
    }
  }
  return std::min(widest, 0.09);
}

/// Three to five tics from -limit to limit.
std::string tics(double limit) {
  double step = 0.005;
  for (const double next : {0.01, 0.02, 0.05})
    if (limit / step > 2.5) step = next;
  return "set xrange [-" + fixed_text(limit, 4) + ":" + fixed_text(limit, 4) + "]\nset xtics " +
         fixed_text(step, 3) + " font \",7.2\"\n";
}

std::string dots(const Table& table, const std::string& x, const LineStyle& style, int point) {
  return "\"" + table.name + ".csv\" using (" + x + "):(column(\"row\")) with points pt " +
         std::to_string(point) + " ps 0.5 lw 0.9 lc rgb \"" + style.colour.hex() + "\"";
}

std::string front_panel(const Table& table) {
  const double limit = half_width(table);
  const auto base = [&](std::size_t column) { return std::get<double>(table.rows[0][column]); };
  const auto within = [&](const std::string& name) {
    const std::string edge = plot_number(limit), x = "column(\"" + name + "\")";
    return x + " > " + edge + " ? " + edge + " : " + x + " < -" + edge + " ? -" + edge + " : " + x;
  };
  return row_labels(table) + tics(limit) + base_line(1, base(3)) + base_line(2, base(4)) +
         "set xlabel \"Δ{/:Italic Z}/{/:Italic L}\" offset 0,0.4\nplot " +
         dots(table, within("rms"), run_style(0), 7) + " title \"RMS\", \\\n     " +
         dots(table, within("bias"), run_style(1), 12) + " title \"bias\"\nunset arrow\n";
}

std::string cost_panel(const Table& table) {
  return "unset ytics\nset key off\nset logscale x\n" + axis_range("x", table, {7}) +
         "set xtics autofreq\nset xlabel \"cost / base\" offset 0,0.4\n" +
         base_line(1, std::get<double>(table.rows[0][7])) + "plot " +
         dots(table, "column(\"cost_over_base\")", run_style(2), 5) + " notitle\n";
}

Figure sensitivity_figure(const StudyResult& study, const std::string& method,
                          const std::string& title) {
  json metrics;
  measure_sensitivity(study, metrics);
  Figure figure;
  figure.name = "sensitivity_" + method;
  figure.title = "Sensitivity of " + title + " to its choices";
  const json& all = metrics["sensitivity"];
  if (!all.contains(method)) {
    return empty_figure(figure.name, figure.title,
                        "This study has no runs for it; the full study has.");
  }
  figure.tables.push_back(table_of(figure.name, all[method]));
  const Table& table = figure.tables.back();
  const double lowest = std::get<double>(table.rows.back()[0]) - 0.8;
  figure.height_mm = 20.0 - 3.3 * lowest;
  figure.caption =
      "Leading edge against the reference before it comes near the far wall, when one choice is "
      "made otherwise: root mean square (filled circles) and bias (open diamonds) of the "
      "difference in Z/L, and CPU time per simulated second over that of the base. Dashed: the "
      "base. What lies beyond the frame stands at its edge, and a run that broke up early is "
      "measured as far as it goes; the table has the numbers.";
  const auto screen = [&](double mm) { return fixed_text(1.0 - mm / figure.height_mm, 4); };
  figure.script = "set multiplot\nset yrange [" + fixed_text(lowest, 1) +
                  ":0.8]\nset tmargin at screen " + screen(6.5) + "\nset bmargin at screen " +
                  screen(figure.height_mm - 9.5) + "\nset key at screen 0.48," + screen(1.0) +
                  " left top horizontal maxrows 1 samplen 0.8 width -1\n" +
                  "set lmargin at screen 0.48\nset rmargin at screen 0.77\n" + front_panel(table) +
                  "set lmargin at screen 0.81\nset rmargin at screen 0.97\n" + cost_panel(table) +
                  "unset multiplot\n";
  return figure;
}

}  // namespace

Figure mps_sensitivity_figure(const StudyResult& study) {
  return sensitivity_figure(study, "mps", "MPS");
}

Figure sph_sensitivity_figure(const StudyResult& study) {
  return sensitivity_figure(study, "sph", "SPH");
}

Figure vof_sensitivity_figure(const StudyResult& study) {
  return sensitivity_figure(study, "vof", "VOF");
}

}  // namespace surge::compare
