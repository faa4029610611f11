#include <algorithm>
#include <cmath>
#include <map>

#include "compare/figures/figures.hpp"
#include "compare/figures/style.hpp"
#include "compare/study/sequences.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

constexpr const char* drawn_quantity = "Z_over_L_at_T_2.00";

double or_gap(const json& value) {
  return value.is_number() ? value.get<double>() : std::nan("");
}

/// The looks of the sequences by their labels: VOF as the reference, the others in order.
std::map<std::string, LineStyle> styles_of(const json& sequences) {
  std::map<std::string, LineStyle> styles;
  std::size_t index = 0;
  for (const json& sequence : sequences) {
    const std::string label = sequence["label"];
    if (styles.contains(label)) continue;
    const bool mesh = label.starts_with("VOF");
    styles[label] = mesh ? reference_style() : run_style(index);
    if (!mesh) ++index;
  }
  return styles;
}

std::string filter(const std::string& file, const std::string& label, const std::string& kind,
                   const std::string& x, const std::string& y) {
  return "\"" + file + ".csv\" using (strcol(1) eq " + plot_string(label) + " && strcol(2) eq " +
         plot_string(kind) + " ? column(\"" + x + "\") : NaN):(column(\"" + y + "\"))";
}

std::string joined(const std::vector<std::string>& plots) {
  std::string text;
  for (const auto& plot : plots) text += (text.empty() ? "plot " : ", \\\n     ") + plot;
  return text + "\n";
}

std::string look(const LineStyle& style, double size) {
  return line_spec(style, 1.2) + " pt " + std::to_string(style.point) + " ps " +
         fixed_text(size, 2);
}

/// What an axis has to show.
struct Range {
  double least = 1e300, most = -1e300;
  void add(double value) {
    if (!std::isfinite(value)) return;
    least = std::min(least, value);
    most = std::max(most, value);
  }
  [[nodiscard]] std::string linear() const {
    const double margin = 0.1 * std::max(most - least, 1e-6);
    return "[" + plot_number(least - margin) + ":" + plot_number(most + margin) + "]";
  }
};

Figure sequence_figure(const StudyResult& study, const json& sequences) {
  const double drawn_time = 2.0;  // T of drawn_quantity
  const Scales scales = study.reference_run().run.physics.scales();
  const std::string moment =
      study.judges_paper()
          ? std::string("T = 2")
          : "t = " + fixed_text(scales.dimensional(DimensionlessTime(drawn_time)).value(), 3) +
                " s";
  Figure figure;
  figure.name = "convergence";
  figure.title = "Leading edge at " + moment + " over the spacing";
  figure.height_mm = 80.0;
  Table table{figure.name, {"sequence", "kind", "spacing_mm", "Z_over_L"}, {}};
  const auto styles = styles_of(sequences);
  std::vector<std::string> plots;
  std::size_t place = 0;
  Range shown;  // the coarsest levels may lie far off
  for (const json& sequence : sequences) {
    if (sequence["refined"] != "spacing") continue;
    const std::string label = sequence["label"];
    const json& quantity = sequence["quantities"][drawn_quantity];
    for (std::size_t i = 0; i < sequence["levels"].size(); ++i)
      table.add({label, "computed", sequence["levels"][i]["size_milli"].get<double>(),
                 or_gap(quantity["values"][i])});
    for (std::size_t i = 0; i + 1 < sequence["levels"].size(); ++i)
      shown.add(or_gap(quantity["values"][i]));
    const LineStyle& style = styles.at(label);
    plots.push_back(filter(figure.name, label, "computed", "spacing_mm", "Z_over_L") +
                    " with linespoints " + look(style, 0.4) + " title " + plot_string(label));
    if (quantity["result"].is_null()) continue;
    const json& result = quantity["result"];
    // Beside each other, where they would hide each other.
    const double aside = 0.12 * static_cast<double>(place);
    const double u = result["uncertainty"], fine = or_gap(quantity["values"][0]);
    for (const double end : {fine - u, fine + u}) {
      table.add(
          {label, "uncertainty", sequence["levels"][0]["size_milli"].get<double>() - aside, end});
      shown.add(end);
    }
    table.add({label, result["asymptotic"].get<bool>() ? "limit" : "guess",
               -0.2 - 0.25 * static_cast<double>(place++), or_gap(result["extrapolated"])});
    plots.push_back(filter(figure.name, label, "uncertainty", "spacing_mm", "Z_over_L") +
                    " with lines lw 1.5 lc rgb \"" + style.colour.hex() + "\" notitle");
    for (const auto& [kind, point] : {std::pair{"limit", 7}, std::pair{"guess", 6}})
      plots.push_back(filter(figure.name, label, kind, "spacing_mm", "Z_over_L") +
                      " with points pt " + std::to_string(point) + " ps 0.5 lw 0.8 lc rgb \"" +
                      style.colour.hex() + "\" notitle");
  }
  figure.tables.push_back(std::move(table));
  figure.caption =
      "Bars: 95 % numerical uncertainty of the finest level. Circles left of zero: extrapolated "
      "values, filled where the levels are in the asymptotic range, open where they are not and "
      "the value is a guess; none where the levels diverge. The coarsest levels may lie outside.";
  figure.script =
      "set key below left Left reverse maxcols 2\nset xlabel \"spacing or cell, mm\" offset 0,0.4\n"
      "set ylabel \"Z/L at " +
      moment + "\"\nset xrange [-1.8:*]\nset xtics 0,5\nset yrange " + shown.linear() +
      "\nset arrow 1 from 0, graph 0 to 0, graph 1 nohead lw 0.6 lc rgb \"#808080\"\n" +
      joined(plots);
  return figure;
}

}  // namespace

std::vector<Figure> convergence_figures(const StudyResult& study) {
  json metrics;
  measure_convergence(study, metrics);
  if (metrics["convergence"].empty()) return {};
  const json& sequences = metrics["convergence"]["sequences"];
  return {sequence_figure(study, sequences)};
}

}  // namespace surge::compare
