#include <gmock/gmock.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>

#include "compare/read/readers.hpp"
#include "particle/support/json.hpp"
#include "tests/compare/synthetic.hpp"
#include "tests/places.hpp"

namespace surge::compare {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;
using testing::write_run;

struct Outcome {
  int code = -1;
  std::string text;
};

/// Runs surge-compare as a user does; both streams in one text.
Outcome run_program(const std::string& arguments) {
  const std::string command = tests::programs() + "/surge-compare " + arguments + " 2>&1";
  Outcome outcome;
  FILE* pipe = popen(command.c_str(), "r");
  std::array<char, 512> buffer{};
  while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe))
    outcome.text += buffer.data();
  const int status = pclose(pipe);
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

class Program : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::vector<double> times{0,    0.02, 0.04, 0.06, 0.08, 0.1,
                                    0.12, 0.14, 0.16, 0.18, 0.2,  0.22};
    write_run(folder_ / "a", times, [](double t) { return 0.145 + 2.2 * t; });
    write_run(folder_ / "b", times, [](double t) { return 0.145 + 2.0 * t; });
  }
  [[nodiscard]] std::string at(const std::string& name) const { return (folder_ / name).string(); }

  TemporaryFolder folder_;
};

TEST_F(Program, WritesAFront) {
  const Outcome outcome = run_program("front " + at("a") + " --out " + at("f.csv"));
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  std::ifstream in(at("f.csv"));
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "time_s,T,Z_over_L");
  double t = 0.0, dimensionless = 0.0, z = 0.0;
  for (int i = 0; i <= 5; ++i) std::getline(in, line);
  ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf", &t, &dimensionless, &z), 3);
  EXPECT_NEAR(t, 0.1, 1e-12);
  EXPECT_NEAR(dimensionless, 1.1632298, 6e-6);  // to five decimals
  EXPECT_NEAR(z, 0.365 / 0.145, 6e-6);
}

TEST_F(Program, WritesMetrics) {
  const Outcome outcome = run_program("metrics " + at("a") + " --reference " + at("b") + " --out " +
                                      at("m.json") + " --published " + tests::sources() +
                                      "/compare/reference/martin_moyce_1952_2.25in.csv");
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  const nlohmann::json metrics = read_json(at("m.json"));
  // Lead of 0.2 m/s t / L; the window ends where a is at 3.9 L, T = W.
  const double end = (3.9 - 1.0) * 0.145 / 2.2;
  EXPECT_NEAR(metrics["front"]["a"]["max_vs_reference"].get<double>(), 0.2 * end / 0.145, 1e-6);
  EXPECT_NEAR(metrics["front"]["a"]["rms_vs_reference"].get<double>(),
              0.2 * end / 0.145 / std::sqrt(3.0), 1e-6);
  EXPECT_EQ(metrics["front"]["a"]["published"]["martin_moyce_1952_2.25in"]["status"], "passed");
}

// Two people's runs are often called "out".
TEST_F(Program, SourcesOfOneNameAreToldApart) {
  std::filesystem::create_directories(folder_ / "mine");
  std::filesystem::create_directories(folder_ / "theirs");
  std::filesystem::copy(at("a"), at("mine/out"), std::filesystem::copy_options::recursive);
  std::filesystem::copy(at("b"), at("theirs/out"), std::filesystem::copy_options::recursive);
  const Outcome outcome =
      run_program("metrics " + at("mine/out") + " --reference " + at("theirs/out") + " --out " +
                  at("m.json") + " --max-rms mine/out=0.5 --max-arrival 1");
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  const nlohmann::json metrics = read_json(at("m.json"));
  EXPECT_EQ(metrics["definition"]["reference"], "theirs/out");
  EXPECT_GT(metrics["front"]["mine/out"]["rms_vs_reference"].get<double>(), 0.0);
}

TEST_F(Program, RefusesOtherPhysicsInOneLineEach) {
  nlohmann::json manifest = testing::dam_break_manifest();
  manifest["case"]["fluid"]["density"] = 900;
  write_run(
      folder_ / "c", {0.0, 0.1}, [](double t) { return 0.145 + t; }, manifest);
  const std::string arguments =
      "metrics " + at("c") + " --reference " + at("b") + " --out " + at("m.json");
  const Outcome outcome = run_program(arguments);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.text, HasSubstr("density: 900 kg/m3 in c, 1000 kg/m3 in b"));
  EXPECT_FALSE(std::filesystem::exists(at("m.json")));
  EXPECT_EQ(run_program(arguments + " --allow density").code, 0);
  EXPECT_EQ(run_program(arguments + " --allow dense").code, 1);
}

