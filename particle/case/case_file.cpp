#include "particle/case/case_file.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <span>

#include "particle/case/enum_names.hpp"
#include "particle/case/read_motion.hpp"
#include "particle/case/read_obstacle.hpp"

namespace surge {

namespace {

std::size_t size(int dimension) {
  return static_cast<std::size_t>(dimension);
}

Point read_point(const TomlTable& table, std::string_view key, int dimension) {
  const std::vector<double> values = table.numbers(key, size(dimension));
  Point point{};
  std::copy(values.begin(), values.end(), point.begin());
  return point;
}

Box read_box(const TomlTable& table, int dimension) {
  return {read_point(table, "lower", dimension), read_point(table, "upper", dimension)};
}

/// Sets flags[i] for each of names[i] that the list `key` holds.
template <std::size_t N>
void read_flags(const TomlTable& table, std::string_view key,
                std::span<const std::string_view> names, std::array<bool, N>& flags) {
  if (!table.has(key)) return;
  for (const std::string& name : table.texts(key)) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      std::string known;
      for (const auto& other : names) known += (known.empty() ? "" : ", ") + std::string(other);
      throw table.error(key, '"' + name + '"', "names out of " + known);
    }
    flags[static_cast<std::size_t>(found - names.begin())] = true;
  }
}

/// Without the room that it may state.
Tank read_tank(const TomlTable& table, int dimension) {
  Tank tank;
  if (!table.has("polygon") || table.has("lower") || table.has("upper"))
    tank.box = read_box(table, dimension);
  read_flags(table, "open", std::span(side_names).first(2 * size(dimension)), tank.open);
  read_flags(table, "periodic", std::span(axis_names).first(size(dimension)), tank.periodic);
  if (table.has("wall")) tank.wall = table.enumerator("wall", enum_names<WallCondition>);
  return tank;
}

FluidBlock read_block(const TomlTable& table, int dimension) {
  FluidBlock block;
  block.shape = table.enumerator("shape", enum_names<FluidBlock::Shape>);
  block.box = read_box(table, dimension);
  if (table.has("velocity")) block.velocity = read_point(table, "velocity", dimension);
  if (table.has("velocity_gradient")) {
    const auto rows = table.matrix("velocity_gradient", size(dimension), size(dimension));
    for (std::size_t a = 0; a < rows.size(); ++a) {
      std::copy(rows[a].begin(), rows[a].end(), block.velocity_gradient[a].begin());
    }
  }
  block.wave_amplitude = table.number_or("wave_amplitude", 0.0, Bounds::at_least(0.0));
  return block;
}

TimeControl read_time(const TomlTable& table) {
  TimeControl time;
  time.end = table.number("end", Bounds::above(0.0));
  time.initial_step = table.number_or("initial_step", time.initial_step, Bounds::above(0.0));
  time.maximum_step = table.number_or("maximum_step", time.maximum_step, Bounds::above(0.0));
  time.courant = table.number_or("courant", time.courant, Bounds::above_to(0.0, 1.0));
  return time;
}

/// spacing, or per = particles and length = the length (m) that holds them. What is given on the
/// command line stands for what the file says.
double read_spacing(const TomlTable& table) {
  const bool by_count = table.has("per");
  const bool by_length = table.has("spacing");
  if (by_count && by_length && table.overridden("per") == table.overridden("spacing")) {
    throw table.error("per", "a spacing besides",
                      "either spacing, or per (particles) and length (m)");
  }
  if (!by_count || (by_length && table.overridden("spacing"))) {
    if (by_length) static_cast<void>(table.number_or("length", 1.0, Bounds::above(0.0)));
    return table.number("spacing", Bounds::above(0.0));
  }
  const double per = table.number("per", Bounds::at_least(1.0));
  return table.number("length", Bounds::above(0.0)) / per;
}

MovingWall read_moving_wall(const TomlTable& table, int dimension) {
  return {table.text("name"), read_box(table, dimension),
          read_direction(table, "direction", dimension), read_law(table)};
}

