#include "particle/case/case_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "particle/case/case_checks.hpp"
#include "particle/case/case_json.hpp"
#include "particle/core/initial_particles.hpp"
#include "particle/core/particle_count.hpp"
#include "particle/io/computation.hpp"
#include "particle/io/presets.hpp"
#include "particle/mps/options.hpp"
#include "particle/sph/options.hpp"
#include "tests/case/case_fixture.hpp"
#include "tests/places.hpp"

namespace surge {
namespace {

using test::make_case;
using test::make_computation;

Case read_flow(const std::filesystem::path& file, std::span<const std::string> overrides = {}) {
  return read_computation(file, overrides).flow;
}

TEST(CaseFile, HoldsWhatTheFileSays) {
  const Computation computation = make_computation();
  const Case& c = computation.flow;
  EXPECT_EQ(c.title, "Small");
  EXPECT_EQ(c.dimension, 2);
  EXPECT_EQ(c.gravity, (Point{0.0, -9.81, 0.0}));
  ASSERT_TRUE(c.has_tank);
  EXPECT_EQ(c.tank.open, (std::array<bool, 6>{false, false, false, true, false, false}));
  EXPECT_EQ(c.tank.periodic, (std::array<bool, 3>{}));
  ASSERT_EQ(c.blocks.size(), 1U);
  EXPECT_EQ(c.blocks[0].box.upper, (Point{0.04, 0.08, 0.0}));
  ASSERT_EQ(c.obstacles.size(), 1U);
  ASSERT_EQ(c.probes.size(), 1U);
  EXPECT_EQ(c.probes[0].name, "corner");
  EXPECT_DOUBLE_EQ(c.time.initial_step, 1e-4);
  EXPECT_EQ(computation.search, Search::cell_grid);
  EXPECT_EQ(computation.method_name(), "sph");
  EXPECT_DOUBLE_EQ(count_particles(c, 0).fluid, 32.0);
}

TEST(CaseFile, DamBreakIsThePapers) {
  const Computation computation =
      read_computation(tests::sources() + "/particle/cases/dam_break.toml");
  const Case& c = computation.flow;
  EXPECT_DOUBLE_EQ(count_particles(c, 0).fluid, 1682.0);                       // Sec. 5.1
  EXPECT_DOUBLE_EQ(c.blocks[0].box.upper[1], 2.0 * c.blocks[0].box.upper[0]);  // 2L high, Fig. 6
  EXPECT_DOUBLE_EQ(c.tank.box.upper[0], 4.0 * c.blocks[0].box.upper[0]);       // 4L wide, Fig. 6
  EXPECT_DOUBLE_EQ(c.time.courant, 0.2);                                       // Eq. (25)
  EXPECT_DOUBLE_EQ(c.time.maximum_step, 1e-3);
  EXPECT_EQ(computation.method_name(), "mps");
}

TEST(CaseFile, DamBreakDividesAtEveryResolutionOfTheStudy) {
  for (const int per_length : {20, 29, 40, 58, 80, 116}) {
    const std::string spacing = "resolution.spacing=" + number_text(0.145 / per_length);
    const std::vector<std::string> overrides{spacing};
    const Case c = read_flow(tests::sources() + "/particle/cases/dam_break.toml", overrides);
    EXPECT_DOUBLE_EQ(count_particles(c, 0).fluid, 2.0 * per_length * per_length);
  }
}

TEST(CaseFile, EveryCaseOfTheProductIsGoodWithEveryMethod) {
  int count = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(tests::sources() + "/particle/cases")) {
    if (entry.path().extension() != ".toml") continue;
    for (const Method& method : methods()) {
      const std::string name(method.name);
      const std::vector<std::string> overrides{
          "method.name=" + name, "method.preset=" + preset_names(method.name).front()};
      EXPECT_NO_THROW(static_cast<void>(read_computation(entry.path(), overrides))) << entry.path();
    }
    ++count;
  }
  EXPECT_GE(count, 4);
}

TEST(CaseFile, VelocityGradientAndBallsInThreeDimensions) {
  const Case c = parse_computation(R"(title = "Drop"
dimension = 3
[fluid]
density = 1000.0
gravity = [0, 0, 0]
[[block]]
shape = "ball"
lower = [-1, -1, -1]
upper = [1, 1, 1]
velocity_gradient = [[-100, 0, 0], [0, 100, 0], [0, 0, 0]]
[resolution]
spacing = 0.1
[time]
end = 0.01
[output]
interval = 0.001
[method]
name = "sph"
)",
                                   "drop.toml")
                     .flow;
  EXPECT_FALSE(c.has_tank);
  EXPECT_EQ(c.blocks[0].shape, FluidBlock::Shape::ball);
  EXPECT_DOUBLE_EQ(c.blocks[0].velocity_gradient[0][0], -100.0);
  EXPECT_DOUBLE_EQ(c.blocks[0].velocity_gradient[1][1], 100.0);
  EXPECT_EQ(count_particles(c, 0).fluid, static_cast<double>(initial_particles<3>(c, 0).size()));
  EXPECT_NEAR(count_particles(c, 0).fluid, 4188.8, 40.0);  // 4/3 pi 10^3
}

