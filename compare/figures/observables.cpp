#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>

#include "compare/figures/figures.hpp"
#include "compare/figures/style.hpp"
#include "compare/study/observable_verdicts.hpp"
#include "compare/study/sequences.hpp"

namespace surge::compare {
namespace {

constexpr std::size_t most_bins = 500;   ///< of a curve in a figure: two points each
constexpr std::size_t band_points = 25;  ///< at which the uncertainty of a run is found

/// Least and largest value of each bin, in their order: a peak is never left out.
Curve thinned(const Curve& curve) {
  if (curve.first.size() <= 2 * most_bins) return curve;
  Curve out;
  const double begin = curve.first.front(), length = curve.first.back() - begin;
  for (std::size_t i = 0; i < curve.first.size();) {
    const auto bin = [&](std::size_t k) {
      return static_cast<std::size_t>((curve.first[k] - begin) / length * most_bins);
    };
    std::size_t low = i, high = i, end = i;
    for (; end < curve.first.size() && bin(end) == bin(i); ++end) {
      if (curve.value[end] < curve.value[low]) low = end;
      if (curve.value[end] > curve.value[high]) high = end;
    }
    for (const std::size_t k : {std::min(low, high), std::max(low, high)}) {
      if (!out.first.empty() && out.first.back() == curve.first[k]) continue;
      out.first.push_back(curve.first[k]);
      out.value.push_back(curve.value[k]);
    }
    i = end;
  }
  return out;
}

/// One that a file and an SVG element can have.
std::string file_name(const std::string& key) {
  std::string name = "observable_" + key;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name;
}

/// What stands at the axis: what is measured, with its unit.
std::string axis_label(const StudyObservable& asked, const ObservedQuantity& quantity) {
  static const std::map<std::string, std::string> words{{"gauge", "height"},
                                                        {"profile", "height"},
                                                        {"column-height", "height"},
                                                        {"front", "leading edge"}};
  const auto found = words.find(asked.kind);
  std::string text = found != words.end() ? found->second : asked.kind;
  std::replace(text.begin(), text.end(), '-', ' ');
  if (!quantity.component.empty()) text += ", " + quantity.component;
  return plot_string(quantity.unit == "1" ? text : text + " [" + quantity.unit + "]");
}

class ObservableDrawing {
 public:
  ObservableDrawing(const StudyResult& study, const ObservedQuantity& quantity)
      : study_(study), quantity_(quantity) {
    figure_.name = file_name(quantity.key);
    figure_.title = quantity.title;
    table_ = {
        figure_.name, {"curve", quantity.is_profile() ? "x_m" : "t_s", "value", "low", "high"}, {}};
  }

  Figure made() {
    add_runs();
    add_series();
    if (lines_.empty()) {
      figure_.missing = "No run has two values of it, and nothing was published of this case.";
      return std::move(figure_);
    }
    figure_.caption = caption();
    figure_.x_label = quantity_.is_profile() ? "x, m" : "t, s";
    figure_.y_label =
        quantity_.unit == "1" ? quantity_.title : quantity_.title + ", " + quantity_.unit;
    figure_.height_mm = 62.0 + 3.9 * static_cast<double>(legend_);
    const std::string ranges = range();
    figure_.tables.push_back(std::move(table_));
    const std::string screen = fixed_text(1.0 - 57.0 / figure_.height_mm, 4);
    figure_.script =
        "set lmargin at screen 0.225\nset rmargin at screen 0.97\nset tmargin at screen " +
        fixed_text(1.0 - 2.5 / figure_.height_mm, 4) + "\nset bmargin at screen " +
        fixed_text(1.0 - 46.0 / figure_.height_mm, 4) + "\nset key at screen 0.05," + screen +
        " left top vertical maxcols 1 Left reverse\nset format y \"%g\"\nset xlabel \"" +
        (quantity_.is_profile() ? "{/:Italic x} [m]" : "{/:Italic t} [s]") +
        "\" offset 0,0.4\nset ylabel " +
        axis_label(study_.observables[quantity_.observable], quantity_) + " offset 1.2\n" + ranges +
        plots();
    return std::move(figure_);
  }

 private:
  [[nodiscard]] std::string rows(const std::string& curve, const std::string& columns) const {
    return plotted_rows(table_, {curve}) + " using 2:" + columns;
  }
  void line(const std::string& plot) { lines_.push_back(plot); }

  void add_runs() {
    std::size_t index = 0;
    for (const RunResult* run : study_.measured()) {
      const bool reference = run == &study_.reference();
      const LineStyle style = reference ? reference_style() : run_style(index);
      if (!reference) ++index;
      const Curve curve = curve_of(quantity_, *run->measured).curve;
      if (curve.first.size() < 2) continue;
      const std::string& name = run->study.name;
      end_ = std::max(end_, curve.first.back());
      const Curve shown = thinned(curve);
      for (std::size_t i = 0; i < shown.first.size(); ++i)
        table_.add({name, shown.first[i], shown.value[i], shown.value[i], shown.value[i]});
      add_band(*run, curve, style);
      line(rows(name, "3") + " with lines " + line_spec(style, reference ? 1.5 : 1.3) + " title " +
           plot_string(run->label()));
      figure_.curves.push_back(
          {figure_.name, name, table_.columns[1], "value", run->label(), style.colour.hex()});
      ++legend_;
    }
  }

