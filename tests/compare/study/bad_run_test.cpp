#include <gmock/gmock.h>

#include "compare/read/recorded.hpp"
#include "compare/report/report.hpp"
#include "compare/study/run_fault.hpp"
#include "tests/compare/synthetic_study.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::AllOf;
using testing::error_of;
using ::testing::HasSubstr;
using testing::read_text;
using testing::SyntheticStudy;

/// Writes the report as the program does: a run that is found faulty on the way is left out.
json report_of(const SyntheticStudy& files) {
  Faults faults;
  for (int tries = 0; tries < 4; ++tries) {
    try {
      const StudyResult study =
          collect(read_study(files.study()), files.runs(), files.series(), faults);
      std::string warnings;
      static_cast<void>(write_report(study, files.out(), warnings));
      break;
    } catch (const RunFault& fault) {
      faults[fault.run()] = fault.what();
    }
  }
  return json::parse(read_text(files.out() / "metrics.json"));
}

/// The manifest of a run with one entry replaced.
void replace(const SyntheticStudy& files, const std::string& run, const std::string& pointer,
             const json& value) {
  const fs::path file = files.runs() / run / "manifest.json";
  json manifest = json::parse(read_text(file));
  manifest[json::json_pointer(pointer)] = value;
  testing::write_text(file, manifest.dump());
}

void expect_unusable(const SyntheticStudy& files, const std::string& run, const std::string& file) {
  const json metrics = report_of(files);
  EXPECT_EQ(metrics["runs"][run]["status"], "unusable") << file;
  EXPECT_THAT(metrics["runs"][run]["note"].get<std::string>(), HasSubstr(file));
  EXPECT_EQ(metrics["runs"]["sph-a"]["status"], "complete");
  EXPECT_TRUE(metrics["front"].contains("sph-a"));
  EXPECT_FALSE(metrics["front"].contains(run));
}

TEST(BadRun, ManifestsOfWrongTypesAreNamed) {
  const std::vector<std::pair<std::string, json>> wrong{
      {"/finished", "yes"},
      {"/wall_s", 2.5},
      {"/wall_s/total", "long"},
      {"/steps", "many"},
      {"/steps", nullptr},
      {"/steps", -1},
      {"/cpu", 7},
      {"/commit", json::array()},
      {"/started", 2026},
      {"/stopped", json::object()},
      {"/threads", {1}},
      {"/simulated_s", "1"},
      {"/fluid_particles", json::object()},
      {"/case", 1},
      {"/case/method", "mps"},
      {"/case/method/name", 1},
      {"/case/method/parameters", json::array()},
      {"/case/method/parameters/beta", json::array()},
      {"/case/probes", 3},
      {"/case/probes/0/position", {1, 2}},
      {"/case/fluid", json::array()},
      {"/case/fluid/gravity", "down"},
      {"/case/blocks", json::object()},
      {"/case/dimension", 4},
      {"/case/tank", "wide"},
      {"/case/tank/open", {{"y+", 1}}},
  };
  const SyntheticStudy files;
  const fs::path file = files.runs() / "mps-a/manifest.json";
  const std::string good = read_text(file);
  for (const auto& [pointer, value] : wrong) {
    replace(files, "mps-a", pointer, value);
    const StudyResult study = files.collected();
    EXPECT_EQ(study.runs[0].status, RunStatus::unusable) << pointer << value;
    EXPECT_THAT(study.runs[0].note, HasSubstr("mps-a/manifest.json")) << pointer << value;
    EXPECT_EQ(study.runs[1].status, RunStatus::complete);
    EXPECT_NO_THROW(static_cast<void>(report_metrics(study))) << pointer << value;
    testing::write_text(file, good);
  }
  replace(files, "mps-a", "/steps", "many");
  expect_unusable(files, "mps-a", "manifest.json: steps: \"many\" found, a finite number");
}

TEST(BadRun, ManifestsThatAreNoJsonAreNamed) {
  const SyntheticStudy files;
  for (const std::string text :
       {"", "[1, 2]", "{\"finished\": tru", "{\"steps\": 1e400}", "\xff\xfe"}) {
    testing::write_text(files.runs() / "mps-a/manifest.json", text);
    const StudyResult study = files.collected();
    EXPECT_EQ(study.runs[0].status, RunStatus::unusable) << text;
    EXPECT_THAT(study.runs[0].note, HasSubstr("mps-a/manifest.json"));
  }
  // The last one is no UTF-8, and its error not either.
  expect_unusable(files, "mps-a", "mps-a/manifest.json");
}

TEST(BadRun, OnlyTheReferenceIsPresent) {
  const SyntheticStudy files;
  fs::remove_all(files.runs() / "mps-a");
  fs::remove_all(files.runs() / "sph-a");
  const json metrics = report_of(files);
  EXPECT_EQ(metrics["runs"]["mps-a"]["status"], "missing");
  EXPECT_EQ(metrics["runs"]["sph-a"]["status"], "missing");
  EXPECT_EQ(metrics["runs"]["vof-20"]["status"], "complete");
}

