#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cstdlib>

#include "tests/compare/foreign_hdf5_writers.hpp"
#include "tests/compare/foreign_text_writers.hpp"
#include "tests/compare/foreign_vtk_writers.hpp"
#include "tests/places.hpp"

namespace surge::compare {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;
using testing::write_text;

/// Blocks of a language in a page of the documentation.
std::vector<std::string> blocks(const std::string& page, const std::string& language) {
  std::vector<std::string> found;
  const std::string fence = "```" + language + "\n";
  for (auto at = page.find(fence); at != std::string::npos; at = page.find(fence, at)) {
    at += fence.size();
    found.push_back(page.substr(at, page.find("```", at) - at));
  }
  return found;
}

std::string page() {
  std::ifstream in(tests::sources() + "/docs/foreign-codes.md");
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The folder that the page speaks of.
class Walkthrough : public ::testing::Test {
 protected:
  void SetUp() override {
    testing::write_dualsphysics_vtk(folder_ / "dualsphysics/CaseDambreak_out/vtks");
    testing::write_dualsphysics_run(folder_ / "dualsphysics/CaseDambreak_out");
    testing::write_pysph(folder_ / "pysph/dam_break_2d_output");
    testing::write_sphinxsys(folder_ / "sphinxsys/output", false);
    testing::write_trixi(folder_ / "trixi/out");
    testing::write_mps_basic(folder_ / "mps-basic/vtu");
    testing::write_openmps(folder_ / "openmps/result");
    testing::write_gpusph(folder_ / "gpusph/data");
    testing::write_aquagpusph(folder_ / "aquagpusph");
    testing::write_gadget(folder_ / "swift/snapshots", testing::GadgetUnits{0.01, 0.001, 0.5});
    testing::write_time_table(folder_ / "mine/all.csv", ",");
    for (const std::string& text : blocks(page(), "toml"))
      write_text(folder_ / text.substr(2, text.find('\n') - 2), text);
  }

  /// Runs commands as a user does, in the folder; the exit code.
  [[nodiscard]] int run(const std::string& commands) const {
    write_text(folder_ / "commands.sh", "set -e\nPATH=" + tests::programs() + ":$PATH\ncd " +
                                            folder_.path().string() + "\n" + commands);
    const int status = std::system(("sh " + (folder_ / "commands.sh").string() + " > " +
                                    (folder_ / "output.txt").string() + " 2>&1")
                                       .c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  [[nodiscard]] std::string text_of(const std::string& name) const {
    std::ifstream in(folder_ / name);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  TemporaryFolder folder_;
};

TEST_F(Walkthrough, EveryCommandOfThePageGivesTheKnownFront) {
  const auto commands = blocks(page(), "sh");
  ASSERT_GE(commands.size(), 8U);
  for (const std::string& command : commands) {
    ASSERT_EQ(run(command), 0) << command << text_of("output.txt");
    const auto out = command.find("--out ") + 6;
    const std::string name = command.substr(out, command.find_first_of(" \n", out) - out);
    const std::string result = text_of(name);
    std::filesystem::remove(folder_ / name);
    if (!name.ends_with(".csv")) continue;
    // Six frames, 0.1 L from one to the next.
    double time = 0.0, dimensionless = 0.0, front = 0.0;
    std::istringstream lines(result);
    std::string line;
    std::getline(lines, line);
    for (int i = 0; i < 6; ++i) {
      ASSERT_TRUE(std::getline(lines, line)) << command;
      ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf", &time, &dimensionless, &front), 3);
      EXPECT_NEAR(time, 0.02 * i, 2e-6);
      EXPECT_NEAR(front, 1.0 + 0.1 * i, 1e-5) << command;
    }
  }
}

TEST_F(Walkthrough, OptionOfSeveralSourcesNeedsAName) {
  const std::string metrics =
      "surge-compare metrics trixi/out --reference sphinxsys/output --strip-height 0.03 --out "
      "m.json "
      "--gravity 9.81";
  EXPECT_EQ(run(metrics), 1);
  EXPECT_THAT(text_of("output.txt"), HasSubstr("expected NAME=VALUE with one of out, output"));
  EXPECT_EQ(run(metrics + " --spacing nobody=0.01"), 1);
}

TEST_F(Walkthrough, ObservablesOfSeveralSourcesHaveTheirOwnOptions) {
  const std::string measure =
      "surge-compare measure mine/all.csv trixi/out --reference mine/all.csv --strip-height 0.03 "
      "--observable front --observable centre-of-mass --csv m.csv --map all.csv=mine.toml ";
  ASSERT_EQ(run(measure + "--spacing out=0.01 --gravity out=9.81"), 0) << text_of("output.txt");
  const std::string found = text_of("m.csv");
  for (const char* source : {"all.csv", "out"}) {
    const auto last = found.find(std::string(source) + ",front,m,0.1,");
    ASSERT_NE(last, std::string::npos) << found;
    EXPECT_NEAR(std::stod(found.substr(found.find(",,", last) + 2)), 0.15, 1e-6);
  }
  EXPECT_EQ(run(measure + "--spacing out=0.01"), 1);
  EXPECT_THAT(text_of("output.txt"), HasSubstr("--gravity"));
}

TEST_F(Walkthrough, FactThatAMapStatesCanBeChangedBesideIt) {
  EXPECT_EQ(run("surge-compare front mine/all.csv --out x.csv --map mine.toml --spacing 0.03"), 1);
  EXPECT_THAT(text_of("output.txt"), HasSubstr("spacing 0.03 m"));
}

}  // namespace
}  // namespace surge::compare
