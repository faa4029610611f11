#include <algorithm>
#include <cmath>
#include <sstream>

#include "compare/figures/method.hpp"
#include "compare/figures/style.hpp"

namespace surge::compare {

namespace {

constexpr const char* patterns_title = "Flow patterns: overlap with the reference, detached water";

/// Rows of all runs; NaN where a run has no overlap at that time.
Table pattern_table(const StudyResult& study) {
  Table table{"patterns",
              {"run", "time_s", "T", "overlap", "detached_part", "detached_part_least",
               "detached_part_most", "pieces", "pieces_least", "pieces_most"},
              {}};
  const Scales scales = study.reference_run().run.physics.scales();
  for (const RunResult* run : study.measured()) {
    for (const PatternSample& s : study.pattern(*run)) {
      const auto [least, most] =
          std::minmax_element(s.detached.begin(), s.detached.end(),
                              [](const Detached& a, const Detached& b) { return a.part < b.part; });
      const auto [fewest, many] = std::minmax_element(
          s.detached.begin(), s.detached.end(),
          [](const Detached& a, const Detached& b) { return a.pieces < b.pieces; });
      const Detached& usual = s.detached[usual_cohesion];
      table.add({run->study.name, s.time.value(), scales.dimensionless(s.time).value(),
                 s.overlap.value_or(std::nan("")), usual.part, least->part, most->part,
                 static_cast<double>(usual.pieces), static_cast<double>(fewest->pieces),
                 static_cast<double>(many->pieces)});
    }
  }
  return table;
}

LineStyle style_of(const StudyResult& study, const RunResult& run) {
  std::size_t index = 0;
  for (const RunResult* other : study.measured()) {
    if (other == &study.reference()) continue;
    if (other == &run) return run_style(index);
    ++index;
  }
  return reference_style();
}

std::string rows_of(const RunResult& run) {
  return "\"patterns.csv\" using (strcol(1) eq " + plot_string(run.study.name) +
         " ? column(3) : NaN)";
}

/// A curve per run; with a band between two columns where there are some.
std::string panel(const StudyResult& study, int column, int least, int most, bool reference,
                  bool legend, double scale) {
  const auto value = [&](int c) {
    return "($" + std::to_string(c) + "*" + plot_number(scale) + ")";
  };
  std::string plots;
  const auto add = [&](const std::string& text) {
    plots += (plots.empty() ? "plot " : ", \\\n     ") + text;
  };
  for (const RunResult* run : study.measured()) {
    if (least == 0 || (run == &study.reference() && !reference)) continue;
    add(rows_of(*run) + ":" + value(least) + ":" + value(most) +
        " with filledcurves fs transparent solid 0.22 noborder fc rgb \"" +
        style_of(study, *run).colour.hex() + "\" notitle");
  }
  for (const RunResult* run : study.measured()) {
    if (run == &study.reference() && !reference) continue;
    add(rows_of(*run) + ":" + value(column) + " with lines " +
        line_spec(style_of(study, *run), run == &study.reference() ? 1.4 : 1.2) +
        (legend ? " title " + plot_string(run->label()) : " notitle"));
  }
  if (legend && !reference) {
    add("keyentry with lines " + line_spec(reference_style(), 1.4) + " title " +
        plot_string(study.reference().label()));
  }
  return plots + "\n";
}

/// Largest value of a column, at least `least`.
double largest(const Table& table, std::size_t column, double least) {
  for (const auto& row : table.rows) least = std::max(least, std::get<double>(row[column]));
  return least;
}

}  // namespace

Figure pattern_figure(const StudyResult& study) {
  Figure figure;
  figure.name = "patterns";
  figure.title = patterns_title;
  figure.width_mm = double_column_mm;
  figure.height_mm = 128.0;
  if (study.measured().size() < 2)
    return empty_figure(figure.name, patterns_title,
                        "No run besides the reference could be measured.");
  figure.tables.push_back(pattern_table(study));
  figure.caption =
      "Top: part that the regions of water of a run and of " + study.reference().label() +
      " have in common, over that which either covers. Middle: water that is not connected to the "
      "main body, in per cent of all the water. Bottom: in how many pieces. The line is for a "
      "linking length of 2 spacings (mesh: corners half full), the band for 1.5 to 2.5 spacings "
      "(three quarters to one quarter full); it leaves the picture where a short linking length "
      "cuts the main body in two. Grey: the reference is at the far wall.";
  const auto hit = study.impact_time();
  const Scales scales = study.reference_run().run.physics.scales();
  const double impact = hit ? scales.dimensionless(*hit).value() : 0.0;
  const Table& rows = figure.tables.front();
  std::ostringstream script;
  // The bands may go far beyond what the lines need, where a strict rule cuts the main body in two.
  script << "set multiplot\nset lmargin at screen 0.085\nset rmargin at screen 0.985\n";
  if (hit) {
    script << "set arrow 1 from first " << plot_number(impact) << ",graph 0 to first "
           << plot_number(impact) << ",graph 1 nohead lw 1 lc rgb \"#909090\" back\n";
  }
  const auto place = [&](double top, double bottom, bool last) {
    script << "set tmargin at screen " << top << "\nset bmargin at screen " << bottom << "\n"
           << (last ? "set format x \"%g\"\nset xlabel \"{/:Italic T} = {/:Italic t} "
                      "(2{/:Italic g}/{/:Italic L})^{1/2}\"\n"
                    : "set format x \"\"\nunset xlabel\n");
  };
  place(0.98, 0.715, false);
  script << "set ylabel \"overlap with the reference\"\nset yrange [0:1]\nset key bottom left Left "
            "reverse\n"
         << panel(study, 4, 0, 0, false, true, 1.0);
  place(0.675, 0.41, false);
  script << "set ylabel \"detached water, %\"\nset yrange [0:"
         << plot_number(std::ceil(150.0 * largest(rows, 4, 0.01))) << "]\nunset key\n"
         << panel(study, 5, 6, 7, true, false, 100.0);
  place(0.37, 0.105, true);
  script << "set ylabel \"pieces\"\nset yrange [0:" << plot_number(1.05 * largest(rows, 9, 1.0))
         << "]\n"
         << panel(study, 8, 9, 10, true, false, 1.0) << "unset multiplot\n";
  figure.script = script.str();
  return figure;
}

}  // namespace surge::compare
