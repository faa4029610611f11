#include <algorithm>
#include <cmath>

#include "compare/figures/figures.hpp"
#include "compare/figures/method.hpp"
#include "compare/figures/surface.hpp"

namespace surge::compare {

namespace {

constexpr const char* surfaces_title = "Free surfaces of all runs";
constexpr std::size_t columns = 2;
/// Places in mm.
constexpr double left_mm = 14.0, right_mm = 3.0, top_mm = 5.0, column_gap = 9.0, row_gap = 8.0,
                 foot = 11.0;
constexpr double line = 3.9, tallest = 90.0;
constexpr double panel_width =
    (double_column_mm - left_mm - right_mm - column_gap * (columns - 1)) / columns;

struct Line {
  const RunResult* run;
  LineStyle style;
  std::vector<Segment> surface;
};

struct SurfacePanel {
  Seconds time;
  std::vector<Line> lines;
  double height = 0.5;  ///< over L
};

std::vector<std::pair<const RunResult*, LineStyle>> styled_runs(const StudyResult& study) {
  // The reference first, behind the others.
  std::vector<std::pair<const RunResult*, LineStyle>> runs{{&study.reference(), reference_style()}};
  std::size_t index = 0;
  for (const RunResult* run : study.measured())
    if (run != &study.reference()) runs.emplace_back(run, run_style(index++));
  return runs;
}

SurfacePanel make_panel(const StudyResult& study, Seconds time) {
  SurfacePanel panel{time, {}};
  for (const auto& [result, style] : styled_runs(study)) {
    const Run& run = result->measured->run;
    const auto index = frame_near(run.frames->times(), time);
    if (!index) continue;
    const WaterPicture water = water_picture(run.frames->read(*index, {.pressure = true}), run);
    panel.lines.push_back({result, style, free_surface(water, solids_of(run), time)});
    panel.height = std::max(panel.height, water.height_of(0.97) + 0.1);
  }
  panel.height = std::ceil(2.0 * panel.height) / 2.0;
  return panel;
}

struct Span {
  double x0 = 0.0, x1 = 1.0;
};

Span span_of(const Solids& solids, const std::vector<SurfacePanel>& panels) {
  Span span;
  for (const SurfacePanel& panel : panels)
    for (const Line& one : panel.lines)
      for (const Segment& s : one.surface) {
        span.x0 = std::min({span.x0, s.x0, s.x1});
        span.x1 = std::max({span.x1, s.x0, s.x1});
      }
  if (solids.tank && std::isfinite(solids.tank->x0)) span.x0 = solids.tank->x0;
  if (solids.tank && std::isfinite(solids.tank->x1)) span.x1 = solids.tank->x1;
  return span;
}

std::string box(const Rectangle& r, const char* colour) {
  return "set object rectangle from " + plot_number(r.x0) + "," + plot_number(r.y0) + " to " +
         plot_number(r.x1) + "," + plot_number(r.y1) + " fc rgb \"" + colour +
         "\" fs solid 1 border lc rgb \"#303030\" lw 0.6\n";
}

std::string plots_of(const SurfacePanel& panel, const Table& table) {
  std::string plots;
  for (const Line& one : panel.lines) {
    if (one.surface.empty()) continue;
    const double width =
        one.style.dash == "solid" && one.style.colour.red == 0 && one.style.colour.blue == 0 ? 0.8
                                                                                             : 1.1;
    plots += (plots.empty() ? "plot " : ", \\\n     ") +
             plotted_rows(table, {one.run->study.name, panel.time.value()}) +
             " using 3:4:(column(5)-column(3)):(column(6)-column(4)) with vectors nohead lw " +
             fixed_text(width, 1) + " lc rgb \"" + one.style.colour.hex() + "\" notitle";
  }
  return plots.empty() ? "plot 1/0 notitle\n" : plots + "\n";
}

double tidy(double value) {
  return std::round(1e5 * value) / 1e5;
}

}  // namespace

Figure surface_figure(const StudyResult& study) {
  std::vector<SurfacePanel> panels;
  for (Seconds time : study.study.snapshot_times) panels.push_back(make_panel(study, time));
  if (panels.empty())
    return empty_figure("surfaces", surfaces_title, "The study names no snapshot_times.");
  const Solids solids = solids_of(study.reference_run().run);
  const Span span = span_of(solids, panels);
  const double scale = panel_width / (span.x1 - span.x0);  // mm per L
  const auto runs = styled_runs(study);

  Figure figure;
  figure.name = "surfaces";
  figure.title = surfaces_title;
  figure.width_mm = double_column_mm;
  figure.caption =
      "The free surface of every run at each time: on a mesh half a volume fraction, of particles "
      "where they cover half of the plane. Black and thin: the reference " +
      study.reference().label() + ". Grey: obstacles; orange: walls that move.";
  const Scales scales = study.reference_run().run.physics.scales();
  std::vector<double> heights;  // of the rows, mm
  for (std::size_t k = 0; k < panels.size(); ++k) {
    if (k % columns == 0) heights.push_back(0.0);
    heights.back() = std::max(heights.back(), std::clamp(panels[k].height * scale, 8.0, tallest));
  }
  const std::size_t key_rows = (runs.size() + 1) / 2;
  figure.height_mm = top_mm + foot + 2.0 + line * double(key_rows);
  for (const double height : heights) figure.height_mm += height + row_gap;
  const auto x = [](double mm) { return fixed_text(mm / double_column_mm, 5); };
  const auto y = [&](double mm) { return fixed_text(1.0 - mm / figure.height_mm, 5); };
  figure.script =
      "set multiplot\nunset grid\nset border 11 lw 0.8 lc rgb \"#404040\"\nset key off\n";
  Table table{"surfaces", {"run", "time_s", "x0", "y0", "x1", "y1"}, {}};
  double above = top_mm;
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const SurfacePanel& panel = panels[k];
    const std::size_t row = k / columns, column = k % columns;
    const double height = heights[row];
    const double from = left_mm + double(column) * (panel_width + column_gap);
    figure.script += "unset object\nset lmargin at screen " + x(from) + "\nset rmargin at screen " +
                     x(from + panel_width) + "\nset tmargin at screen " + y(above) +
                     "\nset bmargin at screen " + y(above + height) + "\nset xrange [" +
                     plot_number(span.x0) + ":" + plot_number(span.x1) +
                     "]\nset yrange [0:" + plot_number(height / scale) + "]\n";
    const bool is_last = k + columns >= panels.size();
    figure.script += is_last
                         ? "set format x \"%g\"\nset xlabel \"{/:Italic x}/{/:Italic L}\" offset "
                           "0,0.5\n"
                         : "set format x \"\"\nunset xlabel\n";
    figure.script +=
        column == 0 ? "set ylabel \"{/:Italic y}/{/:Italic L}\" offset 0.5\n" : "unset ylabel\n";
    for (const Rectangle& one : solids.obstacles) figure.script += box(one, "#8a8a8a");
    for (const Outline& outline : solids.outlines)
      figure.script +=
          outline_object(outline, "fc rgb \"#8a8a8a\" fs solid 1 border lc rgb \"#303030\" lw 0.6");
    for (const Solids::MovingWall& wall : solids.walls)
      figure.script += box(wall.at(panel.time), "#e69f00");
    for (const Line& one : panel.lines)
      for (const Segment& s : one.surface)
        table.add({one.run->study.name, panel.time.value(), tidy(s.x0), tidy(s.y0), tidy(s.x1),
                   tidy(s.y1)});
    figure.script +=
        "set label 1 \"{/:Italic t} = " + fixed_text(panel.time.value(), 2) +
        " s,  {/:Italic T} = " + fixed_text(scales.dimensionless(panel.time).value(), 2) +
        "\" at graph 0,1 left offset 0,character 0.6\n" + plots_of(panel, table);
    if (column + 1 == columns || k + 1 == panels.size()) above += height + row_gap;
  }
  // The legend, below all panels.
  figure.script +=
      "unset object\nunset label\nunset border\nunset tics\nunset xlabel\nunset ylabel\n"
      "set lmargin at screen 0\nset rmargin at screen 1\nset key at screen " +
      x(left_mm) + "," + y(above + foot - row_gap + 3.0) + " left top vertical maxrows " +
      std::to_string(key_rows) +
      " Left reverse\nset xrange [0:1]\nset yrange [0:1]\nplot 1/0 notitle";
  for (std::size_t k = 0; k < runs.size(); ++k)
    figure.script +=
        std::string(", \\\n     ") + std::string("keyentry with lines lw 1.3 lc rgb \"") +
        runs[k].second.colour.hex() + "\" title " + plot_string(runs[k].first->label());
  figure.script += "\nunset multiplot\n";
  figure.tables.push_back(std::move(table));
  return figure;
}

}  // namespace surge::compare
