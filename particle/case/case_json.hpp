#pragma once

#include <nlohmann/json.hpp>

#include "particle/case/case.hpp"

namespace surge {

/// A case as the manifest holds it: every value resolved, points always with three coordinates.
[[nodiscard]] nlohmann::json to_json(const Case& c);

}  // namespace surge
