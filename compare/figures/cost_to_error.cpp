#include <algorithm>
#include <cmath>
#include <sstream>

#include "compare/figures/cost_to_error.hpp"
#include "compare/figures/style.hpp"
#include "compare/read/four_digits.hpp"
#include "compare/study/cost_to_error.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

std::string rows_of(const std::string& method, const char* kind, const char* columns) {
  return "\"cost_to_error.csv\" using (strcol(1) eq " + plot_string(method) +
         " && strcol(2) eq \"" + kind + "\" ? column(3) : NaN):" + columns;
}

/// Numbers at an axis of a few decades, where powers of ten alone are too few to read by.
std::string ticks_between(double low, double high) {
  std::ostringstream ticks;
  for (int power = static_cast<int>(std::floor(std::log10(low))); std::pow(10.0, power) < high;
       ++power)
    for (const int step : {1, 2, 5}) {
      const double at = step * std::pow(10.0, power);
      if (at < low || at > high) continue;
      ticks << (ticks.tellp() == 0 ? "(" : ",") << '"' << four_digits(at) << "\" "
            << plot_number(at);
    }
  return ticks.tellp() == 0 ? "autofreq" : ticks.str() + ")";
}

/// Styles by method: VOF as the reference, the others in order.
std::vector<std::pair<std::string, LineStyle>> styles_of_methods(const json& methods) {
  std::vector<std::pair<std::string, LineStyle>> styles;
  std::size_t index = 0;
  for (const std::string method : methods)
    styles.emplace_back(method, method.starts_with("VOF") ? reference_style() : run_style(index++));
  return styles;
}

}  // namespace

std::vector<Figure> cost_to_error_figures(const StudyResult& study) {
  json metrics;
  measure_cost_to_error(study, metrics);
  const json& found = metrics["cost_to_error"];
  if (found.empty()) return {};
  const json& points = found["points"];
  Figure figure;
  figure.name = "cost_to_error";
  figure.title = "Error over cost";
  figure.width_mm = double_column_mm;
  figure.height_mm = 80.0;
  Table table{figure.name,
              {"method", "kind", "cpu_s_per_s", "E", "E_least", "E_most", "threads", "run"},
              {}};
  const auto styles = styles_of_methods(found["methods"]);
  double least = 1e300, most = 0.0, cheap = 1e300, costly = 0.0;
  for (const json& point : points) {
    cheap = std::min(cheap, point["cpu_s_per_s"].get<double>() / 1.4);
    costly = std::max(costly, 1.4 * point["cpu_s_per_s"].get<double>());
    if (const double e = point["E"]; e > 0.0) {
      least = std::min(least, e);
      most = std::max(most, e + (point["U"].is_number() ? point["U"].get<double>() : 0.0));
    }
  }
  if (most <= 0.0) return {};
  // A decade at least, or there would be too few numbers to read it by.
  if (const double wide = std::sqrt(10.0 * cheap / costly); wide > 1.0) {
    cheap /= wide;
    costly *= wide;
  }
  // A bar that reaches zero leaves a logarithmic axis; it is drawn to the edge.
  const double foot = least / 2.5, head = std::min(1.3 * most, 40.0 * least);
  const auto has = [&](const std::string& method, const std::string& kind) {
    return std::any_of(table.rows.begin(), table.rows.end(), [&](const auto& row) {
      return std::get<std::string>(row[0]) == method && std::get<std::string>(row[1]) == kind;
    });
  };
  for (const auto& [method, style] : styles)
    for (const char* kind : {"one", "more"})
      for (const json& point : points) {
        const bool many = point["threads"].is_number() && point["threads"] > 1;
        if (point["method"] != method || many != (kind == std::string("more"))) continue;
        const double e = point["E"];
        const double u = point["U"].is_number() ? point["U"].get<double>() : std::nan("");
        table.add({method, std::string(kind), point["cpu_s_per_s"].get<double>(), e,
                   std::isnan(u) ? u : std::max(e - u, foot), e + u,
                   many ? point["threads"].get<double>() : 1.0, point["run"].get<std::string>()});
      }
  std::string plots;
  const auto add = [&](const std::string& text) {
    plots += (plots.empty() ? "plot " : ", \\\n     ") + text;
  };
  for (const auto& [method, style] : styles) {
    // Bars of a coarse study are as high as the picture; the lines must be seen before them.
    const std::string pale = " lc rgb \"#a0" + style.colour.hex().substr(1) + "\"";
    for (const char* kind : {"one", "more"})
      if (has(method, kind))
        add(rows_of(method, kind, "4:5:6") + " with yerrorbars pt 0 lw 0.7" + pale + " notitle");
    if (has(method, "one"))
      add(rows_of(method, "one", "4") + " with linespoints " + line_spec(style, 1.1) + " pt " +
          std::to_string(style.point) + " ps 0.9 title " + plot_string(method));
  }
  bool titled = false;
  for (const auto& [method, style] : styles) {
    if (!has(method, "more")) continue;
    add(rows_of(method, "more", "4") + " with points pt 2 ps 1 lw 1.2 lc rgb \"" +
        style.colour.hex() + "\"" + (titled ? " notitle" : " title \"more threads\""));
    titled = true;
  }
  const std::string unit = found["unit"] == "1" ? "" : ", " + found["unit"].get<std::string>();
  figure.caption =
      "RMS of the difference to " + found["against"].get<std::string>() + " (" +
      found["quantity"].get<std::string>() +
      ") over the CPU time of all threads for one simulated second, output included. Lines join "
      "the "
      "resolutions of a method; bars: 95 % uncertainty of the difference, of both sides, where "
      "their refinements tell it.";
  figure.script =
      "set key outside right top Left reverse samplen 2 width -1\nset logscale xy\n"
      "set xlabel \"CPU time per simulated second, s\" offset 0,0.4\nset ylabel \"RMS difference" +
      unit + "\"\nset format x \"10^{%L}\"\nset xrange [" + plot_number(cheap) + ":" +
      plot_number(costly) + "]\nset yrange [" + plot_number(foot) + ":" + plot_number(head) + "]\n";
  if (costly < 300.0 * cheap) figure.script += "set xtics " + ticks_between(cheap, costly) + "\n";
  if (head < 300.0 * foot) figure.script += "set ytics " + ticks_between(foot, head) + "\n";
  if (found["against_u"].is_number() && found["against_u"].get<double>() > foot) {
    figure.caption += " Below the dashed line is the standard uncertainty of that run itself.";
    const std::string u = plot_number(found["against_u"].get<double>());
    figure.script += "set arrow 1 from graph 0, first " + u + " to graph 1, first " + u +
                     " nohead lw 0.8 dt '_' lc rgb \"#808080\"\n";
  }
  figure.script += plots + "\n";
  figure.tables.push_back(std::move(table));
  std::vector<Figure> figures;
  figures.push_back(std::move(figure));
  return figures;
}

}  // namespace surge::compare
