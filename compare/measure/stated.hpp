#pragma once

#include <string>
#include <vector>

#include "compare/read/run.hpp"

namespace surge::compare {

/// A place that a run's manifest names: case.probes or case.gauges.
struct StatedPlace {
  std::string name;
  Vec3 place{};  ///< m
};

/// `kind`: "probes" or "gauges". Empty where there is no manifest or it has none. Throws
/// surge::Error where an entry has no name or position.
[[nodiscard]] std::vector<StatedPlace> stated_places(const Run& run, const std::string& kind);

/// The one of that name; throws surge::Error, beginning with `asker`, that lists the others.
[[nodiscard]] Vec3 stated_place(const Run& run, const std::string& kind, const std::string& name,
                                const std::string& asker);

/// Throws surge::Error, beginning with `asker`, where the run's manifest states no such entry of
/// case.`kind` ("probes", "gauges" or "forces"), with those that it has.
void require_stated(const Run& run, const std::string& kind, const std::string& name,
                    const std::string& asker);

/// The function object of an OpenFOAM case that records what its case calls `name`, as its manifest
/// states the file: "stepForce" of "postProcessing/stepForce/0/force.dat". The name itself where
/// the manifest does not say. `kind`: "probes", "gauges" or "forces".
[[nodiscard]] std::string recording_object(const Run& run, const std::string& kind,
                                           const std::string& name);

}  // namespace surge::compare
