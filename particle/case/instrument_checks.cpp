#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "particle/case/case_checks.hpp"
#include "particle/case/enum_names.hpp"
#include "particle/case/scales.hpp"
#include "particle/support/printable.hpp"

namespace surge {

namespace {

/// Checks what a case records: that there is water to measure at each place, and a name for it.
class Instruments {
 public:
  Instruments(const Case& c, const TomlTable& root)
      : case_(c), root_(root), dimension_(static_cast<std::size_t>(c.dimension)) {
    const double g = length(c.gravity);
    for (std::size_t a = 0; a < dimension_; ++a)
      if (g > 0.0 && std::abs(c.gravity[a]) > 0.999999 * g) vertical_ = a;
  }

  void check() const {
    check_names("probe", case_.probes);
    check_names("gauge", case_.gauges);
    check_names("force", case_.forces);
    for (std::size_t i = 0; i < case_.probes.size(); ++i) {
      const TomlTable table = root_.tables("probe")[i];
      check_in_tank(table, case_.probes[i].position, {});
      check_in_water(table, case_.probes[i].position, {});
      check_diameter(table, case_.probes[i].diameter);
    }
    for (std::size_t i = 0; i < case_.gauges.size(); ++i) {
      const TomlTable table = root_.tables("gauge")[i];
      if (length(case_.gravity) == 0.0)
        throw table.error("position", "a gauge without gravity", "gravity, along which it stands");
      check_in_tank(table, case_.gauges[i].position, vertical_);
      check_in_water(table, case_.gauges[i].position, vertical_);
    }
    for (std::size_t i = 0; i < case_.forces.size(); ++i) check_force(i);
  }

 private:
  template <class Instrument>
  void check_names(const char* kind, const std::vector<Instrument>& instruments) const {
    std::set<std::string> names;
    for (std::size_t i = 0; i < instruments.size(); ++i) {
      const std::string& name = instruments[i].name;
      const bool plain = name.find_first_of(",\"") == std::string::npos && !name.empty() &&
                         printable(name) == name;
      if (plain && names.insert(name).second) continue;
      const TomlTable table = root_.tables(kind)[i];
      if (!plain)
        throw table.error("name", '"' + name + '"',
                          "a name without commas, quotes and control characters");
      throw table.error("name", '"' + name + "\" twice", "different names");
    }
  }

  /// `free` is an axis along which the place does not matter.
  void check_in_tank(const TomlTable& table, const Point& place,
                     std::optional<std::size_t> free) const {
    if (!case_.has_tank) return;
    const Box& tank = case_.tank.box;
    for (std::size_t a = 0; a < dimension_; ++a) {
      if (a == free || (place[a] >= tank.lower[a] && place[a] <= tank.upper[a])) continue;
      throw table.error("position", std::string(axis_names[a]) + " = " + number_text(place[a]),
                        "a place inside the tank, between " + number_text(tank.lower[a]) + " and " +
                            number_text(tank.upper[a]));
    }
  }

  /// In an obstacle there is no water. Along a free axis it must fill the whole tank.
  void check_in_water(const TomlTable& table, const Point& place,
                      std::optional<std::size_t> free) const {
    const auto inside = [&](const Box& box) {
      for (std::size_t a = 0; a < dimension_; ++a) {
        if (a == free) {
          const bool whole = case_.has_tank && box.lower[a] <= case_.tank.box.lower[a] &&
                             box.upper[a] >= case_.tank.box.upper[a];
          if (!whole) return false;
        } else if (place[a] <= box.lower[a] || place[a] >= box.upper[a]) {
          return false;
        }
      }
      return true;
    };
    const auto refuse = [&](const std::string& where) {
      throw table.error("position", "a place inside " + where,
                        "a place that water can reach, or on the surface of " + where);
    };
    for (std::size_t i = 0; i < case_.obstacles.size(); ++i) {
      const Obstacle& obstacle = case_.obstacles[i];
      if (obstacle.surface ? inside_surface(*obstacle.surface, place, free) : inside(obstacle))
        refuse("obstacle." + std::to_string(i));
    }
    for (std::size_t i = 0; i < case_.moving_walls.size(); ++i)
      if (inside(case_.moving_walls[i].box)) refuse("moving_wall." + std::to_string(i));
  }

  /// The same of a surface: by more than a thousandth of a spacing, and along a free axis all of a
  /// thousand places from end to end of the tank.
  [[nodiscard]] bool inside_surface(const ClosedSurface& surface, Point place,
                                    std::optional<std::size_t> free) const {
    const auto in = [&] { return surface.distance(place) < -1e-3 * case_.spacing; };
    if (!free) return in();
    constexpr int places = 1000;
    const Box& tank = case_.tank.box;
    for (int k = 0; k < places; ++k) {
      place[*free] =
          tank.lower[*free] + (k + 0.5) / places * (tank.upper[*free] - tank.lower[*free]);
      if (!case_.has_tank || !in()) return false;
    }
    return true;
  }

  /// A sensor is in a wall of the tank, or smaller than what could stand in it.
  void check_diameter(const TomlTable& table, double diameter) const {
    if (!case_.has_tank) return;
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t a = 0; a < dimension_; ++a)
      if (!case_.tank.periodic[a])
        smallest = std::min(smallest, case_.tank.box.upper[a] - case_.tank.box.lower[a]);
    if (diameter > smallest)
      throw table.error("diameter", number_text(diameter) + " m",
                        "at most the tank's smallest size, " + number_text(smallest) + " m");
  }

  /// A side must be a wall.
  void check_force(std::size_t i) const {
    const ForceSurface& force = case_.forces[i];
    if (force.of != ForceSurface::Of::side) return;
    const std::string side(side_names[force.index]);
    std::string found;
    if (!case_.has_tank) {
      found = "without a tank";
    } else if (case_.tank.open[force.index]) {
      found = "which is open";
    } else if (case_.tank.periodic[force.index / 2]) {
      found = "on a periodic axis";
    }
    if (!found.empty())
      throw root_.tables("force")[i].error("on", "side " + side + ' ' + found, "a wall");
  }

  const Case& case_;
  const TomlTable& root_;
  std::size_t dimension_;
  std::optional<std::size_t> vertical_;  ///< the axis of gravity, where it has one
};

}  // namespace

void check_instruments(const Case& c, const TomlTable& root) {
  Instruments(c, root).check();
}

}  // namespace surge
