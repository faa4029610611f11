// Runs the program surge-particle as a user does.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "particle/io/computation.hpp"
#include "tests/case/case_fixture.hpp"
#include "tests/places.hpp"

namespace surge {
namespace {

struct Result {
  int status = -1;
  std::string output;  ///< of stdout and stderr, or as the command directs
};

Result shell(const std::string& command) {
  Result result;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return result;
  std::array<char, 4096> buffer{};
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe)) {
    result.output.append(buffer.data(), n);
  }
  const int status = ::pclose(pipe);
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return result;
}

class Program : public testing::Test {
 protected:
  Program() { std::ofstream(case_) << test::small_case; }

  [[nodiscard]] Result run(const std::string& arguments) const {
    return shell("cd '" + folder_.path().string() + "' && " + tests::programs() +
                 "/surge-particle " + arguments);
  }
  [[nodiscard]] nlohmann::json manifest(const std::string& run) const {
    return nlohmann::json::parse(test::read_text(folder_.path() / run / "manifest.json"));
  }
  /// Expects exit status 1 and one line on stderr that contains `text`, and nothing on stdout.
  void expect_error(const std::string& arguments, const std::string& text) const {
    const Result result = run(arguments + " 2>&1");
    EXPECT_EQ(result.status, 1) << arguments;
    EXPECT_THAT(result.output, testing::HasSubstr(text));
    EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
  }

  tests::TemporaryFolder folder_;
  std::filesystem::path case_ = folder_.path() / "case.toml";
};

/// How often the OpenMP library was told to spin so long, over all starts of the program.
long spinning(const std::string& output, const std::string& count) {
  const std::string line = "GOMP_SPINCOUNT = '" + count + "'";
  long found = 0;
  for (auto at = output.find(line); at != std::string::npos; at = output.find(line, at + 1))
    ++found;
  return found;
}

// The library itself tells what it goes by, each time that the program starts.
TEST_F(Program, ThreadsWaitPassivelyUnlessTheUserSaysHow) {
  const auto told = [&](const std::string& environment, const std::string& threads) {
    return shell("cd '" + folder_.path().string() + "' && " + environment +
                 " OMP_DISPLAY_ENV=verbose " + tests::programs() +
                 "/surge-particle run case.toml --out run"
                 " --force --set time.end=0.001 --threads " +
                 threads + " 2>&1");
  };
  const std::string plain = "env -u GOMP_SPINCOUNT -u OMP_WAIT_POLICY";
  const Result two = told(plain, "2");
  EXPECT_EQ(two.status, 0) << two.output;
  EXPECT_EQ(spinning(two.output, "1000"), 1) << two.output;
  EXPECT_EQ(spinning(told(plain, "1").output, "1000"), 0) << "a single thread waits for nobody";
  EXPECT_EQ(spinning(told(plain + " GOMP_SPINCOUNT=77", "2").output, "77"), 1);
  EXPECT_EQ(spinning(told(plain + " OMP_WAIT_POLICY=active", "2").output, "1000"), 0);
}

TEST_F(Program, TellsHelpAndVersion) {
  EXPECT_THAT(run("--help").output,
              testing::AllOf(testing::HasSubstr("run"), testing::HasSubstr("check")));
  const Result version = run("--version");
  EXPECT_EQ(version.status, 0);
  EXPECT_THAT(version.output, testing::StartsWith("surge-particle 0."));
  EXPECT_THAT(version.output, testing::HasSubstr("commit "));
}

TEST_F(Program, ListsPresetsAndOptions) {
  EXPECT_THAT(run("list").output, testing::AllOf(testing::HasSubstr("mps-paper"),
                                                 testing::HasSubstr("sph-paper-bare")));
  EXPECT_THAT(
      run("list --options").output,
      testing::AllOf(testing::HasSubstr("beta = 0.97"), testing::HasSubstr("xsph_epsilon = 0.5")));
}

