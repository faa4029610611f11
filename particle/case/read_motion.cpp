#include "particle/case/read_motion.hpp"

#include <charconv>
#include <cmath>
#include <fstream>

#include "particle/case/enum_names.hpp"
#include "particle/case/scales.hpp"
#include "particle/support/printable.hpp"
#include "particle/support/regular_file.hpp"

namespace surge {

namespace {

using Sample = std::array<double, 2>;

constexpr std::size_t most_samples = 50000;  // which a case file holds, too
constexpr std::size_t longest_line = 1000;

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

/// Reads a whole text as a finite number.
bool parse_number(std::string_view text, double& value) {
  text = trimmed(text);
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  return result.ec == std::errc{} && result.ptr == end && std::isfinite(value);
}

bool parse_sample(std::string_view line, Sample& sample) {
  const std::size_t comma = line.find(',');
  return comma != std::string_view::npos && parse_number(line.substr(0, comma), sample[0]) &&
         parse_number(line.substr(comma + 1), sample[1]);
}

/// A piece of a file as an error shows it: short, and without what a terminal would obey.
std::string shown(std::string_view line) {
  return printable(line.substr(0, 60));
}

std::vector<Sample> read_samples(const std::filesystem::path& file) {
  std::ifstream stream = open_regular(file, most_table_bytes, "a table of time,value");
  std::vector<Sample> samples;
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    const std::string place = file.string() + ":" + std::to_string(number) + ": ";
    if (line.size() > longest_line || samples.size() == most_samples)
      throw Error(place + "found a table that is too long, expected at most " +
                  std::to_string(most_samples) + " lines of time,value");
    if (trimmed(line).empty()) continue;
    Sample sample{};
    if (parse_sample(line, sample)) {
      samples.push_back(sample);
    } else if (number > 1) {
      throw Error(place + "found \"" + shown(line) + "\", expected two numbers, time,value");
    }
  }
  return samples;
}

void check_samples(const TomlTable& table, std::string_view key,
                   const std::vector<Sample>& samples) {
  if (samples.size() < 2) {
    throw table.error(key, std::to_string(samples.size()) + " samples", "at least two");
  }
  for (std::size_t k = 1; k < samples.size(); ++k) {
    if (samples[k][0] > samples[k - 1][0]) continue;
    throw table.error(
        key,
        "time " + number_text(samples[k][0]) + " s after " + number_text(samples[k - 1][0]) + " s",
        "times that increase");
  }
}

void read_harmonic(const TomlTable& table, ScalarMotion& law) {
  law.amplitude = table.number("amplitude");
  law.period = table.number("period", Bounds::above(0.0));
  law.phase = table.number_or("phase", 0.0);
  law.ramp = table.number_or("ramp", 0.0, Bounds::at_least(0.0));
  law.start = table.number_or("start", 0.0);
}

void read_constant(const TomlTable& table, ScalarMotion& law) {
  law.speed = table.number("speed");
  law.start = table.number_or("start", 0.0);
  law.stop = table.number("stop", Bounds::above(law.start));
}

void read_table(const TomlTable& table, ScalarMotion& law) {
  law.quantity = table.enumerator("quantity", enum_names<ScalarMotion::Quantity>);
  const bool in_file = table.has("table");
  if (in_file == table.has("samples")) {
    throw table.error("table", in_file ? "samples besides" : "no such key",
                      "either table = \"FILE.csv\" or samples = [[time, value], ...]");
  }
  if (in_file) {
    law.samples = read_samples(table.folder() / table.text("table"));
  } else {
    for (const auto& row : table.matrix("samples", {}, 2)) law.samples.push_back({row[0], row[1]});
  }
  check_samples(table, in_file ? "table" : "samples", law.samples);
}

}  // namespace

Point read_direction(const TomlTable& table, std::string_view key, int dimension) {
  const std::vector<double> values = table.numbers(key, static_cast<std::size_t>(dimension));
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  if (!(largest > 0.0)) throw table.error(key, "a zero vector", "a direction");
  Point direction{};
  for (std::size_t a = 0; a < values.size(); ++a) direction[a] = values[a] / largest;
  const double norm = length(direction);
  for (std::size_t a = 0; a < values.size(); ++a) direction[a] /= norm;
  // What is a unit vector already stays as it is, to the last bit.
  const double given = length({values[0], values[1], dimension == 3 ? values[2] : 0.0});
  if (std::abs(given - 1.0) < 1e-12) std::copy(values.begin(), values.end(), direction.begin());
  return direction;
}

ScalarMotion read_law(const TomlTable& table) {
  ScalarMotion law;
  law.kind = table.enumerator("law", enum_names<ScalarMotion::Kind>);
  if (law.kind == ScalarMotion::Kind::harmonic) read_harmonic(table, law);
  if (law.kind == ScalarMotion::Kind::constant) read_constant(table, law);
  if (law.kind == ScalarMotion::Kind::table) read_table(table, law);
  return law;
}

TankMotion read_tank_motion(const TomlTable& table, int dimension) {
  TankMotion motion;
  motion.kind = table.enumerator("kind", enum_names<TankMotion::Kind>);
  if (motion.kind == TankMotion::Kind::translation) {
    motion.direction = read_direction(table, "direction", dimension);
  } else {
    const auto centre = table.numbers("centre", static_cast<std::size_t>(dimension));
    std::copy(centre.begin(), centre.end(), motion.centre.begin());
    motion.direction = {0.0, 0.0, 1.0};
    if (dimension == 3) motion.direction = read_direction(table, "direction", dimension);
  }
  motion.law = read_law(table);
  return motion;
}

}  // namespace surge
