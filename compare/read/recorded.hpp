#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "compare/read/run.hpp"

namespace surge::compare {

/// Checks the entries that the comparator takes from a manifest, those that are there, for their
/// kind: a text, a number that is finite and not negative, and so on. Throws surge::Error with the
/// file, the key, what was found and what is expected.
void check_manifest(const nlohmann::json& manifest, const std::filesystem::path& file);

/// A manifest that is there and passes check_manifest(). Throws surge::Error.
[[nodiscard]] nlohmann::json read_manifest(const std::filesystem::path& file);

/// Holds the frames of a run against its manifest: their number, their times, the number of steps.
/// A run that says of itself that it did not finish is named as such in the notices; where one that
/// says that it finished lacks frames or steps, throws surge::Error.
void check_recorded(Run& run);

/// Whether a run says of itself that it did not come to its end; its first notice then says why.
[[nodiscard]] bool is_unfinished(const Run& run);

}  // namespace surge::compare