TEST_F(Program, ChecksACaseWithoutRunningIt) {
  const Result result = run("check case.toml");
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.output, testing::HasSubstr("32 fluid"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1);
}

TEST_F(Program, ChecksIntoJson) {
  const Result result = run("check case.toml --json --set method.name=mps");
  ASSERT_EQ(result.status, 0);
  const auto j = nlohmann::json::parse(result.output);
  EXPECT_EQ(j["case"], to_json(test::make_computation({"method.name=mps"})));
  EXPECT_EQ(j["size"]["fluid_particles"], 32);
  ASSERT_EQ(run("run case.toml --out r --set method.name=mps").status, 0);
  EXPECT_EQ(j["size"]["wall_particles"], manifest("r")["wall_particles"]);
  EXPECT_EQ(j["size"]["frames"], manifest("r")["frames"]);
}

TEST_F(Program, TellsTheSizeOfARun) {
  const std::string output = run("check case.toml").output;
  for (const char* line : {"wall\n", "steps       about", "memory      about", "disk        about"})
    EXPECT_THAT(output, testing::HasSubstr(line));
}

TEST_F(Program, ListsTheKeysOfACaseFile) {
  EXPECT_THAT(run("list").output,
              testing::AllOf(testing::HasSubstr("[[moving_wall]]"), testing::HasSubstr("per ="),
                             testing::HasSubstr("kinematic_viscosity = m2/s; 0")));
}

TEST_F(Program, ARunWithoutAStepIsNotFinished) {
  expect_error("run case.toml --out r --set time.end=1e-300", "in which no step is taken");
  EXPECT_EQ(manifest("r")["finished"], false);
  EXPECT_EQ(manifest("r")["steps"], 0);
}

TEST_F(Program, TextsOfAFileDoNotReachTheTerminalAsOrders) {
  const std::string title = "--set 'title=\"a\\u001b[31mb\"'";
  EXPECT_THAT(run("check case.toml " + title).output, testing::StartsWith("a?[31mb\n"));
  expect_error("check case.toml --set 'probe.0.name=\"\\u001b[31m,\"'", "found \"?[31m,\"");
}

TEST_F(Program, SaysWhatItDoesNotRecord) {
  std::ofstream(case_, std::ios::app) << "[[gauge]]\nname = \"H\"\nposition = [0.05, 0.0]\n";
  EXPECT_THAT(run("check case.toml").output,
              testing::HasSubstr("note: 1 gauge of the case not recorded by the run"));
}

TEST_F(Program, WritesARunFolder) {
  for (const std::string method : {"mps", "sph"}) {
    const Result result =
        run("run case.toml --out " + method + " --threads 1 --set method.name=" + method);
    ASSERT_EQ(result.status, 0) << result.output;
    const nlohmann::json j = manifest(method);
    EXPECT_EQ(j["program"], "surge-particle");
    EXPECT_EQ(j["finished"], true);
    EXPECT_EQ(j["threads"], 1);
    EXPECT_EQ(j["fluid_particles"], 32);
    const auto sheet =
        nlohmann::json::parse(test::read_text(folder_.path() / method / "method.json"));
    EXPECT_EQ(sheet["method"], method);
    EXPECT_EQ(sheet["spacing_m"], 0.01);
    EXPECT_GT(j["wall_particles"], 0);
    EXPECT_NEAR(j["simulated_s"], 0.02, 1e-12);
    EXPECT_EQ(j["frames"], 5);
    EXPECT_EQ(j["nonfinite"], 0);
    EXPECT_GT(j["wall_s"]["total"], 0.0);
    EXPECT_GT(j["cpu_s"], 0.0);
    EXPECT_EQ(j.contains("ppe"), method == "mps");
    if (method == "mps") {
      EXPECT_GT(j["ppe"]["iterations"], 0);
      EXPECT_GT(j["ppe"]["setup_s"], 0.0);
      EXPECT_GT(j["ppe"]["solve_s"], 0.0);
      EXPECT_LT(j["ppe"]["setup_s"].get<double>() + j["ppe"]["solve_s"].get<double>(),
                j["wall_s"]["pressure"]);
    }
    for (const char* phase : {"setup", "neighbours", "pressure", "forces", "output"}) {
      EXPECT_TRUE(j["wall_s"].contains(phase)) << phase;
    }
    // The manifest's case is the one that was asked for, and case.toml says the same.
    EXPECT_EQ(j["case"], to_json(test::make_computation({"method.name=" + method})));
    EXPECT_EQ(j["case"], to_json(read_computation(folder_.path() / method / "case.toml")));
    const std::string steps = test::read_text(folder_.path() / method / "steps.csv");
    EXPECT_EQ(std::count(steps.begin(), steps.end(), '\n'), j["steps"].get<long>() + 1);
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / method / "frames/frame_00004.vtp"));
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / method / "particles.pvd"));
  }
}

