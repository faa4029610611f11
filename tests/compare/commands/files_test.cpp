#include <gmock/gmock.h>

#include "compare/commands/command_options.hpp"
#include "compare/report/report.hpp"
#include "tests/compare/synthetic_study.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;
using testing::error_of;
using ::testing::HasSubstr;
using testing::SyntheticStudy;

/// The synthetic study and the files of another program, which are its MPS run without what says
/// so. `read`: what its table says of them.
Study with_files(const SyntheticStudy& files, const std::string& read) {
  const fs::path theirs = files.runs().parent_path() / "studies/their files";
  fs::copy(files.runs() / "mps-a", theirs, fs::copy_options::recursive);
  for (const char* name : {"manifest.json", "method.json", "steps.csv"}) fs::remove(theirs / name);
  std::ofstream(files.study(), std::ios::app)
      << "[[run]]\nname = \"theirs\"\nprogram = \"files\"\nsource = \"their files/particles.pvd\"\n"
      << "read = {" << read << "}\n";
  Study study = read_study(files.study());
  for (StudyRun& run : study.runs)
    if (run.is_files()) run.source = source_options(run);
  return study;
}

TEST(Files, OfAnotherProgramAreARunOfTheStudy) {
  const SyntheticStudy files;
  const Study study =
      with_files(files, "spacing = 0.005, gravity = 9.81, column-width = 0.145, tank-width = 0.58");
  const StudyResult result = collect(study, files.runs(), files.series());
  const RunResult& theirs = result.runs.back();
  EXPECT_EQ(theirs.study.name, "theirs");
  EXPECT_EQ(theirs.status, RunStatus::complete) << theirs.note;
  ASSERT_NE(theirs.measured, nullptr) << theirs.note;
  const nlohmann::json metrics = report_metrics(result);
  EXPECT_NEAR(metrics["front"]["theirs"]["rms_vs_vof"],
              metrics["front"]["mps-a"]["rms_vs_vof"].get<double>(), 1e-6);
}

TEST(Files, WhatTheyDoNotSayIsAskedForAsOneRunsFault) {
  const SyntheticStudy files;
  const StudyResult result =
      collect(with_files(files, "gravity = 9.81"), files.runs(), files.series());
  EXPECT_EQ(result.runs.back().status, RunStatus::unusable);
  EXPECT_THAT(result.runs.back().note, HasSubstr("--spacing"));
  EXPECT_EQ(result.runs.front().status, RunStatus::complete);
}

TEST(Files, OptionsThatThereAreNotAreNamedWithTheirLine) {
  const SyntheticStudy files;
  EXPECT_THAT(error_of([&] { static_cast<void>(with_files(files, "spcing = 0.005")); }),
              HasSubstr("run.3.read.spcing: found no such option"));
  const SyntheticStudy others;
  EXPECT_THAT(error_of([&] { static_cast<void>(with_files(others, "spacing = -1")); }),
              HasSubstr("run.3.read.spacing"));
}

}  // namespace
}  // namespace surge::compare
