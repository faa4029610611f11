#include <algorithm>
#include <cmath>

#include "compare/figures/figures.hpp"
#include "compare/figures/lines_of_text.hpp"
#include "compare/figures/solids.hpp"
#include "compare/figures/water.hpp"

namespace surge::compare {

namespace {

/// The part of the water that a row of panels must show; single drops may fly out of the picture.
constexpr double shown_quantile = 0.97;

struct SnapshotPanel {
  const RunResult* run = nullptr;
  Seconds time;  ///< of the frame
  WaterPicture water;
  Solids solids{};
  std::string missing;  ///< why there is no picture; empty where there is one
};

struct Row {
  Seconds time;
  double height = 0.0;  ///< of the panels, over L
  std::vector<SnapshotPanel> panels;
};

/// SnapshotLayout in mm; the origin is the figure's upper left corner.
struct SnapshotLayout {
  double left = 12.0, right = 3.0, top = 9.0, bottom = 26.0, column_gap = 3.5, row_gap = 8.5;
  double x_span = 4.0;  ///< of every panel, over L
  double panel_width = 0.0;
  double height = 0.0;  ///< of the whole figure

  [[nodiscard]] double scale() const { return panel_width / x_span; }  ///< mm per L
  [[nodiscard]] double pixels() const { return 11.0 * scale(); }       ///< per L: 280 per inch
};

SnapshotPanel make_panel(const RunResult& run, Seconds time) {
  SnapshotPanel panel;
  panel.run = &run;
  if (!run.measured) {
    panel.missing = status_text(run.status);
    return panel;
  }
  FrameReader& frames = *run.measured->run.frames;
  const auto index = frame_near(frames.times(), time);
  if (!index) {
    panel.missing = run.note.empty() ? "no frame at this time" : run.note;
    return panel;
  }
  panel.time = frames.times()[*index];
  panel.solids = solids_of(run.measured->run);
  panel.water = water_picture(frames.read(*index, {.pressure = true}), run.measured->run);
  return panel;
}

Row make_row(const StudyResult& study, Seconds time) {
  Row row{time, 0.0, {}};
  double highest = 0.0;
  for (const auto& run : study.runs) {
    row.panels.push_back(make_panel(run, time));
    highest = std::max(highest, row.panels.back().water.height_of(shown_quantile));
  }
  row.height = std::max(1.0, std::ceil(2.0 * (highest + 0.05)) / 2.0);
  return row;
}

std::string screen(double x) {
  return fixed_text(x, 5);
}

std::string margins(double left, double right, double top, double bottom) {
  return "set lmargin at screen " + screen(left) + "\nset rmargin at screen " + screen(right) +
         "\nset tmargin at screen " + screen(top) + "\nset bmargin at screen " + screen(bottom) +
         "\n";
}

std::string panel_label(const SnapshotPanel& panel, const Row& row) {
  const double above = panel.water.part_above(row.height);
  if (above <= 0.0) return "";
  return "set label 2 \"" + fixed_text(100.0 * above, above < 0.001 ? 2 : 1) +
         " % above\" at graph 1,1 right offset 0,character 0.55 font \",5.6\" "
         "textcolor rgb \"#606060\"\n";
}

/// Plot command of one panel; the picture lies under the line of the free surface.
std::string panel_plot(const SnapshotPanel& panel, const Table& surface, const std::string& image,
                       const SnapshotLayout& layout) {
  if (!panel.missing.empty()) return missing_panel(panel.missing, layout.panel_width);
  const double pixel = 1.0 / layout.pixels();
  std::string plot = "plot \"" + image + ".png\" binary filetype=png origin=(" +
                     plot_number(0.5 * pixel) + "," + plot_number(0.5 * pixel) +
                     ") dx=" + plot_number(pixel) + " dy=" + plot_number(pixel) +
                     " with rgbalpha notitle";
  if (!panel.water.surface.empty()) {
    plot += ", \\\n     " + plotted_rows(surface, {panel.run->study.name, panel.time.value()}) +
            " using 3:4:(column(5)-column(3)):(column(6)-column(4)) "
            "with vectors nohead lw 0.9 lc rgb \"#d55e00\" notitle";
  }
  return plot + "\n";
}

/// On a line above panel_label(): six columns leave no room for both side by side.
std::string row_heading(const Row& row, const Scales& scales) {
  return "set label 1 \"{/:Italic t} = " + fixed_text(row.time.value(), 2) +
         " s,  {/:Italic T} = " + fixed_text(scales.dimensionless(row.time).value(), 2) +
         "\" at graph 0,1 left offset 0,character 1.45\n";
}

/// A bar with the colours of p/(rho g H) from 0 to 1.
std::string colour_bar(const SnapshotLayout& layout) {
  const double width = 0.35;
  const double bottom = 11.5 / layout.height;
  return margins(0.5 - width / 2, 0.5 + width / 2, bottom + 2.5 / layout.height, bottom) +
         "set label 4 \"\"\nset border 15\nset xrange [0:1]\nset yrange [0:1]\nset xtics 0.25\n"
         "unset ytics\nset format x \"%g\"\nunset ylabel\n"
         "set xlabel \"{/:Italic p}/(ρ{/:Italic gH})\" offset 0,0.4\n"
         "plot \"fig7_colours.png\" binary filetype=png origin=(0.001953125,0.25) dx=0.00390625 "
         "dy=0.5 "
         "with rgbalpha notitle\n";
}

Image colour_bar_image() {
  // Two rows, because gnuplot draws nothing of a picture of one.
  Image image(0.0, 256.0, 0.0, 2.0, 1.0);
  for (int i = 0; i < 256; ++i) image.rectangle(i, i + 1, 0.0, 2.0, viridis(i / 255.0), 1.0);
  return image;
}

/// Five decimals of L are a hundredth of a particle at the finest; more would only fill the disk.
double rounded(double value) {
  return std::round(1e5 * value) / 1e5;
}

void add_rows(const SnapshotPanel& panel, Table& water, Table& surface) {
  const std::string& name = panel.run->study.name;
  const double time = panel.time.value();
  for (const auto& p : panel.water.patches) {
    water.add({name, time, rounded(p.x), rounded(p.y), rounded(p.pressure), rounded(p.fraction)});
  }
  for (const auto& s : panel.water.surface) {
    surface.add({name, time, rounded(s.x0), rounded(s.y0), rounded(s.x1), rounded(s.y1)});
  }
}

double span_of(const StudyResult& study, const std::vector<Row>& rows) {
  if (const auto wall = study.wall().far_wall) return wall->value();
  double span = 1.0;
  for (const auto& row : rows) {
    for (const auto& panel : row.panels) {
      for (const auto& p : panel.water.patches) span = std::max(span, p.x + p.half_x);
    }
  }
  return span;
}

SnapshotLayout layout_of(const StudyResult& study, const std::vector<Row>& rows) {
  SnapshotLayout layout;
  layout.x_span = span_of(study, rows);
  const auto columns = double(study.runs.size());
  layout.panel_width =
      (double_column_mm - layout.left - layout.right - layout.column_gap * (columns - 1.0)) /
      columns;
  layout.height = layout.top + layout.bottom;
  for (const auto& row : rows) layout.height += row.height * layout.scale() + layout.row_gap;
  return layout;
}

std::string image_name(std::size_t row, std::size_t column) {
  return "fig7_" + std::to_string(row) + "_" + std::to_string(column);
}

/// Numbers on the axes of the outer panels only.
std::string axes(bool first_column, bool last_row) {
  return std::string(last_row ? "set format x \"%g\"\nset xlabel \"{/:Italic x}/{/:Italic L}\" "
                                "offset 0,0.5\n"
                              : "set format x \"\"\nunset xlabel\n") +
         (first_column
              ? "set format y \"%g\"\nset ylabel \"{/:Italic y}/{/:Italic L}\" offset 0.8\n"
              : "set format y \"\"\nunset ylabel\n");
}

/// Script of one row whose panels begin `top` mm below the figure's upper edge.
std::string row_script(const std::vector<Row>& rows, std::size_t r, const Table& surface,
                       const SnapshotLayout& layout, const Scales& scales, double top) {
  const Row& row = rows[r];
  const double bottom = top + row.height * layout.scale();
  std::string script = "set xrange [0:" + plot_number(layout.x_span) +
                       "]\nset yrange [0:" + plot_number(row.height) + "]\n";
  for (std::size_t c = 0; c < row.panels.size(); ++c) {
    const SnapshotPanel& panel = row.panels[c];
    const double left = layout.left + double(c) * (layout.panel_width + layout.column_gap);
    script += margins(left / double_column_mm, (left + layout.panel_width) / double_column_mm,
                      1.0 - top / layout.height, 1.0 - bottom / layout.height) +
              axes(c == 0, r + 1 == rows.size());
    if (c == 0) script += row_heading(row, scales);
    if (r == 0) {
      script += "set label 4 " + plot_label(label_in_two_lines(panel.run->label())) +
                " at graph 0.5,1 center offset 0,character 3.6 font \",7.5\"\n";
    }
    script += solid_objects(panel.solids, panel.time) + panel_label(panel, row) +
              panel_plot(panel, surface, image_name(r, c), layout) + "unset label\nunset object\n";
  }
  return script;
}

/// Pictures and data of all panels.
void add_pictures(const std::vector<Row>& rows, const SnapshotLayout& layout, Figure& figure) {
  Table water{"fig7", {"run", "time_s", "x_over_L", "y_over_L", "p_over_rho_g_H", "alpha"}, {}};
  Table surface{"fig7_surface", {"run", "time_s", "x0", "y0", "x1", "y1"}, {}};
  figure.images.push_back({"fig7_colours", colour_bar_image()});
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < rows[r].panels.size(); ++c) {
      const SnapshotPanel& panel = rows[r].panels[c];
      if (!panel.missing.empty()) continue;
      Image image(0.0, layout.x_span, 0.0, rows[r].height, layout.pixels());
      panel.water.paint(image);
      figure.images.push_back({image_name(r, c), std::move(image)});
      add_rows(panel, water, surface);
    }
  }
  figure.tables = {std::move(water), std::move(surface)};
}

}  // namespace

