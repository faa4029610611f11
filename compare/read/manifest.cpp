#include <cmath>
#include <set>

#include "compare/read/readers.hpp"
#include "compare/read/recorded.hpp"
#include "particle/support/error.hpp"
#include "particle/support/json.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A JSON value with its place, every access checked.
class Entry {
 public:
  Entry(const json& value, std::string place) : value_(value), place_(std::move(place)) {}

  [[nodiscard]] bool has(const std::string& key) const {
    return value_.is_object() && value_.contains(key);
  }

  [[nodiscard]] Entry at(const std::string& key) const {
    if (!has(key)) fail_at(key, "nothing", "an entry");
    return {value_.at(key), place_ + (place_.back() == ':' ? " " : ".") + key};
  }

  [[nodiscard]] Entry at(std::size_t i) const {
    if (!value_.is_array() || value_.size() <= i)
      fail("an array of at least " + std::to_string(i + 1));
    return {value_.at(i), place_ + "." + std::to_string(i)};
  }

  [[nodiscard]] double number() const {
    if (!value_.is_number() || !std::isfinite(value_.get<double>())) fail("a finite number");
    return value_.get<double>();
  }

  [[nodiscard]] std::string text() const {
    if (!value_.is_string()) fail("a text");
    return value_.get<std::string>();
  }

  [[nodiscard]] std::size_t size() const {
    if (!value_.is_array()) fail("an array");
    return value_.size();
  }

  [[nodiscard]] std::set<std::string> names() const {
    std::set<std::string> found;
    for (std::size_t i = 0; i < size(); ++i) found.insert(at(i).text());
    return found;
  }

  [[nodiscard]] Vec3 vector() const { return {at(0).number(), at(1).number(), at(2).number()}; }

  [[nodiscard]] Extent extent() const { return {at("lower").vector(), at("upper").vector()}; }

  [[nodiscard]] const std::string& place() const { return place_; }

  [[noreturn]] void fail(const std::string& expected) const {
    throw Error(place_ + ": " + json_shown(value_) + " found, " + expected + " expected");
  }

 private:
  [[noreturn]] void fail_at(const std::string& key, const std::string& found,
                            const std::string& expected) const {
    throw Error(place_ + (place_.back() == ':' ? " " : ".") + key + ": " + found + " found, " +
                expected + " expected");
  }

  const json& value_;
  std::string place_;
};

std::vector<Point> points_of(const Entry& list, std::size_t dimension) {
  std::vector<Point> points(list.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t a = 0; a < dimension; ++a) points[i][a] = list.at(i).at(a).number();
  return points;
}

/// A box, or a body by its polygon, or by its vertices and triangles.
SolidBody solid_of(const Entry& entry) {
  const bool plane = entry.has("polygon");
  if (!plane && !entry.has("vertices")) return entry.extent();
  try {
    if (plane) return SolidBody(ClosedSurface::polygon(points_of(entry.at("polygon"), 2)));
    std::vector<Point> vertices = points_of(entry.at("vertices"), 3);
    const Entry list = entry.at("triangles");
    std::vector<ClosedSurface::Facet> facets(list.size());
    for (std::size_t i = 0; i < facets.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const double number = list.at(i).at(k).number();
        if (!(number >= 0.0 && number < static_cast<double>(vertices.size())))
          list.at(i).at(k).fail("the number of a vertex");
        facets[i][k] = static_cast<std::uint32_t>(number);
      }
    return SolidBody(ClosedSurface::triangles(std::move(vertices), std::move(facets)));
  } catch (const Error& error) {
    const std::string what = error.what();
    if (!what.starts_with("found ")) throw;
    throw Error(entry.place() + ": " + what);
  }
}

}  // namespace

void apply_manifest(Run& run, const fs::path& file) {
  run.manifest = read_manifest(file);
  const Entry root(run.manifest, file.string() + ":");
  static_cast<void>(root.at("case"));
  apply_case(run, run.manifest.at("case"), file.string() + ": case");
}

void apply_case(Run& run, const json& value, const std::string& place) {
  const Entry stated(value, place);
  const Entry method = stated.at("method");
  run.method = method.at("name").text();
  run.preset = method.at("preset").text();
  Physics& physics = run.physics;
  physics.dimension = static_cast<int>(stated.at("dimension").number());
  if (physics.dimension != 2 && physics.dimension != 3) stated.at("dimension").fail("2 or 3");
  const Entry fluid = stated.at("fluid");
  physics.gravity = fluid.at("gravity").vector();
  physics.density = fluid.at("density").number();
  physics.kinematic_viscosity = fluid.at("kinematic_viscosity").number();
  (void)stated.at("blocks").at(0);
  physics.blocks.emplace();
  for (std::size_t i = 0; i < stated.at("blocks").size(); ++i) {
    const Entry block = stated.at("blocks").at(i);
    WaterBody body{"box", block.extent(), {}};
    if (block.has("shape")) body.shape = block.at("shape").text();
    if (block.has("velocity")) body.velocity = block.at("velocity").vector();
    physics.blocks->push_back(std::move(body));
  }
  if (stated.has("obstacles")) {
    physics.obstacles.emplace();
    for (std::size_t i = 0; i < stated.at("obstacles").size(); ++i)
      physics.obstacles->push_back(solid_of(stated.at("obstacles").at(i)));
  }
  if (stated.has("tank")) {
    physics.tank = stated.at("tank").extent();
    const Entry tank = stated.at("tank");
    if (tank.has("wall")) physics.wall = tank.at("wall").text();
    if (tank.has("open")) physics.open = tank.at("open").names();
    if (tank.has("periodic")) physics.periodic = tank.at("periodic").names();
  }
  if (stated.has("motion")) physics.motion = value.at("motion");
  if (stated.has("moving_walls")) physics.moving_walls = value.at("moving_walls");
  physics.column = (*physics.blocks)[column_among_blocks(physics)].box;
  if (stated.has("cells_per_L")) {
    run.cells_per_width = stated.at("cells_per_L").number();
    if (*run.cells_per_width <= 0.0) stated.at("cells_per_L").fail("a positive number");
    run.spacing = Metres(physics.column_width().value() / *run.cells_per_width);
  } else {
    run.spacing = Metres(stated.at("spacing").number());
    if (run.spacing <= Metres(0.0)) stated.at("spacing").fail("a positive length");
  }
}

}  // namespace surge::compare
