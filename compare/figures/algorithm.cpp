#include <sstream>

#include "compare/figures/method.hpp"

namespace surge::compare {

namespace {

/// Places in mm from the figure's upper left corner.
constexpr double chart_left = 9.0, chart_right = 81.0, middle = 0.5 * (chart_left + chart_right);
constexpr double box_height = 8.4, gap = 3.6, diamond_height = 11.0, diamond_half = 17.0;
constexpr const char* ink = "lc rgb \"#303030\"";

/// A flowchart that grows downwards.
class Flowchart {
 public:
  /// A box with what is done, by which function, and the equations.
  void box(const std::string& does, const std::string& function, const std::string& equations,
           bool terminal = false) {
    const double bottom = y_ + box_height;
    script_ << "set object rectangle from " << chart_left << ',' << y_ << " to " << chart_right
            << ',' << bottom << " fc rgb \"" << (terminal ? "#f0f0f0" : "#e6f1f8")
            << "\" fs solid 1 border " << ink << " lw 0.8\n";
    text(does, chart_left + 2.0, y_ + 2.7, "left", "\",7\"");
    text(function, chart_left + 2.0, y_ + 6.1, "left", "\"monospace,6.2\"");
    text(equations, chart_right - 2.0, y_ + 6.1, "right", "\",6.2\"");
    y_ = bottom;
  }

  /// The question; "no" leads out to the right.
  void question(const std::string& asks, const std::string& function, const std::string& end) {
    const double top = y_, bottom = y_ + diamond_height, centre = 0.5 * (top + bottom);
    script_ << "set object polygon from " << middle << ',' << top << " to " << middle + diamond_half
            << ',' << centre << " to " << middle << ',' << bottom << " to " << middle - diamond_half
            << ',' << centre << " to " << middle << ',' << top
            << " fc rgb \"#fdf0df\" fs solid 1 border " << ink << " lw 0.8\n";
    text(asks, middle, centre - 1.2, "center", "\",7\"");
    text(function, middle, centre + 1.7, "center", "\"monospace,5.4\"");
    arrow(middle + diamond_half, centre, chart_right - 10.0, centre, true);
    text("no", middle + diamond_half + 2.5, centre - 1.6, "center", "\",6.2\"");
    script_ << "set object rectangle from " << chart_right - 10.0 << ',' << centre - 3.0 << " to "
            << chart_right << ',' << centre + 3.0 << " fc rgb \"#f0f0f0\" fs solid 1 border " << ink
            << " lw 0.8\n";
    text(end, chart_right - 5.0, centre, "center", "\",7\"");
    y_ = bottom;
    text("yes", middle + 2.0, y_ + 1.6, "left", "\",6.2\"");
  }

  void down() {
    arrow(middle, y_, middle, y_ + gap, true);
    y_ += gap;
  }

  /// From below the last box back to a height above, along the left.
  void back_to(double height) {
    const double out = chart_left - 5.0;
    arrow(middle, y_, middle, y_ + 2.5, false);
    arrow(middle, y_ + 2.5, out, y_ + 2.5, false);
    arrow(out, y_ + 2.5, out, height, false);
    arrow(out, height, middle, height, true);
    y_ += 2.5;
  }

  [[nodiscard]] double y() const { return y_; }
  [[nodiscard]] std::string script() const { return script_.str(); }

 private:
  void text(const std::string& words, double x, double y, const char* align, const char* font) {
    if (words.empty()) return;
    script_ << "set label " << plot_label(words) << " at " << x << ',' << y << ' ' << align
            << " front font " << font << '\n';
  }
  void arrow(double x0, double y0, double x1, double y1, bool head) {
    script_ << "set arrow from " << x0 << ',' << y0 << " to " << x1 << ',' << y1
            << (head ? " head size 1.4,20 filled" : " nohead") << " lw 0.9 " << ink << '\n';
  }

  std::ostringstream script_;
  double y_ = 1.0;
};

Figure flowchart(const StudyResult& study, const std::string& method, const std::string& name,
                 const std::string& title) {
  const auto from = sheet_run(study, method);
  if (!from) {
    return empty_figure(name, title,
                        std::string("No ") + (method == "mps" ? "MPS" : "SPH") +
                            " run of this study has a method.json.");
  }
  const MethodSheet& sheet = from->sheet;
  Figure figure;
  figure.name = name;
  figure.title = title;
  figure.caption = "Made from the source of " + sheet.step +
                   ": every function that it calls with the options of " + from->run->label() +
                   ", in that order, with the comment on it. The box of a function names its "
                   "equations" +
                   (study.judges_paper() ? " in the paper." : ", as its source does.");
  Table table{name, {"order", "function", "does", "equations"}, {}};
  Flowchart chart;
  chart.box("Particles, walls, first neighbours", sheet.start, "", true);
  const double entry = chart.y() + 0.5 * gap;
  chart.down();
  chart.question("t < end?", sheet.until, "end");
  const nlohmann::json& manifest = from->run->measured->run.manifest;
  const std::vector<MethodSheet::Stage> stages = sheet.stages_with(manifest.at("case"));
  for (const auto& stage : stages) {
    chart.down();
    chart.box(stage.does.empty() ? stage.function : stage.does, stage.function + "()",
              stage.equations);
    table.add(
        {static_cast<double>(table.rows.size() + 1), stage.function, stage.does, stage.equations});
  }
  chart.back_to(entry);
  figure.tables.push_back(std::move(table));
  figure.height_mm = chart.y() + 1.0;
  figure.script =
      "unset border\nunset tics\nunset grid\nunset key\nset lmargin at screen 0\n"
      "set rmargin at screen 1\nset bmargin at screen 0\nset tmargin at screen 1\nset xrange [0:" +
      plot_number(single_column_mm) + "]\nset yrange [" + plot_number(figure.height_mm) + ":0]\n" +
      chart.script() + "plot 1/0 notitle\n";
  return figure;
}

}  // namespace

Figure mps_algorithm_figure(const StudyResult& study) {
  return flowchart(study, "mps", "fig3", "Fig. 3. Algorithm of the MPS method");
}

Figure sph_algorithm_figure(const StudyResult& study) {
  return flowchart(study, "sph", "fig5", "Fig. 5. Algorithm of the SPH method");
}

}  // namespace surge::compare