Figure snapshot_figure(const StudyResult& study) {
  std::vector<Row> rows;
  for (Seconds time : study.study.snapshot_times) rows.push_back(make_row(study, time));
  const SnapshotLayout layout = layout_of(study, rows);
  const Scales scales = study.reference_run().run.physics.scales();

  Figure figure;
  figure.name = "fig7";
  figure.title = "Fig. 7. The flow at different times";
  figure.caption =
      "Pressure over that of the resting column, p/(ρgH) with H its height; colours end at 0 and "
      "1. Particles are discs of diameter l0. On the mesh the colour fades with the volume "
      "fraction "
      "and the line is alpha = 0.5. Each row is as high as the lowest 97 % of the water need; what "
      "is above is stated over the panel.";
  const bool has_noise = std::any_of(study.runs.begin(), study.runs.end(), [](const auto& run) {
    return run.measured && !run.measured->run.is_mesh() && run.measured->run.preset == "paper";
  });
  if (has_noise)
    figure.caption +=
        " All runs share the one scale. The presets “paper” have noisy pressure: single bright and "
        "dark particles are the method’s noise, and not waves in the water.";
  figure.width_mm = double_column_mm;
  figure.height_mm = layout.height;
  figure.script =
      "set multiplot\nset border 11 lw 0.8 lc rgb \"#404040\"\nunset grid\n"
      "unset key\nset xtics 1\nset ytics 1\n";
  add_pictures(rows, layout, figure);
  double top = layout.top;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    top += layout.row_gap;
    figure.script += row_script(rows, r, figure.tables.back(), layout, scales, top);
    top += rows[r].height * layout.scale();
  }
  figure.script += colour_bar(layout) + "unset multiplot\n";
  return figure;
}

}  // namespace surge::compare
