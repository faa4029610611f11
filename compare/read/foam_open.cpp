#include <algorithm>
#include <memory>
#include <optional>

#include "compare/read/foam_case.hpp"
#include "compare/read/foam_file.hpp"
#include "compare/read/foam_reader.hpp"
#include "compare/read/readers.hpp"
#include "particle/support/error.hpp"
#include "particle/support/text.hpp"

namespace surge::compare {

namespace fs = std::filesystem;

namespace {

bool has_mesh(const fs::path& part, const std::string& region) {
  const fs::path faces = fs::path(region) / "polyMesh" / "faces";
  if (has_foam_file(part / "constant" / faces)) return true;
  const auto times = foam_time_folders(part);
  return std::any_of(times.begin(), times.end(),
                     [&](const auto& time) { return has_foam_file(part / time.second / faces); });
}

/// Regions of a case with several meshes: constant/<region>/polyMesh.
std::vector<std::string> regions_of(const fs::path& part) {
  std::vector<std::string> regions;
  for (const fs::path& folder : foam_folders(part / "constant"))
    if (has_foam_file(folder / "polyMesh" / "faces")) regions.push_back(folder.filename().string());
  return regions;
}

/// The region with the water, empty for a case of one mesh; none where there is no mesh at all.
std::optional<std::string> region_of(const fs::path& root, const fs::path& part) {
  if (has_mesh(part, "")) return "";
  const std::vector<std::string> regions = regions_of(part);
  if (regions.empty()) return std::nullopt;
  std::vector<std::string> wet;
  for (const std::string& region : regions)
    if (!foam_phases(part, region).empty()) wet.push_back(region);
  if (wet.size() == 1) return wet.front();
  throw Error(root.string() + ": regions " + comma_list(regions) + " found, " +
              (wet.empty() ? std::string("none") : std::to_string(wet.size())) +
              " with a volume fraction; a case with one such region expected");
}

/// The volume fraction of the water: as the user names it, or the only one that there is.
std::string alpha_of(const fs::path& root, const std::vector<std::string>& found,
                     const std::string& asked) {
  if (found.empty() || std::find(found.begin(), found.end(), asked) != found.end()) return asked;
  if (found.size() == 1 && asked == SourceOptions{}.alpha_array) return found.front();
  throw Error(root.string() + ": no " + asked + ", found " + comma_list(found) +
              "; expected the one of the water (--alpha-array)");
}

/// A kind of results that the case has.
struct Candidate {
  std::string name;
  FoamParts parts;
};

std::string kind_of(const FoamReader& reader, const std::string& name) {
  return name + " (" + std::to_string(reader.times().size()) + " times)";
}

}  // namespace

fs::path foam_case_folder(const fs::path& path) {
  const std::string extension = path.extension().string();
  const bool named = extension == ".foam" || extension == ".OpenFOAM";
  if (!named || fs::is_directory(path)) return path;
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

std::unique_ptr<FrameReader> open_foam_case(const fs::path& folder, const SourceOptions& options) {
  if (!has_foam_file(folder / "system" / "controlDict"))
    throw Error(folder.string() + ": no system/controlDict found, an OpenFOAM case expected");
  std::vector<Candidate> candidates{{"the case itself", {{folder}, false, 1}}};
  if (FoamParts parts = foam_processors(folder); !parts.folders.empty())
    candidates.push_back({"processor folders", std::move(parts)});
  if (FoamParts parts = foam_collated(folder); !parts.folders.empty())
    candidates.push_back({"collated processor folders", std::move(parts)});

  std::unique_ptr<FoamReader> best;
  std::string best_kind, others, missing = options.alpha_array;
  bool any_mesh = false;
  for (const Candidate& candidate : candidates) {
    const fs::path& part = candidate.parts.folders.front();
    const std::optional<std::string> region = region_of(folder, part);
    if (!region) continue;
    any_mesh = true;
    const std::string alpha = alpha_of(folder, foam_phases(part, *region), options.alpha_array);
    auto reader = std::make_unique<FoamReader>(folder, candidate.parts, *region, alpha);
    missing = alpha;
    if (reader->times().empty()) continue;
    const std::string kind = kind_of(*reader, candidate.name);
    const bool better = !best || reader->times().size() > best->times().size();
    const std::string& left = better ? best_kind : kind;
    if (!left.empty()) others += (others.empty() ? "" : ", ") + left;
    if (!better) continue;
    best_kind = kind;
    best = std::move(reader);
  }
  if (!any_mesh)
    throw Error(folder.string() +
                ": no constant/polyMesh found, a case with its mesh expected (blockMesh)");
  if (!best)
    throw Error(folder.string() + ": no time folder with " + missing + " found, results expected");
  // The initial field beside processor folders is the usual thing.
  if (!others.empty() && others != "the case itself (1 times)")
    best->tell("results found in " + best_kind + " and in " + others + ": the former are read");
  if (!best->region().empty()) best->tell("region " + best->region() + " is read");
  if (best->alpha() != options.alpha_array)
    best->tell(best->alpha() + " is taken as the volume fraction of the water");
  best->leave_out_unfinished();
  return best;
}

}  // namespace surge::compare
