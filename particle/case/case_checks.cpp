#include "particle/case/case_checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "particle/case/divisions.hpp"
#include "particle/case/enum_names.hpp"
#include "particle/case/surface_checks.hpp"

namespace surge {

namespace {

constexpr std::array<const char*, 3> axis{"x", "y", "z"};
constexpr double relative_tolerance = 1e-9;
constexpr double most_frames = 1e6;
constexpr double most_steps = 1e12;
constexpr double most_along_an_axis = 2e9;  ///< cells are numbered in 32 bits
constexpr std::size_t most_bodies = 5000;

std::string indexed(const char* table, std::size_t i) {
  return std::string(table) + "." + std::to_string(i);
}

/// Distance between the surfaces of two bodies of fluid or solid; negative where they overlap.
struct Body {
  Box box;
  bool ball = false;

  [[nodiscard]] double centre(std::size_t a) const { return 0.5 * (box.lower[a] + box.upper[a]); }
  [[nodiscard]] double radius() const { return ball ? 0.5 * (box.upper[0] - box.lower[0]) : 0.0; }
  [[nodiscard]] double lower(std::size_t a) const { return ball ? centre(a) : box.lower[a]; }
  [[nodiscard]] double upper(std::size_t a) const { return ball ? centre(a) : box.upper[a]; }
};

/// A ball is a point with a radius, a box has extent and no radius: one formula serves all pairs.
double gap(const Body& a, const Body& b, std::size_t dimension) {
  double square = 0.0;
  double deepest = -std::numeric_limits<double>::infinity();
  for (std::size_t d = 0; d < dimension; ++d) {
    const double apart = std::max(a.lower(d) - b.upper(d), b.lower(d) - a.upper(d));
    square += std::pow(std::max(apart, 0.0), 2);
    deepest = std::max(deepest, apart);
  }
  return (square > 0.0 ? std::sqrt(square) : std::min(deepest, 0.0)) - a.radius() - b.radius();
}

/// Finds faults in a case and says where they stand in the file.
class Checker {
 public:
  Checker(const Case& c, const TomlTable& root)
      : case_(c), root_(root), dimension_(static_cast<std::size_t>(c.dimension)) {}

  void check() const {
    check_time();
    if (case_.blocks.empty()) throw root_.error("block", "no fluid", "at least one [[block]]");
    if (case_.has_tank) check_tank();
    check_bodies("block");
    check_bodies("obstacle");
    check_bodies("moving_wall");
    check_moving_walls();
    check_overlaps();
    check_surface_overlaps(case_, root_);
    check_instruments(case_, root_);
  }

 private:
  void check_time() const {
    if (case_.time.initial_step > case_.time.maximum_step) {
      throw root_.table("time").error(
          "initial_step", number_text(case_.time.initial_step),
          "at most time.maximum_step = " + number_text(case_.time.maximum_step));
    }
    // Frames and steps are counted in whole numbers.
    const double steps = case_.time.end / case_.time.maximum_step;
    if (!(steps <= most_steps)) {
      throw root_.table("time").error(
          "end", number_text(case_.time.end) + " s, which takes " + number_text(steps) + " steps",
          "at most " + number_text(most_steps) + " steps of time.maximum_step");
    }
    const double frames = case_.time.end / case_.output_interval;
    if (!(frames <= most_frames)) {
      throw root_.table("output").error(
          "interval",
          number_text(case_.output_interval) + " s, which makes " + number_text(frames) + " frames",
          "at most " + number_text(most_frames) + " frames until time.end");
    }
  }

  /// The box has extent, and the spacing divides it.
  void check_extent(const TomlTable& table, const Box& box) const {
    for (std::size_t a = 0; a < dimension_; ++a) {
      const double extent = box.upper[a] - box.lower[a];
      const std::string from = std::string(axis[a]) + " from " + number_text(box.lower[a]) +
                               " to " + number_text(box.upper[a]);
      if (!(extent > 0.0)) throw table.error("upper", from, "upper above lower");
      const double count = extent / case_.spacing;
      if (!whole_spacings(extent, case_.spacing)) {
        throw table.error("upper",
                          from + ", " + number_text(std::round(count * 1e6) / 1e6) + " spacings",
                          division_advice(case_, extent));
      }
      if (count > most_along_an_axis) {
        throw table.error("upper", from + ", " + number_text(count) + " spacings",
                          "at most " + number_text(most_along_an_axis));
      }
    }
  }

  void check_tank() const {
    const TomlTable table = root_.table("tank");
    const Tank& tank = case_.tank;
    check_extent(table, tank.box);
    for (std::size_t a = 0; a < dimension_; ++a) {
      if (!tank.periodic[a]) continue;
      // What lies a period farther is a copy only where the axis of rotation passes through both.
      if (case_.motion.kind == TankMotion::Kind::rotation &&
          std::abs(case_.motion.direction[a]) < 1.0 - 1e-12) {
        throw table.error("periodic", std::string(axis[a]) + " in a tank that turns",
                          "a rotation about the periodic axis, or walls");
      }
      for (const std::size_t side : {2 * a, 2 * a + 1}) {
        if (!tank.open[side]) continue;
        const std::string name = axis[a] + std::string(side % 2 == 0 ? "-" : "+");
        throw table.error("open", '"' + name + '"',
                          "no open side on the periodic axis " + std::string(axis[a]));
      }
    }
  }

