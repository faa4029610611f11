#include <algorithm>
#include <cmath>

#include "compare/figures/differences.hpp"
#include "compare/figures/lines_of_text.hpp"
#include "compare/figures/method.hpp"
#include "compare/figures/solids.hpp"
#include "compare/study/water_differences.hpp"

namespace surge::compare {

namespace {

constexpr const char* differences_title =
    "Where a run has water and the reference has none, and the reverse";
/// Okabe & Ito (2008): two colours that differ in tone and in brightness, on a pale grey.
constexpr Colour only_run{0xd5, 0x5e, 0x00}, only_reference{0x00, 0x72, 0xb2},
    both{0xd8, 0xd8, 0xd8};

struct DifferencePanel {
  std::optional<WaterDifference> found;
  std::string missing;
};

/// Places in mm, from the figure's upper left corner.
struct DifferenceLayout {
  double left = 12.0, right = 3.0, top = 9.0, foot = 17.0, column_gap = 3.5, row_gap = 8.5;
  double from = 0.0, to = 4.0;  ///< of every panel, over L
  double panel_width = 0.0;
  [[nodiscard]] double scale() const { return panel_width / (to - from); }  ///< mm per L
};

/// Part of the water of both that a row must show; single drops may fly out of the picture.
constexpr double shown_part = 0.97;

/// Height over L below which that part of the wet cells lies.
double height_of(const std::vector<DifferencePanel>& panels, const PictureScale& scale) {
  double height = 0.5;
  for (const DifferencePanel& panel : panels) {
    if (!panel.found) continue;
    std::vector<double> tops;
    for (std::size_t i = 0; i < panel.found->water.size(); ++i)
      if (panel.found->water.wet(i) || panel.found->reference.wet(i))
        tops.push_back(scale.y(panel.found->water.box_of(i).upper[scale.up]));
    if (tops.empty()) continue;
    const auto nth =
        tops.begin() + static_cast<std::ptrdiff_t>(shown_part * double(tops.size() - 1));
    std::nth_element(tops.begin(), nth, tops.end());
    height = std::max(height, *nth);
  }
  return std::max(1.0, std::ceil(2.0 * (height + 0.05)) / 2.0);
}

Image picture_of(const WaterDifference& found, const PictureScale& scale,
                 const DifferenceLayout& layout, double height) {
  Image image(layout.from, layout.to, 0.0, height, 11.0 * layout.scale());
  for (std::size_t i = 0; i < found.water.size(); ++i) {
    const bool mine = found.water.wet(i), theirs = found.reference.wet(i);
    if (!mine && !theirs) continue;
    const Extent box = found.water.box_of(i);
    image.rectangle(scale.x(box.lower[0]), scale.x(box.upper[0]), scale.y(box.lower[scale.up]),
                    scale.y(box.upper[scale.up]),
                    mine && theirs ? both
                    : mine         ? only_run
                                   : only_reference,
                    1.0);
  }
  return image;
}

/// "12 %", with a decimal below ten.
std::string per_cent(double part) {
  return fixed_text(100.0 * part, part < 0.0995 ? 1 : 0) + " %";
}

/// "MPS improved 4.1 to 16 %"
std::string range_of(const std::string& label, const std::vector<double>& parts) {
  const auto [least, most] = std::minmax_element(parts.begin(), parts.end());
  return label.substr(0, label.find(", ")) + " " + per_cent(*least) +
         (parts.size() > 1 ? " to " + per_cent(*most) : "");
}

}  // namespace

std::vector<Figure> difference_figures(const StudyResult& study) {
  std::vector<const RunResult*> runs;
  for (const RunResult* run : study.measured())
    if (run != &study.reference()) runs.push_back(run);
  const Run& reference = study.reference_run().run;
  const std::vector<Seconds>& times = study.study.snapshot_times;
  // In space the water of one run would hide that of the other.
  if (runs.empty() || times.empty() || reference.physics.dimension != 2) return {};
  const PictureScale scale(reference);
  const Solids solids = solids_of(reference);
  DifferenceLayout layout;
  if (solids.tank && std::isfinite(solids.tank->x0)) layout.from = solids.tank->x0;
  if (solids.tank && std::isfinite(solids.tank->x1)) layout.to = solids.tank->x1;
  layout.panel_width = (double_column_mm - layout.left - layout.right -
                        layout.column_gap * double(runs.size() - 1)) /
                       double(std::max<std::size_t>(runs.size(), 2));
  Figure figure;
  figure.name = "differences";
  figure.title = differences_title;
  figure.width_mm = double_column_mm;
  Table table{"differences",
              {"run", "time_s", "only_run_m2", "only_reference_m2", "both_m2", "over_reference"},
              {}};
  std::vector<std::vector<DifferencePanel>> rows;
  std::vector<std::vector<double>> parts(runs.size());
  std::vector<double> heights;
  double mm = layout.top + layout.foot;
  for (Seconds time : times) {
    auto& row = rows.emplace_back();
    for (std::size_t c = 0; c < runs.size(); ++c) {
      auto found = water_difference(study, *runs[c], time);
      if (found) {
        table.add({runs[c]->study.name, time.value(), found->size_of(found->cells.only_first),
                   found->size_of(found->cells.only_second), found->size_of(found->cells.both),
                   found->part().value_or(std::nan(""))});
        if (found->part()) parts[c].push_back(*found->part());
      }
      row.push_back({std::move(found), "no frame at this time"});
    }
    heights.push_back(height_of(row, scale));
    mm += heights.back() * layout.scale() + layout.row_gap;
  }
  figure.height_mm = mm;
  const auto across = [](double at) { return fixed_text(at / double_column_mm, 5); };
  const auto down = [&](double at) { return fixed_text(1.0 - at / figure.height_mm, 5); };
  const Scales scales = reference.physics.scales();
  const double length = reference.physics.column_width().value();
  figure.script =
      "set multiplot\nset border 11 lw 0.8 lc rgb \"#404040\"\nunset grid\nunset key\nset xtics "
      "1\nset ytics 1\nset xrange [" +
      plot_number(layout.from) + ":" + plot_number(layout.to) + "]\n";
  double top = layout.top;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    top += layout.row_gap;
    const double bottom = top + heights[r] * layout.scale();
    const bool is_last = r + 1 == rows.size();
    figure.script += "set yrange [0:" + plot_number(heights[r]) + "]\n";
    for (std::size_t c = 0; c < runs.size(); ++c) {
      const double left = layout.left + double(c) * (layout.panel_width + layout.column_gap);
      figure.script +=
          "set lmargin at screen " + across(left) + "\nset rmargin at screen " +
          across(left + layout.panel_width) + "\nset tmargin at screen " + down(top) +
          "\nset bmargin at screen " + down(bottom) + "\n" +
          (is_last ? "set format x \"%g\"\nset xlabel \"{/:Italic x}/{/:Italic L}\" offset 0,0.5\n"
                   : "set format x \"\"\nunset xlabel\n") +
          (c == 0 ? "set format y \"%g\"\nset ylabel \"{/:Italic y}/{/:Italic L}\" offset 0.8\n"
                  : "set format y \"\"\nunset ylabel\n");
      if (c == 0)
        figure.script +=
            "set label 1 \"{/:Italic t} = " + fixed_text(times[r].value(), 2) +
            " s,  {/:Italic T} = " + fixed_text(scales.dimensionless(times[r]).value(), 2) +
            "\" at graph 0,1 left offset 0,character 1.45\n";
      if (r == 0)
        figure.script += "set label 4 " + plot_label(label_in_two_lines(runs[c]->label())) +
                         " at graph 0.5,1 center offset 0,character 3.6 font \",7.5\"\n";
      figure.script += solid_objects(solids, times[r]);
      const DifferencePanel& panel = rows[r][c];
      if (!panel.found) {
        figure.script += missing_panel(panel.missing, layout.panel_width);
      } else {
        const std::string name = "differences_" + std::to_string(r) + "_" + std::to_string(c);
        const double pixel = 1.0 / (11.0 * layout.scale());
        figure.images.push_back({name, picture_of(*panel.found, scale, layout, heights[r])});
        figure.script +=
            "set label 2 \"" + fixed_text(panel.found->size() / (length * length), 3) +
            " {/:Italic L}²" + (panel.found->part() ? ", " + per_cent(*panel.found->part()) : "") +
            "\" at graph 1,1 right offset 0,character 0.5\nplot \"" + name +
            ".png\" binary filetype=png origin=(" + plot_number(layout.from + 0.5 * pixel) + "," +
            plot_number(0.5 * pixel) + ") dx=" + plot_number(pixel) + " dy=" + plot_number(pixel) +
            " with rgbalpha notitle\n";
      }
      figure.script += "unset label\nunset object\n";
    }
    top = bottom;
  }
  // The legend.
  figure.script +=
      "unset border\nunset tics\nunset xlabel\nunset ylabel\nset lmargin at screen 0\nset rmargin "
      "at screen 1\nset xrange [0:1]\nset yrange [0:1]\nset key at screen 0.5," +
      down(figure.height_mm - 4.5) +
      " center horizontal maxrows 1 Left reverse samplen 1.5\nplot 1/0 notitle";
  for (const auto& [colour, words] : {std::pair{only_run, std::string("only the run")},
                                      std::pair{only_reference, std::string("only the reference")},
                                      std::pair{both, std::string("both")}})
    figure.script += ", \\\n     keyentry with boxes fs solid 1 noborder fc rgb \"" + colour.hex() +
                     "\" title " + plot_string(words);
  figure.script += "\nunset multiplot\n";
  figure.caption = "Water of each run beside that of " + study.reference().label() +
                   ", in squares as coarse as the coarser of the two; a square is water where it "
                   "is at least half full. Over each panel the area that only one of the two "
                   "covers, and that area over the reference’s water. From the least to the most "
                   "over these times: ";
  std::string ranges;
  for (std::size_t c = 0; c < runs.size(); ++c)
    if (!parts[c].empty())
      ranges += (ranges.empty() ? "" : "; ") + range_of(runs[c]->label(), parts[c]);
  figure.caption += (ranges.empty() ? "not known" : ranges) + ".";
  figure.tables.push_back(std::move(table));
  std::vector<Figure> figures;
  figures.push_back(std::move(figure));
  return figures;
}

}  // namespace surge::compare
