#pragma once

#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "compare/read/units.hpp"
#include "particle/case/closed_surface.hpp"

namespace surge::compare {

using Vec3 = std::array<double, 3>;

struct Extent {
  Vec3 lower{};  ///< m
  Vec3 upper{};  ///< m
};

/// A fixed solid body: a box, or what a closed surface holds; the box is then the one around it.
struct SolidBody : Extent {
  std::shared_ptr<const ClosedSurface> surface;  ///< null: the box itself

  SolidBody() = default;
  SolidBody(const Extent& box) : Extent(box) {}  // NOLINT: a box is a body
  SolidBody(const Vec3& from, const Vec3& to) : Extent{from, to} {}
  explicit SolidBody(ClosedSurface made)
      : Extent{made.bounds().lower, made.bounds().upper},
        surface(std::make_shared<const ClosedSurface>(std::move(made))) {}
};

/// Whether two bodies are the same to a tolerance (m), along so many axes.
[[nodiscard]] bool same_solid(const SolidBody& a, const SolidBody& b, std::size_t dimension,
                              double tolerance);

/// A body of water at time zero.
struct WaterBody {
  std::string shape = "box";
  Extent box;
  Vec3 velocity{};  ///< m/s
};

/// What a run computed, as far as its files say so. The column and gravity are always known
/// (without them there is no Z/L); what a foreign source does not state is empty.
struct Physics {
  int dimension = 2;
  Vec3 gravity{0.0, -9.81, 0.0};              ///< m/s2
  Extent column;                              ///< the fluid block at time zero; its width is L
  std::optional<Extent> tank;                 ///< m; an entry that is not known is not finite
  std::optional<double> density;              ///< of the water, kg/m3
  std::optional<double> kinematic_viscosity;  ///< of the water, m2/s
  std::optional<std::string> wall;            ///< "slip" or "no-slip"
  std::optional<std::vector<WaterBody>> blocks;
  std::optional<std::vector<SolidBody>> obstacles;
  std::optional<std::set<std::string>> open;      ///< sides without a wall: "x-" to "z+"
  std::optional<std::set<std::string>> periodic;  ///< axes
  /// Motion of the tank and the walls that move, as a manifest has them; null: it is at rest.
  std::optional<nlohmann::json> motion, moving_walls;
  std::optional<Metres> stated_bed;  ///< --bed-depth, of a source without blocks

  [[nodiscard]] double gravity_magnitude() const;
  /// Axis (0, 1, 2) that gravity points along; throws surge::Error where it is oblique, zero or
  /// along x, the direction of the surge.
  [[nodiscard]] int vertical_axis() const;
  /// +1 where the water surges towards +x, -1 where the column stands at the tank's upper wall
  /// along x, and not at the lower one.
  [[nodiscard]] double surge_direction() const;
  /// x of the wall that the column stands at, m.
  [[nodiscard]] double column_wall() const;
  [[nodiscard]] Metres column_width() const;
  [[nodiscard]] Scales scales() const;
  /// Height of the tank's floor (of the column's foot where no tank is known), m.
  [[nodiscard]] double floor() const;
  /// Depth of the water that covers the floor from the column's edge to the far wall at time zero:
  /// as stated, or the depth of the blocks that do; zero where they leave floor dry or are of
  /// different depths. Empty where the source does not say what water there is.
  [[nodiscard]] std::optional<Metres> bed_depth() const;
  /// Distance of the far wall from the column's wall; empty where no tank is known.
  [[nodiscard]] std::optional<Metres> far_wall() const;
  /// Whether water surges from the column: it stands on the floor and leaves floor beyond it.
  [[nodiscard]] bool has_surge() const;
};

/// Which of a source's blocks is the column: of water that lies in the tank and a higher block the
/// higher one; else the first block that does not reach from wall to wall along x; else the first.
/// Gravity, dimension, tank, blocks (one at least) and obstacles must be known.
[[nodiscard]] std::size_t column_among_blocks(const Physics& physics);

/// What differs between two runs and which statements could not be compared.
struct PhysicsComparison {
  struct Difference {
    std::string key;   ///< what --allow takes
    std::string line;  ///< "gravity: 9.81 m/s2 in a, 1.62 m/s2 in b"
  };
  std::vector<Difference> differences;
  std::vector<std::string> not_stated;  ///< keys that one of the two files does not state
};

/// Keys: dimension, gravity, column-width, column-height, tank-width, tank-height, density,
/// viscosity, wall, blocks, obstacles, open, periodic, motion, moving-walls. Lengths agree within
/// 0.1 % of L, other numbers within 1e-6 relative.
[[nodiscard]] PhysicsComparison compare_physics(const Physics& a, const std::string& name_a,
                                                const Physics& b, const std::string& name_b);

/// Whether two values of a manifest say the same: numbers within 1e-6 of the larger; entries that
/// only one of them has are passed over.
[[nodiscard]] bool same_statement(const nlohmann::json& a, const nlohmann::json& b);

/// Throws surge::Error with a line per difference whose key is not in `allowed`, and for a key in
/// `allowed` that does not exist.
void require_same_physics(const PhysicsComparison& comparison,
                          const std::set<std::string>& allowed);

}  // namespace surge::compare
