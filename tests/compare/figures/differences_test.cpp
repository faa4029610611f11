#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "compare/figures/differences.hpp"
#include "compare/report/report.hpp"
#include "compare/study/water_differences.hpp"
#include "tests/compare/synthetic_study.hpp"

namespace surge::compare {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using testing::SyntheticStudy;

TEST(Differences, AreWhatIsWetOnOneSideOnly) {
  const SyntheticStudy files;
  const StudyResult study = files.collected();
  const Seconds time = study.study.snapshot_times.at(1);
  double reference_water = -1.0;
  for (const RunResult* run : study.measured()) {
    const auto found = water_difference(study, *run, time);
    ASSERT_TRUE(found.has_value());
    const double theirs = found->size_of(found->cells.both + found->cells.only_second);
    if (reference_water < 0.0) reference_water = theirs;
    EXPECT_DOUBLE_EQ(theirs, reference_water);
    ASSERT_TRUE(found->part().has_value());
    EXPECT_DOUBLE_EQ(*found->part(), found->size() / theirs);
    if (run == &study.reference()) {
      EXPECT_EQ(found->size(), 0.0);
    }
  }
  // MPS leads and SPH lags.
  const auto by_name = [&](const std::string& name) {
    for (const RunResult* run : study.measured())
      if (run->study.name == name) return *water_difference(study, *run, time);
    throw std::runtime_error(name);
  };
  EXPECT_EQ(by_name("mps-a").cells.only_second, 0U);
  EXPECT_EQ(by_name("sph-a").cells.only_first, 0U);
  EXPECT_GT(by_name("sph-a").cells.only_second, 0U);
}

TEST(Differences, FigureTableAndMetricsHaveTheSameNumbers) {
  const SyntheticStudy files;
  const StudyResult study = files.collected();
  const std::vector<Figure> figures = difference_figures(study);
  ASSERT_EQ(figures.size(), 1U);
  EXPECT_EQ(draw(figures[0], files.out()), "");
  EXPECT_THAT(figures[0].caption, HasSubstr("SPH paper "));
  EXPECT_THAT(figures[0].caption, HasSubstr(" %"));
  EXPECT_THAT(testing::read_text(files.out() / "differences.svg"), HasSubstr("only the reference"));
  const json metrics = report_metrics(study);
  const Table& table = figures[0].tables.at(0);
  EXPECT_EQ(table.rows.size(), 2 * study.study.snapshot_times.size());
  std::map<std::pair<std::string, double>, json> entries;
  for (const char* run : {"mps-a", "sph-a"})
    for (const json& entry : metrics["patterns"][run]["differences"])
      entries[{run, entry["time_s"].get<double>()}] = entry;
  for (const auto& row : table.rows) {
    const json& entry = entries.at({std::get<std::string>(row[0]), std::get<double>(row[1])});
    EXPECT_EQ(entry["unit"], "m2");
    EXPECT_EQ(entry["only_run"], std::get<double>(row[2]));
    EXPECT_EQ(entry["only_reference"], std::get<double>(row[3]));
    EXPECT_EQ(entry["both"], std::get<double>(row[4]));
    EXPECT_EQ(entry["over_reference"], std::get<double>(row[5]));
  }
  EXPECT_FALSE(metrics["patterns"]["vof-20"].contains("differences"));
}

}  // namespace
}  // namespace surge::compare
