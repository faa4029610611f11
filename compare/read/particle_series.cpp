#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>

#include "compare/read/readers.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

bool is_particle_file(const fs::path& file) {
  const std::string extension = file.extension().string();
  return extension == ".vtp" || extension == ".vtu" || extension == ".vtk";
}

/// The last number in a file's name, by which its series is ordered.
std::optional<long long> number_of(const fs::path& file) {
  const std::string stem = file.stem().string();
  const auto last = stem.find_last_of("0123456789");
  if (last == std::string::npos) return std::nullopt;
  const auto before = stem.find_last_not_of("0123456789", last);
  const auto first = before == std::string::npos ? 0 : before + 1;
  if (last - first >= 18) return std::nullopt;
  return std::stoll(stem.substr(first, last - first + 1));
}

/// `*` stands for any characters.
bool matches(std::string_view text, std::string_view pattern) {
  if (pattern.empty()) return text.empty();
  if (pattern.front() == '*') {
    for (std::size_t skip = 0; skip <= text.size(); ++skip) {
      if (matches(text.substr(skip), pattern.substr(1))) return true;
    }
    return false;
  }
  return !text.empty() && text.front() == pattern.front() &&
         matches(text.substr(1), pattern.substr(1));
}

/// The whole of a time step's text as a finite number.
Seconds collection_time(std::string_view text, const std::string& place) {
  const auto first = text.find_first_not_of(" \t\n");
  const auto last = text.find_last_not_of(" \t\n");
  const std::string_view word =
      first == std::string_view::npos ? text.substr(0, 0) : text.substr(first, last - first + 1);
  double value = 0.0;
  const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (failed != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
    throw Error(place + ": timestep: found \"" + std::string(text) +
                "\", expected a finite number such as 5.0e-02");
  }
  return Seconds(value);
}

/// Collections written on Windows name their files with backslashes.
std::string slashes(std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  return name;
}

std::vector<SeriesEntry> list_collection(const fs::path& file) {
  if (!fs::is_regular_file(file)) throw Error(file.string() + ": no such file");
  const VtkErrors errors;
  const auto root =
      vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(file.c_str()));
  errors.check(file);
  vtkXMLDataElement* collection = root ? root->FindNestedElementWithName("Collection") : nullptr;
  if (!collection)
    throw Error(file.string() + ": no <Collection> found, a ParaView collection expected");
  std::vector<SeriesEntry> list;
  std::set<std::string> parts;  // of the present time
  for (int i = 0; i < collection->GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement* element = collection->GetNestedElement(i);
    const std::string place = file.string() + ": DataSet " + std::to_string(i);
    const char* name = element->GetAttribute("file");
    const char* stated = element->GetAttribute("timestep");
    if (!name || !stated) throw Error(place + " without file or timestep, both expected");
    const Seconds time = collection_time(stated, place);
    if (!list.empty() && time < *list.back().time) {
      throw Error(place + ": timestep " + stated + " after " +
                  std::to_string(list.back().time->value()) +
                  ": increasing times expected (are two runs in one collection?)");
    }
    if (list.empty() || time > *list.back().time) {
      list.push_back({time, std::nullopt, {}});
      parts.clear();
    }
    const char* part = element->GetAttribute("part");
    if (!parts.insert(part ? part : "0").second) {
      throw Error(place + ": a second file of part " + (part ? part : "0") + " at time " + stated +
                  ": one file per part and time expected (are two runs in one collection?)");
    }
    list.back().files.push_back(file.parent_path() / slashes(name));
  }
  return list;
}

