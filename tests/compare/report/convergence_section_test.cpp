#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "compare/figures/cost_to_error.hpp"
#include "compare/figures/figures.hpp"
#include "compare/report/report.hpp"
#include "compare/study/sequences.hpp"
#include "tests/compare/synthetic_study.hpp"

namespace surge::compare {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::SyntheticStudy;

constexpr double length = SyntheticStudy::length;

/// Fronts whose error is `c` (l0 / 5 mm)^p L at all times after the start, beside the study of
/// SyntheticStudy, whose front moves at 2 m/s.
class SyntheticLevels {
 public:
  void add(const std::string& name, const std::string& method, double spacing, double c, double p,
           double seconds, int threads = 1, const std::string& group = "") {
    json manifest = testing::dam_break_manifest();
    manifest["case"]["spacing"] = spacing;
    manifest["case"]["method"]["name"] = method;
    manifest["case"]["method"]["preset"] = method == "mps" ? "improved" : "slip";
    if (method == "vof") manifest["case"]["cells_per_L"] = length / spacing;
    manifest["steps"] = 1000;
    manifest["simulated_s"] = 0.22;
    manifest["wall_s"] = {{"total", seconds + 3.0}, {"setup", 1.0}, {"output", 2.0}};
    std::vector<double> times;
    for (double t = 0.0; t <= 0.22 + 1e-9; t += 0.01) times.push_back(t);
    const double lead = c * std::pow(spacing / 0.005, p) * length;
    testing::write_run(
        files_.runs() / name, times,
        [lead](double t) { return length + 2.0 * t + (t > 0.0 ? lead + 0.0001 : 0.0001); },
        manifest);
    runs_ += "[[run]]\nname = \"" + name +
             "\"\nprogram = \"surge-particle\"\ncase = \"c.toml\"\nset = []\nthreads = " +
             std::to_string(threads) + "\nrole = \"convergence\"\ngroup = \"" +
             (group.empty() ? method : group) + "\"\n";
  }

  [[nodiscard]] StudyResult collected() const {
    const auto file = files_.study().parent_path() / "levels.toml";
    testing::write_text(file, "title = \"Levels\"\ninclude = [\"study.toml\"]\n" + runs_);
    return collect(read_study(file), files_.runs(), files_.series());
  }
  [[nodiscard]] std::filesystem::path out() const { return files_.out(); }

