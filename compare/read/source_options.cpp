#include "compare/read/source_options.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "particle/support/error.hpp"
#include "particle/support/spelling.hpp"
#include "particle/support/text.hpp"
#include "particle/support/toml.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;
using Words = std::span<const std::string>;

/// What a key is set to, with its place.
struct Setting {
  Words words;
  std::string place;
  fs::path folder;

  [[noreturn]] void fail(const std::string& expected) const {
    throw Error(place + ": found \"" + comma_list(words) + "\", expected " + expected);
  }
  [[nodiscard]] const std::string& one(const std::string& expected = "one value") const {
    if (words.size() != 1 || words[0].empty()) fail(expected);
    return words[0];
  }
  [[nodiscard]] double number(const std::string& expected, double least) const {
    const std::string& word = one(expected);
    double value = 0.0;
    const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (failed != std::errc() || end != word.data() + word.size() || !std::isfinite(value) ||
        value < least)
      fail(expected);
    return value;
  }
  [[nodiscard]] double positive() const {
    return number("a positive number", std::numeric_limits<double>::min());
  }
  [[nodiscard]] std::vector<std::string> some() const {
    if (words.empty() || std::any_of(words.begin(), words.end(),
                                     [](const std::string& word) { return word.empty(); }))
      fail("one name or more");
    return {words.begin(), words.end()};
  }
  [[nodiscard]] double factor(const std::map<std::string, double>& units) const {
    std::string names;
    for (const auto& [name, value] : units) names += (names.empty() ? "" : ", ") + name;
    const auto found = units.find(one("one of " + names));
    if (found == units.end()) fail("one of " + names);
    return found->second;
  }
};

const std::map<std::string, double> lengths{{"m", 1.0}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}};
const std::map<std::string, double> times{{"s", 1.0}, {"ms", 1e-3}, {"us", 1e-6}};
const std::map<std::string, double> velocities{{"m/s", 1.0}, {"cm/s", 1e-2}, {"mm/s", 1e-3}};
const std::map<std::string, double> pressures{
    {"Pa", 1.0}, {"hPa", 1e2}, {"kPa", 1e3}, {"bar", 1e5}};

int dimension_of(const Setting& s) {
  const std::string& word = s.one("2 or 3");
  if (word != "2" && word != "3") s.fail("2 or 3");
  return word == "2" ? 2 : 3;
}

std::string format_of(const Setting& s) {
  const std::string expected = "vtk, csv, hdf5 or lammps";
  const std::string& word = s.one(expected);
  for (const char* name : {"vtk", "csv", "hdf5", "lammps"})
    if (word == name) return word;
  s.fail(expected);
}

std::vector<std::string> components_of(const Setting& s) {
  if (s.words.size() > 3) s.fail("one vector, or two or three components");
  return s.some();
}

void set_vertical(SourceOptions& o, const Setting& s) {
  const std::string& word = s.one("y or z");
  if (word != "y" && word != "z") s.fail("y or z");
  o.vertical_axis = word == "z" ? 2 : 1;
  o.vertical_stated = true;
}

using Setter = std::function<void(SourceOptions&, const Setting&)>;
struct OptionEntry {
  SourceKey key;
  Setter set;
};