TEST(CaseFile, WrittenAsTomlItReadsBackTheSame) {
  Computation c = make_computation({"sph.kernel=wendland_c2", "sph.h_over_l0=1.3333333333333333",
                                    "block.0.velocity=[0.1, -0.2]", "method.preset=paper-bare",
                                    "title=\"with \\\"quotes\\\" and \\\\\"",
                                    "search.neighbours=all_pairs", "tank.wall=no-slip"});
  c.flow.blocks[0].velocity_gradient[0][1] = 0.3;
  const Computation again = parse_computation(to_toml(c), "written.toml");
  EXPECT_EQ(to_json(again), to_json(c));
  EXPECT_EQ(to_json(again)["method"]["parameters"]["kernel"], "wendland_c2");

  const Computation three =
      read_computation(tests::sources() + "/particle/cases/dam_break_3d.toml");
  EXPECT_EQ(to_json(parse_computation(to_toml(three), "written.toml")), to_json(three));
}

TEST(Presets, ExtendEachOtherAndTheCaseComesLast) {
  const auto bare = make_computation({"method.preset=paper-bare"}).params<sph::Params>();
  EXPECT_EQ(bare.acoustic_courant, 0.0);
  EXPECT_EQ(bare.negative_pressure, sph::NegativePressure::keep);
  const auto paper = make_computation().params<sph::Params>();
  EXPECT_GT(paper.acoustic_courant, 0.0);  // whatever value the preset is tuned to
  EXPECT_EQ(paper.negative_pressure, sph::NegativePressure::clip);
  EXPECT_EQ(paper.gamma, bare.gamma);  // inherited
  const auto own = make_computation({"sph.acoustic_courant=0.1"}).params<sph::Params>();
  EXPECT_EQ(own.acoustic_courant, 0.1);
  EXPECT_EQ(own.negative_pressure, sph::NegativePressure::clip);
}

TEST(Presets, AllHaveADescriptionAndKnownOptions) {
  ASSERT_THAT(preset_names("mps"), testing::Contains("paper"));
  ASSERT_THAT(preset_names("sph"), testing::IsSupersetOf({"paper", "paper-bare"}));
  for (const PresetFile& file : preset_files()) EXPECT_FALSE(preset_description(file).empty());
  for (const char* method : {"mps", "sph"}) {
    for (const std::string& name : preset_names(method)) {
      EXPECT_NO_THROW(make_case({std::string("method.name=") + method, "method.preset=" + name}));
    }
  }
}

TEST(Options, HaveNamesForEveryEnumeratorAndNoNameTwice) {
  std::vector<std::string> names;
  const auto collect = [&](const char* name, const auto& member, Bounds, const char* description) {
    names.emplace_back(name);
    EXPECT_FALSE(std::string_view(description).empty());
    if constexpr (std::is_enum_v<std::remove_cvref_t<decltype(member)>>) {
      EXPECT_NE(name_of(member), "?");
    }
  };
  const sph::Params sph;
  visit_options(sph, collect);
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
}

