#include <algorithm>
#include <cmath>

#include "compare/figures/figures.hpp"
#include "compare/figures/style.hpp"
#include "compare/study/wall_pressures.hpp"

namespace surge::compare {

namespace {

constexpr double before_impact = 0.25;  ///< of T, shown before the impact
constexpr double pressure_panel_mm = 34.0;

/// What a sensor would have written around the impact, a row per sampling interval.
void add_rows(Table& table, const WallPressureResult& result) {
  const Physics& physics = result.run->measured->run.physics;
  const Scales scales = physics.scales();
  const double scale = pressure_scale(physics).value_or(1.0);
  const double hit = result.impact->value(), d = sensor_interval.value();
  const double before = scales.dimensional(DimensionlessTime(before_impact)).value();
  const double after = scales.dimensional(impact_duration).value();
  for (long k = -std::lround(before / d); k <= std::lround(after / d); ++k) {
    const double t = hit + static_cast<double>(k) * d;
    if (!result.signal->covers(t - 0.5 * d, t + 0.5 * d)) continue;
    table.add({result.run->study.name, t, scales.dimensionless(Seconds(t - hit)).value(),
               result.signal->mean(t, d) / scale});
  }
}

std::string pressure_rows(const Table& table, const RunResult& run) {
  return plotted_rows(table, {run.study.name}) + " using 3:4 with lines ";
}

/// The same for all panels, by the reference: what a noisy run has beyond it would leave nothing
/// else to see.
double upper_end(const Table& table, const std::string& reference) {
  double largest = 0.5;
  for (const auto& row : table.rows) {
    if (std::get<std::string>(row[0]) == reference)
      largest = std::max(largest, std::get<double>(row[3]));
  }
  return std::ceil(2.5 * largest);
}

}  // namespace

std::vector<Figure> wall_pressure_figures(const StudyResult& study) {
  Figure figure;
  figure.name = "wall_pressure";
  figure.title = "Wall pressure at the impact";
  figure.tables.push_back({figure.name, {"run", "time_s", "T_after_impact", "p_over_rho_g_H"}, {}});
  Table& table = figure.tables.front();
  std::vector<const RunResult*> panels;
  const auto results = wall_pressures(study);
  for (const WallPressureResult& result : results) {
    if (!result.impact) continue;
    add_rows(table, result);
    if (result.run != &study.reference()) panels.push_back(result.run);
  }
  if (panels.empty()) return {};
  const double top = upper_end(table, study.reference().study.name);
  const Run& reference = study.reference_run().run;
  const double height = (*wall_probe(reference))[1] - reference.physics.floor();
  figure.height_mm = 10.0 + pressure_panel_mm * static_cast<double>(panels.size());
  figure.caption =
      "Pressure on the far wall, " + fixed_text(1e3 * height, 1) +
      " mm above the floor, over the height of the column times rho g, after each run’s own "
      "impact. "
      "Each panel has one run (colour) over " +
      study.reference().label() +
      " (black). Values are means over the sampling interval of a sensor, " +
      fixed_text(1e3 * sensor_interval.value(), 2) +
      " ms, and not filtered otherwise; what leaves the picture is in the CSV file, the peaks are "
      "in the table.";
  figure.script =
      "set multiplot\nset lmargin at screen 0.13\nset rmargin at screen 0.975\nset key off\n"
      "set xrange [" +
      fixed_text(-before_impact, 2) + ":" + fixed_text(impact_duration.value(), 2) +
      "]\nset yrange [-0.5:" + fixed_text(top, 1) +
      "]\nset xtics 0.5\nset format x \"\"\nset label 2 " + plot_label(study.reference().label()) +
      " at graph 1,1.09 right\n";
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const double from_top = 5.0 + pressure_panel_mm * static_cast<double>(i);
    const auto place = [&](double mm) { return fixed_text(1.0 - mm / figure.height_mm, 4); };
    figure.script += "set tmargin at screen " + place(from_top) + "\nset bmargin at screen " +
                     place(from_top + pressure_panel_mm - 6.5) + "\nset label 1 " +
                     plot_label(panels[i]->label()) + " at graph 0,1.09 left textcolor rgb \"" +
                     readable(run_style(i).colour).hex() + "\"\n";
    if (i + 1 == panels.size())
      figure.script +=
          "set format x \"%g\"\nset xlabel \"{/:Italic T} after the impact\" offset 0,0.4\n";
    figure.script += i == panels.size() / 2
                         ? "set ylabel \"{/:Italic p}/({/:Italic ρgH})\" offset 1.2\n"
                         : "unset ylabel\n";
    figure.script += "plot " + pressure_rows(table, *panels[i]) +
                     line_spec({run_style(i).colour, "solid"}, 0.7) + ", \\\n     " +
                     pressure_rows(table, study.reference()) + line_spec(reference_style(), 1.1) +
                     "\nunset label 2\n";
  }
  figure.script += "unset multiplot\n";
  std::vector<Figure> figures;
  figures.push_back(std::move(figure));
  return figures;
}

}  // namespace surge::compare
