#include <gmock/gmock.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/compare/foreign_text_writers.hpp"
#include "tests/places.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;
using testing::ForeignFlow;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::TemporaryFolder;
using testing::write_text;

/// The table of a run whose front is a tenth of L ahead from the second frame on.
void write_faster(const fs::path& file) {
  std::string text = "t,px,py,vx,vy,p,kind\n";
  for (int i = 0; i < ForeignFlow::frames; ++i) {
    const auto p = ForeignFlow{.ahead = i == 0 ? 0 : 1}.particles(i, 1, 2);
    for (std::size_t k = 0; k < p.position.size(); ++k)
      text += std::to_string(i * ForeignFlow::interval) + ',' +
              std::to_string(1000.0 * p.position[k][0]) + ',' +
              std::to_string(1000.0 * p.position[k][1]) + ",0,0,1," + std::to_string(p.type[k]) +
              '\n';
  }
  write_text(file, text);
}

/// A foreign program's files, a map of them, and the program that checks them.
class Check : public ::testing::Test {
 protected:
  void SetUp() override {
    testing::write_time_table(folder_ / "out/all.csv", ",");
    write_text(
        folder_ / "mine.toml",
        "spacing = 0.01\ngravity = 9.81\nposition_array = [\"px\", \"py\"]\n"
        "type_array = \"kind\"\nfluid_type = 1\nlength_unit = \"mm\"\n"
        "velocity_array = [\"vx\", \"vy\"]\npressure_array = \"p\"\npressure_unit = \"kPa\"\n");
  }

  /// Runs surge-compare in the folder; both streams in text_.
  int run(const std::string& arguments) {
    const std::string command = "cd " + folder_.path().string() + " && " + tests::programs() +
                                "/surge-compare " + arguments + " 2>&1";
    text_.clear();
    FILE* pipe = popen(command.c_str(), "r");
    std::array<char, 512> buffer{};
    while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe)) text_ += buffer.data();
    const int status = pclose(pipe);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  int bless(const std::string& more = "") {
    return run(
        "check out/all.csv --baseline b.json --map mine.toml --tank-width 0.4 "
        "--strip-height 0.03 --bless --reason good " +
        more);
  }
  [[nodiscard]] std::string text_of(const std::string& name) const {
    std::ifstream in(folder_ / name);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  [[nodiscard]] std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path()))
      if (entry.is_regular_file()) names.insert(entry.path().filename().string());
    return names;
  }

  TemporaryFolder folder_;
  std::string text_;
};

TEST_F(Check, NeedsNoOptionsBecauseTheBaselineHasThem) {
  ASSERT_EQ(
      bless("--observable front --observable gauge:x=0.05 --observable pressure:x=0.005,y=0.1"), 0)
      << text_;
  EXPECT_THAT(text_, HasSubstr("window: 0 s to 0.1 s: the last frame with a front"));
  ASSERT_EQ(run("check out/all.csv --baseline b.json"), 0) << text_;
  EXPECT_THAT(text_, HasSubstr("all.csv: passed (0 of"));
  EXPECT_THAT(text_, HasSubstr("gauge:x=0.05"));
  // Another place on the disk, another name.
  fs::rename(folder_ / "out", folder_ / "later");
  ASSERT_EQ(run("check later/all.csv --baseline b.json"), 0) << text_;
}

TEST_F(Check, FailsWithTheWorstPointAndTellsAService) {
  ASSERT_EQ(bless(), 0) << text_;
  write_faster(folder_ / "out/all.csv");
  const auto before = files();
  ASSERT_EQ(run("check out/all.csv --baseline b.json --junit-xml c.xml "
                "--json c.json --figure c.svg"),
            2)
      << text_;
  EXPECT_THAT(text_, HasSubstr("failed (1 of"));
  auto after = files();
  for (const char* name : {"c.xml", "c.json", "c.svg"}) EXPECT_EQ(after.erase(name), 1U) << name;
  EXPECT_EQ(after, before);
  EXPECT_THAT(text_of("c.svg"), HasSubstr("<svg"));
  EXPECT_THAT(text_of("c.xml"), HasSubstr("failures=\"1\" errors=\"0\""));
  EXPECT_THAT(text_of("c.xml"), HasSubstr("<failure message=\"found 0.12, expected 0.11 within"));
  const auto json = nlohmann::json::parse(text_of("c.json"));
  EXPECT_EQ(json["passed"], false);
  const auto front =
      std::find_if(json["findings"].begin(), json["findings"].end(),
                   [](const auto& finding) { return finding["quantity"] == "front"; });
  ASSERT_NE(front, json["findings"].end());
  EXPECT_NEAR(front->at("deviation").get<double>(), 0.01, 1e-9);
}

