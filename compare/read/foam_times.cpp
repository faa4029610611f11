#include "compare/read/foam_times.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <regex>
#include <set>

#include "compare/read/foam_dictionary.hpp"
#include "compare/read/foam_file.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"
#include "particle/support/text.hpp"

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

/// A number as far as its letters go, but no finite one: 1e400, nan, inf.
bool is_no_finite_time(const std::string& name) {
  double value = 0.0;
  const auto [end, failed] = std::from_chars(name.data(), name.data() + name.size(), value);
  return end == name.data() + name.size() && !time_of(name);
}

[[noreturn]] void refuse_same(const fs::path& folder, const std::string& a, const std::string& b) {
  throw Error(folder.string() + ": " + a + " and " + b +
              " are the same time, one of them expected");
}

/// Processor folders `processorK` by K.
std::map<int, fs::path> processor_folders(const fs::path& folder) {
  static const std::regex pattern("processor([0-9]{1,6})");
  std::map<int, fs::path> found;
  for (const fs::path& path : foam_folders(folder)) {
    std::smatch match;
    const std::string name = path.filename().string();
    if (std::regex_match(name, match, pattern) && !found.emplace(std::stoi(match[1]), path).second)
      throw Error(path.string() + ": two folders of one processor");
  }
  return found;
}

/// The highest processor that a processor's patches `procBoundaryAtoB` lead to.
int last_neighbour(const fs::path& processor, const fs::path& root) {
  const fs::path file = processor / "constant" / "polyMesh" / "boundary";
  if (!has_foam_file(file)) return -1;
  const std::string all = read_foam_file(file, root);
  static const std::regex pattern("procBoundary[0-9]{1,6}to([0-9]{1,6})");
  int last = -1;
  for (std::sregex_iterator it(all.begin(), all.end(), pattern), end; it != end; ++it)
    last = std::max(last, std::stoi((*it)[1]));
  return last;
}

