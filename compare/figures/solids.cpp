#include "compare/figures/solids.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "particle/support/table.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

/// Whether the plane of the picture cuts the box.
bool is_cut(const PictureScale& scale, const Extent& box) {
  return !scale.three_dimensional ||
         (box.lower[scale.depth] <= scale.middle && scale.middle < box.upper[scale.depth]);
}

Rectangle rectangle_of(const PictureScale& scale, const Extent& box) {
  return {scale.x(box.lower[0]), scale.y(box.lower[scale.up]), scale.x(box.upper[0]),
          scale.y(box.upper[scale.up])};
}

DepthRange depth_of(const PictureScale& scale, const Extent& box) {
  return {scale.z(box.lower[scale.depth]), scale.z(box.upper[scale.depth])};
}

/// As particle/case/case_writer.cpp writes it; empty where it is written otherwise.
std::optional<ScalarMotion> law_of(const json& wall) {
  ScalarMotion law;
  const std::string kind = wall.value("law", "");
  law.start = wall.value("start", 0.0);
  if (kind == "harmonic") {
    law.kind = ScalarMotion::Kind::harmonic;
    law.amplitude = wall.at("amplitude").get<double>();
    law.period = wall.at("period").get<double>();
    law.phase = wall.value("phase", 0.0);
    law.ramp = wall.value("ramp", 0.0);
    if (!(law.period > 0.0)) return std::nullopt;
  } else if (kind == "constant") {
    law.kind = ScalarMotion::Kind::constant;
    law.speed = wall.at("speed").get<double>();
    law.stop = wall.value("stop", std::numeric_limits<double>::infinity());
  } else if (kind == "table") {
    law.kind = ScalarMotion::Kind::table;
    law.quantity = wall.value("quantity", "displacement") == "acceleration"
                       ? ScalarMotion::Quantity::acceleration
                       : ScalarMotion::Quantity::displacement;
    law.samples = wall.at("samples").get<std::vector<std::array<double, 2>>>();
    if (law.samples.empty()) return std::nullopt;
  } else {
    return std::nullopt;
  }
  return law;
}

std::optional<Solids::MovingWall> moving_wall_of(const PictureScale& scale, const json& wall) {
  try {
    const Extent box{wall.at("lower").get<Vec3>(), wall.at("upper").get<Vec3>()};
    const Vec3 direction = wall.at("direction").get<Vec3>();
    const auto law = law_of(wall);
    if (!law) return std::nullopt;
    return Solids::MovingWall{
        rectangle_of(scale, box), direction[0],          direction[scale.up], *law, scale.length,
        depth_of(scale, box),     direction[scale.depth]};
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

/// The closed lines in which the plane of the picture cuts a surface. Each triangle that it cuts
/// gives a segment from one of its edges to another, and each edge that it cuts has two triangles.
std::vector<Outline> section(const PictureScale& scale, const ClosedSurface& surface) {
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  const auto above = [&](std::uint32_t v) {
    return surface.vertices()[v][scale.depth] > scale.middle;
  };
  std::map<Edge, Edge> next;  // from where the surface rises through the plane to where it sinks
  for (const ClosedSurface::Facet& f : surface.facets()) {
    std::optional<Edge> rises, sinks;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = f[k], b = f[(k + 1) % 3];
      if (!above(a) && above(b)) rises = {std::min(a, b), std::max(a, b)};
      if (above(a) && !above(b)) sinks = {std::min(a, b), std::max(a, b)};
    }
    if (rises && sinks) next[*rises] = *sinks;
  }
  std::vector<Outline> outlines;
  while (!next.empty()) {
    Outline outline;
    for (auto at = next.begin(); at != next.end();) {
      const Point &a = surface.vertices()[at->first.first],
                  &b = surface.vertices()[at->first.second];
      const double t = (scale.middle - a[scale.depth]) / (b[scale.depth] - a[scale.depth]);
      outline.push_back({scale.x(a[0] + t * (b[0] - a[0])),
                         scale.y(a[scale.up] + t * (b[scale.up] - a[scale.up]))});
      const Edge to = at->second;
      next.erase(at);
      at = next.find(to);
    }
    outlines.push_back(std::move(outline));
  }
  return outlines;
}

void add_surface(const PictureScale& scale, const ClosedSurface& surface, Solids& solids) {
  if (surface.dimension() == 2) {
    Outline outline;
    for (const Point& x : surface.vertices())
      outline.push_back({scale.x(x[0]), scale.y(x[scale.up])});
    solids.outlines.push_back(std::move(outline));
    return;
  }
  for (Outline& outline : section(scale, surface)) solids.outlines.push_back(std::move(outline));
  std::vector<double> corners;
  for (const ClosedSurface::Facet& f : surface.facets())
    for (const std::uint32_t v : f) {
      const Point& x = surface.vertices()[v];
      corners.insert(corners.end(), {scale.x(x[0]), scale.y(x[scale.up]), scale.z(x[scale.depth])});
    }
  solids.surfaces.push_back(std::move(corners));
}

}  // namespace