  /// Where refinements of the run say what its uncertainty is.
  void add_band(const RunResult& run, const Curve& curve, const LineStyle& style) {
    const std::string name = run.study.name + " band";
    bool any = false;
    for (std::size_t k = 0; k < band_points; ++k) {
      const double part = static_cast<double>(k) / static_cast<double>(band_points - 1);
      const double x = curve.first.front() + part * (curve.first.back() - curve.first.front());
      const auto u = curve_uncertainty(study_, quantity_, run, x);
      const auto y = curve.at(x);
      if (!u || !y) continue;
      table_.add({name, x, *y, *y - coverage * *u, *y + coverage * *u});
      any = true;
    }
    if (!any) return;
    line(rows(name, "4:5") + " with filledcurves fs transparent solid 0.18 noborder fc rgb \"" +
         style.colour.hex() + "\" notitle");
    bands_ = true;
  }

  void add_series() {
    std::size_t index = 0;
    for (const ReferenceSeries* series : series_of(study_, quantity_)) {
      const LineStyle style = published_style(index++);
      const Physics& physics = study_.reference_run().run.physics;
      if (other_case(*series, physics)) continue;
      const ReferenceCurve data = curve_for(*series, physics, quantity_.unit);
      const std::string name = "series " + series->name;
      later_ = later_ || is_later(data.first.back());
      for (std::size_t i = 0; i < data.first.size(); ++i)
        table_.add({name, data.first[i], data.value[i], data.value[i] - data.limit[i],
                    data.value[i] + data.limit[i]});
      if (series->kind == ReferenceKind::experiment) {
        line(rows(name, "3:4:5") + " with yerrorbars " + point_spec(style, 0.45) + " title " +
             plot_string(series->label));
      } else {
        line(rows(name, "3") + " with lines " + line_spec({style.colour, "'.-'"}, 1.6) + " title " +
             plot_string(series->label));
      }
      figure_.curves.push_back({figure_.name, name, table_.columns[1], "value", series->label,
                                style.colour.hex(), series->kind == ReferenceKind::experiment});
      ++legend_;
      published_ = true;
    }
  }

  /// Whether a time is after the end of all runs, with what the last marker needs.
  [[nodiscard]] bool is_later(double x) const {
    return !quantity_.is_profile() && std::isfinite(end_) && x > 1.02 * end_;
  }

  /// Of the curves and the published values while there are runs: a band may be as wide as it
  /// likes.
  [[nodiscard]] std::string range() const {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const auto& row : table_.rows) {
      const std::string& name = std::get<std::string>(row[0]);
      if (name.ends_with(" band") || is_later(std::get<double>(row[1]))) continue;
      low = std::min(low, std::get<double>(row[3]));
      high = std::max(high, std::get<double>(row[4]));
    }
    if (!std::isfinite(low)) return "";
    // A value that hardly changes is shown as what it is, and not as its rounding.
    const double least = std::max(1e-3 * std::max(std::abs(low), std::abs(high)), 1e-12);
    const double margin = std::max(0.08 * (high - low), least);
    const std::string x = later_ ? "set xrange [*:" + plot_number(1.02 * end_) + "]\n" : "";
    return x + "set yrange [" + plot_number(low - margin) + ":" + plot_number(high + margin) +
           "]\n";
  }

  [[nodiscard]] std::string plots() const {
    std::string text;
    // Bands lie under the lines.
    for (const bool band : {true, false})
      for (const std::string& one : lines_)
        if ((one.find("filledcurves") != std::string::npos) == band)
          text += (text.empty() ? "plot " : ", \\\n     ") + one;
    return text + "\n";
  }

  [[nodiscard]] std::string caption() const {
    std::string text = quantity_.is_profile()
                           ? "Height of the water above the floor over x, of the frame nearest to "
                             "this time."
                           : "Over the time t; measured by one rule in all runs.";
    if (bands_) text += " Bands: 95 % interval that follows from refining the run.";
    if (published_) text += " Markers: published values, with their 95 % limits as bars.";
    if (later_) text += " What was published after the runs' end stands in the file alone.";
    return text;
  }

  const StudyResult& study_;
  const ObservedQuantity& quantity_;
  Figure figure_;
  Table table_;
  std::vector<std::string> lines_;
  std::size_t legend_ = 0;
  double end_ = -std::numeric_limits<double>::infinity();  ///< of the run that goes on longest
  bool bands_ = false, published_ = false;
  bool later_ = false;  ///< published values after that
};

}  // namespace

std::vector<Figure> observable_figures(const StudyResult& study) {
  std::vector<Figure> figures;
  for (const ObservedQuantity& quantity : observed_quantities(study))
    figures.push_back(ObservableDrawing(study, quantity).made());
  return figures;
}

}  // namespace surge::compare
