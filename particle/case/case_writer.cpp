#include <sstream>

#include "particle/case/case_file.hpp"
#include "particle/case/case_json.hpp"
#include "particle/case/enum_names.hpp"

namespace surge {

namespace {

using nlohmann::json;

constexpr std::array<const char*, 6> side_names{"x-", "x+", "y-", "y+", "z-", "z+"};
constexpr std::array<const char*, 3> axis_names{"x", "y", "z"};

template <std::size_t N>
json names_of(const std::array<bool, N>& flags, const std::array<const char*, N>& names) {
  json list = json::array();
  for (std::size_t i = 0; i < N; ++i) {
    if (flags[i]) list.push_back(names[i]);
  }
  return list;
}

json box_json(const Box& box) {
  return {{"lower", box.lower}, {"upper", box.upper}};
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
                       key == "position";
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
  for (const Box& box : c.obstacles) j["obstacles"].push_back(box_json(box));
  j["probes"] = json::array();
  for (const Probe& probe : c.probes) {
    j["probes"].push_back({{"name", probe.name}, {"position", probe.position}});
  }
  j["time"] = {{"end", c.time.end},
               {"initial_step", c.time.initial_step},
               {"maximum_step", c.time.maximum_step},
               {"courant", c.time.courant}};
  j["output"] = {{"interval", c.output_interval}};
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
  for (const json& box : j["obstacles"]) write_table(out, "[[obstacle]]", box, dimension);
  for (const json& probe : j["probes"]) write_table(out, "[[probe]]", probe, dimension);
  write_table(out, "[resolution]", {{"spacing", c.spacing}}, dimension);
  write_table(out, "[time]", j["time"], dimension);
  write_table(out, "[output]", j["output"], dimension);
  return out.str();
}

}  // namespace surge
