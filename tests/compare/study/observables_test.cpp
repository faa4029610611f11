#include "compare/study/observables.hpp"

#include <gmock/gmock.h>

#include "compare/figures/figures.hpp"
#include "compare/report/report.hpp"
#include "compare/study/observable_verdicts.hpp"
#include "tests/compare/synthetic_study.hpp"

namespace surge::compare {
namespace {

using testing::error_of;
using ::testing::HasSubstr;
using testing::SyntheticStudy;

void append(const SyntheticStudy& files, const std::string& text) {
  std::ofstream(files.study(), std::ios::app) << text;
}

const Comparison* find(const CurveComparison& all, CurveMeasure measure) {
  for (const Comparison& one : all.measures)
    if (one.measure == measure) return &one;
  return nullptr;
}

const RunResult& run_of(const StudyResult& study, const std::string& name) {
  for (const RunResult& run : study.runs)
    if (run.study.name == name) return run;
  throw Error("no run " + name);
}

const std::string edge =
    "[[observable]]\nname = \"edge\"\nkind = \"front\"\ncompare = [\"rms\", \"arrival\", "
    "\"peak\"]\nthreshold = \"2*L\"\ntolerance = {rms = \"0.05*L\"}\n";

TEST(Observables, DifferencesAndVerdictsAreThoseOfTheFronts) {
  const SyntheticStudy files;
  files.refine_all();
  append(files, edge);
  const StudyResult study = files.collected();
  const auto quantities = observed_quantities(study);
  ASSERT_EQ(quantities.size(), 1U);
  EXPECT_EQ(quantities[0].key, "edge");
  EXPECT_EQ(quantities[0].unit, "m");
  const auto all = compare_curve(study, quantities[0], run_of(study, "mps-a"));
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].against, "vof-20");
  EXPECT_NEAR(all[0].begin, 0.0, 1e-12);
  EXPECT_NEAR(all[0].end, 0.22, 1e-12);
  // The lead comes with the second frame, so that it grows in the first interval.
  const double lead = 0.02 * SyntheticStudy::length;
  const Comparison* rms = find(all[0], CurveMeasure::rms);
  ASSERT_TRUE(rms != nullptr && rms->verdict);
  EXPECT_NEAR(rms->verdict->difference, lead * std::sqrt((21.0 + 1.0 / 3.0) / 22.0), 1e-9);
  EXPECT_NEAR(*rms->maximum, lead, 1e-9);
  EXPECT_NEAR(rms->verdict->tolerance, 0.05 * SyntheticStudy::length, 1e-12);
  EXPECT_EQ(rms->verdict->outcome, Outcome::agrees);
  const Comparison* arrival = find(all[0], CurveMeasure::arrival);
  ASSERT_TRUE(arrival != nullptr && arrival->verdict);
  EXPECT_NEAR(arrival->verdict->difference, -lead / 2.0, 1e-9);  // at 2 m/s
  EXPECT_EQ(arrival->unit, "s");
}

/// A series "clock" of the front, with a case of its own.
void write_clock(const SyntheticStudy& files, const std::string& rows) {
  testing::write_text(
      files.series() / "c.toml",
      "title = \"c\"\ndimension = 2\n[fluid]\ndensity = 1000.0\ngravity = [0.0, -9.81]\n"
      "[tank]\nlower = [0.0, 0.0]\nupper = [0.58, 1.16]\nopen = [\"y+\"]\n"
      "[[block]]\nshape = \"box\"\nlower = [0.0, 0.0]\nupper = [0.145, 0.29]\n"
      "[resolution]\nspacing = 0.0145\n[time]\nend = 1.0\n[output]\ninterval = 0.1\n");
  testing::write_text(
      files.series() / "clock.csv",
      std::string(
          "# label: A\n# citation: B 1952\n# case: c\n# observable: front\n# axes: t, x\n"
          "# time_unit: s\n# value_unit: cm\n# kind: experiment\n# time_uncertainty: 0.001\n"
          "# value_uncertainty: 0.1\n# gate: none\n# time_shift: fitted within 0.05*s\nt,value\n") +
          rows);
}

// The clock of an experiment may be off; both differences are told.
TEST(Observables, AFittedShiftDoesNotHideTheDifferenceWithoutIt) {
  const SyntheticStudy files;
  write_clock(files, "0.07,24.5\n0.12,34.5\n0.17,44.5\n");
  append(files, edge + "references = [\"clock\"]\n");
  const StudyResult study = files.collected();
  const auto all = compare_curve(study, observed_quantities(study)[0], run_of(study, "mps-a"));
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[1].skipped, "");
  const double lead = 0.02 * SyntheticStudy::length;
  EXPECT_NEAR(all[1].shift, -0.02 - lead / 2.0, 1e-4);
  const Comparison* rms = find(all[1], CurveMeasure::rms);
  ASSERT_TRUE(rms != nullptr && rms->verdict && rms->unshifted);
  EXPECT_LT(rms->verdict->difference, 3e-4);
  EXPECT_NEAR(*rms->unshifted, 2.0 * 0.02 + lead, 2e-4);
  EXPECT_EQ(find(all[0], CurveMeasure::rms)->unshifted, std::nullopt);
}