/// ParaView's .vtu.series, .vtk.series: {"files": [{"name": ..., "time": ...}]}.
std::vector<SeriesEntry> list_file_series(const fs::path& file) {
  const nlohmann::json document = read_json(file);
  const auto files = document.is_object() ? document.find("files") : document.end();
  if (!document.is_object() || files == document.end() || !files->is_array())
    throw Error(file.string() + ": no list \"files\" found, one expected");
  std::vector<SeriesEntry> list;
  for (std::size_t i = 0; i < files->size(); ++i) {
    const nlohmann::json& entry = files->at(i);
    const std::string place = file.string() + ": files." + std::to_string(i);
    if (!entry.is_object() || !entry.contains("name") || !entry.at("name").is_string() ||
        !entry.contains("time") || !entry.at("time").is_number())
      throw Error(place + ": " + entry.dump() + " found, {\"name\": ..., \"time\": ...} expected");
    const Seconds time(entry.at("time").get<double>());
    if (!list.empty() && time <= *list.back().time)
      throw Error(place + ": time " + number_text(time.value()) + " after " +
                  number_text(list.back().time->value()) + ": increasing times expected");
    list.push_back(
        {time, std::nullopt, {file.parent_path() / entry.at("name").get<std::string>()}});
  }
  return list;
}

/// The files that a parallel file (.pvtu, .pvtp) is made of; any other file is itself.
std::vector<fs::path> pieces_of(const fs::path& file) {
  if (file.extension() != ".pvtu" && file.extension() != ".pvtp") return {file};
  if (!fs::is_regular_file(file)) throw Error(file.string() + ": no such file");
  const VtkErrors errors;
  const auto root =
      vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(file.c_str()));
  errors.check(file);
  std::vector<fs::path> files;
  for (int i = 0; root && i < root->GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement* grid = root->GetNestedElement(i);
    for (int k = 0; k < grid->GetNumberOfNestedElements(); ++k) {
      vtkXMLDataElement* piece = grid->GetNestedElement(k);
      const char* source = piece->GetAttribute("Source");
      if (std::string_view(piece->GetName()) == "Piece" && source)
        files.push_back(file.parent_path() / source);
    }
  }
  if (files.empty()) throw Error(file.string() + ": no <Piece Source=...> found, one expected");
  return files;
}

std::vector<SeriesEntry> list_numbered(const fs::path& folder, std::string_view pattern) {
  std::map<long long, fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const fs::path& file = entry.path();
    if (!is_particle_file(file) || !matches(file.filename().string(), pattern)) continue;
    const auto number = number_of(file);
    if (!number) continue;
    const auto [other, is_new] = files.emplace(*number, file);
    if (!is_new) {
      throw Error(folder.string() + ": both " + other->second.filename().string() + " and " +
                  file.filename().string() + " are number " + std::to_string(*number) +
                  ", one series expected (name it by a pattern such as \"fluid_*.vtk\")");
    }
  }
  std::vector<SeriesEntry> list;
  list.reserve(files.size());
  for (const auto& [number, file] : files) list.push_back({std::nullopt, number, {file}});
  return list;
}

}  // namespace

std::vector<SeriesEntry> list_series(const fs::path& path) {
  std::vector<SeriesEntry> entries;
  if (path.filename().string().find('*') != std::string::npos) {
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    if (!fs::is_directory(folder)) throw Error(folder.string() + ": no such folder");
    entries = list_numbered(folder, path.filename().string());
  } else if (path.extension() == ".pvd") {
    entries = list_collection(path);
  } else if (path.extension() == ".series") {
    entries = list_file_series(path);
  } else if (fs::is_directory(path)) {
    entries = list_numbered(path, "*");
  } else {
    throw Error(path.string() +
                ": a file found, a .pvd, a .series, a folder or a pattern such as \"fluid_*.vtk\" "
                "expected");
  }
  if (entries.empty())
    throw Error(path.string() + ": no frame found, .vtp, .vtu or .vtk files expected");
  for (SeriesEntry& entry : entries) {
    std::vector<fs::path> files;
    for (const fs::path& file : entry.files) {
      const std::vector<fs::path> pieces = pieces_of(file);
      files.insert(files.end(), pieces.begin(), pieces.end());
    }
    entry.files = std::move(files);
    for (const fs::path& file : entry.files) {
      if (!fs::is_regular_file(file))
        throw Error(file.string() + ": no such file, a frame of " + path.string());
      if (!is_particle_file(file)) {
        throw Error(file.string() + ": " + file.extension().string() +
                    " found, .vtp, .vtu or .vtk expected");
      }
    }
  }
  return entries;
}

}  // namespace surge::compare