bool is_near(const Outline& outline, double x, double y, double margin) {
  bool inside = false;
  double square = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto& [ax, ay] = outline[i];
    const auto& [bx, by] = outline[(i + 1) % outline.size()];
    if ((ay > y) != (by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax)) inside = !inside;
    const double length = (bx - ax) * (bx - ax) + (by - ay) * (by - ay);
    const double along = (x - ax) * (bx - ax) + (y - ay) * (by - ay);
    const double t = length > 0.0 ? std::clamp(along / length, 0.0, 1.0) : 0.0;
    square =
        std::min(square, std::pow(x - ax - t * (bx - ax), 2) + std::pow(y - ay - t * (by - ay), 2));
  }
  return inside || square < margin * margin;
}

std::string outline_object(const Outline& outline, const std::string& style) {
  std::string text = "set object polygon from ";
  for (const auto& [x, y] : outline) text += plot_number(x) + "," + plot_number(y) + " to ";
  return text + plot_number(outline.front()[0]) + "," + plot_number(outline.front()[1]) + " " +
         style + "\n";
}

PictureScale::PictureScale(const Run& run)
    : x_origin(run.physics.surge_direction() > 0.0 ? run.physics.column.lower[0]
                                                   : run.physics.tank->lower[0]),
      floor(run.physics.floor()),
      length(run.physics.column_width().value()),
      up(static_cast<std::size_t>(run.physics.vertical_axis())),
      depth(3 - up),
      three_dimensional(run.physics.dimension == 3) {
  const Extent& box = run.physics.tank ? *run.physics.tank : run.physics.column;
  middle = 0.5 * (box.lower[depth] + box.upper[depth]);
  depth_origin =
      std::isfinite(box.lower[depth]) ? box.lower[depth] : run.physics.column.lower[depth];
}

Rectangle Solids::MovingWall::at(Seconds time) const {
  const double q = motion_at(law, time.value()).displacement / length;
  return {at_rest.x0 + q * along_x, at_rest.y0 + q * along_y, at_rest.x1 + q * along_x,
          at_rest.y1 + q * along_y};
}

DepthRange Solids::MovingWall::depth_at(Seconds time) const {
  const double q = motion_at(law, time.value()).displacement / length * along_z;
  return {depth.from + q, depth.to + q};
}

Solids solids_of(const Run& run) {
  const PictureScale scale(run);
  const Physics& physics = run.physics;
  Solids solids;
  solids.up_side = std::string(1, "xyz"[scale.up]) + "+";
  if (physics.tank) {
    solids.tank = rectangle_of(scale, *physics.tank);
    solids.tank_depth = depth_of(scale, *physics.tank);
  }
  if (physics.open) solids.open = *physics.open;
  if (physics.periodic)
    for (const std::string& axis : *physics.periodic)
      for (const char* side : {"-", "+"}) solids.open.insert(axis + side);
  if (physics.obstacles)
    for (const SolidBody& box : *physics.obstacles) {
      if (box.surface) {
        add_surface(scale, *box.surface, solids);
        continue;
      }
      solids.blocks.push_back({rectangle_of(scale, box), depth_of(scale, box)});
      if (is_cut(scale, box)) solids.obstacles.push_back(solids.blocks.back().plane);
    }
  solids.tank_moves = physics.motion && !physics.motion->is_null();
  if (!physics.moving_walls || !physics.moving_walls->is_array()) return solids;
  for (const json& wall : *physics.moving_walls) {
    if (auto found = moving_wall_of(scale, wall))
      solids.walls.push_back(std::move(*found));
    else
      ++solids.not_drawn;
  }
  return solids;
}

std::string solid_objects(const Solids& solids, Seconds time) {
  const std::string border = " fs solid 1 border lc rgb \"#303030\" lw 0.6";
  std::string text;
  const auto add = [&](const Rectangle& box, const char* colour) {
    text += "set object rectangle from " + plot_number(box.x0) + "," + plot_number(box.y0) +
            " to " + plot_number(box.x1) + "," + plot_number(box.y1) + " front fc rgb \"" + colour +
            "\"" + border + "\n";
  };
  for (const Rectangle& box : solids.obstacles) add(box, "#8a8a8a");
  for (const Outline& outline : solids.outlines)
    text += outline_object(outline, "front fc rgb \"#8a8a8a\"" + border);
  for (const Solids::MovingWall& wall : solids.walls) add(wall.at(time), "#e69f00");
  return text;
}

}  // namespace surge::compare