// An experiment has one clock: what one of its series would like alone is not its to choose.
TEST(Observables, SeriesOfOneClockAreShiftedByTheSameTime) {
  const SyntheticStudy files;
  write_clock(files, "0.07,24.5\n0.12,34.5\n0.17,44.5\n");
  std::string text = testing::read_text(files.series() / "clock.csv");
  text.insert(text.find("t,value"), "# clock: one\n");
  testing::write_text(files.series() / "clock.csv", text);
  std::string second = text;  // 10 ms earlier, and known ten times better
  second.replace(second.find("value_uncertainty: 0.1"), 22, "value_uncertainty: 0.01");
  second.replace(second.find("0.07,"), std::string::npos, "0.06,24.5\n0.11,34.5\n0.16,44.5\n");
  testing::write_text(files.series() / "second.csv", second);
  append(files, edge + "references = [\"clock\", \"second\"]\n");
  const StudyResult study = files.collected();
  const auto all = compare_curve(study, observed_quantities(study)[0], run_of(study, "mps-a"));
  ASSERT_EQ(all.size(), 3U);
  EXPECT_DOUBLE_EQ(all[1].shift, all[2].shift);
  const double alone = -0.01 - 0.02 * SyntheticStudy::length / 2.0;  // of the second
  EXPECT_NEAR(all[2].shift, alone - 0.01 / 101.0, 1e-4);
  EXPECT_THAT(all[1].note, HasSubstr("like all of its clock one"));
  // What one of them allows less holds for all.
  second.replace(second.find("within 0.05"), 11, "within 0.008");
  testing::write_text(files.series() / "second.csv", second);
  const StudyResult strict = files.collected();
  for (const CurveComparison& found :
       compare_curve(strict, observed_quantities(strict)[0], run_of(strict, "mps-a")))
    EXPECT_DOUBLE_EQ(found.shift, found.against == "vof-20" ? 0.0 : -0.008) << found.against;
}

TEST(Observables, FigureEndsWhereTheRunsDo) {
  const auto script = [](const std::string& rows) {
    const SyntheticStudy files;
    write_clock(files, rows);
    append(files, edge + "references = [\"clock\"]\n");
    return observable_figures(files.collected()).at(0).script;
  };
  EXPECT_THAT(script("0.07,24.5\n0.12,34.5\n"), ::testing::Not(HasSubstr("set xrange")));
  const std::string later = script("0.07,24.5\n0.12,34.5\n9,500\n");
  EXPECT_THAT(later, HasSubstr("set xrange [*:"));
  // Nor is the range of values that of what is not shown.
  EXPECT_THAT(later, ::testing::ContainsRegex("set yrange .*:0\\.[0-9]*\\]"));
}

TEST(Observables, WithoutLevelsNothingIsDecided) {
  const SyntheticStudy files;
  append(files, edge);
  const StudyResult study = files.collected();
  const auto all = compare_curve(study, observed_quantities(study)[0], run_of(study, "mps-a"));
  const Comparison* rms = find(all.at(0), CurveMeasure::rms);
  ASSERT_TRUE(rms != nullptr && rms->verdict);
  EXPECT_EQ(rms->verdict->outcome, Outcome::undecided);
  EXPECT_THAT(rms->verdict->why, HasSubstr("two more resolutions"));
}

TEST(Observables, OfACaseAreThoseThatItDeclares) {
  const SyntheticStudy files;
  const StudyResult study = files.collected();
  std::vector<std::string> names;
  for (const StudyObservable& one : study.observables) names.push_back(one.request());
  EXPECT_THAT(names, ::testing::ElementsAre("pressure:x=0.58,y=0.0145", "centre-of-mass",
                                            "potential-energy", "kinetic-energy", "volume"));
  EXPECT_TRUE(study.has_front);
}

TEST(Observables, OneWithoutAFrontNeedsNone) {
  const SyntheticStudy files;
  std::string text = testing::read_text(files.study());
  const auto claims = text.find("claims = \"alves_dreux\"\n");
  text.erase(claims, 23);
  testing::write_text(files.study(), text + "[[observable]]\nname = \"v\"\nkind = \"volume\"\n");
  const StudyResult study = files.collected();
  EXPECT_FALSE(study.has_front);
  EXPECT_TRUE(study.reference_run().history.empty());
  std::string warnings;
  const nlohmann::json metrics = write_report(study, files.out(), warnings);
  EXPECT_EQ(warnings, "");
  EXPECT_TRUE(metrics["observables"].contains("v"));
  EXPECT_FALSE(metrics["front"]["mps-a"].contains("arrival_T"));
  const std::string page = testing::read_text(files.out() / "index.html");
  EXPECT_THAT(page, ::testing::Not(HasSubstr("Leading edge Z/L")));
  EXPECT_THAT(page, ::testing::Not(HasSubstr("the paper")));
  EXPECT_THAT(page, HasSubstr("id=\"observable_v\""));
}

TEST(Observables, SayWhatIsWrong) {
  const auto said = [](const std::string& text) {
    return error_of([&] {
      static_cast<void>(
          read_observables(TomlTable::parse("[[observable]]\nname = \"a\"\n" + text, "s.toml")));
    });
  };
  EXPECT_THAT(said("kind = \"levels\"\n"), HasSubstr("s.toml:3: observable.0.kind"));
  EXPECT_THAT(said("kind = \"volume\"\ncompare = [\"mean\"]\n"), HasSubstr("expected one of rms"));
  EXPECT_THAT(said("kind = \"volume\"\ncompare = [\"rms\", \"rms\"]\n"), HasSubstr("it once"));
  EXPECT_THAT(said("kind = \"volume\"\ncompare = [\"arrival\"]\n"), HasSubstr("threshold"));
  EXPECT_THAT(said("kind = \"volume\"\ncompare = [\"phase\"]\n"), HasSubstr("period"));
  EXPECT_THAT(said("kind = \"volume\"\nwindow = [1.0]\n"), HasSubstr("two times"));
  EXPECT_THAT(said("kind = \"volume\"\n[[observable]]\nname = \"a\"\nkind = \"volume\"\n"),
              HasSubstr("a second time"));
}

}  // namespace
}  // namespace surge::compare