TEST(CaseFile, ObstaclesNeedNoTank) {
  const std::string text = test::case_without_tank();
  const auto make = [&](const std::vector<std::string>& overrides) {
    return parse_computation(text, "open.toml", overrides);
  };
  // Anywhere, as there is no tank to be inside of.
  const Computation computation =
      make({"obstacle.0.lower=[-0.05,-0.04]", "obstacle.0.upper=[0.09,0.0]"});
  const Case& c = computation.flow;
  EXPECT_FALSE(c.has_tank);
  ASSERT_EQ(c.obstacles.size(), 1U);
  EXPECT_EQ(c.obstacles[0].lower, (Point{-0.05, -0.04, 0.0}));
  EXPECT_EQ(to_json(parse_computation(to_toml(computation), "again.toml")), to_json(computation));
  // Its cells are the only wall particles there are: 14 x 4 less the 12 x 2 below one layer.
  const auto particles = initial_particles<2>(c, 1);
  EXPECT_EQ(particles.size(), 32U + 14U * 4U - 24U);
  EXPECT_EQ(std::count(particles.type.begin(), particles.type.end(), ParticleType::fluid), 32);

  const auto refused = [&](const std::vector<std::string>& overrides) -> std::string {
    try {
      static_cast<void>(make(overrides));
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(refused({"obstacle.0.lower=[0.105,0.0]"}),
              testing::StartsWith("open.toml:14: obstacle.0.upper: found x from 0.105 to 0.12"));
  EXPECT_THAT(refused({"obstacle.0.lower=[0.03,0.0]"}),
              testing::StartsWith("open.toml:9: block.0.lower: found an overlap with obstacle.0"));
}

struct Bad {
  const char* name;
  std::string overrides;  ///< separated by blanks
  const char* message;
};

class BadCase : public testing::TestWithParam<Bad> {};

TEST_P(BadCase, IsRefusedWithPlaceFoundAndExpected) {
  std::vector<std::string> overrides;
  std::istringstream stream(GetParam().overrides);
  for (std::string word; stream >> word;) overrides.push_back(word);
  try {
    make_case(overrides);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::StartsWith(GetParam().message));
    EXPECT_THAT(error.what(), testing::HasSubstr(", expected "));
    EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Entries, BadCase,
    testing::Values(
        Bad{"dimension", "dimension=4", "--set dimension=4: found 4, expected a whole number"},
        Bad{"density", "fluid.density=0",
            "--set fluid.density=0: found 0, expected a number above 0"},
        Bad{"viscosity", "fluid.kinematic_viscosity=-1e-6",
            "--set fluid.kinematic_viscosity=-1e-6: found -1e-06"},
        Bad{"gravity", "fluid.gravity=[0,0,-9.81]",
            "--set fluid.gravity=[0,0,-9.81]: found a list of 3"},
        Bad{"spacing", "resolution.spacing=0.011",
            "small.toml:9: tank.upper: found x from 0 to 0.12, 10.909091 spacings"},
        Bad{"spacing_and_block", "block.0.upper=[0.045,0.08]",
            "--set block.0.upper=[0.045,0.08]: found x from 0 to 0.045, 4.5 spacings"},
        Bad{"spacing_and_obstacle", "obstacle.0.lower=[0.105,0.0]",
            "small.toml:20: obstacle.0.upper: found x from 0.105 to 0.12, 1.5 spacings"},
        Bad{"negative_spacing", "resolution.spacing=-0.01",
            "--set resolution.spacing=-0.01: found -0.01"},
        Bad{"tiny_spacing", "resolution.spacing=1e-7",
            "--set resolution.spacing=1e-7: found a size of 3.2e+11 fluid and "},
        Bad{"block_wider_than_tank", "block.0.upper=[0.2,0.08]",
            "--set block.0.upper=[0.2,0.08]: found x = 0.2, expected the block inside the tank, "
            "which ends at 0.12"},
        Bad{"block_below_tank", "block.0.lower=[0,-0.01]",
            "--set block.0.lower=[0,-0.01]: found y = -0.01"},
        Bad{"obstacle_outside", "obstacle.0.upper=[0.13,0.02]",
            "--set obstacle.0.upper=[0.13,0.02]: found x = 0.13"},
        Bad{"upside_down", "block.0.lower=[0,0.09]",
            "small.toml:16: block.0.upper: found y from 0.09 to 0.08"},
        Bad{"overlap", "block.0.upper=[0.11,0.08]",
            "small.toml:15: block.0.lower: found an overlap with obstacle.0"},
        Bad{"ball_without_equal_sides", "block.0.shape=ball",
            "small.toml:16: block.0.upper: found sides of 0.04 and 0.08 m"},
        Bad{"shape", "block.0.shape=cylinder", "--set block.0.shape=cylinder: found \"cylinder\""},
        Bad{"side", "tank.open=[\"up\"]",
            "--set tank.open=[\"up\"]: found \"up\", expected names out of"},
        Bad{"side_of_3d", "tank.open=[\"z+\"]", "--set tank.open=[\"z+\"]: found \"z+\""},
        Bad{"open_and_periodic", "tank.periodic=[\"y\"]", "small.toml:10: tank.open: found \"y+\""},
        Bad{"short_period", "tank.periodic=[\"x\"] sph.h_over_l0=2.1",
            "--set tank.periodic=[\"x\"]: found a period of 0.12 m in x"},
        Bad{"wave_on_a_ball",
            "block.0.shape=ball block.0.upper=[0.04,0.04] "
            "block.0.wave_amplitude=0.001",
            "--set block.0.wave_amplitude=0.001: found 0.001 m on a ball"},
        Bad{"wave_without_gravity",
            "fluid.gravity=[0,0] fluid.reference_speed=1 "
            "block.0.wave_amplitude=0.001",
            "--set block.0.wave_amplitude=0.001: found 0.001 m without gravity"},
        Bad{"no_speed", "fluid.gravity=[0,0]",
            "small.toml:3: fluid.reference_speed: found a case without a speed"},
        Bad{"wall", "tank.wall=sticky", "--set tank.wall=sticky: found \"sticky\""},
        Bad{"probe_outside", "probe.0.position=[0.5,0]",
            "--set probe.0.position=[0.5,0]: found x = 0.5"},
        Bad{"probe_name", "probe.0.name=\"a,b\"", "--set probe.0.name=\"a,b\": found \"a,b\""},
        Bad{"probe_name_for_terminals", "probe.0.name=\"a\\u001b[31m\"",
            "--set probe.0.name=\"a\\u001b[31m\": found \"a\x1b[31m\", expected a name without "
            "commas, quotes and control characters"},
        Bad{"end", "time.end=0", "--set time.end=0: found 0, expected a number above 0"},
        Bad{"infinite_end", "time.end=inf",
            "--set time.end=inf: found inf, expected a number above 0"},
        Bad{"initial_step", "time.initial_step=0.01",
            "--set time.initial_step=0.01: found 0.01, expected at most"},
        Bad{"courant", "time.courant=1.5", "--set time.courant=1.5: found 1.5"},
        Bad{"interval", "output.interval=0", "--set output.interval=0: found 0"},
        Bad{"search", "search.neighbours=tree", "--set search.neighbours=tree: found \"tree\""},
        Bad{"method", "method.name=vof",
            "--set method.name=vof: found \"vof\", expected one of \"mps\", \"sph\""},
        Bad{"preset", "method.preset=best",
            "--set method.preset=best: found \"best\", expected one of \"delta-plus\", "
            "\"paper-bare\", \"paper\""},
        Bad{"beta_zero", "mps.beta=0",
            "--set mps.beta=0: found 0, expected a number between 0 and 1"},
        Bad{"beta_one", "method.name=mps mps.beta=1",
            "--set mps.beta=1: found 1, expected a number between 0 and 1"},
        Bad{"option", "sph.epsilon=0.5", "--set sph.epsilon=0.5: found unknown key \"epsilon\""},
        Bad{"option_of_wrong_type", "sph.gamma=seven",
            "--set sph.gamma=seven: found \"seven\", expected a number"},
        Bad{"enumerator", "sph.kernel=gauss",
            "--set sph.kernel=gauss: found \"gauss\", expected one of"},
        Bad{"whole_number", "mps.ppe_max_iterations=1.5",
            "--set mps.ppe_max_iterations=1.5: found 1.5"},
        Bad{"unknown_table", "tnk.lower=[0,0]",
            "--set tnk.lower=[0,0]: found unknown key \"tnk\", expected \"tank\""},
        Bad{"unknown_key", "time.stop=1", "--set time.stop=1: found unknown key \"stop\""}),
    [](const auto& bad) { return bad.param.name; });

TEST(BadCaseFile, MissingEntriesNameTheTablesLine) {
  for (const auto& [line, message] : std::vector<std::pair<std::string, std::string>>{
           {"density = 1000.0\n",
            "small.toml:3: fluid.density: found no such key, expected a number"},
           {"spacing = 0.01\n", "small.toml:24: resolution.spacing: found no such key"},
           {"name = \"sph\"\n", "small.toml:35: method.name: found no such key, expected one of"},
           {"title = \"Small\"\n", "small.toml:1: title: found no such key, expected a text"}}) {
    std::string text = test::small_case;
    text.replace(text.find(line), line.size(), "\n");
    try {
      static_cast<void>(parse_computation(text, "small.toml"));
      ADD_FAILURE() << "accepted without " << line;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::StartsWith(message));
    }
  }
}

TEST(CaseFile, OverrideOfAnotherMethodIsRefused) {
  EXPECT_NO_THROW(make_case({"sph.h_over_l0=1.3"}));
  try {
    (void)make_case({"method.name=mps", "sph.h_over_l0=1.3"});
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(),
                testing::StartsWith("--set sph.h_over_l0=1.3: found an option of sph"));
  }
}

TEST(CaseFile, PeriodOfTwoRadiiIsEnough) {
  EXPECT_NO_THROW(make_case({"tank.periodic=[\"x\"]", "sph.h_over_l0=2.0",
                             "obstacle.0.lower=[0.0,0.1]", "obstacle.0.upper=[0.12,0.12]"}));
}

}  // namespace
}  // namespace surge