TEST_F(Program, AFailedRunTellsWhereItsTimeWent) {
  // Pressures beyond the largest number.
  const Result result = run("run case.toml --out r --set fluid.density=1e307 2>&1");
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.output, testing::ContainsRegex("step [0-9]+ at t = .* not finite"));
  EXPECT_THAT(result.output, testing::HasSubstr("the last good state is frame"));
  const nlohmann::json j = manifest("r");
  EXPECT_EQ(j["finished"], false);
  EXPECT_THAT(j["stopped"].get<std::string>(), testing::HasSubstr("not finite"));
  double sum = 0.0;
  for (const char* phase : {"setup", "neighbours", "forces", "output"}) {
    EXPECT_GT(j["wall_s"][phase], 0.0) << phase;
    sum += j["wall_s"][phase].get<double>();
  }
  EXPECT_LE(sum, j["wall_s"]["total"]);
}

/// In a shell whose files cannot grow beyond so many KiB, as on a full disk.
std::string with_full_disk(int kib) {
  return "trap '' XFSZ; ulimit -f " + std::to_string(kib) + "; ";
}

TEST_F(Program, AFullDiskIsNamedAndTheManifestCountsWhatIsThere) {
  const Result result =
      shell("cd '" + folder_.path().string() + "' && bash -c \"" + with_full_disk(20) +
            tests::programs() + "/surge-particle run case.toml --out r --set time.end=1 2>&1\"");
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.output, testing::HasSubstr("steps.csv: found File too large"));
  const nlohmann::json j = manifest("r");
  EXPECT_EQ(j["finished"], false);
  EXPECT_THAT(j["stopped"].get<std::string>(), testing::HasSubstr("File too large"));
  const std::string rows = test::read_text(folder_.path() / "r/steps.csv");
  EXPECT_GT(j["steps"], 0);
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), j["steps"].get<long>() + 1);
  EXPECT_EQ(rows.back(), '\n');
  std::string last = rows.substr(rows.rfind('\n', rows.size() - 2) + 1);
  EXPECT_NEAR(j["simulated_s"], std::stod(last), 1e-9);
  EXPECT_EQ(j["frames"],
            std::distance(std::filesystem::directory_iterator(folder_.path() / "r/frames"), {}));
}

TEST_F(Program, WithoutRoomForACheckpointTheRunGoesOn) {
  // A frame is compressed, a checkpoint is not.
  const Result result = shell("cd '" + folder_.path().string() + "' && bash -c \"" +
                              with_full_disk(100) + tests::programs() +
                              "/surge-particle run case.toml --out r --set output.checkpoint=1e-9 "
                              "--set resolution.spacing=0.0025 --set time.end=0.002 2>&1\"");
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_THAT(result.output,
              testing::HasSubstr("warning: no checkpoint: r/checkpoint.bin: found File too large"));
  EXPECT_EQ(manifest("r")["finished"], true);
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "r/checkpoint.bin.tmp"));
}

