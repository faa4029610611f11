#include "compare/measure/stated.hpp"

#include "particle/support/error.hpp"

namespace surge::compare {

std::vector<StatedPlace> stated_places(const Run& run, const std::string& kind) {
  std::vector<StatedPlace> places;
  const nlohmann::json::json_pointer list("/case/" + kind);
  if (!run.manifest.is_object() || !run.manifest.contains(list)) return places;
  for (const nlohmann::json& entry : run.manifest.at(list)) {
    try {
      places.push_back({entry.at("name").get<std::string>(), entry.at("position").get<Vec3>()});
    } catch (const nlohmann::json::exception&) {
      throw Error(run.path.string() + ": manifest.json: case." + kind + ": found " + entry.dump() +
                  ", expected name and position");
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

}  // namespace surge::compare
