#include <algorithm>
#include <array>
#include <cmath>

#include "compare/figures/figures.hpp"
#include "compare/figures/solids.hpp"
#include "compare/figures/style.hpp"
#include "compare/measure/stated.hpp"
#include "particle/support/bounds.hpp"

namespace surge::compare {
namespace {

constexpr double margin_mm = 6.0, line_mm = 3.9;

/// One view of the case along an axis, drawn to scale.
class View {
 public:
  View(const Run& run, std::size_t upright, double top_mm, double height_mm)
      : physics_(run.physics), up_(upright), top_(top_mm), figure_(height_mm) {
    outline_ = physics_.tank.value_or(physics_.column);
    for (const std::size_t a : {std::size_t{0}, up_}) {
      lower_[a] = std::isfinite(outline_.lower[a]) ? outline_.lower[a] : physics_.column.lower[a];
      upper_[a] =
          std::isfinite(outline_.upper[a]) ? outline_.upper[a] : 1.5 * physics_.column.upper[a];
    }
    // A high tank has nothing in its upper part.
    if (is_side()) {
      double needed = 0.0;
      for (const WaterBody& body : physics_.blocks.value_or(std::vector<WaterBody>{}))
        needed = std::max(needed, body.box.upper[up_] - lower_[up_]);
      needed = std::max(needed, physics_.column.upper[up_] - lower_[up_]);
      for (const SolidBody& box : physics_.obstacles.value_or(std::vector<SolidBody>{}))
        needed = std::max(needed, box.upper[up_] - lower_[up_]);
      cut_ = upper_[up_] > lower_[up_] + 1.35 * needed;
      if (cut_) upper_[up_] = lower_[up_] + 1.35 * needed;
    }
  }

  [[nodiscard]] double height_mm() const {
    return std::max(8.0, width_mm * (upper_[up_] - lower_[up_]) / (upper_[0] - lower_[0]));
  }

  [[nodiscard]] std::string script(const std::vector<StatedPlace>& marked,
                                   std::size_t probes) const {
    const auto screen = [&](double mm) { return plot_number(1.0 - mm / figure_); };
    std::string text = "unset object\nunset arrow\nunset label\nset tmargin at screen " +
                       screen(top_) + "\nset bmargin at screen " + screen(top_ + height_mm()) +
                       "\nset xrange [" + plot_number(lower_[0]) + ":" + plot_number(upper_[0]) +
                       "]\nset yrange [" + plot_number(lower_[up_]) + ":" +
                       plot_number(upper_[up_]) + "]\n" + water() + solids() + walls();
    std::vector<std::array<double, 2>> taken;
    for (std::size_t k = 0; k < marked.size(); ++k)
      text += mark(marked[k].place, std::to_string(k + 1), k >= probes && is_side(), taken);
    return text + "plot 1/0 notitle\n";
  }

  static constexpr double width_mm = single_column_mm - 2.0 * margin_mm;

 private:
  [[nodiscard]] bool is_side() const {
    return up_ == static_cast<std::size_t>(physics_.vertical_axis());
  }
  [[nodiscard]] std::string at(double x, double y) const {
    return plot_number(x) + "," + plot_number(y);
  }
  [[nodiscard]] std::string rectangle(const Vec3& lower, const Vec3& upper,
                                      const std::string& style) const {
    return "set object rectangle from " + at(lower[0], lower[up_]) + " to " +
           at(upper[0], std::min(upper[up_], upper_[up_])) + " " + style + "\n";
  }
  [[nodiscard]] std::string line(double x0, double y0, double x1, double y1,
                                 const std::string& style) const {
    return "set arrow from " + at(x0, y0) + " to " + at(x1, y1) + " " + style + "\n";
  }

  [[nodiscard]] std::string water() const {
    std::string text;
    const std::string style = "fc rgb \"#9fd0ee\" fs solid 1 border lc rgb \"#0072b2\" lw 1 behind";
    for (const WaterBody& body :
         physics_.blocks.value_or(std::vector<WaterBody>{{"box", physics_.column, {}}})) {
      if (body.shape == "box") {
        text += rectangle(body.box.lower, body.box.upper, style);
        continue;
      }
      text += "set object ellipse center " +
              at(0.5 * (body.box.lower[0] + body.box.upper[0]),
                 0.5 * (body.box.lower[up_] + body.box.upper[up_])) +
              " size " +
              at(body.box.upper[0] - body.box.lower[0], body.box.upper[up_] - body.box.lower[up_]) +
              " " + style + "\n";
    }
    return text;
  }