TEST_F(Check, OtherReadingFails) {
  ASSERT_EQ(bless(), 0) << text_;
  EXPECT_EQ(run("check out/all.csv --baseline b.json --dimension 3"), 2) << text_;
  EXPECT_THAT(text_, HasSubstr("read as dimension"));
}

TEST_F(Check, WhatCannotBeReadIsAnErrorToAServiceToo) {
  ASSERT_EQ(bless(), 0) << text_;
  fs::resize_file(folder_ / "out/all.csv", 3000);
  EXPECT_EQ(run("check out/all.csv --baseline b.json --junit-xml c.xml --json c.json"), 1);
  EXPECT_THAT(text_of("c.xml"), HasSubstr("errors=\"1\""));
  EXPECT_EQ(nlohmann::json::parse(text_of("c.json"))["passed"], false);
  fs::remove(folder_ / "out/all.csv");
  EXPECT_EQ(run("check out/all.csv --baseline b.json"), 1);
  EXPECT_EQ(run("check out/all.csv --baseline b.json --skip-missing --junit-xml c.xml"), 77);
  EXPECT_THAT(text_of("c.xml"), HasSubstr("<skipped/>"));
  EXPECT_EQ(run("check out/all.csv --baseline nothing.json"), 1);
}

TEST_F(Check, JsonOnTheStandardOutputStandsAlone) {
  ASSERT_EQ(bless(), 0) << text_;
  ASSERT_EQ(run("check out/all.csv --baseline b.json --json - 2>/dev/null"), 0);
  EXPECT_EQ(nlohmann::json::parse(text_)["passed"], true);
  ASSERT_EQ(run("front out/all.csv --map mine.toml --strip-height 0.03 --json - 2>/dev/null"), 0);
  EXPECT_NEAR(nlohmann::json::parse(text_)["Z_over_L"][5].get<double>(), 1.5, 1e-9);
  ASSERT_EQ(run("front out/all.csv --map mine.toml --strip-height 0.03 --out - 2>/dev/null"), 0);
  EXPECT_THAT(text_, HasSubstr("time_s,T,Z_over_L\n0,0,1\n"));
}

TEST_F(Check, BlessingAgainKeepsWhatIsNotSaidAnew) {
  ASSERT_EQ(bless("--observable centre-of-mass --absolute centre-of-mass.x=0.002 --until 0.06 "
                  "--because splash"),
            0)
      << text_;
  ASSERT_EQ(run("check out/all.csv --baseline b.json --bless --reason again"), 0) << text_;
  const auto baseline = nlohmann::json::parse(text_of("b.json"));
  EXPECT_EQ(baseline["measured"]["reason"], "again");
  EXPECT_EQ(baseline["window"]["until_s"], 0.06);
  EXPECT_EQ(baseline["window"]["because"], "splash");
  EXPECT_EQ(baseline["curves"][0]["series"], "centre-of-mass.x");
  EXPECT_EQ(baseline["curves"][0]["tolerance"]["absolute"], 0.002);
  EXPECT_EQ(baseline["read"]["length_unit"][0], "mm");
}

TEST_F(Check, BlessNeedsAReasonAndAWindow) {
  EXPECT_EQ(run("check out/all.csv --baseline b.json --map mine.toml --bless"), 1);
  EXPECT_THAT(text_, HasSubstr("--reason"));
  EXPECT_EQ(run("check out/all.csv --baseline b.json --map mine.toml --bless --reason good"), 1);
  EXPECT_THAT(text_, HasSubstr("expected --until SECONDS"));
  EXPECT_FALSE(fs::exists(folder_ / "b.json"));
}