const std::vector<OptionEntry>& option_entries() {
  using O = SourceOptions;
  using S = Setting;
  static const std::vector<OptionEntry> list{
      {{"column_width", "L, width of the column at time 0, m"},
       [](O& o, const S& s) { o.column_width = Metres(s.positive()); }},
      {{"column_height", "height of the column at time 0, m"},
       [](O& o, const S& s) { o.column_height = Metres(s.positive()); }},
      {{"tank_width", "far wall from the column's wall, m"},
       [](O& o, const S& s) { o.tank_width = Metres(s.positive()); }},
      {{"tank_height", "top of the tank above its floor, m"},
       [](O& o, const S& s) { o.tank_height = Metres(s.positive()); }},
      {{"bed_depth", "depth of the water that lies in the tank at time 0, m"},
       [](O& o, const S& s) { o.bed_depth = Metres(s.positive()); }},
      {{"density", "of the water, kg/m3"}, [](O& o, const S& s) { o.density = s.positive(); }},
      {{"gravity", "magnitude, m/s2"}, [](O& o, const S& s) { o.gravity = s.positive(); }},
      {{"dimension", "2 or 3"}, [](O& o, const S& s) { o.dimension = dimension_of(s); }},
      {{"vertical", "axis of the files that points up: y or z"}, set_vertical},
      {{"axes", "axes of the files along the surge and up, such as x,z or -y,z", true},
       [](O& o, const S& s) { o.axes = FileAxes::parse(s.words, s.place); }},
      {{"spacing", "particle spacing l0, m"},
       [](O& o, const S& s) { o.spacing = Metres(s.positive()); }},
      {{"time_step", "s from one number in the names (step of a dump) to the next"},
       [](O& o, const S& s) { o.time_step = Seconds(s.positive()); }},
      {{"first_time", "time of the first file, s [its number times time_step]"},
       [](O& o, const S& s) { o.first_time = Seconds(s.number("a time of 0 or later", 0.0)); }},
      {{"time_array", "column, field data or HDF5 attribute (group@name) with the time"},
       [](O& o, const S& s) { o.time_array = s.one(); }},
      {{"time_file", "CSV with the number (or step) and the time of each frame"},
       [](O& o, const S& s) { o.time_file = s.folder / s.one(); }},
      {{"length_unit", "of the files: m, cm, mm, um"},
       [](O& o, const S& s) { o.units.length = s.factor(lengths); }},
      {{"time_unit", "of the files: s, ms, us"},
       [](O& o, const S& s) { o.units.time = s.factor(times); }},
      {{"velocity_unit", "of the files: m/s, cm/s, mm/s [length_unit / time_unit]"},
       [](O& o, const S& s) { o.units.velocity = s.factor(velocities); }},
      {{"pressure_unit", "of the files: Pa, hPa, kPa, bar"},
       [](O& o, const S& s) { o.units.pressure = s.factor(pressures); }},
      {{"format", "vtk, csv, hdf5, lammps [by the files]"},
       [](O& o, const S& s) { o.format = format_of(s); }},
      {{"files", "patterns of the files with the fluid, inside the source's folder", true},
       [](O& o, const S& s) { o.files = s.some(); }},
      {{"walls", "patterns of files with walls only, which are left out", true},
       [](O& o, const S& s) { o.walls = s.some(); }},
      {{"groups", "groups of an HDF5 file with the fluid; * stands for the times", true},
       [](O& o, const S& s) { o.groups = s.some(); }},
      {{"position_array", "position: a vector, or its components", true},
       [](O& o, const S& s) { o.position_array = components_of(s); }},
      {{"velocity_array", "velocity: a vector, or its components [velocity]", true},
       [](O& o, const S& s) { o.velocity_array = components_of(s); }},
      {{"pressure_array", "pressure [pressure]"},
       [](O& o, const S& s) { o.pressure_array = s.one(); }},
      {{"type_array", "array that tells fluid from walls [type, if there is one]"},
       [](O& o, const S& s) {
         o.type_array = s.one();
         o.type_required = true;
       }},
      {{"fluid_type", "its values for fluid: 3 or 1,2 or 1-3 or water [0]; all where all are",
        true},
       [](O& o, const S& s) {
         o.all_fluid = s.words.size() == 1 && s.words[0] == "all";
         if (!o.all_fluid) o.fluid_type = TypeValues::parse(s.words, s.place);
       }},
      {{"alpha_array", "volume fraction of water in an OpenFOAM case [alpha.water]"},
       [](O& o, const S& s) { o.alpha_array = s.one(); }}};
  return list;
}

std::size_t axis_of(char letter) {
  return static_cast<std::size_t>(std::string("xyz").find(letter));
}

}  // namespace

TypeValues TypeValues::parse(Words words, const std::string& place) {
  TypeValues values(0);
  values.ranges_.clear();
  const std::string expected = "whole numbers such as 3 or 1-3, or words such as water";
  const auto is_word = [](const std::string& word) {
    return !word.empty() && std::isalpha(static_cast<unsigned char>(word[0])) != 0;
  };
  // No number is among the values then; the words are those that were stated.
  if (!words.empty() && std::all_of(words.begin(), words.end(), is_word)) return values;
  for (const std::string& word : words) {
    const auto fail = [&] {
      throw Error(place + ": found \"" + word + "\", expected " + expected);
    };
    long first = 0, last = 0;
    const char* end = word.data() + word.size();
    auto [rest, failed] = std::from_chars(word.data(), end, first);
    if (failed != std::errc()) fail();
    last = first;
    if (rest != end) {
      if (*rest != '-') fail();
      const auto second = std::from_chars(rest + 1, end, last);
      if (second.ec != std::errc() || second.ptr != end || last < first) fail();
    }
    values.ranges_.emplace_back(first, last);
  }
  if (values.ranges_.empty()) throw Error(place + ": found nothing, expected " + expected);
  return values;
}