  /// A polygon; of a surface in space all that can be seen, triangle by triangle, or its box where
  /// they are many.
  [[nodiscard]] std::string body(const ClosedSurface& surface, const std::string& style) const {
    constexpr std::size_t most_drawn = 500;
    if (surface.facets().size() > most_drawn && surface.dimension() == 3)
      return rectangle(surface.bounds().lower, surface.bounds().upper, style);
    const auto corner = [&](std::uint32_t v) {
      const Point& x = surface.vertices()[v];
      return std::array<double, 2>{x[0], x[up_]};
    };
    std::string text;
    Outline outline;
    for (const ClosedSurface::Facet& f : surface.facets()) {
      outline.push_back(corner(f[0]));
      if (surface.dimension() == 2) continue;
      text += outline_object({corner(f[0]), corner(f[1]), corner(f[2])},
                             "fc rgb \"#8a8a8a\" fs solid 1 border lc rgb \"#8a8a8a\" lw 0.5");
      outline.clear();
    }
    return outline.empty() ? text : outline_object(outline, style);
  }

  [[nodiscard]] std::string solids() const {
    std::string text;
    const std::string grey = "fc rgb \"#8a8a8a\" fs solid 1 border lc rgb \"#303030\" lw 1";
    for (const SolidBody& box : physics_.obstacles.value_or(std::vector<SolidBody>{}))
      text += box.surface ? body(*box.surface, grey) : rectangle(box.lower, box.upper, grey);
    if (!physics_.moving_walls || !physics_.moving_walls->is_array()) return text;
    for (const nlohmann::json& wall : *physics_.moving_walls) {
      if (!wall.contains("lower") || !wall.contains("upper")) continue;
      const Vec3 lower = wall.at("lower").get<Vec3>(), upper = wall.at("upper").get<Vec3>();
      text +=
          rectangle(lower, upper, "fc rgb \"#e69f00\" fs solid 1 border lc rgb \"#303030\" lw 1");
      const Vec3 direction = wall.value("direction", Vec3{});
      const double reach = 0.15 * (upper_[0] - lower_[0]);
      const double x = 0.5 * (lower[0] + upper[0]);
      const double y = 0.5 * (lower[up_] + std::min(upper[up_], upper_[up_]));
      text += line(x, y, x + reach * direction[0], y + reach * direction[up_],
                   "head filled front lw 1.2 lc rgb \"#303030\"");
    }
    return text;
  }

  /// Sides without a wall are dotted; one that is cut off is not drawn.
  [[nodiscard]] std::string walls() const {
    const auto style = [&](std::size_t axis, char sign) {
      const std::string side = std::string(1, "xyz"[axis]) + sign;
      const bool open = (physics_.open && physics_.open->contains(side)) ||
                        (physics_.periodic && physics_.periodic->contains(side.substr(0, 1))) ||
                        !physics_.tank;
      return std::string("nohead front lc rgb \"#303030\" ") + (open ? "lw 0.8 dt '.'" : "lw 2.2");
    };
    const double x0 = lower_[0], x1 = upper_[0], y0 = lower_[up_], y1 = upper_[up_];
    std::string text = line(x0, y0, x1, y0, style(up_, '-')) + line(x0, y0, x0, y1, style(0, '-')) +
                       line(x1, y0, x1, y1, style(0, '+'));
    if (!cut_) text += line(x0, y1, x1, y1, style(up_, '+'));
    return text;
  }

  /// A number beside its place; above those that it would lie over (`taken`, mm), with a line to
  /// its place.
  [[nodiscard]] std::string mark(const Vec3& place, const std::string& number, bool gauge,
                                 std::vector<std::array<double, 2>>& taken) const {
    const double mm = (upper_[0] - lower_[0]) / width_mm;
    const std::string colour = "textcolor rgb \"#a34400\"";
    const double y = gauge ? upper_[up_] - 0.08 * (upper_[up_] - lower_[up_])
                           : std::clamp(place[up_], lower_[up_], upper_[up_]);
    const bool to_the_left = place[0] > 0.9 * upper_[0];
    const double x = place[0] + (to_the_left ? -1.2 : 1.2) * mm;
    const double free_y = free_place(x / mm, y / mm, taken) * mm;
    std::string text;
    if (gauge)
      text += line(place[0], lower_[up_], place[0], upper_[up_],
                   "nohead front lw 1 lc rgb \"#d55e00\" dt '-'");
    if (free_y > y + 0.1 * mm)
      text += line(place[0], y, x, free_y, "nohead front lw 0.4 lc rgb \"#d55e00\"");
    if (!gauge)
      text +=
          "set label \"\" at " + at(place[0], y) + " front point pt 7 ps 0.35 lc rgb \"#d55e00\"\n";
    return text + "set label " + plot_string(number) + " at " + at(x, free_y) +
           (to_the_left ? " right" : " left") + " front font \",6.5\" " + colour + "\n";
  }

  /// The height, mm, at or above y where a number lies over none of the others; it is taken then.
  static double free_place(double x, double y, std::vector<std::array<double, 2>>& taken) {
    constexpr double wide = 3.5, high = 2.7;  // of two digits of 6.5 pt
    const auto over = [&](const std::array<double, 2>& other) {
      return std::abs(other[0] - x) < wide && std::abs(other[1] - y) < high;
    };
    for (auto other = std::find_if(taken.begin(), taken.end(), over); other != taken.end();
         other = std::find_if(taken.begin(), taken.end(), over))
      y = (*other)[1] + 1.001 * high;
    taken.push_back({x, y});
    return y;
  }

