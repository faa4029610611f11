#include <sstream>

#include "particle/case/case_file.hpp"
#include "particle/case/case_json.hpp"
#include "particle/case/enum_names.hpp"

namespace surge {

namespace {

using nlohmann::json;

template <std::size_t N>
json names_of(const std::array<bool, N>& flags, const std::array<std::string_view, N>& names) {
  json list = json::array();
  for (std::size_t i = 0; i < N; ++i) {
    if (flags[i]) list.push_back(names[i]);
  }
  return list;
}

json box_json(const Box& box) {
  return {{"lower", box.lower}, {"upper", box.upper}};
}

/// A body with its surface in full, so that a file that changes is another case.
json obstacle_json(const Obstacle& obstacle) {
  json j = box_json(obstacle);
  if (!obstacle.surface) return j;
  const bool plane = obstacle.surface->dimension() == 2;
  json& corners = j[plane ? "polygon" : "vertices"] = json::array();
  for (const Point& x : obstacle.surface->vertices())
    corners.push_back(plane ? json{x[0], x[1]} : json(x));
  if (!plane) j["triangles"] = obstacle.surface->facets();
  return j;
}

json tank_json(const Tank& tank) {
  json j = box_json(tank.box);
  j["open"] = names_of(tank.open, side_names);
  j["periodic"] = names_of(tank.periodic, axis_names);
  j["wall"] = name_of(tank.wall);
  return j;
}

json block_json(const FluidBlock& block) {
  json j = box_json(block.box);
  j["shape"] = name_of(block.shape);
  j["velocity"] = block.velocity;
  j["velocity_gradient"] = block.velocity_gradient;
  j["wave_amplitude"] = block.wave_amplitude;
  return j;
}

/// The entries of a law that act, and no others.
void add_law(json& j, const ScalarMotion& law) {
  j["law"] = name_of(law.kind);
  if (law.kind == ScalarMotion::Kind::harmonic) {
    j["amplitude"] = law.amplitude;
    j["period"] = law.period;
    j["phase"] = law.phase;
    j["ramp"] = law.ramp;
    j["start"] = law.start;
  } else if (law.kind == ScalarMotion::Kind::constant) {
    j["speed"] = law.speed;
    j["start"] = law.start;
    j["stop"] = law.stop;
  } else {
    j["quantity"] = name_of(law.quantity);
    j["samples"] = law.samples;
  }
}

json motion_json(const TankMotion& motion) {
  if (motion.kind == TankMotion::Kind::none) return nullptr;
  json j{{"kind", name_of(motion.kind)}, {"direction", motion.direction}};
  if (motion.kind == TankMotion::Kind::rotation) j["centre"] = motion.centre;
  add_law(j, motion.law);
  return j;
}

json moving_wall_json(const MovingWall& wall) {
  json j = box_json(wall.box);
  j["name"] = wall.name;
  j["direction"] = wall.direction;
  add_law(j, wall.law);
  return j;
}

json force_json(const ForceSurface& force, const Case& c) {
  std::string on;
  if (force.of == ForceSurface::Of::side) on = side_names[force.index];
  if (force.of == ForceSurface::Of::obstacle) on = "obstacle." + std::to_string(force.index);
  if (force.of == ForceSurface::Of::moving_wall) on = c.moving_walls[force.index].name;
  return {{"name", force.name}, {"on", on}};
}

// In case files a point has as many entries as the case has dimensions, in the manifest always
// three.
json cut(json value, std::size_t dimension) {
  value.erase(value.begin() + static_cast<std::ptrdiff_t>(dimension), value.end());
  return value;
}

void write_table(std::ostream& out, const std::string& header, const json& entries,
                 std::size_t dimension) {
  out << '\n' << header << '\n';
  for (const auto& [key, value] : entries.items()) {
    const bool point = key == "lower" || key == "upper" || key == "velocity" || key == "gravity" ||
                       key == "position" || key == "direction" || key == "centre";
    if (key == "velocity_gradient") {
      json rows = json::array();
      for (const json& row : cut(value, dimension)) rows.push_back(cut(row, dimension));
      out << key << " = " << rows << '\n';
    } else {
      out << key << " = " << (point ? cut(value, dimension) : value) << '\n';
    }
  }
}

}  // namespace

json to_json(const Case& c) {
  json j;
  j["title"] = c.title;
  j["dimension"] = c.dimension;
  j["spacing"] = c.spacing;
  j["fluid"] = {{"density", c.density},
                {"kinematic_viscosity", c.kinematic_viscosity},
                {"reference_speed", c.reference_speed},
                {"gravity", c.gravity}};
  j["tank"] = c.has_tank ? tank_json(c.tank) : json(nullptr);
  j["blocks"] = json::array();
  for (const FluidBlock& block : c.blocks) j["blocks"].push_back(block_json(block));
  j["obstacles"] = json::array();
  for (const Obstacle& obstacle : c.obstacles) j["obstacles"].push_back(obstacle_json(obstacle));
  j["probes"] = json::array();
  for (const Probe& probe : c.probes) {
    j["probes"].push_back(
        {{"name", probe.name}, {"position", probe.position}, {"diameter", probe.diameter}});
  }
  j["motion"] = motion_json(c.motion);
  j["moving_walls"] = json::array();
  for (const MovingWall& wall : c.moving_walls) j["moving_walls"].push_back(moving_wall_json(wall));
  j["gauges"] = json::array();
  for (const Gauge& gauge : c.gauges)
    j["gauges"].push_back({{"name", gauge.name}, {"position", gauge.position}});
  j["forces"] = json::array();
  for (const ForceSurface& force : c.forces) j["forces"].push_back(force_json(force, c));
  j["time"] = {{"end", c.time.end},
               {"initial_step", c.time.initial_step},
               {"maximum_step", c.time.maximum_step},
               {"courant", c.time.courant}};
  j["output"] = {{"interval", c.output_interval}, {"checkpoint", c.checkpoint_interval}};
  return j;
}

std::string toml_table(const std::string& header, const json& entries) {
  std::ostringstream out;
  write_table(out, header, entries, 3);
  return out.str();
}

// JSON's numbers, strings and lists are TOML's, so that only the tables differ.
std::string to_toml(const Case& c) {
  const json j = to_json(c);
  const auto dimension = static_cast<std::size_t>(c.dimension);
  std::ostringstream out;
  out << "title = " << j["title"] << "\ndimension = " << c.dimension << '\n';
  write_table(out, "[fluid]", j["fluid"], dimension);
  if (c.has_tank) write_table(out, "[tank]", j["tank"], dimension);
  for (const json& block : j["blocks"]) write_table(out, "[[block]]", block, dimension);
  for (json obstacle : j["obstacles"]) {
    const bool is_box = !obstacle.contains("polygon") && !obstacle.contains("vertices");
    if (!is_box) {  // the surface says where it ends
      obstacle.erase("lower");
      obstacle.erase("upper");
    }
    write_table(out, "[[obstacle]]", obstacle, dimension);
  }
  for (const json& probe : j["probes"]) write_table(out, "[[probe]]", probe, dimension);
  if (json motion = j["motion"]; !motion.is_null()) {
    // In 2D there is one axis to turn about, and a case file does not name it.
    const bool turns = c.motion.kind == TankMotion::Kind::rotation;
    if (turns && c.dimension == 2) motion.erase("direction");
    write_table(out, "[motion]", motion, dimension);
  }
  for (const json& wall : j["moving_walls"]) write_table(out, "[[moving_wall]]", wall, dimension);
  for (const json& gauge : j["gauges"]) write_table(out, "[[gauge]]", gauge, dimension);
  for (const json& force : j["forces"]) write_table(out, "[[force]]", force, dimension);
  write_table(out, "[resolution]", {{"spacing", c.spacing}}, dimension);
  write_table(out, "[time]", j["time"], dimension);
  write_table(out, "[output]", j["output"], dimension);
  return out.str();
}

}  // namespace surge
