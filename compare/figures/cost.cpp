#include <cmath>

#include "compare/figures/method.hpp"
#include "compare/figures/style.hpp"
#include "compare/report/scaling.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

/// Rows of both panels; NaN where the total is not known.
Table cost_table(const json& curves) {
  Table table{"fig9",
              {"curve", "fluid_particles", "all_particles", "ms_per_step", "ms_least", "ms_most",
               "total_s", "extrapolated", "steps", "repeats"},
              {}};
  for (const auto& [name, curve] : curves.items()) {
    for (const json& p : curve["points"]) {
      const double total = p["total_s"].is_number() ? p["total_s"].get<double>() : std::nan("");
      table.add({name, p["fluid_particles"].get<double>(), p["all_particles"].get<double>(),
                 p["ms_per_step"].get<double>(), p["ms_per_step_least"].get<double>(),
                 p["ms_per_step_most"].get<double>(), total,
                 p["extrapolated"].get<bool>() ? 1.0 : 0.0, p["steps"].get<double>(),
                 p["repeats"].get<double>()});
    }
  }
  return table;
}

std::string exponent_text(const json& fit) {
  if (fit.is_null()) return "";
  return ", exponent " + fixed_text(fit["exponent"], 2) + " ± " + fixed_text(fit["half_width"], 2);
}

std::string panel(const json& curves, const std::string& column, const std::string& fit) {
  std::string plots;
  std::size_t index = 0;
  for (const auto& [name, curve] : curves.items()) {
    const LineStyle style = run_style(index++);
    plots += (plots.empty() ? "plot " : ", \\\n     ") +
             std::string("\"fig9.csv\" using (strcol(1) eq ") + plot_string(name) +
             " ? column(\"fluid_particles\") : NaN):(column(\"" + column +
             "\")) with linespoints " + line_spec(style, 1.2) + " pt " +
             std::to_string(style.point) + " ps 0.4 title " +
             plot_string(curve["label"].get<std::string>() + exponent_text(curve[fit]));
  }
  return plots + "\n";
}

}  // namespace

Figure cost_figure(const StudyResult& study) {
  json metrics;
  measure_scaling(study, metrics);
  const json& curves = metrics["scaling"];
  Figure figure;
  figure.name = "fig9";
  figure.title = "Fig. 9. Processing time over the number of fluid particles";
  figure.width_mm = double_column_mm;
  figure.height_mm = 95.0;
  Table table = cost_table(curves);
  if (table.rows.empty()) {
    return empty_figure(figure.name, figure.title,
                        "This study has no timed runs; the full study has.");
  }
  figure.tables.push_back(std::move(table));
  figure.caption =
      "Left: solving time per step. Right: of the whole time, extrapolated from the steps timed "
      "where the table says so. Medians of the repeats, setup and output left out; the exponents "
      "are over all particles, walls included, with their 95 % intervals.";
  figure.script =
      "set multiplot layout 1,2\nset logscale xy\nset key below left Left reverse maxcols 1\n"
      "set xlabel \"fluid particles\"\nset ylabel \"ms per step\"\n" +
      panel(curves, "ms_per_step", "fit_per_step") + "set ylabel \"total, s\"\n" +
      panel(curves, "total_s", "fit_total") + "unset multiplot\n";
  return figure;
}

}  // namespace surge::compare
