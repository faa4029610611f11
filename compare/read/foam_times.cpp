#include "compare/read/foam_times.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>

#include "compare/read/foam_dictionary.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {

namespace fs = std::filesystem;

namespace {

std::optional<double> time_of(const std::string& name) {
  double value = 0.0;
  const auto [end, failed] = std::from_chars(name.data(), name.data() + name.size(), value);
  if (failed != std::errc() || end != name.data() + name.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

/// Time folders by their value.
std::map<double, fs::path> time_folders(const fs::path& folder) {
  std::map<double, fs::path> times;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (!entry.is_directory()) continue;
    if (const auto time = time_of(entry.path().filename().string())) times[*time] = entry.path();
  }
  return times;
}

bool has_field(const fs::path& time, const std::string& field) {
  return fs::is_regular_file(time / field) || fs::is_regular_file(time / (field + ".gz"));
}

std::string list_text(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// Processor folders `processorK` by K.
std::map<int, fs::path> processor_folders(const fs::path& folder) {
  static const std::regex pattern("processor([0-9]{1,6})");
  std::map<int, fs::path> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    std::smatch match;
    const std::string name = entry.path().filename().string();
    if (entry.is_directory() && std::regex_match(name, match, pattern))
      found[std::stoi(match[1])] = entry.path();
  }
  return found;
}

/// The highest processor that a processor's patches `procBoundaryAtoB` lead to.
int last_neighbour(const fs::path& processor) {
  std::ifstream in(processor / "constant" / "polyMesh" / "boundary", std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  const std::string all = text.str();
  static const std::regex pattern("procBoundary[0-9]{1,6}to([0-9]{1,6})");
  int last = -1;
  for (std::sregex_iterator it(all.begin(), all.end(), pattern), end; it != end; ++it)
    last = std::max(last, std::stoi((*it)[1]));
  return last;
}

/// numberOfSubdomains of decomposeParDict; empty where that is not there or not a plain number.
std::optional<int> announced_processors(const fs::path& folder) {
  try {
    const auto dictionary = FoamDictionary::read(folder / "system" / "decomposeParDict");
    return static_cast<int>(std::clamp(dictionary.number("numberOfSubdomains"), 0.0, 1e6));
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace

std::vector<fs::path> foam_processors(const fs::path& folder) {
  const std::map<int, fs::path> found = processor_folders(folder);
  std::vector<fs::path> folders;
  if (found.empty()) return folders;
  int last = found.rbegin()->first;
  for (const auto& [number, path] : found) last = std::max(last, last_neighbour(path));
  const int announced = announced_processors(folder).value_or(last + 1);
  std::vector<std::string> missing;
  for (int k = 0; k <= last; ++k)
    if (!found.contains(k)) missing.push_back("processor" + std::to_string(k));
  if (!missing.empty()) {
    throw Error(folder.string() + ": " + list_text(missing) + " not there, a folder for each of " +
                std::to_string(last + 1) + " processors expected");
  }
  if (announced > last + 1) {
    throw Error(folder.string() + ": " + std::to_string(found.size()) +
                " processor folders found, " + std::to_string(announced) +
                " expected (numberOfSubdomains in system/decomposeParDict)");
  }
  for (const auto& [number, path] : found) folders.push_back(path);
  return folders;
}

FoamTimes foam_times(const std::vector<fs::path>& folders, const std::string& field) {
  FoamTimes result;
  std::map<double, std::vector<std::string>> lacking;  // folders without the field
  std::map<double, std::size_t> having;
  for (const fs::path& folder : folders) {
    for (const auto& [time, path] : time_folders(folder)) {
      if (has_field(path, field)) {
        ++having[time];
      } else {
        lacking[time].push_back(folder.filename().string());
      }
    }
  }
  for (const auto& [time, count] : having)
    if (count == folders.size() && time >= 0.0) result.times.emplace_back(time);
  for (const auto& [time, names] : lacking) {
    if (having.contains(time) && having.at(time) > 0 && folders.size() > 1) continue;
    result.notices.push_back("time " + number_text(time) + " has no " + field + ": left out");
  }
  for (const auto& [time, count] : having) {
    if (time < 0.0)
      result.notices.push_back("time " + number_text(time) + " is before the start: left out");
    if (count == folders.size()) continue;
    result.notices.push_back("time " + number_text(time) + " is in " + std::to_string(count) +
                             " of " + std::to_string(folders.size()) +
                             " processor folders only (unfinished): left out");
  }
  return result;
}

std::vector<std::string> foam_phases(const fs::path& folder) {
  std::set<std::string> names;
  const auto times = time_folders(folder);
  for (const auto& [time, path] : times) {
    for (const fs::directory_entry& entry : fs::directory_iterator(path)) {
      std::string name = entry.path().filename().string();
      if (name.ends_with(".gz")) name.resize(name.size() - 3);
      if (name.starts_with("alpha.") && name.find('_') == std::string::npos) names.insert(name);
    }
    if (!names.empty()) break;
  }
  return {names.begin(), names.end()};
}

void refuse_collated(const fs::path& folder, const std::string& field) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (!entry.is_directory() || !name.starts_with("processors")) continue;
    const FoamTimes there = foam_times({entry.path()}, field);
    const FoamTimes here = foam_times({folder}, field);
    if (there.times.size() <= here.times.size()) continue;
    throw Error(folder.string() + ": " + std::to_string(there.times.size()) + " times in " + name +
                ", the collated format, which is not read, and " +
                std::to_string(here.times.size()) +
                " in the case itself; expected the times in the case (run reconstructPar)");
  }
}

}  // namespace surge::compare
