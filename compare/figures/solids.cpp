#include "compare/figures/solids.hpp"

#include <cmath>
#include <limits>

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

}  // namespace

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
    for (const Extent& box : *physics.obstacles) {
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

}  // namespace surge::compare
