#pragma once

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
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

/// The number, or null where there is none or it is not finite.
[[nodiscard]] inline nlohmann::json json_or_null(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? nlohmann::json(*value) : nlohmann::json();
}

/// The number, or NaN, a gap in a figure, where there is none.
[[nodiscard]] inline double json_or_gap(const nlohmann::json& value) {
  return value.is_number() ? value.get<double>() : std::nan("");
}

}  // namespace surge