/// numberOfSubdomains of decomposeParDict; empty where that is not there or not a plain number.
std::optional<int> announced_processors(const fs::path& folder) {
  try {
    const auto dictionary = FoamDictionary::read(folder / "system" / "decomposeParDict", folder);
    return static_cast<int>(std::clamp(dictionary.number("numberOfSubdomains"), 0.0, 1e6));
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace

std::map<double, std::string> foam_time_folders(const fs::path& folder) {
  std::map<double, std::string> times;
  for (const fs::path& path : foam_folders(folder)) {
    const std::string name = path.filename().string();
    const auto time = time_of(name);
    if (!time) continue;
    const auto [entry, is_new] = times.emplace(*time + 0.0, name);
    if (!is_new) refuse_same(folder, entry->second, name);
  }
  // 0.1 and 0.1000000000001, where timePrecision grew on the way.
  for (auto here = times.begin(); here != times.end(); ++here) {
    const auto next = std::next(here);
    if (next != times.end() && next->first - here->first <= 1e-9 * std::abs(next->first))
      refuse_same(folder, here->second, next->second);
  }
  return times;
}

FoamParts foam_processors(const fs::path& folder) {
  const std::map<int, fs::path> found = processor_folders(folder);
  FoamParts parts;
  if (found.empty()) return parts;
  int last = found.rbegin()->first;
  for (const auto& [number, path] : found) last = std::max(last, last_neighbour(path, folder));
  const int announced = announced_processors(folder).value_or(last + 1);
  std::vector<std::string> missing;
  for (int k = 0; k <= last && missing.size() < 8; ++k)
    if (!found.contains(k)) missing.push_back("processor" + std::to_string(k));
  if (!missing.empty()) {
    throw Error(folder.string() + ": " + comma_list(missing) + " not there, a folder for each of " +
                std::to_string(last + 1) + " processors expected");
  }
  if (announced > last + 1) {
    throw Error(folder.string() + ": " + std::to_string(found.size()) +
                " processor folders found, " + std::to_string(announced) +
                " expected (numberOfSubdomains in system/decomposeParDict)");
  }
  for (const auto& [number, path] : found) parts.folders.push_back(path);
  parts.processors = parts.folders.size();
  return parts;
}

FoamParts foam_collated(const fs::path& folder) {
  static const std::regex pattern("processors([0-9]{1,6})(_([0-9]{1,6})-([0-9]{1,6}))?");
  std::map<int, std::pair<int, fs::path>> found;  // first processor: last one, folder
  std::set<int> sizes;
  for (const fs::path& path : foam_folders(folder)) {
    std::smatch match;
    const std::string name = path.filename().string();
    if (!std::regex_match(name, match, pattern)) continue;
    sizes.insert(std::stoi(match[1]));
    const int first = match[3].matched ? std::stoi(match[3]) : 0;
    const int last = match[4].matched ? std::stoi(match[4]) : std::stoi(match[1]) - 1;
    if (!found.emplace(first, std::pair(last, path)).second && sizes.size() == 1)
      throw Error(path.string() + ": two folders with processor " + std::to_string(first));
  }
  FoamParts parts;
  if (found.empty()) return parts;
  if (sizes.size() > 1) {
    throw Error(folder.string() + ": collated results of " + std::to_string(*sizes.begin()) +
                " and of " + std::to_string(*sizes.rbegin()) +
                " processors found, one decomposition expected (remove the older)");
  }
  parts.collated = true;
  parts.processors = static_cast<std::size_t>(*sizes.begin());
  int next = 0;
  for (const auto& [first, end] : found) {
    if (first != next) break;
    next = end.first + 1;
    parts.folders.push_back(end.second);
  }
  if (next != *sizes.begin() || parts.folders.size() != found.size()) {
    throw Error(folder.string() + ": collated results of processor " + std::to_string(next) +
                " not there, those of " + std::to_string(*sizes.begin()) + " processors expected");
  }
  return parts;
}

FoamTimes foam_times(const std::vector<fs::path>& folders, const std::string& field) {
  FoamTimes result;
  std::map<double, std::size_t> there, having;
  std::map<double, std::string> names;
  std::set<std::string> odd;
  for (const fs::path& folder : folders) {
    for (const fs::path& path : foam_folders(folder))
      if (is_no_finite_time(path.filename().string())) odd.insert(path.filename().string());
    for (const auto& [time, name] : foam_time_folders(folder)) {
      ++there[time];
      names.emplace(time, name);
      if (has_foam_file(folder / name / field)) ++having[time];
    }
  }
  const auto leave_out = [&](const std::string& name, const std::string& why) {
    result.notices.push_back("time " + name + " " + why + ": left out");
  };
  for (const std::string& name : odd) leave_out(name, "is no finite number");
  for (const auto& [time, name] : names) {
    const std::size_t count = having[time];
    if (count == 0) {
      leave_out(number_text(time), "has no " + field);
    } else if (count < folders.size()) {
      leave_out(number_text(time), "is in " + std::to_string(count) + " of " +
                                       std::to_string(folders.size()) +
                                       " processor folders only (unfinished)");
    } else if (time < 0.0) {
      leave_out(number_text(time), "is before the start");
    } else {
      result.times.emplace_back(time);
      result.names.push_back(name);
    }
  }
  return result;
}

std::vector<std::string> foam_phases(const fs::path& folder, const std::string& region) {
  std::set<std::string> phases, others;
  for (const auto& [time, folder_name] : foam_time_folders(folder)) {
    std::error_code failed;
    for (fs::directory_iterator it(folder / folder_name / region, failed), end;
         !failed && it != end; it.increment(failed)) {
      std::string name = it->path().filename().string();
      if (name.ends_with(".gz")) name.resize(name.size() - 3);
      static const std::regex phase("alpha\\.[A-Za-z0-9_-]+");
      static const std::regex other("alpha[0-9]*|alpha[A-Z][a-z]+1?");
      // Old times and set-aside fields: alpha.water_0, alpha.orig.
      if (name.ends_with("_0") || name.ends_with(".orig") || name.ends_with(".org")) continue;
      if (std::regex_match(name, phase)) phases.insert(name);
      if (std::regex_match(name, other) && !name.starts_with("alphaPhi")) others.insert(name);
    }
    if (!phases.empty() || !others.empty()) break;
  }
  const std::set<std::string>& names = phases.empty() ? others : phases;
  return {names.begin(), names.end()};
}

}  // namespace surge::compare
