#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "compare/study/study.hpp"

namespace surge::compare {

/// Where two JSON values differ that both state: dotted path, and both values. Numbers agree within
/// 1e-9 of the larger; entries that only one of them has are passed over.
struct JsonDifference {
  std::string path;
  nlohmann::json found;
  nlohmann::json expected;
};
[[nodiscard]] std::optional<JsonDifference> first_difference(const nlohmann::json& found,
                                                             const nlohmann::json& expected);

/// system/caseParameters of an OpenFOAM case: values by their names, numbers as numbers, lists
/// where an entry has several words. Throws surge::Error.
[[nodiscard]] nlohmann::json case_parameters(const std::filesystem::path& case_folder);

/// A setting's value in the same form.
[[nodiscard]] nlohmann::json parameter_value(const std::string& text);

/// Whether the run in a folder is another one than the study asks for: "made with
/// resolution.spacing = 0.01, the study asks for 0.005". Held against each other are what the
/// study's run is to compute (StudyRun::resolved, see check_study(); nothing is said where that is
/// null) and the case of the folder's manifest; of an OpenFOAM case from a folder, its
/// system/caseParameters. Throws surge::Error where the folder's files cannot be read.
[[nodiscard]] std::optional<std::string> other_run(const StudyRun& run,
                                                   const std::filesystem::path& folder,
                                                   const nlohmann::json& manifest);

}  // namespace surge::compare
