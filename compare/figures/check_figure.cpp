#include "compare/figures/check_figure.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "compare/figures/gnuplot.hpp"
#include "compare/figures/style.hpp"
#include "particle/support/error.hpp"
#include "particle/support/write_error.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

constexpr double panel_mm = 55.0;

/// A folder of its own among the temporary ones, removed at the end.
class Workshop {
 public:
  Workshop() {
    std::string pattern = (fs::temp_directory_path() / "surge-check-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw write_error(pattern);
    path_ = pattern;
  }
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;
  ~Workshop() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// Rows kind, place, value, lower, upper.
Table table_of(const BaselineComparison& curve, std::size_t index) {
  Table table{"curve" + std::to_string(index), {"kind", "place", "value", "lower", "upper"}, {}};
  const BaselineCurve& expected = curve.expected;
  for (std::size_t i = 0; i < expected.at.size(); ++i) {
    const double value = expected.values[i], off = expected.tolerance.of(value);
    table.add({"expected", expected.at[i], value, value - off, value + off});
  }
  const auto worst = std::find(expected.at.begin(), expected.at.end(), curve.worst);
  if (worst != expected.at.end()) {
    const double value = expected.values[static_cast<std::size_t>(worst - expected.at.begin())];
    table.add({"worst", *worst, value, value, value});
  }
  for (std::size_t i = 0; i < curve.at.size(); ++i)
    table.add({"found", curve.at[i], curve.values[i], curve.values[i], curve.values[i]});
  return table;
}

/// The rows of one kind as a function of gnuplot's columns.
std::string rows(const std::string& file, const std::string& kind, const std::string& columns) {
  return plot_string(file) + " using (strcol(1) eq \"" + kind + "\" ? column(2) : NaN):" + columns;
}

std::string panel(const BaselineComparison& curve, std::size_t index) {
  const std::string file = "curve" + std::to_string(index) + ".csv";
  const BaselineCurve& expected = curve.expected;
  const std::string unit = expected.unit == "1" ? "" : ", " + expected.unit;
  std::string script = "set title " + plot_string(expected.name()) + " noenhanced\nset xlabel " +
                       plot_string(expected.time ? "position, m" : "time, s") + "\nset ylabel " +
                       plot_string("value" + unit) + " noenhanced\nplot ";
  script += rows(file, "expected", "4:5") +
            " with filledcurves fc rgb \"#d0d0d0\" fs solid 0.7 noborder title \"tolerance\", ";
  script += rows(file, "expected", "3") + " with lines " + line_spec(reference_style(), 1.0) +
            " title \"baseline\", ";
  script += rows(file, "found", "3") + " with linespoints pt 7 ps 0.2 " +
            line_spec(run_style(0), 1.2) + " title \"found\", ";
  script += rows(file, "worst", "3") +
            " with points pt 6 ps 1.2 lw 1.2 lc rgb \"#d55e00\" title \"worst\"\n";
  return script;
}

}  // namespace

std::string draw_check(const std::vector<BaselineComparison>& curves, const fs::path& file) {
  if (curves.empty())
    throw Error(file.string() + ": found no curve that could be drawn, expected one at least");
  Figure figure;
  figure.name = "check";
  figure.title = "What was found over what the baseline expects";
  figure.width_mm = double_column_mm;
  figure.height_mm = panel_mm * static_cast<double>(curves.size());
  figure.script = "set multiplot layout " + std::to_string(curves.size()) + ",1\n";
  for (std::size_t k = 0; k < curves.size(); ++k) {
    figure.tables.push_back(table_of(curves[k], k));
    figure.script += panel(curves[k], k);
  }
  figure.script += "unset multiplot\n";
  const Workshop folder;
  std::string warnings = draw(figure, folder.path());
  errno = 0;
  std::ifstream in(folder.path() / "check.svg", std::ios::binary);
  std::ofstream out(file, std::ios::binary);
  out << in.rdbuf();
  out.close();
  if (!out) throw write_error(file);
  return warnings;
}

}  // namespace surge::compare
