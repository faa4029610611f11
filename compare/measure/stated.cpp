#include "compare/measure/stated.hpp"

#include <filesystem>
#include <iterator>

#include "particle/support/error.hpp"
#include "particle/support/json.hpp"

namespace surge::compare {

std::vector<StatedPlace> stated_places(const Run& run, const std::string& kind) {
  std::vector<StatedPlace> places;
  const nlohmann::json::json_pointer list("/case/" + kind);
  if (!run.manifest.is_object() || !run.manifest.contains(list)) return places;
  for (const nlohmann::json& entry : run.manifest.at(list)) {
    try {
      places.push_back({entry.at("name").get<std::string>(), entry.at("position").get<Vec3>()});
    } catch (const nlohmann::json::exception&) {
      throw Error(run.path.string() + ": manifest.json: case." + kind + ": found " +
                  json_shown(entry) + ", expected name and position");
    }
  }
  return places;
}

Vec3 stated_place(const Run& run, const std::string& kind, const std::string& name,
                  const std::string& asker) {
  std::string known;
  for (const StatedPlace& entry : stated_places(run, kind)) {
    if (entry.name == name) return entry.place;
    known += (known.empty() ? "" : ", ") + entry.name;
  }
  throw Error(asker + ": found no \"" + name + "\" among the " + kind + " of " + run.path.string() +
              ", expected " + (known.empty() ? "a place, as it states none" : "one of " + known));
}

void require_stated(const Run& run, const std::string& kind, const std::string& name,
                    const std::string& asker) {
  std::string known;
  const nlohmann::json::json_pointer list("/case/" + kind);
  if (run.manifest.is_object() && run.manifest.contains(list)) {
    for (const nlohmann::json& entry : run.manifest.at(list)) {
      const std::string one = entry.is_object() ? entry.value("name", "") : "";
      if (one == name) return;
      known += (known.empty() ? "" : ", ") + one;
    }
  }
  throw Error(asker + ": found no \"" + name + "\" among the " + kind + " of " + run.name +
              ", expected " + (known.empty() ? "a case that states it" : "one of " + known));
}

std::string recording_object(const Run& run, const std::string& kind, const std::string& name) {
  const nlohmann::json::json_pointer list("/case/" + kind);
  if (!run.manifest.is_object() || !run.manifest.contains(list)) return name;
  for (const nlohmann::json& entry : run.manifest.at(list)) {
    if (!entry.is_object() || entry.value("name", "") != name || !entry.contains("file")) continue;
    const std::filesystem::path file = entry.value("file", "");
    // postProcessing / object / time / file
    if (std::distance(file.begin(), file.end()) == 4 && *file.begin() == "postProcessing")
      return std::next(file.begin())->string();
  }
  return name;
}

}  // namespace surge::compare