TEST(BadRun, MethodSheetsAndStepsOfOneRunAreItsOwnFault) {
  const SyntheticStudy files;
  testing::write_text(files.runs() / "mps-a/method.json", "{\"stages\": 3}");
  expect_unusable(files, "mps-a", "method.json");
}

// The front reads positions only: what else a frame lacks shows when the pictures are made.
TEST(BadRun, AFrameWithoutItsFieldsIsOneRunsFault) {
  const SyntheticStudy files;
  testing::write_vtp(files.runs() / "mps-a/frames/particles_5.vtp", {{0.1, 0.1, 0}}, {0});
  const fs::path frame = files.runs() / "mps-a/frames/particles_5.vtp";
  std::string text = read_text(frame);
  for (auto at = text.find("\"pressure\""); at != std::string::npos; at = text.find("\"pressure\""))
    text.replace(at, 10, "\"pressore\"");
  testing::write_text(frame, text);
  expect_unusable(files, "mps-a", "mps-a");
}

/// A run folder of its own with frames that state their times, as surge-particle writes them.
class Recorded : public ::testing::Test {
 protected:
  void SetUp() override {
    json manifest = testing::dam_break_manifest();
    manifest["frames"] = 5;
    manifest["simulated_s"] = 0.04;
    manifest["steps"] = 4;
    testing::write_run(
        run_, {0.0, 0.01, 0.02, 0.03, 0.04}, [](double t) { return 0.145 + 2.0 * t; }, manifest);
    testing::write_text(run_ / "steps.csv", "time,dt\n0.01,1\n0.02,1\n0.03,1\n0.04,1\n");
    for (int k = 0; k < 5; ++k)
      testing::write_vtp(frame(k), testing::lattice({0, 0, 0}, {0.145, 0.29, 0}, 0.005), {}, "type",
                         0.01 * k);
  }
  [[nodiscard]] fs::path frame(int k) const {
    return run_ / ("frames/particles_" + std::to_string(k) + ".vtp");
  }
  [[nodiscard]] std::string refusal() const {
    return error_of([&] { static_cast<void>(measure(open_run(run_), {})); });
  }
  testing::TemporaryFolder folder_;
  fs::path run_ = folder_ / "run";
};

TEST_F(Recorded, WhatIsWholeIsTaken) {
  EXPECT_EQ(measure(open_run(run_), {}).history.size(), 5U);
}

TEST_F(Recorded, ACollectionThatLacksFramesIsNamed) {
  std::string list = read_text(run_ / "particles.pvd");
  for (int k : {4, 3}) {
    const auto at = list.find("<DataSet timestep=\"0.0" + std::to_string(k));
    list.erase(at, list.find('\n', at) + 1 - at);
  }
  testing::write_text(run_ / "particles.pvd", list);
  EXPECT_THAT(refusal(), HasSubstr("3 frames in particles.pvd found, 5 expected"));
}

TEST_F(Recorded, SwappedFramesAreNamed) {
  fs::rename(frame(2), run_ / "frames/other.vtp");
  fs::rename(frame(3), frame(2));
  fs::rename(run_ / "frames/other.vtp", frame(3));
  EXPECT_THAT(refusal(), AllOf(HasSubstr("particles_2.vtp: a frame of 0.03 s found"),
                               HasSubstr("one of 0.02 s expected")));
}

TEST_F(Recorded, StepsThatAreNotThereAreNamed) {
  testing::write_text(run_ / "steps.csv", "time,dt\n0.01,1\n0.02,1\n");
  EXPECT_THAT(refusal(), HasSubstr("2 rows in steps.csv found, 4 expected"));
}

TEST_F(Recorded, AnEndThatIsNotThereIsNamed) {
  json manifest = json::parse(read_text(run_ / "manifest.json"));
  manifest["simulated_s"] = 1.0;
  testing::write_text(run_ / "manifest.json", manifest.dump());
  EXPECT_THAT(refusal(), HasSubstr("a last frame at 0.04 s found, 1 s expected"));
}

TEST_F(Recorded, ARunOfNoStepsIsNotFinished) {
  json manifest = json::parse(read_text(run_ / "manifest.json"));
  manifest["steps"] = 0;
  testing::write_text(run_ / "manifest.json", manifest.dump());
  EXPECT_THAT(refusal(), HasSubstr("steps: 0 found, at least one"));
}

TEST_F(Recorded, AKilledRunSaysSo) {
  json manifest = json::parse(read_text(run_ / "manifest.json"));
  manifest["finished"] = false;
  manifest["frames"] = 0;
  manifest["steps"] = 0;
  testing::write_text(run_ / "manifest.json", manifest.dump());
  const surge::compare::Run run = open_run(run_);
  EXPECT_TRUE(is_unfinished(run));
  ASSERT_FALSE(run.notices.empty());
  EXPECT_EQ(run.notices[0], "the run did not finish: what it has ends at 0.04 s");
}

}  // namespace
}  // namespace surge::compare
