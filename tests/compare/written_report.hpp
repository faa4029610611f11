#pragma once

#include "compare/report/page.hpp"
#include "compare/report/report.hpp"
#include "tests/compare/synthetic_study.hpp"

namespace surge::compare::testing {

struct WrittenReport {
  std::string page;
  nlohmann::json metrics;
  std::string table;
};

inline WrittenReport written_report(const SyntheticStudy& files) {
  const StudyResult study = files.collected();
  std::string warnings;
  const nlohmann::json metrics = write_report(study, files.out(), warnings);
  EXPECT_EQ(warnings, "");
  return {read_text(files.out() / "index.html"),
          nlohmann::json::parse(read_text(files.out() / "metrics.json")),
          summary_table(study, metrics)};
}

/// Most of what a report says needs no figure, and drawing them takes most of its time.
inline WrittenReport report_without_figures(const SyntheticStudy& files) {
  const StudyResult study = files.collected();
  const nlohmann::json metrics = report_metrics(study);
  std::filesystem::create_directories(files.out());
  write_page(study, metrics, {}, files.out());
  return {read_text(files.out() / "index.html"), nlohmann::json::parse(metrics.dump()),
          summary_table(study, metrics)};
}

}  // namespace surge::compare::testing
