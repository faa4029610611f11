#include "compare/measure/recorded.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>

#include "compare/read/foam_reader.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"
#include "particle/support/regular_file.hpp"

namespace surge::compare {

namespace fs = std::filesystem;

namespace {

std::vector<std::string> split(const std::string& line, const char* separators, bool keep_empty) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find_first_of(separators, at), line.size());
    if (keep_empty || end > at) words.push_back(line.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

double number(const std::string& word, const std::string& place) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value))
    throw Error(place + ": found \"" + word + "\", expected a finite number");
  return value;
}

void require_later(const std::vector<double>& times, double time, const std::string& place) {
  if (!times.empty() && !(time > times.back()))
    throw Error(place + ": found the time " + number_text(time) + " s after " +
                number_text(times.back()) + " s, expected increasing times");
}

std::optional<double> start_of(const fs::path& folder) {
  const std::string name = folder.filename().string();
  double value = 0.0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), value);
  const bool all = error == std::errc{} && end == name.data() + name.size();
  return all ? std::optional(value) : std::nullopt;
}

/// Files postProcessing/NAME/TIME/FILE by their start time.
std::map<double, fs::path> files_of(const Run& run, const std::string& name,
                                    const std::string& file) {
  std::map<double, fs::path> files;
  const fs::path folder = run.path / "postProcessing" / name;
  if (!fs::is_directory(folder)) return files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const auto start = start_of(entry.path());
    if (start && fs::is_regular_file(entry.path() / file)) files[*start] = entry.path() / file;
  }
  return files;
}

const FoamReader* foam_reader(const Run& run) {
  return dynamic_cast<const FoamReader*>(run.frames.get());
}

/// As the frames count time and axes.
double frame_time(const Run& run, double time) {
  const FoamReader* reader = foam_reader(run);
  return reader != nullptr ? time - reader->start() : time;
}

Vec3 frame_vector(const Run& run, const Vec3& v) {
  const FoamReader* reader = foam_reader(run);
  return reader != nullptr ? reader->axes().read(v) : v;
}

}  // namespace

Recorded read_recorded_csv(const fs::path& file, const std::vector<std::string>& columns) {
  require_inside(file, file.parent_path());
  std::ifstream in = open_regular(file, most_table_bytes, "what the run recorded");
  std::string line;
  std::getline(in, line);
  if (!line.empty() && line.back() == '\r') line.pop_back();
  const std::vector<std::string> header = split(line, ",", true);
  Recorded table;
  std::vector<std::size_t> wanted;
  for (const std::string& column : columns) {
    const auto found = std::find(header.begin(), header.end(), column);
    if (found == header.end())
      throw Error(file.string() + ":1: found no column " + column + ", expected it among " + line);
    wanted.push_back(static_cast<std::size_t>(found - header.begin()));
  }
  table.values.resize(columns.size());
  for (std::size_t row = 2; std::getline(in, line); ++row) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty()) continue;
    const std::string place = file.string() + ":" + std::to_string(row);
    const std::vector<std::string> words = split(line, ",", true);
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      if (wanted[k] >= words.size())
        throw Error(place + ": found no column " + std::to_string(wanted[k] + 1) + ", expected " +
                    columns[k]);
      table.values[k].push_back(number(words[wanted[k]], place));
    }
    const double time = number(words.front(), place);
    require_later(table.time, time, place);
    table.time.push_back(time);
  }
  if (table.time.empty()) throw Error(file.string() + ": found no row, expected one per step");
  return table;
}

