#include <cmath>

#include "particle/case/case_checks.hpp"
#include "particle/case/scales.hpp"
#include "particle/case/solid_cells.hpp"
#include "particle/case/surface_checks.hpp"

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
    check_walls();
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

  /// A solid by its number among obstacles and then moving walls, as in the file.
  [[nodiscard]] std::string name_of_solid(std::size_t i) const {
    const std::size_t obstacles = case_.obstacles.size();
    return i < obstacles ? "obstacle." + std::to_string(i)
                         : "moving_wall." + std::to_string(i - obstacles);
  }
  [[nodiscard]] TomlTable table_of_solid(std::size_t i) const {
    const std::size_t obstacles = case_.obstacles.size();
    return i < obstacles ? root_.tables("obstacle")[i] : root_.tables("moving_wall")[i - obstacles];
  }

  /// Particles act on each other through a wall that is thinner than their radius of interaction,
  /// and none fits into a gap narrower than a spacing.
  void check_walls() const {
    if (case_.obstacles.empty() && case_.moving_walls.empty()) return;
    const double cells = SolidCells::cell_count(case_);
    if (cells > SolidCells::most_cells) {
      throw root_.error("obstacle",
                        "faces that cut the space into " + number_text(cells) + " cells",
                        "at most " + number_text(SolidCells::most_cells));
    }
    const SolidCells space(case_);
    if (const auto thin = space.thin_wall(radius_)) refuse_thin(*thin);
    if (const auto gap = space.narrow_gap(case_.spacing)) refuse_gap(*gap);
    check_surface_thickness(case_, root_, radius_);
  }

  [[noreturn]] void refuse_thin(const ThinPlace& thin) const {
    const std::string finer =
        number_text(std::floor(1e6 * case_.spacing * thin.thickness / radius_) / 1e6);
    throw table_of_solid(thin.solid.value())
        .error("upper",
               "a wall " + number_text(std::round(thin.thickness * 1e9) / 1e9) + " m thick along " +
                   axis[thin.axis] + " with room for water on both sides",
               "at least " + number_text(std::round(radius_ * 1e9) / 1e9) +
                   " m, over which particles act on each other, or a spacing of at most " + finer +
                   " m");
  }

  [[noreturn]] void refuse_gap(const ThinPlace& gap) const {
    const std::string found = "a gap of " + number_text(std::round(gap.thickness * 1e9) / 1e9) +
                              " m along " + axis[gap.axis] + " above " +
                              (gap.solid ? name_of_solid(*gap.solid) : "the tank's wall");
    const std::string expected = "none, or at least a spacing of " + number_text(case_.spacing) +
                                 " m, into which a particle fits";
    if (gap.solid) throw table_of_solid(*gap.solid).error("upper", found, expected);
    throw root_.table("tank").error("lower", found, expected);
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
