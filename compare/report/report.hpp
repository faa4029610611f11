#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "compare/study/study_result.hpp"

namespace surge::compare {

/// All numbers of the report: what metrics() measures, and what the sections add.
[[nodiscard]] nlohmann::json report_metrics(const StudyResult& study);

/// Writes out/metrics.json, out/figures/* and out/index.html. Returns the metrics and adds
/// what gnuplot warned of to `warnings`.
nlohmann::json write_report(const StudyResult& study, const std::filesystem::path& out,
                            std::string& warnings);

/// The main figures as a short table for a terminal.
[[nodiscard]] std::string summary_table(const StudyResult& study, const nlohmann::json& metrics);

}  // namespace surge::compare
