#include <cmath>

#include "compare/figures/axis_range.hpp"
#include "compare/figures/method.hpp"
#include "compare/figures/style.hpp"
#include "compare/study/cost_curves.hpp"
#include "particle/support/json.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

/// Rows of both panels; NaN where something is not known.
Table cost_table(const json& curves) {
  Table table{"fig9",
              {"curve", "fluid_particles", "all_particles", "ms_per_step", "ms_least", "ms_most",
               "repeats", "steps", "measured_total_s", "extrapolated_total_s", "total_s",
               "neighbours", "pressure", "forces"},
              {}};
  for (const auto& [name, curve] : curves.items()) {
    for (const json& p : curve["points"]) {
      const json& sample = p[p["window"].is_null() ? "whole" : "window"];
      const double total = json_or_gap(p["total_s"]);
      const bool extrapolated = p["extrapolated"];
      const auto share = [&](const char* phase) {
        return p["shares"].contains(phase) ? json_or_gap(p["shares"][phase]) : std::nan("");
      };
      table.add({name, p["fluid_particles"].get<double>(), p["all_particles"].get<double>(),
                 p["ms_per_step"].get<double>(), sample["ms_per_step_least"].get<double>(),
                 sample["ms_per_step_most"].get<double>(), sample["repeats"].get<double>(),
                 sample["steps"].get<double>(), extrapolated ? std::nan("") : total,
                 extrapolated ? total : std::nan(""), total, share("neighbours"), share("pressure"),
                 share("forces")});
    }
  }
  return table;
}

std::string exponent_text(const json& curve, const std::string& fit) {
  const auto one = [&](const std::string& key) {
    const json& found = curve[key];
    return found.is_null()
               ? std::string("–")
               : fixed_text(found["exponent"], 2) + " ± " + fixed_text(found["half_width"], 2);
  };
  return ": " + one(fit + "_over_fluid") + " (" + one(fit) + ")";
}

std::string points_of(const std::string& curve, const std::string& column) {
  return "\"fig9.csv\" using (strcol(1) eq " + plot_string(curve) +
         " ? column(\"fluid_particles\") : NaN):(column(\"" + column + "\"))";
}

std::string step_panel(const json& curves) {
  std::string plots;
  std::size_t index = 0;
  for (const auto& [name, curve] : curves.items()) {
    const LineStyle style = run_style(index++);
    plots += (plots.empty() ? "plot " : ", \\\n     ") + points_of(name, "ms_per_step") +
             " with linespoints " + line_spec(style, 1.2) + " pt " + std::to_string(style.point) +
             " ps 0.4 title " +
             plot_string(curve["label"].get<std::string>() + exponent_text(curve, "fit_per_step"));
  }
  return plots + "\n";
}

/// Measured totals with filled markers, extrapolated ones with open markers.
std::string total_panel(const json& curves) {
  std::string plots;
  std::size_t index = 0;
  for (const auto& [name, curve] : curves.items()) {
    const LineStyle style = run_style(index++);
    const std::string colour = " lc rgb \"" + style.colour.hex() + "\"";
    plots += (plots.empty() ? "plot " : ", \\\n     ") + points_of(name, "total_s") +
             " with lines " + line_spec(style, 0.8) + " notitle, \\\n     " +
             points_of(name, "extrapolated_total_s") + " with points pt " +
             std::to_string(style.point) + " ps 0.45" + colour + " notitle, \\\n     " +
             points_of(name, "measured_total_s") + " with points pt " +
             std::to_string(style.point + 1) + " ps 0.45" + colour + " title " +
             plot_string(curve["label"].get<std::string>() + exponent_text(curve, "fit_total"));
  }
  return plots + "\n";
}

/// A panel from left to right, its legend below it with a line per curve.
std::string panel_place(double left, double right) {
  return "set lmargin at screen " + fixed_text(left, 3) + "\nset rmargin at screen " +
         fixed_text(right, 3) + "\nset key at screen " + fixed_text(left - 0.04, 3) +
         ",0.26 left top vertical maxcols 1 Left reverse samplen 2 font \",8.6\"\n";
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
                        "This study has no timed runs. Its figure is made by ./Allrun --study "
                        "compare/studies/timing.toml, which times both methods at many sizes.");
  }
  const std::string sizes = axis_range("x", table, {1});
  const std::string steps = axis_range("y", table, {3}), totals = axis_range("y", table, {10});
  figure.tables.push_back(std::move(table));
  figure.caption =
      "Left: solving time per step in the first steps of the collapse. Right: solving time of the "
      "whole run, filled markers measured, open markers extrapolated as the table says. Medians of "
      "the repeats; setup and output are left out. In the legends the exponent over the number of "
      "fluid particles and, in brackets, of all particles, walls included, with 95 % intervals.";
  figure.script =
      "set multiplot\nset logscale xy\nset format \"10^{%L}\"\nset xlabel \"fluid particles\" "
      "offset 0,0.4\nset tmargin at screen 0.97\nset bmargin at screen 0.36\n" +
      panel_place(0.085, 0.485) + sizes + steps + "set ylabel \"ms per step\" offset 1.2\n" +
      step_panel(curves) + panel_place(0.575, 0.975) + totals +
      "set ylabel \"total, s\" offset 1.2\n" + total_panel(curves) + "unset multiplot\n";
  return figure;
}

}  // namespace surge::compare
