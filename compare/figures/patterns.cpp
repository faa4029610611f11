#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

#include "compare/figures/method.hpp"
#include "compare/figures/style.hpp"
#include "particle/support/bounds.hpp"

namespace surge::compare {

namespace {

constexpr const char* patterns_title = "Flow patterns: overlap with the reference, detached water";

/// The overlap at the times of which run and reference both have a frame. A line through them must
/// not be broken by the run's other times.
struct Overlaps {
  Table table{"overlap", {"run", "time_s", "T", "overlap"}, {}};
  std::map<const RunResult*, std::size_t> count;
  std::string where;  ///< for the caption: which times these are
};

Overlaps overlaps_of(const StudyResult& study) {
  Overlaps found;
  const Scales scales = study.reference_run().run.physics.scales();
  std::string fewer;
  for (const RunResult* run : study.measured()) {
    if (run == &study.reference()) continue;
    std::vector<double> times;
    for (const PatternSample& s : study.pattern(*run)) {
      if (!s.overlap) continue;
      times.push_back(s.time.value());
      found.table.add(
          {run->study.name, s.time.value(), scales.dimensionless(s.time).value(), *s.overlap});
    }
    found.count[run] = times.size();
    const std::size_t frames = study.pattern(*run).size();
    if (times.size() == frames) continue;
    fewer += (fewer.empty() ? "" : "; ") + run->label() + " ";
    if (times.empty()) {
      fewer += "has none of its " + std::to_string(frames) + " frames at a time of the reference";
    } else {
      fewer += "at " + std::to_string(times.size()) + " of its " + std::to_string(frames) +
               " frames, " + number_text(times.front()) + " to " + number_text(times.back()) + " s";
    }
  }
  found.where = "at the times of which both have a frame" + (fewer.empty() ? "" : ": " + fewer);
  return found;
}

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

/// Joins what is drawn in one panel.
class Panel {
 public:
  void add(const std::string& text) { plots_ += (plots_.empty() ? "plot " : ", \\\n     ") + text; }
  [[nodiscard]] std::string text() const { return plots_ + "\n"; }

 private:
  std::string plots_;
};

/// A curve per run, with markers where there are few times; the legend names all runs.
std::string overlap_panel(const StudyResult& study, const Overlaps& overlaps) {
  constexpr std::size_t few = 40;
  Panel panel;
  panel.add("1/0 notitle");  // gnuplot draws no legend without a plot
  for (const RunResult* run : study.measured()) {
    if (run == &study.reference()) continue;
    const std::string line = line_spec(style_of(study, *run), 1.2);
    const std::size_t count = overlaps.count.at(run);
    if (count == 0) {
      panel.add("keyentry with lines " + line + " title " +
                plot_string(run->label() + ": no time in common"));
    } else {
      panel.add(plotted_rows(overlaps.table, {run->study.name}) + " using 3:4 with " +
                (count < few ? "linespoints pt 7 ps 0.25 " : "lines ") + line + " title " +
                plot_string(run->label()));
    }
  }
  panel.add("keyentry with lines " + line_spec(reference_style(), 1.4) + " title " +
            plot_string(study.reference().label()));
  return panel.text();
}

/// A curve per run with a band between two columns.
std::string panel_of(const StudyResult& study, const Table& table, int column, int least, int most,
                     double scale) {
  const auto value = [&](int c) {
    return "($" + std::to_string(c) + "*" + plot_number(scale) + ")";
  };
  Panel panel;
  for (const RunResult* run : study.measured())
    panel.add(plotted_rows(table, {run->study.name}) + " using 3:" + value(least) + ":" +
              value(most) + " with filledcurves fs transparent solid 0.22 noborder fc rgb \"" +
              style_of(study, *run).colour.hex() + "\" notitle");
  for (const RunResult* run : study.measured())
    panel.add(plotted_rows(table, {run->study.name}) + " using 3:" + value(column) +
              " with lines " +
              line_spec(style_of(study, *run), run == &study.reference() ? 1.4 : 1.2) + " notitle");
  return panel.text();
}

/// Largest value of a column, at least `least`.
double largest(const Table& table, std::size_t column, double least) {
  for (const auto& row : table.rows) least = std::max(least, std::get<double>(row[column]));
  return least;
}

/// Least and largest value of a column.
std::pair<double, double> range_of(const Table& table, std::size_t column) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const auto& row : table.rows) {
    least = std::min(least, std::get<double>(row[column]));
    most = std::max(most, std::get<double>(row[column]));
  }
  return {least, most > least ? most : least + 1.0};
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
  Overlaps overlaps = overlaps_of(study);
  figure.caption =
      "Top: part that the regions of water of a run and of " + study.reference().label() +
      " have in common, over that which either covers, " + overlaps.where +
      ". Middle: water that is not connected to the "
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
  const auto [first, last] = range_of(rows, 2);
  script << "set multiplot\nset lmargin at screen 0.085\nset rmargin at screen 0.985\nset xrange ["
         << plot_number(first) << ":" << plot_number(last) << "]\n";
  // The line of the impact; in the first panel above the legend only.
  const auto mark_impact = [&](double from) {
    if (hit)
      script << "set arrow 1 from first " << plot_number(impact) << ",graph " << plot_number(from)
             << " to first " << plot_number(impact)
             << ",graph 1 nohead lw 1 lc rgb \"#909090\" back\n";
  };
  constexpr double panel_mm = 0.265 * 128.0, entry_mm = 3.9;
  mark_impact(
      std::min(0.9, 0.05 + entry_mm / panel_mm * static_cast<double>(study.measured().size())));
  const auto place = [&](double top, double bottom, bool lowest) {
    script << "set tmargin at screen " << top << "\nset bmargin at screen " << bottom << "\n"
           << (lowest ? "set format x \"%g\"\nset xlabel \"{/:Italic T} = {/:Italic t} "
                        "(2{/:Italic g}/{/:Italic L})^{1/2}\"\n"
                      : "set format x \"\"\nunset xlabel\n");
  };
  place(0.98, 0.715, false);
  script << "set ylabel \"overlap with the reference\"\nset yrange [0:1]\nset key bottom left Left "
            "reverse\n"
         << overlap_panel(study, overlaps);
  place(0.675, 0.41, false);
  mark_impact(0.0);
  script << "set ylabel \"detached water, %\"\nset yrange [0:"
         << plot_number(std::ceil(150.0 * largest(rows, 4, 0.01))) << "]\nunset key\n"
         << panel_of(study, rows, 5, 6, 7, 100.0);
  place(0.37, 0.105, true);
  script << "set ylabel \"pieces\"\nset yrange [0:" << plot_number(1.05 * largest(rows, 9, 1.0))
         << "]\n"
         << panel_of(study, rows, 8, 9, 10, 1.0) << "unset multiplot\n";
  figure.script = script.str();
  figure.tables.push_back(std::move(overlaps.table));
  return figure;
}

}  // namespace surge::compare