 private:
  SyntheticStudy files_;
  std::string runs_;
};

/// A little above 5 mm and its half and double, because water farther apart than two spacings would
/// not be connected.
constexpr std::array<double, 3> spacings{0.0101, 0.00505, 0.002525};

/// Three levels of VOF without an error, MPS of first order, and MPS on two threads.
void add_all(SyntheticLevels& levels) {
  for (const double spacing : spacings) {
    const std::string size = std::to_string(std::lround(length / spacing));
    levels.add("vof-" + size, "vof", spacing, 0.0, 1.0, 2.0 / spacing);
    levels.add("mps-" + size, "mps", spacing, -0.04, 1.0, 0.1 / spacing);
  }
  levels.add("mps-fast", "mps", 0.002525, -0.04, 1.0, 15.0, 2);
}

const json& sequence(const json& metrics, const std::string& group) {
  for (const json& entry : metrics["convergence"]["sequences"])
    if (entry["group"] == group) return entry;
  throw std::runtime_error(group);
}

TEST(ConvergenceSection, FindsOrderExtrapolationAndIndexOfTheLevels) {
  SyntheticLevels levels;
  add_all(levels);
  const json metrics = report_metrics(levels.collected());
  const json& mps = sequence(metrics, "mps");
  EXPECT_EQ(mps["label"], "MPS improved");
  EXPECT_EQ(mps["refined"], "spacing");
  ASSERT_EQ(mps["levels"].size(), 3U);  // the run on two threads is no level of its own
  EXPECT_EQ(mps["levels"][0]["size"], 0.002525);
  const json& result = mps["quantities"]["Z_over_L_at_T_2.00"]["result"];
  EXPECT_NEAR(result["order"].get<double>(), 1.0, 1e-3);
  const double t = testing::dam_break().scales().dimensional(DimensionlessTime(2.0)).value();
  // The fronts of synthetic frames are on a lattice: exact to its rounding.
  EXPECT_NEAR(result["extrapolated"].get<double>(), (length + 2.0 * t + 0.0001) / length, 1e-3);
  EXPECT_NEAR(result["gci21"].get<double>(), 1.25 * 0.02, 1e-3);
  EXPECT_TRUE(result["asymptotic"].get<bool>());
  EXPECT_NEAR(mps["quantities"]["rms"]["values"][0].get<double>(), 0.02, 1e-3);
  EXPECT_EQ(sequence(metrics, "vof")["quantities"]["Z_over_L_at_T_2.00"]["result"]["approach"],
            "constant");
  EXPECT_FALSE(sequence(metrics, "vof")["quantities"].contains("rms"));
}

TEST(ConvergenceSection, DifferencesHaveTheCombinedUncertaintyOfBothSides) {
  SyntheticLevels levels;
  add_all(levels);
  const json metrics = report_metrics(levels.collected());
  const json& out = metrics["uncertainty"];
  ASSERT_EQ(out["against_vof"].size(), 1U);
  for (const json& row : out["against_vof"][0]["rows"]) {
    EXPECT_NEAR(row["E"].get<double>(), -0.02, 1e-3);
    const double u = row["u_num"];
    EXPECT_NEAR(u, 1.25 * 0.02 / numerical_coverage, 2e-3);
    EXPECT_NEAR(row["U"].get<double>(), 2.0 * std::hypot(u, row["u_D"].get<double>()), 1e-12);
    EXPECT_FALSE(row["beyond"].get<bool>());
  }
  // The series is the fronts, 0.2 late in T: differs as published, and not when it is shifted.
  ASSERT_EQ(out["experiments"].size(), 1U);
  const json& series = out["experiments"][0];
  EXPECT_NEAR(series["shift_T"].get<double>(), -0.2, 2e-3);
  const double speed = 2.0 / length / std::sqrt(2.0 * 9.81 / length);  // dZ/dT
  const json& rms = series["rms"];
  EXPECT_NEAR(rms["raw"]["E"].get<double>(), 0.2 * speed, 0.02);
  EXPECT_NEAR(rms["raw"]["u_D"].get<double>(), std::hypot(0.15, 0.1 * speed) / 2.0, 2e-3);
  EXPECT_TRUE(rms["raw"]["beyond"].get<bool>());
  EXPECT_FALSE(rms["shifted"]["beyond"].get<bool>());
}

/// The points of metrics.cost_to_error by their runs.
std::map<std::string, json> cost_points(const json& metrics) {
  std::map<std::string, json> points;
  for (const json& point : metrics["cost_to_error"]["points"]) points[point["run"]] = point;
  return points;
}

TEST(CostToError, HoldsEveryLevelWithItsErrorItsUncertaintyAndItsCost) {
  SyntheticLevels levels;
  add_all(levels);
  const json metrics = report_metrics(levels.collected());
  const json& out = metrics["cost_to_error"];
  EXPECT_THAT(out["against"].get<std::string>(), HasSubstr("VOF slip, 57.4"));
  EXPECT_EQ(out["quantity"], "Leading edge Z/L");
  const auto points = cost_points(metrics);
  EXPECT_FALSE(points.contains("vof-57"));  // what all are held against
  ASSERT_TRUE(points.contains("vof-14") && points.contains("vof-29"));
  const json& fine = points.at("mps-57");
  EXPECT_NEAR(fine["E"].get<double>(), 0.02, 1e-3);
  EXPECT_GT(fine["U"].get<double>(), 0.0);
  // All of the wall time of one thread, over 0.22 s of flow.
  EXPECT_NEAR(fine["cpu_s_per_s"].get<double>(), (0.1 / 0.002525 + 3.0) / 0.22, 1e-6);
  const json& fast = points.at("mps-fast");
  EXPECT_EQ(fast["threads"], 2);
  EXPECT_NEAR(fast["cpu_s_per_s"].get<double>(), 2.0 * 18.0 / 0.22, 1e-6);
  EXPECT_NEAR(fast["speedup"].get<double>(), (0.1 / 0.002525 + 3.0) / 18.0, 1e-6);
  double before = 0.0;
  for (const json& point : out["points"]) {
    EXPECT_GE(point["cpu_s_per_s"].get<double>(), before);
    before = point["cpu_s_per_s"];
  }
}

TEST(CostToError, NamesTheCheapestRunOfEachMethodAndItsFactor) {
  SyntheticLevels levels;
  add_all(levels);
  const json metrics = report_metrics(levels.collected());
  const json& out = metrics["cost_to_error"];
  std::map<std::string, json> cells;  // of those with an error of at most 0.05
  for (const json& level : out["levels"])
    if (std::abs(level["E"].get<double>() - 0.05) < 1e-12)
      for (const json& cell : level["cells"]) cells[cell["method"]] = cell;
  const auto cost = [&](const json& cell) {
    return out["points"][cell["point"].get<std::size_t>()]["cpu_s_per_s"].get<double>();
  };
  const json &mps = cells.at("MPS improved"), &vof = cells.at("VOF slip");
  EXPECT_EQ(out["points"][mps["point"].get<std::size_t>()]["run"], "mps-29");  // E = 0.04
  EXPECT_EQ(out["points"][vof["point"].get<std::size_t>()]["run"], "vof-14");
  double least = 1e300;
  for (const auto& [method, cell] : cells)
    if (!cell["point"].is_null()) least = std::min(least, cost(cell));
  EXPECT_DOUBLE_EQ(mps["factor"].get<double>(), cost(mps) / least);
  EXPECT_DOUBLE_EQ(vof["factor"].get<double>(), cost(vof) / least);
  // No level of MPS is within 0.01, and one on two threads does not count.
  for (const json& cell : out["levels"].back()["cells"])
    if (cell["method"] == "MPS improved") {
      EXPECT_TRUE(cell["point"].is_null());
    }
}

TEST(CostToError, RowsOfACurveStandTogether) {
  // A run on more threads is between those on one; gnuplot would break the line there.
  SyntheticLevels levels;
  add_all(levels);
  const std::vector<Figure> figures = cost_to_error_figures(levels.collected());
  ASSERT_EQ(figures.size(), 1U);
  std::vector<std::pair<std::string, std::string>> curves;
  for (const auto& row : figures[0].tables.at(0).rows) {
    const std::pair curve{std::get<std::string>(row[0]), std::get<std::string>(row[1])};
    if (curves.empty() || curves.back() != curve) curves.push_back(curve);
  }
  EXPECT_THAT(curves,
              ::testing::Contains(std::pair<std::string, std::string>("MPS improved", "more")));
  EXPECT_EQ(std::set(curves.begin(), curves.end()).size(), curves.size());
}

TEST(ConvergenceSection, TheBarsOfTheRecommendedPresetsAreHeldAgainstTheirLevels) {
  SyntheticLevels levels;
  add_all(levels);
  const json metrics = report_metrics(levels.collected());
  const json& bars = metrics["convergence"]["bars"];
  ASSERT_EQ(bars.size(), 2U);
  for (const json& bar : bars) {
    EXPECT_EQ(bar["reached"], bar["rms"].get<double>() <= bar["bar"].get<double>());
    EXPECT_FALSE(bar["reached"].get<bool>());
  }
}

TEST(ConvergenceSection, StepsAreTheSizeWhereTheSpacingIsTheSame) {
  SyntheticLevels levels;
  add_all(levels);
  levels.add("steps-a", "mps", 0.00505, 0.0, 1.0, 1.0, 1, "steps");
  levels.add("steps-b", "mps", 0.00505, 0.1, 1.0, 1.0, 1, "steps");
  const json metrics = report_metrics(levels.collected());
  const json& steps = sequence(metrics, "steps");
  EXPECT_EQ(steps["refined"], "time step");
  EXPECT_DOUBLE_EQ(steps["levels"][0]["size"], 0.22 / 1000);
  EXPECT_TRUE(steps["quantities"]["rms"]["result"].is_null());  // two levels of one size
  for (const json& point : metrics["cost_to_error"]["points"])
    EXPECT_THAT(point["run"].get<std::string>(), Not(HasSubstr("steps")));
}

TEST(ConvergenceSection, ReportHasItsTablesAndFiguresAndNoStudyWithoutRunsDoes) {
  SyntheticLevels levels;
  add_all(levels);
  const StudyResult study = levels.collected();
  std::string warnings;
  (void)write_report(study, levels.out(), warnings);
  EXPECT_EQ(warnings, "");
  const std::string page = testing::read_text(levels.out() / "index.html");
  for (const char* text :
       {"id=\"convergence\"", "MPS improved, spacing refined", "missed", "cannot be told apart",
        "<figure id=\"cost_to_error\"", "What a given error costs"})
    EXPECT_NE(page.find(text), std::string::npos) << text;
  const SyntheticStudy without;
  EXPECT_TRUE(convergence_figures(without.collected()).empty());
}

}  // namespace
}  // namespace surge::compare