  void check_wave(const TomlTable& table, const FluidBlock& block) const {
    const std::string found = number_text(block.wave_amplitude) + " m";
    if (block.shape != FluidBlock::Shape::box)
      throw table.error("wave_amplitude", found + " on a ball", "a wave on a box");
    const Point& g = case_.gravity;
    if (!(g[0] == 0.0 && g[1] < 0.0 && g[2] == 0.0))
      throw table.error("wave_amplitude", found + " without gravity along -y", "gravity along -y");
  }

  [[nodiscard]] Box box_of(const std::string& kind, std::size_t i) const {
    return kind == "block"      ? case_.blocks[i].box
           : kind == "obstacle" ? case_.obstacles[i]
                                : case_.moving_walls[i].box;
  }

  void check_bodies(const std::string& kind) const {
    const std::vector<TomlTable> tables = root_.tables(kind);
    for (std::size_t i = 0; i < tables.size(); ++i) {
      const Box box = box_of(kind, i);
      if (case_.has_tank) check_inside(tables[i], kind, box);
      if (kind == "obstacle" && case_.obstacles[i].surface) continue;
      check_extent(tables[i], box);
      if (kind == "block" && case_.blocks[i].shape == FluidBlock::Shape::ball)
        check_ball(tables[i], box);
      if (kind == "block" && case_.blocks[i].wave_amplitude > 0.0)
        check_wave(tables[i], case_.blocks[i]);
    }
  }

  void check_inside(const TomlTable& table, const std::string& kind, const Box& box) const {
    const Box& tank = case_.tank.box;
    const double slack = relative_tolerance * case_.spacing;
    for (std::size_t a = 0; a < dimension_; ++a) {
      const std::string inside = "the " + kind + " inside the tank, ";
      const std::string key = place_key(table);
      if (box.lower[a] < tank.lower[a] - slack) {
        throw table.error(key, std::string(axis[a]) + " = " + number_text(box.lower[a]),
                          inside + "which begins at " + number_text(tank.lower[a]));
      }
      if (box.upper[a] > tank.upper[a] + slack) {
        throw table.error(key == "lower" ? "upper" : key,
                          std::string(axis[a]) + " = " + number_text(box.upper[a]),
                          inside + "which ends at " + number_text(tank.upper[a]));
      }
    }
  }

  void check_ball(const TomlTable& table, const Box& box) const {
    const double side = box.upper[0] - box.lower[0];
    for (std::size_t a = 1; a < dimension_; ++a) {
      if (std::abs(box.upper[a] - box.lower[a] - side) > relative_tolerance * side) {
        throw table.error("upper",
                          "sides of " + number_text(side) + " and " +
                              number_text(box.upper[a] - box.lower[a]) + " m",
                          "equal sides around a ball");
      }
    }
  }

  void check_moving_walls() const {
    std::set<std::string> names;
    for (std::size_t i = 0; i < case_.moving_walls.size(); ++i) {
      const std::string& name = case_.moving_walls[i].name;
      const TomlTable table = root_.tables("moving_wall")[i];
      const bool taken = name.starts_with("obstacle.") ||
                         std::count(side_names.begin(), side_names.end(), name) > 0;
      if (name.empty() || taken)
        throw table.error("name", '"' + name + '"', "a name that is no side and no obstacle");
      if (!names.insert(name).second)
        throw table.error("name", '"' + name + "\" twice", "different names");
    }
  }

  /// Bodies may touch and not overlap: two particles in one place are not a flow.
  void check_overlaps() const {
    struct Place {
      const char* table;
      std::size_t index;
    };
    std::vector<Body> bodies;
    std::vector<Place> places;
    const auto add = [&](const Body& body, const char* table, std::size_t index) {
      bodies.push_back(body);
      places.push_back({table, index});
    };
    for (std::size_t i = 0; i < case_.blocks.size(); ++i) {
      const FluidBlock& block = case_.blocks[i];
      add({block.box, block.shape == FluidBlock::Shape::ball}, "block", i);
    }
    for (std::size_t i = 0; i < case_.obstacles.size(); ++i)
      if (!case_.obstacles[i].surface) add({case_.obstacles[i]}, "obstacle", i);
    for (std::size_t i = 0; i < case_.moving_walls.size(); ++i)
      add({case_.moving_walls[i].box}, "moving_wall", i);
    if (bodies.size() > most_bodies) {
      throw root_.error("block", std::to_string(bodies.size()) + " bodies",
                        "at most " + std::to_string(most_bodies));
    }
    const double slack = relative_tolerance * case_.spacing;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      for (std::size_t j = i + 1; j < bodies.size(); ++j) {
        if (gap(bodies[i], bodies[j], dimension_) >= -slack) continue;
        throw root_.tables(places[i].table)[places[i].index].error(
            "lower", "an overlap with " + indexed(places[j].table, places[j].index),
            "separate bodies");
      }
    }
  }

  const Case& case_;
  const TomlTable& root_;
  std::size_t dimension_;
};

}  // namespace

void check_case(const Case& c, const TomlTable& root) {
  Checker(c, root).check();
}

}  // namespace surge