std::vector<std::string> foam_function_objects(const Run& run, const std::string& file) {
  std::vector<std::string> names;
  const fs::path folder = run.path / "postProcessing";
  if (!fs::is_directory(folder)) return names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (!files_of(run, name, file).empty()) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

FoamTable read_foam_table(const Run& run, const std::string& name, const std::string& file) {
  const std::map<double, fs::path> files = files_of(run, name, file);
  if (files.empty())
    throw Error((run.path / "postProcessing" / name).string() + ": found no " + file +
                " in it, expected what the function object recorded");
  FoamTable table;
  for (const auto& [start, path] : files) {
    require_inside(path, run.path);
    std::ifstream in = open_regular(path, most_table_bytes, "what was recorded");
    table.comments.clear();
    bool first = true;
    std::string line;
    for (std::size_t count = 1; std::getline(in, line); ++count) {
      const std::string place = path.string() + ":" + std::to_string(count);
      const std::vector<std::string> words = split(line, " \t()\r", false);
      if (words.empty()) continue;
      if (words.front().front() == '#') {
        table.comments.push_back(line);
        continue;
      }
      const double time = frame_time(run, number(words.front(), place));
      while (first && !table.time.empty() && table.time.back() >= time) {
        table.time.pop_back();
        table.rows.pop_back();
      }
      first = false;
      require_later(table.time, time, place);
      std::vector<double> row;
      for (std::size_t k = 1; k < words.size(); ++k) row.push_back(number(words[k], place));
      if (!table.rows.empty() && row.size() != table.rows.back().size())
        throw Error(place + ": found " + std::to_string(row.size()) + " numbers, expected " +
                    std::to_string(table.rows.back().size()) + " as before");
      table.time.push_back(time);
      table.rows.push_back(std::move(row));
    }
  }
  if (table.time.empty())
    throw Error(files.rbegin()->second.string() + ": found no row, expected one per step");
  return table;
}

FoamProbes read_foam_probes(const Run& run, const std::string& name) {
  const FoamTable table = read_foam_table(run, name, "p");
  const std::string place = (run.path / "postProcessing" / name).string();
  FoamProbes probes;
  for (const std::string& comment : table.comments) {
    const std::vector<std::string> words = split(comment, " \t()\r#", false);
    if (words.size() < 5 || words[0] != "Probe" || comment.find('(') == std::string::npos) continue;
    if (comment.find("Not Found") != std::string::npos)
      throw Error(place + ": found a probe outside of the mesh: " + comment +
                  ", expected places inside");
    probes.places.push_back(frame_vector(
        run, {number(words[2], place), number(words[3], place), number(words[4], place)}));
  }
  const std::size_t columns = table.rows.front().size();
  if (probes.places.size() != columns)
    throw Error(place + ": found " + std::to_string(probes.places.size()) + " places and " +
                std::to_string(columns) + " columns, expected one each");
  probes.pressure.time = table.time;
  probes.pressure.values.resize(columns);
  for (const auto& row : table.rows) {
    for (std::size_t k = 0; k < columns; ++k) {
      // OpenFOAM writes -1e300 for a probe that it has no value of.
      if (std::abs(row[k]) > 1e100)
        throw Error(place + ": found " + number_text(row[k]) + " of probe " + std::to_string(k) +
                    ", expected a pressure (a probe outside of the mesh?)");
      probes.pressure.values[k].push_back(row[k]);
    }
  }
  return probes;
}

Recorded read_foam_force(const Run& run, const std::string& name) {
  const FoamTable table = read_foam_table(run, name, "force.dat");
  const std::string place = (run.path / "postProcessing" / name).string();
  // "# Time (total_x total_y total_z) (pressure_x ...) (viscous_x ...)", with or without brackets.
  std::vector<std::string> names;
  for (const std::string& comment : table.comments) {
    std::vector<std::string> words = split(comment, " \t()\r#", false);
    if (!words.empty() && words.front() == "Time") names.assign(words.begin() + 1, words.end());
  }
  std::array<std::size_t, 3> columns{};
  for (std::size_t a = 0; a < 3; ++a) {
    const auto found = std::find(names.begin(), names.end(), std::string("total_") + "xyz"[a]);
    columns[a] = static_cast<std::size_t>(found - names.begin());
    if (found == names.end() || columns[a] >= table.rows.front().size())
      throw Error(place + ": found no column total_" + "xyz"[a] +
                  " in force.dat, expected a file of the function object forces (v1906 or later)");
  }
  Recorded force{table.time, std::vector<std::vector<double>>(3)};
  for (const auto& row : table.rows) {
    const Vec3 f = frame_vector(run, {row[columns[0]], row[columns[1]], row[columns[2]]});
    for (std::size_t a = 0; a < 3; ++a) force.values[a].push_back(f[a]);
  }
  return force;
}

}  // namespace surge::compare
