#include <cmath>
#include <sstream>

#include "compare/figures/method.hpp"
#include "compare/figures/style.hpp"

namespace surge::compare {

namespace {

constexpr const char* mps_title = "Fig. 1. Weight function of MPS";
constexpr const char* sph_title = "Fig. 4. Kernel of SPH and its derivative";

/// A radius as "2.1 l0"; the number as short as it is.
std::string radius_text(double over_l0) {
  std::string text = fixed_text(over_l0, 3);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text + " {/:Italic l}_0";
}

std::string curve(const std::string& file, int x, int y, const LineStyle& style,
                  const std::string& title) {
  return "\"" + file + ".csv\" using " + std::to_string(x) + ':' + std::to_string(y) +
         " with lines " + line_spec(style, 1.6) + " title \"" + title + "\"";
}

std::string vertical(double x, const LineStyle& style) {
  return "set arrow from first " + plot_number(x) + ",graph 0 to first " + plot_number(x) +
         ",graph 1 nohead lw 0.7 dt (6,4) lc rgb \"" + style.colour.hex() + "\"\n";
}

/// A radius as a line across the plot and what it is for, beside it at a height of the graph.
std::string radius_mark(double radius, const std::string& place, double height,
                        const LineStyle& style, const std::string& use) {
  return vertical(radius, style) + "set label \"{/:Italic r_e} = " + radius_text(radius) + "\\n" +
         use + "\" at first " + plot_number(radius) + ",graph " + plot_number(height) + " " +
         place + " textcolor rgb \"" + readable(style.colour).hex() + "\"\n";
}

}  // namespace

Figure weight_figure(const StudyResult& study) {
  const auto from = sheet_run(study, "mps");
  if (!from) return empty_figure("fig1", mps_title, "No MPS run of this study has a method.json.");
  const MethodSheet& sheet = from->sheet;
  const auto& gradient = sheet.function("w");
  const auto& laplacian = sheet.function("w_laplacian");
  const double l0 = sheet.spacing;

  Figure figure;
  figure.name = "fig1";
  figure.title = mps_title;
  figure.caption = "Eq. (3) as the run " + from->run->study.name +
                   " computed it, sampled by the program from its own function, for the radius of "
                   "number density and gradient and for that of the Laplacian. It has no bound at "
                   "r = 0.";
  Table table{"fig1", {"function", "r_m", "r_over_l0", "w"}, {}};
  // An empty cell would end a line that is drawn by column, so each function has its own rows.
  for (const auto* f : {&gradient, &laplacian}) {
    for (std::size_t k = 0; k < f->r.size(); ++k)
      table.add({f->name, f->r[k], f->r[k] / l0, f->value[k]});
  }
  figure.tables.push_back(std::move(table));
  const auto of = [](const std::string& name) {
    return "\"fig1.csv\" using (strcol(1) eq " + plot_string(name) + " ? column(3) : NaN):4";
  };
  std::ostringstream script;
  script << "set xlabel \"{/:Italic r}/{/:Italic l}_0\"\nset ylabel \"{/:Italic w}\"\n"
         << "set xrange [0:" << plot_number(1.08 * laplacian.support / l0) << "]\n"
         << "set yrange [0:6]\nset xtics 1\nset ytics 1\nunset key\n"
         << radius_mark(gradient.support / l0,
                        gradient.support < 0.6 * laplacian.support ? "left offset 0.8"
                                                                   : "right offset -0.8",
                        0.94, run_style(0), "number density,\\ngradient")
         << radius_mark(laplacian.support / l0, "right offset -0.8", 0.62, run_style(1),
                        "Laplacian")
         << "plot " << of("w") << " with lines " << line_spec(run_style(0), 1.8)
         << " notitle, \\\n     " << of("w_laplacian") << " with lines "
         << line_spec(run_style(1), 1.8) << " notitle\n";
  figure.script = script.str();
  return figure;
}

Figure kernel_figure(const StudyResult& study) {
  const auto from = sheet_run(study, "sph");
  if (!from || !from->sheet.length)
    return empty_figure("fig4", sph_title, "No SPH run of this study has a method.json.");
  const MethodSheet& sheet = from->sheet;
  const auto& value = sheet.function("W");
  const auto& slope = sheet.function("dW/dr");
  const double h = *sheet.length;
  const double volume = std::pow(h, sheet.dimension);

  Figure figure;
  figure.name = "fig4";
  figure.title = sph_title;
  const bool quintic = std::abs(value.support / h - 3.0) < 1e-9;
  if (quintic) figure.title = "Fig. 4. Quintic spline function and its derivative";
  figure.caption = std::string(quintic ? "Eq. (18)" : "The kernel") + " as the run " +
                   from->run->study.name +
                   " computed it, sampled by the program from its own functions. With h as the "
                   "unit of length; the table has SI units too.";
  const std::string unit = std::to_string(sheet.dimension);
  Table table{
      "fig4",
      {"r_m", "r_over_h", "W_per_m" + unit, "dW_dr_per_m" + std::to_string(sheet.dimension + 1),
       "W_times_h" + unit, "dW_dr_times_h" + std::to_string(sheet.dimension + 1)},
      {}};
  for (std::size_t k = 0; k < value.r.size(); ++k) {
    table.add({value.r[k], value.r[k] / h, value.value[k], slope.value.at(k),
               value.value[k] * volume, slope.value[k] * volume * h});
  }
  figure.tables.push_back(std::move(table));
  const std::string support = plot_number(value.support / h);
  std::ostringstream script;
  script << "set xlabel \"{/:Italic R} = {/:Italic r}/{/:Italic h}\"\n"
         << "set xrange [0:" << plot_number(1.06 * value.support / h) << "]\nset xtics 1\n"
         << "set ytics 0.1\nset format y \"%.1f\"\nset key top right Left reverse enhanced\n"
         << "set xzeroaxis lw 0.8 lc rgb \"#404040\"\n"
         << vertical(value.support / h, {{0x60, 0x60, 0x60}, "solid", 1}) << "plot "
         << curve("fig4", 2, 5, run_style(0), "{/:Italic h}^" + unit + " {/:Italic W}")
         << ", \\\n     "
         << curve("fig4", 2, 6, run_style(1),
                  "{/:Italic h}^" + std::to_string(sheet.dimension + 1) +
                      " d{/:Italic W}/d{/:Italic r}")
         << "\n";
  figure.script = script.str();
  return figure;
}

}  // namespace surge::compare
