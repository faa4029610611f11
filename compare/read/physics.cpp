#include "compare/read/physics.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "compare/read/physics_keys.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

constexpr const char* known_keys[] = {"dimension",  "gravity",     "column-width", "column-height",
                                      "tank-width", "tank-height", "density",      "viscosity",
                                      "wall",       "blocks",      "obstacles",    "open",
                                      "periodic",   "motion",      "moving-walls"};

/// Collects differences between two named sides.
class Comparer {
 public:
  Comparer(std::string name_a, std::string name_b)
      : name_a_(std::move(name_a)), name_b_(std::move(name_b)) {}

  void number(const std::string& key, const std::string& unit, std::optional<double> a,
              std::optional<double> b, double tolerance) {
    if (!stated(a) || !stated(b)) {
      result_.not_stated.push_back(key);
    } else if (std::abs(*a - *b) > tolerance) {
      differ(key, text(*a) + unit, text(*b) + unit);
    }
  }

  void word(const std::string& key, const std::optional<std::string>& a,
            const std::optional<std::string>& b) {
    if (!a || !b) {
      result_.not_stated.push_back(key);
    } else if (*a != *b) {
      differ(key, *a, *b);
    }
  }

  void names(const std::string& key, const std::optional<std::set<std::string>>& a,
             const std::optional<std::set<std::string>>& b) {
    const auto listed = [](const std::set<std::string>& names) {
      std::string text;
      for (const std::string& name : names) text += (text.empty() ? "" : " ") + name;
      return text.empty() ? "none" : text;
    };
    word(key, a ? std::optional(listed(*a)) : std::nullopt,
         b ? std::optional(listed(*b)) : std::nullopt);
  }

  /// Lists in any order, each entry of the one with its like in the other.
  template <class Body, class Same>
  void bodies(const std::string& key, const std::optional<std::vector<Body>>& a,
              const std::optional<std::vector<Body>>& b, const Same& same) {
    if (!a || !b) {
      result_.not_stated.push_back(key);
      return;
    }
    std::vector<Body> left = *b;
    std::size_t missing = 0;
    for (const Body& body : *a) {
      const auto found =
          std::find_if(left.begin(), left.end(), [&](const Body& x) { return same(body, x); });
      if (found == left.end()) {
        ++missing;
      } else {
        left.erase(found);
      }
    }
    if (missing == 0 && left.empty()) return;
    differ(
        key,
        std::to_string(a->size()) + ", " + std::to_string(missing) + " of them not in " + name_b_,
        std::to_string(b->size()) + ", " + std::to_string(left.size()) + " of them not in " +
            name_a_);
  }

  void statement(const std::string& key, const std::optional<nlohmann::json>& a,
                 const std::optional<nlohmann::json>& b) {
    if (!a || !b) {
      result_.not_stated.push_back(key);
    } else if (!same_statement(*a, *b)) {
      const auto shown = [](const nlohmann::json& value) {
        return value.empty() ? std::string("none") : value.dump();
      };
      differ(key, shown(*a), shown(*b));
    }
  }

  void differ(const std::string& key, const std::string& a, const std::string& b) {
    result_.differences.push_back(
        {key, key + ": " + a + " in " + name_a_ + ", " + b + " in " + name_b_});
  }

  static std::string text(double value) {
    std::ostringstream out;
    out.precision(9);
    out << value;
    return out.str();
  }

  [[nodiscard]] PhysicsComparison result() const { return result_; }

 private:
  static bool stated(std::optional<double> value) { return value && std::isfinite(*value); }

  std::string name_a_;
  std::string name_b_;
  PhysicsComparison result_;
};

double relative(double a, double b) {
  return 1e-6 * std::max(std::abs(a), std::abs(b));
}

bool same_point(const Vec3& a, const Vec3& b, std::size_t dimension, double tolerance) {
  for (std::size_t axis = 0; axis < dimension; ++axis)
    if (std::abs(a[axis] - b[axis]) > tolerance) return false;
  return true;
}

bool same_box(const Extent& a, const Extent& b, std::size_t dimension, double tolerance) {
  return same_point(a.lower, b.lower, dimension, tolerance) &&
         same_point(a.upper, b.upper, dimension, tolerance);
}

std::optional<double> tank_height(const Physics& p, int up) {
  if (!p.tank) return std::nullopt;
  const auto axis = static_cast<std::size_t>(up);
  return p.tank->upper[axis] - p.tank->lower[axis];
}

std::optional<double> far_wall_metres(const Physics& p) {
  const std::optional<Metres> far = p.far_wall();
  return far ? std::optional(far->value()) : std::nullopt;
}

}  // namespace

double Physics::gravity_magnitude() const {
  return std::hypot(gravity[0], gravity[1], gravity[2]);
}

int Physics::vertical_axis() const {
  const double g = gravity_magnitude();
  for (std::size_t axis = 1; axis < 3; ++axis) {
    if (g > 0.0 && -gravity[axis] >= (1.0 - 1e-9) * g) return static_cast<int>(axis);
  }
  throw Error("gravity: (" + Comparer::text(gravity[0]) + " " + Comparer::text(gravity[1]) + " " +
              Comparer::text(gravity[2]) +
              ") found, a vector along -y or -z expected (the leading edge runs along x)");
}

double Physics::surge_direction() const {
  if (!tank || !std::isfinite(tank->upper[0]) || !std::isfinite(tank->lower[0])) return 1.0;
  const double slack = 0.02 * (column.upper[0] - column.lower[0]);
  const bool at_upper = column.upper[0] > tank->upper[0] - slack;
  const bool at_lower = column.lower[0] < tank->lower[0] + slack;
  return at_upper && !at_lower ? -1.0 : 1.0;
}