bool TypeValues::contain(double value) const {
  if (value != std::round(value)) return false;
  return std::any_of(ranges_.begin(), ranges_.end(), [&](const auto& range) {
    return value >= static_cast<double>(range.first) && value <= static_cast<double>(range.second);
  });
}

std::string TypeValues::text() const {
  std::string text;
  for (const auto& [first, last] : ranges_) {
    if (!text.empty()) text += ',';
    text += std::to_string(first);
    if (last == first) continue;
    text += '-';
    text += std::to_string(last);
  }
  return text;
}

FileAxes FileAxes::parse(Words words, const std::string& place) {
  const auto fail = [&] {
    throw Error(place + ": found \"" + comma_list(words) +
                "\", expected the axes along the surge and up, two of x, y, z with or without -, "
                "such as x, z");
  };
  FileAxes axes;
  if (words.size() != 2) fail();
  for (std::size_t a = 0; a < 2; ++a) {
    std::string word = words[a];
    if (word.size() == 2 && (word[0] == '-' || word[0] == '+')) {
      axes.sign[a] = word[0] == '-' ? -1.0 : 1.0;
      word.erase(0, 1);
    }
    if (word.size() != 1 || axis_of(word[0]) > 2) fail();
    axes.axis[a] = axis_of(word[0]);
  }
  if (axes.axis[0] == axes.axis[1]) fail();
  axes.axis[2] = 3 - axes.axis[0] - axes.axis[1];
  const bool even = (axes.axis[1] + 3 - axes.axis[0]) % 3 == 1;
  axes.sign[2] = (even ? 1.0 : -1.0) * axes.sign[0] * axes.sign[1];
  return axes;
}

std::string FileAxes::text() const {
  std::string text;
  for (std::size_t a = 0; a < 2; ++a) {
    if (a > 0) text += ", ";
    if (sign[a] < 0.0) text += '-';
    text += "xyz"[axis[a]];
  }
  return text;
}

const std::vector<SourceKey>& source_keys() {
  static const std::vector<SourceKey> keys = [] {
    std::vector<SourceKey> list;
    for (const OptionEntry& entry : option_entries()) list.push_back(entry.key);
    return list;
  }();
  return keys;
}

void set_source_option(SourceOptions& options, const std::string& key, Words words,
                       const std::string& place, const fs::path& folder) {
  for (const OptionEntry& entry : option_entries()) {
    if (entry.key.name != key) continue;
    if ((key == "axes" && options.vertical_stated) || (key == "vertical" && options.axes))
      throw Error(place + ": axes and vertical are both given, expected one of them");
    entry.set(options, {words, place, folder});
    options.stated[key] = {words.begin(), words.end()};
    if (key == "time_file") options.stated[key] = {options.time_file.string()};
    return;
  }
  std::vector<std::string> names{"map"};
  for (const SourceKey& known : source_keys()) names.push_back(known.name);
  const std::string near = nearest(key, names);
  throw Error(place + ": found no such key" +
              (near.empty() ? "" : ", did you mean \"" + near + "\"?") +
              ", expected a fact about a source's files, such as spacing or type_array");
}

SourceOptions source_options(const TomlTable& table, SourceOptions options) {
  if (table.has("map")) options = read_source_map(table.folder() / table.text("map"), options);
  for (const std::string& key : table.keys()) {
    if (key == "map") continue;
    // The message for a key that there is not must not depend on what it is set to.
    const bool known = std::any_of(source_keys().begin(), source_keys().end(),
                                   [&](const SourceKey& k) { return k.name == key; });
    const std::vector<std::string> words = known ? table.words(key) : std::vector<std::string>{};
    set_source_option(options, key, words, table.place(key), table.folder());
  }
  return options;
}

SourceOptions read_source_map(const fs::path& file, SourceOptions options) {
  const TomlTable table = TomlTable::read(file);
  if (table.has("map"))
    throw table.error("map", "a map in a map", "the keys of a source's files only");
  return source_options(table, std::move(options));
}

}  // namespace surge::compare
