#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "particle/case/case.hpp"

namespace surge {

/// A case as the manifest holds it: every value resolved, points always with three coordinates.
[[nodiscard]] nlohmann::json to_json(const Case& c);

/// A table of a TOML file from a JSON object of numbers, texts and lists.
[[nodiscard]] std::string toml_table(const std::string& header, const nlohmann::json& entries);

}  // namespace surge
