#include "particle/case/case_file.hpp"

#include <algorithm>

#include "particle/case/enum_names.hpp"

namespace surge {

namespace {

constexpr std::array<std::string_view, 6> side_names{"x-", "x+", "y-", "y+", "z-", "z+"};
constexpr std::array<std::string_view, 3> axis_names{"x", "y", "z"};

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

Tank read_tank(const TomlTable& table, int dimension) {
  Tank tank;
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
    c.obstacles.push_back(read_box(table, c.dimension));
  }
  for (const TomlTable& table : root.tables("probe")) {
    c.probes.push_back({table.text("name"), read_point(table, "position", c.dimension)});
  }
  c.spacing = root.table("resolution").number("spacing", Bounds::above(0.0));
  c.time = read_time(root.table("time"));
  c.output_interval = root.table("output").number("interval", Bounds::above(0.0));
  return c;
}

}  // namespace surge
