#include "particle/case/case_checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "particle/case/scales.hpp"

namespace surge {

namespace {

constexpr std::array<const char*, 3> axis{"x", "y", "z"};
constexpr double relative_tolerance = 1e-9;
constexpr double most_frames = 1e6;
constexpr double most_steps = 1e12;

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
    check_overlaps();
    check_probes();
    check_size();
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
      const double whole = std::round(count);
      if (whole < 1.0 || std::abs(count - whole) > relative_tolerance * whole) {
        throw table.error("upper",
                          from + ", " + number_text(std::round(count * 1e6) / 1e6) + " spacings",
                          "a whole number of spacings of " + number_text(case_.spacing) + " m");
      }
    }
  }

  void check_tank() const {
    const TomlTable table = root_.table("tank");
    const Tank& tank = case_.tank;
    check_extent(table, tank.box);
    for (std::size_t a = 0; a < dimension_; ++a) {
      if (!tank.periodic[a]) continue;
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
    return kind == "block" ? case_.blocks[i].box : case_.obstacles[i];
  }

  void check_bodies(const std::string& kind) const {
    const std::vector<TomlTable> tables = root_.tables(kind);
    for (std::size_t i = 0; i < tables.size(); ++i) {
      const Box box = box_of(kind, i);
      if (case_.has_tank) check_inside(tables[i], kind, box);
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
      if (box.lower[a] < tank.lower[a] - slack) {
        throw table.error("lower", std::string(axis[a]) + " = " + number_text(box.lower[a]),
                          inside + "which begins at " + number_text(tank.lower[a]));
      }
      if (box.upper[a] > tank.upper[a] + slack) {
        throw table.error("upper", std::string(axis[a]) + " = " + number_text(box.upper[a]),
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

  void check_overlaps() const {
    const double slack = relative_tolerance * case_.spacing;
    std::vector<Body> bodies;
    for (const FluidBlock& block : case_.blocks) {
      bodies.push_back({block.box, block.shape == FluidBlock::Shape::ball});
    }
    for (const Box& box : case_.obstacles) bodies.push_back({box});
    for (std::size_t i = 0; i < case_.blocks.size(); ++i) {
      for (std::size_t j = i + 1; j < bodies.size(); ++j) {
        if (gap(bodies[i], bodies[j], dimension_) >= -slack) continue;
        const std::size_t blocks = case_.blocks.size();
        const std::string other =
            j < blocks ? indexed("block", j) : indexed("obstacle", j - blocks);
        throw root_.tables("block")[i].error("lower", "an overlap with " + other,
                                             "separate bodies");
      }
    }
  }

  void check_probes() const {
    const std::vector<TomlTable> tables = root_.tables("probe");
    std::set<std::string> names;
    for (std::size_t i = 0; i < tables.size(); ++i) {
      const Probe& probe = case_.probes[i];
      const bool plain =
          probe.name.find_first_of(",\"\n\r") == std::string::npos && !probe.name.empty();
      if (!plain)
        throw tables[i].error("name", '"' + probe.name + '"', "a name without commas and quotes");
      if (!names.insert(probe.name).second) {
        throw tables[i].error("name", '"' + probe.name + "\" twice", "different names");
      }
      if (case_.has_tank) check_probe_inside(tables[i], probe);
      check_probe_outside(tables[i], probe);
    }
  }

  void check_probe_inside(const TomlTable& table, const Probe& probe) const {
    const Box& tank = case_.tank.box;
    for (std::size_t a = 0; a < dimension_; ++a) {
      if (probe.position[a] < tank.lower[a] || probe.position[a] > tank.upper[a]) {
        throw table.error("position", std::string(axis[a]) + " = " + number_text(probe.position[a]),
                          "a place inside the tank, between " + number_text(tank.lower[a]) +
                              " and " + number_text(tank.upper[a]));
      }
    }
  }

  /// In an obstacle there is no water whose pressure could be read.
  void check_probe_outside(const TomlTable& table, const Probe& probe) const {
    for (std::size_t i = 0; i < case_.obstacles.size(); ++i) {
      const Box& box = case_.obstacles[i];
      bool inside = true;
      for (std::size_t a = 0; a < dimension_; ++a)
        inside = inside && probe.position[a] > box.lower[a] && probe.position[a] < box.upper[a];
      if (inside)
        throw table.error("position", "a place inside " + indexed("obstacle", i),
                          "a place that water can reach, or on the obstacle's surface");
    }
  }

  /// Particles are numbered in 32 bits.
  void check_size() const {
    constexpr double most = 2e9;
    if (fluid_particle_count(case_) > most) {
      throw root_.table("resolution")
          .error("spacing",
                 number_text(case_.spacing) + ", which makes " +
                     number_text(fluid_particle_count(case_)) + " particles",
                 "at most 2e9 particles");
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

double fluid_particle_count(const Case& c) {
  double total = 0.0;
  for (const FluidBlock& block : c.blocks) {
    double count = 1.0;
    for (std::size_t a = 0; a < static_cast<std::size_t>(c.dimension); ++a) {
      count *= std::round((block.box.upper[a] - block.box.lower[a]) / c.spacing);
    }
    const double ball_in_box = c.dimension == 2 ? std::numbers::pi / 4.0 : std::numbers::pi / 6.0;
    total += block.shape == FluidBlock::Shape::ball ? std::round(count * ball_in_box) : count;
  }
  return total;
}

}  // namespace surge