TEST_F(Program, RunsWithAnObstacleAndNoTank) {
  std::ofstream(folder_.path() / "open.toml") << test::case_without_tank();
  for (const std::string method : {"mps", "sph"}) {
    const Result result =
        run("run open.toml --out " + method + " --set method.name=" + method +
            " --set obstacle.0.lower=[-0.05,-0.04]" + " --set obstacle.0.upper=[0.09,0.0] 2>&1");
    ASSERT_EQ(result.status, 0) << result.output;
    const nlohmann::json j = manifest(method);
    EXPECT_EQ(j["finished"], true);
    EXPECT_EQ(j["nonfinite"], 0);
    EXPECT_TRUE(j["case"]["tank"].is_null());
    EXPECT_GT(j["wall_particles"], 14);
    // The floor carries the block: without it the probe would be left behind within 0.02 s.
    const std::string steps = test::read_text(folder_.path() / method / "steps.csv");
    const std::string last = steps.substr(steps.find_last_of(',') + 1);
    EXPECT_GT(std::stod(last), 0.1 * 1000 * 9.81 * 0.08) << method;
  }
}

TEST_F(Program, ReplacesAnOlderRunWithForceAndNothingElse) {
  ASSERT_EQ(run("run case.toml --out r --set output.interval=0.002").status, 0);
  std::ofstream(folder_.path() / "r/notes.txt") << "mine";
  expect_error("run case.toml --out r", "r: found a finished run, expected an empty folder");
  EXPECT_EQ(manifest("r")["frames"], 11);
  ASSERT_EQ(run("run case.toml --out r --force").status, 0);
  EXPECT_EQ(manifest("r")["frames"], 5);
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "r/frames/frame_00005.vtp"));
  EXPECT_EQ(test::read_text(folder_.path() / "r/notes.txt"), "mine");
}

TEST_F(Program, RefusesFoldersThatAreNotRuns) {
  std::filesystem::create_directory(folder_.path() / "thesis");
  std::ofstream(folder_.path() / "thesis/chapter.tex") << "text";
  expect_error("run case.toml --out thesis", "thesis: found \"chapter.tex\" and no run");
  EXPECT_EQ(test::read_text(folder_.path() / "thesis/chapter.tex"), "text");
  std::ofstream(folder_.path() / "thesis/manifest.json") << R"({"program": "interFoam"})";
  expect_error("run case.toml --out thesis", "and no run of surge-particle");
  expect_error("run case.toml --out case.toml", "case.toml: found ");
}

TEST_F(Program, BadInputGetsOneLine) {
  expect_error("", "subcommand");
  expect_error("rn case.toml", "surge-particle: ");
  expect_error("run case.toml", "--out");
  expect_error("run nowhere.toml --out r", "nowhere.toml: found no such file");
  expect_error("run case.toml --out r --threads 0", "--threads");
  expect_error("check case.toml --set time.end=-1", "--set time.end=-1: found -1");
  expect_error("check case.toml --set", "--set");
  expect_error("run case.toml --out r --set resolution.spacing=0.011", "case.toml:9: tank.upper");
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "r"));
}

TEST_F(Program, InterruptedRunSaysSoAndOpens) {
  // Long enough that the signal comes while it runs; `exec` so that the signal reaches the program.
  const Result result =
      shell("cd '" + folder_.path().string() + "' && sh -c 'exec " + tests::programs() +
            "/surge-particle run case.toml --out r --set time.end=1000' > log & pid=$!; "
            "until grep -qs frame_00001 '" +
            folder_.path().string() +
            "/r/particles.pvd'; do sleep 0.05; done; kill -INT $pid; wait $pid");
  // Background commands of a shell without job control ignore SIGINT unless the program asks for
  // it.
  EXPECT_EQ(result.status, 130);
  const nlohmann::json j = manifest("r");
  EXPECT_EQ(j["finished"], false);
  EXPECT_EQ(j["stopped"], "interrupted");
  EXPECT_GT(j["steps"], 0);
  EXPECT_THAT(test::read_text(folder_.path() / "r/particles.pvd"),
              testing::HasSubstr("</VTKFile>"));
}

}  // namespace
}  // namespace surge