TEST_F(Check, ParticlesThatAreLostOrNotFiniteFail) {
  ASSERT_EQ(bless("--absolute 1"), 0) << text_;
  const std::string table = text_of("out/all.csv");
  // The second line is a particle of the water at time 0, the last of the tank's wall.
  const auto second = table.find('\n') + 1, third = table.find('\n', second) + 1;
  std::string damaged = table;
  damaged.replace(second, third - second, "");
  write_text(folder_ / "out/all.csv", damaged);
  EXPECT_EQ(run("check out/all.csv --baseline b.json"), 2) << text_;
  EXPECT_THAT(text_, ::testing::ContainsRegex("fluid_particles +failed"));
  damaged = table;
  damaged.insert(damaged.find(',', damaged.find("\n0.02") + 1) + 1, "nan,0,0,0,1,1\n0.02,");
  write_text(folder_ / "out/all.csv", damaged);
  EXPECT_EQ(run("check out/all.csv --baseline b.json"), 2) << text_;
  EXPECT_THAT(text_, ::testing::ContainsRegex("nonfinite +failed"));
}

TEST_F(Check, OneTimeIsNoCurve) {
  const std::string table = text_of("out/all.csv");
  write_text(folder_ / "out/all.csv", table.substr(0, table.find("\n0.02") + 1));
  EXPECT_EQ(bless(), 1);
  EXPECT_THAT(text_, HasSubstr("two times at least"));
}

TEST_F(Check, OptionGivenTwiceIsAnError) {
  EXPECT_EQ(run("front out/all.csv --map mine.toml --out x.csv --spacing 0.01 --spacing 0.01"), 1);
  EXPECT_THAT(text_, HasSubstr("--spacing: found twice for"));
  EXPECT_EQ(run("front out/all.csv --map mine.toml --out x.csv --out y.csv"), 1);
  EXPECT_EQ(bless("--absolute front=0.1 --absolute front=0.2"), 1);
  EXPECT_THAT(text_, HasSubstr("found two values of front"));
}

TEST_F(Check, UnknownSubcommandIsNamedWithTheNearest) {
  EXPECT_EQ(run("metrcs a --reference b"), 1);
  EXPECT_THAT(text_, HasSubstr("unknown subcommand \"metrcs\", did you mean metrics?"));
  EXPECT_EQ(run("frobnicate"), 1);
  EXPECT_THAT(text_, Not(HasSubstr("did you mean")));
  EXPECT_THAT(text_, HasSubstr("front, measure, metrics, check"));
}

TEST_F(Check, LimitsHoldAgainstALiveReference) {
  testing::write_time_table(folder_ / "ref/all2.csv", ",");
  const std::string metrics =
      "metrics out/all.csv --reference ref/all2.csv --strip-height 0.03 --map all.csv=mine.toml "
      "--map all2.csv=mine.toml --out m.json ";
  EXPECT_EQ(run(metrics + "--max-rms 0.001 --max-difference 0.001 --junit-xml m.xml"), 0) << text_;
  EXPECT_THAT(text_of("m.xml"), HasSubstr("tests=\"2\" failures=\"0\""));
  write_faster(folder_ / "ref/all2.csv");
  EXPECT_EQ(run(metrics + "--max-rms 0.05"), 2) << text_;
  EXPECT_THAT(text_, HasSubstr("all.csv: failed (1 of 1 quantities outside all2.csv)"));
  EXPECT_EQ(run(metrics + "--max-rms 0.3 --max-bias all.csv=0.3 --max-difference 0.11"), 0)
      << text_;
  EXPECT_EQ(run(metrics + "--max-rms nobody=0.3"), 1);
  EXPECT_THAT(text_, HasSubstr("found no such run"));
  EXPECT_EQ(run("metrics ref/all2.csv --reference ref/all2.csv --map mine.toml "
                "--strip-height 0.03 --out m.json --max-rms 1"),
            1);
  EXPECT_THAT(text_, HasSubstr("nothing was compared"));
}

}  // namespace
}  // namespace surge::compare
