#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>

#include "compare/read/delimited.hpp"
#include "compare/read/numbered_files.hpp"
#include "compare/read/readers.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"
#include "particle/support/json.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

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

/// A file that a collection names; nothing outside the collection's folder is followed.
fs::path named_file(const fs::path& collection, const std::string& name) {
  const fs::path folder = collection.has_parent_path() ? collection.parent_path() : fs::path(".");
  fs::path file = folder / slashes(name);
  std::error_code failed;
  if (!fs::exists(file, failed)) file = folder / without_percent(slashes(name));
  const fs::path inside = fs::relative(fs::weakly_canonical(file, failed),
                                       fs::weakly_canonical(folder, failed), failed);
  if (failed || inside.empty() || *inside.begin() == "..")
    throw Error(collection.string() + ": " + name +
                ": outside of the collection's folder, which is not followed");
  return file;
}

std::vector<SeriesEntry> list_collection(const fs::path& file) {
  require_regular(file);
  const VtkErrors errors;
  const auto root =
      vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(file.c_str()));
  errors.check(file);
  vtkXMLDataElement* collection = root ? root->FindNestedElementWithName("Collection") : nullptr;
  if (!collection)
    throw Error(file.string() + ": no <Collection> found, a ParaView collection expected");
  std::vector<SeriesEntry> list;
  std::set<std::pair<std::string, std::string>> parts;  // groups and parts of the present time
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
      list.push_back({time, std::nullopt, {}, {}});
      parts.clear();
    }
    const char* part = element->GetAttribute("part");
    const char* group = element->GetAttribute("group");
    if (!parts.emplace(group ? group : "", part ? part : "0").second) {
      throw Error(place + ": a second file of part " + (part ? part : "0") + " at time " + stated +
                  ": one file per part and time expected (are two runs in one collection?)");
    }
    list.back().files.push_back(named_file(file, name));
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
      throw Error(place + ": " + json_shown(entry) +
                  " found, {\"name\": ..., \"time\": ...} expected");
    const Seconds time(entry.at("time").get<double>());
    if (!list.empty() && time <= *list.back().time)
      throw Error(place + ": time " + number_text(time.value()) + " after " +
                  number_text(list.back().time->value()) + ": increasing times expected");
    list.push_back(
        {time, std::nullopt, {named_file(file, entry.at("name").get<std::string>())}, {}});
  }
  return list;
}

/// Of the files that a collection names those with the fluid, as far as the options tell them.
void keep_fluid(std::vector<SeriesEntry>& entries, const SourceOptions& options) {
  const auto fits = [](const fs::path& file, const std::vector<std::string>& patterns) {
    return std::any_of(patterns.begin(), patterns.end(), [&](const std::string& pattern) {
      return matches(file.filename().string(), pattern);
    });
  };
  for (SeriesEntry& entry : entries)
    std::erase_if(entry.files, [&](const fs::path& file) {
      return (!options.files.empty() && !fits(file, options.files)) || fits(file, options.walls);
    });
  std::erase_if(entries, [](const SeriesEntry& entry) { return entry.files.empty(); });
}

/// Every file belongs to one time; a wall that is named at every time beside others stands still.
void refuse_repeats(const fs::path& path, const std::vector<SeriesEntry>& entries) {
  std::map<fs::path, std::size_t> seen, times;
  for (const SeriesEntry& entry : entries)
    if (entry.files.size() > 1)
      for (const fs::path& file : entry.files) ++times[file.lexically_normal()];
  std::erase_if(times, [&](const auto& file) { return file.second != entries.size(); });
  for (std::size_t i = 0; i < entries.size(); ++i)
    for (const fs::path& file : entries[i].files)
      if (!seen.emplace(file.lexically_normal(), i).second &&
          !times.contains(file.lexically_normal()))
        throw Error(path.string() + ": names " + file.filename().string() +
                    " twice, one time for each file expected");
}

}  // namespace

std::vector<fs::path> parallel_pieces(const fs::path& file) {
  if (file.extension() != ".pvtu" && file.extension() != ".pvtp") return {file};
  require_regular(file);
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
        files.push_back(named_file(file, source));
    }
  }
  if (files.empty()) throw Error(file.string() + ": no <Piece Source=...> found, one expected");
  return files;
}

std::vector<SeriesEntry> list_series(const fs::path& path, const SourceOptions& options) {
  std::vector<SeriesEntry> entries;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (path.filename().string().find('*') != std::string::npos) {
    if (!fs::is_directory(folder)) throw Error(folder.string() + ": no such folder");
    entries = list_numbered(folder, {path.filename().string()}, options.walls);
  } else if (path.extension() == ".pvd") {
    entries = list_collection(path);
  } else if (path.extension() == ".series") {
    entries = list_file_series(path);
  } else if (fs::is_directory(path)) {
    entries = list_numbered(path, options.files, options.walls);
  } else if (has_particle_name(path)) {
    entries.push_back({std::nullopt, std::nullopt, {path}, {}});
  } else {
    throw Error(path.string() +
                ": a file found, a .pvd, a .series, a folder, a pattern such as \"fluid_*.vtk\" or "
                "one file with particles expected");
  }
  if (!fs::is_directory(path)) keep_fluid(entries, options);
  if (entries.empty())
    throw Error(path.string() + ": no frame found, numbered files of particles expected");
  for (SeriesEntry& entry : entries) {
    std::vector<fs::path> files;
    for (const fs::path& file : entry.files) {
      const std::vector<fs::path> pieces = parallel_pieces(file);
      files.insert(files.end(), pieces.begin(), pieces.end());
    }
    entry.files = std::move(files);
    for (const fs::path& file : entry.files) {
      if (!fs::exists(file))
        throw Error(file.string() + ": no such file, a frame of " + path.string());
      (void)format_of(file, options);
    }
  }
  refuse_repeats(path, entries);
  return entries;
}

}  // namespace surge::compare