TEST_F(Program, BlessesChecksAndFails) {
  const std::string baseline = " --baseline " + at("base.json");
  EXPECT_EQ(run_program("check " + at("a") + baseline).code, 1) << "no baseline yet";
  EXPECT_EQ(run_program("check " + at("a") + baseline + " --bless").code, 1) << "no reason";
  EXPECT_EQ(run_program("check " + at("a") + baseline + " --bless --reason 'a test'").code, 0);
  EXPECT_EQ(run_program("check " + at("a") + baseline).code, 0);
  const Outcome failed = run_program("check " + at("b") + baseline);
  EXPECT_EQ(failed.code, 2);
  EXPECT_THAT(failed.text, HasSubstr("0.18 s"));
  EXPECT_EQ(run_program("check " + at("none") + baseline).code, 1);
  EXPECT_EQ(run_program("check " + at("none") + baseline + " --skip-missing").code, 77);
  EXPECT_NE(run_program("check " + at("a") + baseline + " --strip-height 0.01").code, 0)
      << "it is the baseline's";
}

TEST_F(Program, ErrorsAreOneLineAndNotZero) {
  for (const char* arguments :
       {"front /nowhere --out x.csv", "front", "", "frnt", "metrics --out x.json",
        "metrics --study /nowhere.toml --out x.json"}) {
    const Outcome outcome = run_program(arguments);
    EXPECT_EQ(outcome.code, 1) << arguments;
    EXPECT_FALSE(outcome.text.empty()) << arguments;
  }
  const Outcome outcome = run_program("front /nowhere --out x.csv");
  EXPECT_EQ(outcome.text, "surge-compare: /nowhere: no such file or folder\n");
  EXPECT_EQ(run_program("front " + at("a") + " --out x.csv --strip-height -1").code, 1);
}

TEST_F(Program, HelpsWithExamples) {
  EXPECT_EQ(run_program("--version").code, 0);
  for (const char* command : {"front", "metrics", "check"}) {
    const Outcome outcome = run_program(std::string(command) + " --help");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_THAT(outcome.text, HasSubstr("Examples:"));
  }
}

TEST_F(Program, ListsItsObservables) {
  const Outcome outcome = run_program("measure --list");
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  for (const char* name :
       {"front", "gauge", "column-height", "profile", "overlap", "centre-of-mass", "kinetic-energy",
        "potential-energy", "volume", "pressure", "force", "detached"})
    EXPECT_THAT(outcome.text, HasSubstr(name));
}

TEST_F(Program, MeasuresSeveralObservablesOfSeveralSources) {
  const Outcome outcome =
      run_program("measure " + at("a") + " " + at("b") +
                  " --observable gauge:x=0.1 --observable front --reference " + at("b") +
                  " --observable overlap --csv " + at("m.csv") + " --json " + at("m.json"));
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("gauge:x=0.1 [m]: 12 times; first 0.29 at 0 s"));
  const nlohmann::json found = read_json(at("m.json"));
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0]["name"], "a");
  EXPECT_EQ(found[0]["series"][1]["unit"], "m");
  EXPECT_NEAR(found[0]["series"][1]["value"][5].get<double>(), 0.365, 1e-9);
  EXPECT_EQ(found[1]["series"][2]["value"][5], 1.0);
  std::ifstream in(at("m.csv"));
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "source,series,unit,time_s,x_m,value");
  std::getline(in, line);
  EXPECT_THAT(line, HasSubstr("a,gauge:x=0.1,m,0,,0.29"));
}

TEST_F(Program, WritesCsvAloneToTheStandardOutput) {
  const Outcome outcome = run_program("measure " + at("a") + " --observable volume --csv -");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.text.rfind("source,series", 0), 0U) << outcome.text;
  EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 13);
}

TEST_F(Program, AnObservableThatFailsLeavesTheOthersAndTheExitCodeTells) {
  const Outcome outcome =
      run_program("measure " + at("a") + " --observable gauge:x=7 --observable volume");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.text, HasSubstr("gauge:x=7: height of the water: found the place x = 7 m"));
  EXPECT_THAT(outcome.text, HasSubstr("volume [m2]: 12 times"));
  EXPECT_THAT(run_program("measure " + at("a") + " --observable guage:x=0.1").text,
              HasSubstr("\"gauge\"?"));
  EXPECT_THAT(run_program("measure " + at("a")).text, HasSubstr("--list"));
}

}  // namespace
}  // namespace surge::compare