double Physics::column_wall() const {
  return surge_direction() > 0.0 ? column.lower[0] : column.upper[0];
}

Metres Physics::column_width() const {
  return Metres(column.upper[0] - column.lower[0]);
}

Scales Physics::scales() const {
  return {column_width(), gravity_magnitude()};
}

double Physics::floor() const {
  const auto up = static_cast<std::size_t>(vertical_axis());
  return tank ? tank->lower[up] : column.lower[up];
}

std::optional<Metres> Physics::far_wall() const {
  if (!tank || !std::isfinite(tank->upper[0])) return std::nullopt;
  if (surge_direction() < 0.0) return Metres(column.upper[0] - tank->lower[0]);
  return Metres(tank->upper[0] - column.lower[0]);
}

bool Physics::has_surge() const {
  const auto far = far_wall();
  const auto up = static_cast<std::size_t>(vertical_axis());
  const double slack = 0.02 * column_width().value();
  if (column.lower[up] > floor() + slack) return false;
  return !far || *far > column_width() + Metres(slack);
}

bool same_statement(const nlohmann::json& a, const nlohmann::json& b) {
  if (a.is_number() && b.is_number()) {
    const double x = a.get<double>(), y = b.get<double>();
    return std::abs(x - y) <= relative(x, y) + 1e-12;
  }
  if (a.is_array() && b.is_array()) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i)
      if (!same_statement(a[i], b[i])) return false;
    return true;
  }
  if (a.is_object() && b.is_object()) {
    for (const auto& [key, value] : a.items())
      if (b.contains(key) && !same_statement(value, b.at(key))) return false;
    return true;
  }
  return a == b;
}

bool same_solid(const SolidBody& a, const SolidBody& b, std::size_t dimension, double tolerance) {
  if (!same_box(a, b, dimension, tolerance)) return false;
  if (!a.surface || !b.surface) return !a.surface && !b.surface;
  const std::vector<Point>&x = a.surface->vertices(), &y = b.surface->vertices();
  if (x.size() != y.size() || a.surface->facets() != b.surface->facets()) return false;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!same_point(x[i], y[i], dimension, tolerance)) return false;
  return true;
}

PhysicsComparison compare_physics(const Physics& a, const std::string& name_a, const Physics& b,
                                  const std::string& name_b) {
  Comparer compare(name_a, name_b);
  if (a.dimension != b.dimension) {
    compare.differ("dimension", std::to_string(a.dimension) + "D",
                   std::to_string(b.dimension) + "D");
  }
  const double g_a = a.gravity_magnitude();
  const double g_b = b.gravity_magnitude();
  compare.number("gravity", " m/s2", g_a, g_b, relative(g_a, g_b));
  const int up_a = a.vertical_axis();
  const int up_b = b.vertical_axis();
  const double length_tolerance =
      1e-3 * std::max(a.column_width().value(), b.column_width().value());
  compare.number("column-width", " m", a.column_width().value(), b.column_width().value(),
                 length_tolerance);
  const auto height = [](const Physics& p, int up) {
    const auto axis = static_cast<std::size_t>(up);
    return p.column.upper[axis] - p.column.lower[axis];
  };
  compare.number("column-height", " m", height(a, up_a), height(b, up_b), length_tolerance);
  compare.number("tank-width", " m", far_wall_metres(a), far_wall_metres(b), length_tolerance);
  compare.number("tank-height", " m", tank_height(a, up_a), tank_height(b, up_b), length_tolerance);
  compare.number("density", " kg/m3", a.density, b.density,
                 relative(a.density.value_or(0), b.density.value_or(0)));
  compare.number("viscosity", " m2/s", a.kinematic_viscosity, b.kinematic_viscosity,
                 relative(a.kinematic_viscosity.value_or(0), b.kinematic_viscosity.value_or(0)));
  compare.word("wall", a.wall, b.wall);
  const auto dimension = static_cast<std::size_t>(std::min(a.dimension, b.dimension));
  compare.bodies("blocks", a.blocks, b.blocks, [&](const WaterBody& x, const WaterBody& y) {
    return x.shape == y.shape && same_box(x.box, y.box, dimension, length_tolerance) &&
           same_point(x.velocity, y.velocity, dimension, 1e-6);
  });
  compare.bodies("obstacles", a.obstacles, b.obstacles,
                 [&](const SolidBody& x, const SolidBody& y) {
                   return same_solid(x, y, dimension, length_tolerance);
                 });
  compare.names("open", a.open, b.open);
  compare.names("periodic", a.periodic, b.periodic);
  compare.statement("motion", a.motion, b.motion);
  compare.statement("moving-walls", a.moving_walls, b.moving_walls);
  return compare.result();
}

bool is_physics_key(const std::string& key) {
  return std::find(std::begin(known_keys), std::end(known_keys), key) != std::end(known_keys);
}

std::string physics_keys() {
  std::string text;
  for (const char* known : known_keys) {
    if (!text.empty()) text += ' ';
    text += known;
  }
  return text;
}

void require_same_physics(const PhysicsComparison& comparison,
                          const std::set<std::string>& allowed) {
  for (const std::string& key : allowed) {
    if (!is_physics_key(key))
      throw Error("--allow: \"" + key + "\" found, one of " + physics_keys() + " expected");
  }
  std::string lines;
  for (const auto& difference : comparison.differences) {
    if (!allowed.contains(difference.key)) lines += "\n  " + difference.line;
  }
  if (!lines.empty()) throw Error("different physics (accept one with --allow KEY):" + lines);
}

}  // namespace surge::compare
