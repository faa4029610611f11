#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace surge {

/// A JSON text whose depth is bounded, so that no input exhausts the stack. `place` stands before
/// what is wrong. Throws Error, with the place of a syntax error.
[[nodiscard]] nlohmann::json parse_json(std::string_view text, const std::string& place);

/// The same of a regular file of at most 64 MiB.
[[nodiscard]] nlohmann::json read_json(const std::filesystem::path& file);

/// A value as an error shows it: no more than fits into a line.
[[nodiscard]] std::string json_shown(const nlohmann::json& value);

}  // namespace surge