  const Physics& physics_;
  std::size_t up_;
  double top_, figure_;
  Extent outline_;
  Vec3 lower_{}, upper_{};
  bool cut_ = false;
};

std::string metres(double value) {
  return number_text(std::round(1e5 * value) / 1e5);
}

std::string size_of(const Extent& box, const std::vector<std::size_t>& axes) {
  std::string text;
  for (const std::size_t a : axes)
    text += (text.empty() ? "" : " x ") + metres(box.upper[a] - box.lower[a]);
  return text + " m";
}

/// What the drawing shows, in words with numbers.
std::string shape_of(const SolidBody& solid) {
  if (!solid.surface) return {};
  const std::size_t count = solid.surface->facets().size();
  return solid.surface->dimension() == 2 ? "of " + std::to_string(count) + " edges within "
                                         : "of " + std::to_string(count) + " triangles within ";
}

std::vector<std::string> legend_of(const Run& run, const std::vector<StatedPlace>& marked,
                                   std::size_t probes) {
  const Physics& physics = run.physics;
  const FrameView view(physics, run.spacing);
  std::vector<std::string> lines;
  if (physics.tank) lines.push_back("tank " + size_of(*physics.tank, view.axes()));
  for (const WaterBody& body : physics.blocks.value_or(std::vector<WaterBody>{}))
    lines.push_back("water " + size_of(body.box, view.axes()));
  for (const SolidBody& box : physics.obstacles.value_or(std::vector<SolidBody>{}))
    lines.push_back("obstacle " + shape_of(box) + size_of(box, view.axes()) +
                    " from x = " + metres(box.lower[0]) + " m");
  lines.push_back("g = " + fixed_text(physics.gravity_magnitude(), 2) + " m/s²");
  if (physics.motion && !physics.motion->is_null())
    lines.push_back("the tank moves: " + physics.motion->value("kind", "") + ", " +
                    physics.motion->value("law", ""));
  for (std::size_t k = 0; k < marked.size(); ++k) {
    std::string text = std::to_string(k + 1);
    text.append(k < probes ? "  probe " : "  gauge ").append(marked[k].name).append(1, ':');
    for (const std::size_t a : view.axes())
      if (k < probes || a != view.up())
        text.append(1, ' ').append(1, "xyz"[a]).append(" = ").append(metres(marked[k].place[a]));
    lines.push_back(text.append(" m"));
  }
  return lines;
}

}  // namespace

Figure setup_figure(const StudyResult& study) {
  const Run& run = study.reference_run().run;
  std::vector<StatedPlace> marked = stated_places(run, "probes");
  const std::size_t probes = marked.size();
  for (StatedPlace& gauge : stated_places(run, "gauges")) marked.push_back(std::move(gauge));
  const auto up = static_cast<std::size_t>(run.physics.vertical_axis());
  const std::vector<std::string> legend = legend_of(run, marked, probes);
  std::vector<std::size_t> views{up};
  if (run.physics.dimension == 3) views.push_back(3 - up);

  Figure figure;
  figure.name = "fig6";
  figure.title = "Set-up";
  figure.caption = "Drawn from the case of " + run.name +
                   (views.size() > 1 ? ", from the side and from above." : ".") +
                   " Blue: water at the start; grey: obstacles; orange: walls that move; dotted: "
                   "open sides. Lengths in m.";
  double height = 2.0;
  for (const std::size_t view : views) height += View(run, view, 0.0, 1.0).height_mm() + 3.0;
  figure.height_mm = height + line_mm * static_cast<double>(legend.size()) + 2.0;
  figure.script =
      "unset border\nunset tics\nunset grid\nunset key\nset multiplot\nset lmargin at screen " +
      plot_number(margin_mm / single_column_mm) + "\nset rmargin at screen " +
      plot_number(1.0 - margin_mm / single_column_mm) + "\n";
  double top = 2.0;
  for (const std::size_t view : views) {
    const View drawn(run, view, top, figure.height_mm);
    figure.script += drawn.script(marked, probes);
    top += drawn.height_mm() + 3.0;
  }
  figure.script += "unset object\nunset arrow\nunset label\n";
  Table table{"fig6", {"number", "name", "x_m", "y_m", "z_m"}, {}};
  for (std::size_t k = 0; k < marked.size(); ++k)
    table.add({static_cast<double>(k + 1), marked[k].name, marked[k].place[0], marked[k].place[1],
               marked[k].place[2]});
  for (std::size_t k = 0; k < legend.size(); ++k)
    figure.script +=
        "set label " + plot_label(legend[k]) + " at screen " +
        plot_number(margin_mm / single_column_mm) + "," +
        plot_number(1.0 - (top + line_mm * (static_cast<double>(k) + 0.5)) / figure.height_mm) +
        " left font \",6.5\"\n";
  figure.script +=
      "set tmargin at screen 0.02\nset bmargin at screen 0.01\nplot 1/0 notitle\nunset multiplot\n";
  figure.tables.push_back(std::move(table));
  return figure;
}

}  // namespace surge::compare
