#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "compare/figures/gnuplot.hpp"
#include "compare/report/html.hpp"
#include "compare/study/sequences.hpp"
#include "compare/study/study_result.hpp"

namespace surge::compare {

/// What a section writes from: numbers come from `values` alone, `study` says which runs there are.
struct Page {
  const StudyResult& study;
  Values values;
  const std::vector<Figure>& figures;   ///< drawn already
  std::filesystem::path figure_folder;  ///< where their files lie
};

/// A part of the report. First every section adds its numbers to the metrics (what metrics() of
/// the comparator has measured is there already), then the figures are drawn, then each writes its
/// HTML below its heading. One that writes nothing, because the study has no runs for it, is left
/// out of the page.
struct Section {
  std::string id;     ///< anchor
  std::string title;  ///< heading; empty for the summary, which stands under the page's own
  void (*measure)(const StudyResult& study, nlohmann::json& metrics);
  std::string (*write)(const Page& page);
  bool needs_reference = true;  ///< left out of a study that has no reference run
};

/// All sections in the order of the page.
[[nodiscard]] std::span<const Section> report_sections();

void measure_summary(const StudyResult& study, nlohmann::json& metrics);
[[nodiscard]] std::string write_summary(const Page& page);
void measure_nothing(const StudyResult& study, nlohmann::json& metrics);
void measure_figures(const StudyResult& study, nlohmann::json& metrics);
[[nodiscard]] std::string write_figures(const Page& page);
/// Measured by measure_patterns() of claims.hpp.
[[nodiscard]] std::string write_patterns(const Page& page);
void measure_wall_pressure(const StudyResult& study, nlohmann::json& metrics);
[[nodiscard]] std::string write_wall_pressure(const Page& page);
void measure_runs(const StudyResult& study, nlohmann::json& metrics);
[[nodiscard]] std::string write_runs(const Page& page);
[[nodiscard]] std::string write_experiments(const Page& page);
void measure_claims(const StudyResult& study, nlohmann::json& metrics);
[[nodiscard]] std::string write_claims(const Page& page);
void measure_scaling(const StudyResult& study, nlohmann::json& metrics);
[[nodiscard]] std::string write_scaling(const Page& page);
void measure_verification(const StudyResult& study, nlohmann::json& metrics);
[[nodiscard]] std::string write_verification(const Page& page);
void measure_sensitivity(const StudyResult& study, nlohmann::json& metrics);
[[nodiscard]] std::string write_sensitivity(const Page& page);
[[nodiscard]] std::string write_convergence(const Page& page);
void measure_errata(const StudyResult& study, nlohmann::json& metrics);
[[nodiscard]] std::string write_errata(const Page& page);
void measure_deviations(const StudyResult& study, nlohmann::json& metrics);
[[nodiscard]] std::string write_deviations(const Page& page);
void measure_provenance(const StudyResult& study, nlohmann::json& metrics);
[[nodiscard]] std::string write_provenance(const Page& page);

/// A figure of the page with its caption and links to its files; empty where it was not drawn.
[[nodiscard]] std::string figure_html(const Page& page, const std::string& name);

}  // namespace surge::compare
