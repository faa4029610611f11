#include <algorithm>
#include <cmath>
#include <sstream>

#include "compare/figures/figures.hpp"
#include "compare/figures/style.hpp"

namespace surge::compare {

namespace {

/// "0.29 m = 2L": at most three decimals of a metre, without trailing zeros.
std::string dimension_text(const std::string& symbol, double metres, double length) {
  const auto trimmed = [](std::string text) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
  };
  const std::string ratio = trimmed(fixed_text(metres / length, 3));
  const std::string multiple = ratio == "1" ? "" : ratio;
  return (symbol.empty() ? "" : symbol + " = ") + multiple + "{/:Italic L} = " +
         trimmed(fixed_text(metres, 4)) + " m";
}

struct Drawing {
  double length, column_width, column_height, tank_width, tank_height;
  double top;  ///< where the drawing of the walls ends
  bool walls;  ///< a tank is known
};

Drawing drawing_of(const Physics& physics) {
  const auto up = static_cast<std::size_t>(physics.vertical_axis());
  Drawing d{};
  d.length = physics.column_width().value();
  d.column_width = d.length;
  d.column_height = physics.column.upper[up] - physics.column.lower[up];
  d.walls = physics.far_wall().has_value();
  d.tank_width = d.walls ? physics.far_wall()->value() : 1.5 * d.length;
  const double height = d.walls ? physics.tank->upper[up] - physics.tank->lower[up] : 0.0;
  // Some sources state the tank's floor and walls, but not where these end.
  d.tank_height = std::isfinite(height) && height > 0.0 ? height : 1.25 * d.column_height;
  d.top = std::min(d.tank_height, 1.25 * d.column_height);
  return d;
}

std::string edge_line(double x0, double y0, double x1, double y1, const std::string& style) {
  return "set arrow from " + plot_number(x0) + "," + plot_number(y0) + " to " + plot_number(x1) +
         "," + plot_number(y1) + " " + style + "\n";
}

std::string label(const std::string& text, double x, double y, const std::string& place) {
  return "set label \"" + text + "\" at " + plot_number(x) + "," + plot_number(y) + " " + place +
         "\n";
}

std::string water(const Drawing& d) {
  return "set object rectangle from 0,0 to " + plot_number(d.column_width) + "," +
         plot_number(d.column_height) +
         " fc rgb \"#9fd0ee\" fs solid 1 border lc rgb \"#0072b2\" lw 1\n" +
         label("water", 0.5 * d.column_width, 0.5 * d.column_height, "center");
}

std::string walls(const Drawing& d) {
  const std::string style = "nohead lw 2.2 lc rgb \"#303030\"";
  std::string script = edge_line(0, 0, d.tank_width, 0, style) + edge_line(0, 0, 0, d.top, style);
  if (d.walls) script += edge_line(d.tank_width, 0, d.tank_width, d.top, style);
  return script;
}

std::string dimensions(const Drawing& d) {
  const std::string both = "heads size graph 0.015,20 filled lw 0.7 lc rgb \"#303030\"";
  const double gap = 0.18 * d.length;
  std::string script =
      edge_line(0, -gap, d.column_width, -gap, both) +
      label(dimension_text("", d.column_width, d.length), 0.5 * d.column_width, -gap,
            "center offset 0,-0.8") +
      edge_line(d.column_width + gap, 0, d.column_width + gap, d.column_height, both) +
      label(dimension_text("{/:Italic H}", d.column_height, d.length), d.column_width + 1.4 * gap,
            0.5 * d.column_height, "left");
  if (!d.walls) return script;
  script += edge_line(0, -3.2 * gap, d.tank_width, -3.2 * gap, both) +
            label(dimension_text("", d.tank_width, d.length), 0.5 * d.tank_width, -3.2 * gap,
                  "center offset 0,-0.8");
  if (d.tank_height > d.top) {
    script += label("walls up to " + dimension_text("", d.tank_height, d.length),
                    d.tank_width - 0.5 * gap, d.top - gap, "right font \",6\"");
  }
  return script;
}

std::string gravity(const Drawing& d, const Physics& physics) {
  const double x = 0.5 * (d.column_width + d.tank_width) + 0.3 * d.length;
  const double y = 0.62 * d.column_height;
  return edge_line(x, y, x, y - 0.6 * d.length,
                   "head size graph 0.02,20 filled lw 1 lc rgb \"#303030\"") +
         label("{/:Italic g} = " + fixed_text(physics.gravity_magnitude(), 2) + " m/s²", x,
               y - 0.3 * d.length, "left offset 0.8,0");
}

}  // namespace

Figure geometry_figure(const StudyResult& study) {
  if (!study.judges_paper()) return setup_figure(study);
  const Run& run = study.reference_run().run;
  const Drawing d = drawing_of(run.physics);
  const double gap = 0.18 * d.length;
  const double x0 = -0.5 * gap, x1 = d.tank_width + 0.5 * gap;
  const double y0 = -4.6 * gap, y1 = d.top + 0.3 * gap;

  Figure figure;
  figure.name = "fig6";
  figure.title = "Fig. 6. Geometry of the dam-break problem";
  figure.caption = "Drawn from the case of " + run.name + ".";
  figure.height_mm = single_column_mm * (y1 - y0) / (x1 - x0);
  Table table{"fig6", {"quantity", "metres", "over_L"}, {}};
  const auto add = [&](const char* name, double metres) {
    table.add({name, metres, metres / d.length});
  };
  add("column width", d.column_width);
  add("column height", d.column_height);
  if (d.walls) {
    add("tank width", d.tank_width);
    add("tank height", d.tank_height);
  }
  figure.tables.push_back(std::move(table));
  std::ostringstream script;
  script << "unset border\nunset tics\nunset grid\nunset key\nset margins 0,0,0,0\n"
         << "set lmargin at screen 0\nset rmargin at screen 1\nset bmargin at screen 0\n"
         << "set tmargin at screen 1\nset xrange [" << plot_number(x0) << ':' << plot_number(x1)
         << "]\nset yrange [" << plot_number(y0) << ':' << plot_number(y1) << "]\n"
         << water(d) << walls(d) << dimensions(d) << gravity(d, run.physics)
         << "plot 1/0 notitle\n";
  figure.script = script.str();
  return figure;
}

}  // namespace surge::compare