Probe read_probe(const TomlTable& table, int dimension) {
  return {table.text("name"), read_point(table, "position", dimension),
          table.number_or("diameter", 0.0, Bounds::at_least(0.0))};
}

/// The number behind `prefix` in a text such as obstacle.0.
std::optional<std::size_t> number_after(std::string_view text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return std::nullopt;
  const std::string_view digits = text.substr(prefix.size());
  std::size_t number = 0;
  const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (code != std::errc{} || end != digits.data() + digits.size()) return std::nullopt;
  return number;
}

/// on = "x+" (a side), "obstacle.0" or the name of a moving wall; read after all of them.
ForceSurface read_force(const TomlTable& table, const Case& c) {
  const std::string on = table.text("on");
  ForceSurface force{table.text_or("name", on), ForceSurface::Of::side, 0};
  const auto sides = std::span(side_names).first(2 * size(c.dimension));
  if (const auto side = std::find(sides.begin(), sides.end(), on); side != sides.end()) {
    force.index = static_cast<std::size_t>(side - sides.begin());
    return force;
  }
  force.of = ForceSurface::Of::obstacle;
  if (const auto obstacle = number_after(on, "obstacle.")) {
    force.index = *obstacle;
    if (force.index < c.obstacles.size()) return force;
  }
  force.of = ForceSurface::Of::moving_wall;
  for (force.index = 0; force.index < c.moving_walls.size(); ++force.index)
    if (c.moving_walls[force.index].name == on) return force;
  throw table.error("on", '"' + on + '"',
                    "a side such as \"x+\", an obstacle such as \"obstacle.0\" of the " +
                        std::to_string(c.obstacles.size()) + ", or the name of a moving wall");
}

}  // namespace

Case read_case(const TomlTable& root) {
  Case c;
  c.title = root.text("title");
  c.dimension = static_cast<int>(root.integer("dimension", Bounds::closed(2, 3)));
  const TomlTable fluid = root.table("fluid");
  c.density = fluid.number("density", Bounds::above(0.0));
  c.kinematic_viscosity = fluid.number_or("kinematic_viscosity", 0.0, Bounds::at_least(0.0));
  c.reference_speed = fluid.number_or("reference_speed", 0.0, Bounds::at_least(0.0));
  c.gravity = read_point(fluid, "gravity", c.dimension);
  c.has_tank = root.has("tank");
  if (c.has_tank) c.tank = read_tank(root.table("tank"), c.dimension);
  for (const TomlTable& table : root.tables("block"))
    c.blocks.push_back(read_block(table, c.dimension));
  for (const TomlTable& table : root.tables("obstacle")) {
    c.obstacles.push_back(read_obstacle(table, c.dimension));
  }
  if (c.has_tank)
    for (Obstacle& body : read_room(root.table("tank"), c.dimension, c.tank))
      c.obstacles.push_back(std::move(body));
  if (const auto table = root.optional_table("motion"))
    c.motion = read_tank_motion(*table, c.dimension);
  for (const TomlTable& table : root.tables("moving_wall"))
    c.moving_walls.push_back(read_moving_wall(table, c.dimension));
  for (const TomlTable& table : root.tables("probe"))
    c.probes.push_back(read_probe(table, c.dimension));
  for (const TomlTable& table : root.tables("gauge"))
    c.gauges.push_back({table.text("name"), read_point(table, "position", c.dimension)});
  for (const TomlTable& table : root.tables("force")) c.forces.push_back(read_force(table, c));
  c.spacing = read_spacing(root.table("resolution"));
  c.time = read_time(root.table("time"));
  const TomlTable output = root.table("output");
  c.output_interval = output.number("interval", Bounds::above(0.0));
  c.checkpoint_interval =
      output.number_or("checkpoint", c.checkpoint_interval, Bounds::at_least(0.0));
  return c;
}

}  // namespace surge
