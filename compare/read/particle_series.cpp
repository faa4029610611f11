#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <map>

#include "compare/read/readers.hpp"
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

std::vector<SeriesEntry> list_collection(const fs::path& file) {
  if (!fs::is_regular_file(file)) throw Error(file.string() + ": no such file");
  const VtkErrors errors;
  const auto root =
      vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(file.c_str()));
  errors.check(file);
  vtkXMLDataElement* collection = root ? root->FindNestedElementWithName("Collection") : nullptr;
  if (!collection)
    throw Error(file.string() + ": no <Collection> found, a ParaView collection expected");
  std::map<double, SeriesEntry> entries;
  for (int i = 0; i < collection->GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement* element = collection->GetNestedElement(i);
    const char* name = element->GetAttribute("file");
    double time = 0.0;
    if (!name || !element->GetScalarAttribute("timestep", time)) {
      throw Error(file.string() + ": DataSet " + std::to_string(i) +
                  " without file or timestep, both expected");
    }
    SeriesEntry& entry = entries[time];
    entry.time = Seconds(time);
    entry.files.push_back(file.parent_path() / name);
  }
  std::vector<SeriesEntry> list;
  list.reserve(entries.size());
  for (auto& [time, entry] : entries) list.push_back(std::move(entry));
  return list;
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
  for (const auto& [number, file] : files) list.push_back({std::nullopt, {file}});
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
  } else if (fs::is_directory(path)) {
    entries = list_numbered(path, "*");
  } else {
    throw Error(path.string() +
                ": a file found, a .pvd, a folder or a pattern such as \"fluid_*.vtk\" expected");
  }
  if (entries.empty())
    throw Error(path.string() + ": no frame found, .vtp, .vtu or .vtk files expected");
  for (const SeriesEntry& entry : entries) {
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
