#include "compare/read/particle_fields.hpp"

#include <algorithm>
#include <cctype>
#include <set>

#include "compare/read/delimited.hpp"
#include "particle/support/error.hpp"
#include "particle/support/spelling.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

/// 0, 1, 2 for a name that ends so; 3 for others.
std::size_t axis_of(const std::string& name) {
  std::string plain = plain_name(name);
  while (!plain.empty() && (plain.back() == ']' || plain.back() == ')')) plain.pop_back();
  if (plain.empty()) return 3;
  for (const std::string letters : {"xyz", "uvw", "012"})
    if (const auto at = letters.find(plain.back()); at != std::string::npos) return at;
  // Scaled and unwrapped coordinates of LAMMPS.
  for (const std::string tail : {"su", "s", "u"})
    if (plain.size() == tail.size() + 1 && plain.ends_with(tail))
      if (const auto at = std::string("xyz").find(plain[0]); at != std::string::npos) return at;
  return 3;
}

}  // namespace

VectorField VectorField::of(const std::vector<std::string>& names) {
  VectorField field{names, {}};
  std::set<std::size_t> used;
  for (const std::string& name : names) field.axes.push_back(axis_of(name));
  for (const std::size_t axis : field.axes) used.insert(axis);
  if (used.size() != names.size() || used.contains(3))
    for (std::size_t i = 0; i < names.size(); ++i) field.axes[i] = i;
  return field;
}

std::vector<std::string> usual_position(const ParticleTable& table) {
  // How x, y and z are usually called.
  static const std::vector<std::vector<std::string>> usual{
      {"x", "y", "z"},
      {"pos.x", "pos.y", "pos.z"},
      {"posx", "posy", "posz"},
      {"pos_x", "pos_y", "pos_z"},
      {"position_x", "position_y", "position_z"},
      {"position.x", "position.y", "position.z"},
      {"points:0", "points:1", "points:2"},
      {"points_0", "points_1", "points_2"},
      {"position:0", "position:1", "position:2"},
      {"position_0", "position_1", "position_2"},
      {"coordinates_0", "coordinates_1", "coordinates_2"},
      {"xu", "yu", "zu"},
      {"xs", "ys", "zs"},
      {"xsu", "ysu", "zsu"}};
  for (const char* name : {"position", "positions", "coordinates", "pos", "points", "r", "x"})
    for (const ParticleArray& array : table.arrays)
      if (plain_name(array.name) == name && array.components > 1 && array.components < 4)
        return {array.name};
  for (const auto& names : usual) {
    std::vector<std::string> found;
    for (const std::string& name : names)
      for (const ParticleArray& array : table.arrays)
        if (array.components == 1 && !array.is_text() && plain_name(array.name) == name) {
          found.push_back(array.name);
          break;
        }
    if (found.size() >= 2 && plain_name(found[0]) == names[0]) return found;
    // A plane of y and z.
    if (found.size() == 2 && &names == &usual.front()) return found;
  }
  return {};
}

const ParticleArray& require_array(const ParticleTable& table, const std::string& name,
                                   int components, const fs::path& file) {
  const ParticleArray* array = table.find(name);
  if (array == nullptr)
    throw Error(file.string() + ": point array " + name + ": none found, one expected");
  if (array->components != components ||
      array->values.size() != table.count * static_cast<std::size_t>(components))
    throw Error(file.string() + ": point array " + name + ": " + std::to_string(array->components) +
                " components and " +
                std::to_string(array->values.size() /
                               static_cast<std::size_t>(std::max(array->components, 1))) +
                " values found, " + std::to_string(components) + " and " +
                std::to_string(table.count) + " expected");
  return *array;
}

FluidTypes::FluidTypes(const SourceOptions& options) : values(options.fluid_type.value_or(0)) {
  if (!values.text().empty()) return;
  const auto stated = options.stated.find("fluid_type");
  if (stated != options.stated.end()) words = stated->second;
}

std::string FluidTypes::text() const {
  std::string text = values.text();
  for (const std::string& word : words) text += (text.empty() ? "" : ",") + word;
  return text;
}

std::vector<bool> FluidTypes::fluid(const ParticleArray& type, const fs::path& file) const {
  if (type.is_text() == words.empty())
    throw Error(file.string() + ": point array " + type.name + ": " +
                (type.is_text() ? "words" : "numbers") + " found, fluid_type \"" + text() +
                "\" expected among them");
  std::vector<bool> of_word;
  for (const std::string& word : type.words)
    of_word.push_back(std::find(words.begin(), words.end(), word) != words.end());
  std::vector<bool> found;
  for (const double value : type.values) {
    const auto place = static_cast<std::size_t>(value);
    found.push_back(type.is_text() ? place < of_word.size() && of_word[place]
                                   : values.contain(value));
  }
  return found;
}

/// Positions, velocities and pressures are numbers.
const ParticleArray& require_numbers(const ParticleTable& table, const std::string& name,
                                     int components, const fs::path& file) {
  const ParticleArray& array = require_array(table, name, components, file);
  if (array.is_text())
    throw Error(file.string() + ": point array " + name + ": \"" + array.words.front() +
                "\" found, numbers expected");
  return array;
}

std::vector<Vec3> vectors(const ParticleTable& table, const VectorField& field,
                          const fs::path& file) {
  std::vector<Vec3> found(table.count, Vec3{});
  if (field.names.size() == 1) {
    const ParticleArray* named = table.find(field.names[0]);
    const int components = named != nullptr && named->components == 2 ? 2 : 3;
    const ParticleArray& array = require_numbers(table, field.names[0], components, file);
    const auto n = static_cast<std::size_t>(components);
    for (std::size_t i = 0; i < table.count; ++i)
      for (std::size_t c = 0; c < n; ++c) found[i][c] = array.values[i * n + c];
    return found;
  }
  for (std::size_t k = 0; k < field.names.size(); ++k) {
    const ParticleArray& array = require_numbers(table, field.names[k], 1, file);
    for (std::size_t i = 0; i < table.count; ++i) found[i][field.axes[k]] = array.values[i];
  }
  return found;
}

std::vector<Vec3> positions(const ParticleTable& table, const VectorField& field,
                            const fs::path& file) {
  if (!field.names.empty()) return vectors(table, field, file);
  if (table.points.size() != 3 * table.count)
    throw Error(file.string() + ": no position found, one expected (--position-array)");
  std::vector<Vec3> found(table.count);
  for (std::size_t i = 0; i < table.count; ++i)
    found[i] = {table.points[3 * i], table.points[3 * i + 1], table.points[3 * i + 2]};
  return found;
}

}  // namespace surge::compare
