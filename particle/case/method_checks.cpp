#include <cmath>

#include "particle/case/case_checks.hpp"
#include "particle/case/scales.hpp"

namespace surge {

namespace {

constexpr std::array<const char*, 3> axis{"x", "y", "z"};
constexpr double relative_tolerance = 1e-9;

/// Finds what in a case does not fit a method and says where it stands in the file.
class Checker {
 public:
  Checker(const MethodFacts& method, const Case& c, const TomlTable& root)
      : method_(method),
        case_(c),
        root_(root),
        dimension_(static_cast<std::size_t>(c.dimension)),
        radius_(method.interaction_radius * c.spacing) {}

  void check() const {
    check_supports();
    if (case_.has_tank) check_periods();
    check_speed();
    check_thickness();
  }

 private:
  void check_supports() const {
    const auto refuse = [&](const char* key, const char* found) {
      throw root_.error(
          key, found,
          std::string("none with ") + std::string(method_.name) + ", which does not compute it");
    };
    if (case_.motion.kind != TankMotion::Kind::none && !method_.supports.tank_motion)
      refuse("motion", "a tank that moves");
    if (!case_.moving_walls.empty() && !method_.supports.moving_walls)
      refuse("moving_wall", "walls that move");
  }

  void check_periods() const {
    const TomlTable table = root_.table("tank");
    const double reach = 2.0 * radius_;
    for (std::size_t a = 0; a < dimension_; ++a) {
      if (!case_.tank.periodic[a]) continue;
      const double period = case_.tank.box.upper[a] - case_.tank.box.lower[a];
      if (period < reach * (1.0 - relative_tolerance)) {
        throw table.error("periodic", "a period of " + number_text(period) + " m in " + axis[a],
                          "at least twice the interaction radius, " + number_text(reach) + " m");
      }
    }
  }

  /// A method that takes its speed of sound from the flow's needs one.
  void check_speed() const {
    if (!method_.needs_reference_speed || reference_speed(case_) > 0.0) return;
    throw root_.table("fluid").error("reference_speed", "a case without a speed",
                                     "the flow's largest speed in m/s");
  }

  /// Whether water can be on a side of an obstacle: there is more than a spacing to the tank's
  /// wall.
  [[nodiscard]] bool has_room(const Box& box, std::size_t a, bool upper) const {
    if (!case_.has_tank || case_.tank.periodic[a]) return true;
    const double gap =
        upper ? case_.tank.box.upper[a] - box.upper[a] : box.lower[a] - case_.tank.box.lower[a];
    return gap > 0.5 * case_.spacing;
  }

  /// Particles act on each other through a wall that is thinner than their radius of interaction.
  void check_thickness() const {
    const std::vector<TomlTable> tables = root_.tables("obstacle");
    for (std::size_t i = 0; i < tables.size(); ++i) {
      const Box& box = case_.obstacles[i];
      for (std::size_t a = 0; a < dimension_; ++a) {
        const double thickness = box.upper[a] - box.lower[a];
        if (thickness >= radius_ * (1.0 - relative_tolerance)) continue;
        if (!has_room(box, a, false) || !has_room(box, a, true)) continue;
        const std::string finer =
            number_text(std::floor(1e6 * case_.spacing * thickness / radius_) / 1e6);
        throw tables[i].error(
            "upper",
            "a wall " + number_text(std::round(thickness * 1e9) / 1e9) + " m thick along " +
                axis[a] + " with room for water on both sides",
            "at least " + number_text(std::round(radius_ * 1e9) / 1e9) +
                " m, over which particles act on each other, or a spacing of at most " + finer +
                " m");
      }
    }
  }

  const MethodFacts& method_;
  const Case& case_;
  const TomlTable& root_;
  std::size_t dimension_;
  double radius_;  ///< m
};

}  // namespace

void check_case_for(const MethodFacts& method, const Case& c, const TomlTable& root) {
  Checker(method, c, root).check();
}

}  // namespace surge
