// What a case says of motions, gauges and forces: read, checked, written.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "particle/case/case_checks.hpp"
#include "particle/case/case_file.hpp"
#include "particle/case/case_json.hpp"
#include "tests/case/case_fixture.hpp"
#include "tests/places.hpp"

namespace surge {
namespace {

using testing::HasSubstr;

/// The tables of the small case that say what flows, and more of them.
std::string with(const std::string& more) {
  const std::string text = test::small_case;
  return text.substr(0, text.find("[search]")) + more;
}

/// A case by itself, whatever programs can compute of it.
Case read(const std::string& text, const std::string& source = "small.toml",
          const std::vector<std::string>& overrides = {}) {
  const TomlTable root = TomlTable::parse(text, source, overrides);
  Case c = read_case(root);
  root.finish();
  check_case(c, root);
  return c;
}

std::string refusal(const std::string& more, const std::vector<std::string>& overrides = {}) {
  try {
    static_cast<void>(read(with(more), "small.toml", overrides));
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

void expect_written_reads_back(const Case& c) {
  EXPECT_EQ(to_json(read(to_toml(c), "written.toml")), to_json(c)) << to_toml(c);
}

constexpr const char* sway = R"([motion]
kind = "translation"
direction = [3.0, 4.0]
law = "harmonic"
amplitude = 0.032
period = 1.3
ramp = 2.6
)";

constexpr const char* gate = R"([[moving_wall]]
name = "gate"
lower = [0.04, 0.0]
upper = [0.08, 0.12]
direction = [0.0, 1.0]
law = "constant"
speed = 1.5
start = 0.1
stop = 0.2
)";

TEST(MovingCase, TankSwaysAlongAUnitVector) {
  const Case c = read(with(sway));
  EXPECT_EQ(c.motion.kind, TankMotion::Kind::translation);
  EXPECT_DOUBLE_EQ(c.motion.direction[0], 0.6);
  EXPECT_DOUBLE_EQ(c.motion.direction[1], 0.8);
  EXPECT_EQ(c.motion.law.kind, ScalarMotion::Kind::harmonic);
  EXPECT_EQ(c.motion.law.amplitude, 0.032);
  EXPECT_EQ(c.motion.law.ramp, 2.6);
  EXPECT_EQ(c.motion.law.phase, 0.0);
  expect_written_reads_back(c);
}

TEST(MovingCase, TankTurnsAboutItsCentreInTwoAndThreeDimensions) {
  const std::string turn = R"([motion]
kind = "rotation"
centre = [0.06, 0.0]
law = "constant"
speed = 0.5
stop = 3.0
)";
  const Case plane = read(with(turn));
  EXPECT_EQ(plane.motion.direction, (Point{0.0, 0.0, 1.0}));
  EXPECT_EQ(plane.motion.centre, (Point{0.06, 0.0, 0.0}));
  expect_written_reads_back(plane);
  EXPECT_THAT(refusal(turn + "direction = [1.0, 0.0]\n"), HasSubstr("unknown key \"direction\""));

  // A case that turns its periodic axis is refused before it runs.
  EXPECT_THAT(refusal(turn, {"tank.periodic=[\"x\"]"}), HasSubstr("x in a tank that turns"));

  const std::vector<std::string> solid{
      "dimension=3",
      "fluid.gravity=[0,0,-9.81]",
      "tank.lower=[0,0,0]",
      "tank.upper=[0.12,0.12,0.12]",
      "block.0.lower=[0,0,0]",
      "block.0.upper=[0.04,0.08,0.04]",
      "block.0.velocity=[0,0,0]",
      "obstacle.0.lower=[0.1,0,0]",
      "obstacle.0.upper=[0.12,0.02,0.12]",
      "probe.0.position=[0.005,0.005,0.005]",
      "motion.centre=[0,0,0.06]",
      "motion.direction=[0,-2,0]",
  };
  const Case space = read(with(turn), "small.toml", solid);
  EXPECT_EQ(space.motion.direction, (Point{0.0, -1.0, 0.0}));
  expect_written_reads_back(space);
}

TEST(MovingCase, GateIsLifted) {
  const Case c = read(with(gate));
  ASSERT_EQ(c.moving_walls.size(), 1U);
  EXPECT_EQ(c.moving_walls[0].name, "gate");
  EXPECT_EQ(c.moving_walls[0].box.upper, (Point{0.08, 0.12, 0.0}));
  EXPECT_DOUBLE_EQ(motion_at(c.moving_walls[0].law, 1.0).displacement, 0.15);
  expect_written_reads_back(c);
}

TEST(MovingCase, TableIsReadBesideTheCaseAndWrittenIntoIt) {
  const tests::TemporaryFolder folder;
  std::ofstream(folder.path() / "sway.csv")
      << "time,displacement\n0,0\n 0.5 , 0.02\r\n\n1e0,-0.01\n";
  const std::string motion = R"([motion]
kind = "translation"
direction = [1.0, 0.0]
law = "table"
quantity = "displacement"
table = "sway.csv"
)";
  const std::string source = (folder.path() / "case.toml").string();
  const Case c = read(with(motion), source);
  EXPECT_EQ(c.motion.law.samples,
            (std::vector<std::array<double, 2>>{{0.0, 0.0}, {0.5, 0.02}, {1.0, -0.01}}));
  expect_written_reads_back(c);  // without the file

  const auto refused = [&](const std::string& table) -> std::string {
    std::ofstream(folder.path() / "sway.csv") << table;
    try {
      static_cast<void>(read(with(motion), source));
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(refused("0,0\n1,1\n1,2\n"), HasSubstr("found time 1 s after 1 s"));
  EXPECT_THAT(refused("0,0\n1,nan\n"), HasSubstr("sway.csv:2: found \"1,nan\""));
  EXPECT_THAT(refused("0,0\n1,2,3\n"), HasSubstr("sway.csv:2: found \"1,2,3\""));
  EXPECT_THAT(refused("0,0\n1\033[31m,2\n"), HasSubstr("found \"1?[31m,2\""));
  EXPECT_THAT(refused("0,0\n"), HasSubstr("found 1 samples, expected at least two"));
  EXPECT_THAT(refused("0,0\n1," + std::string(5000, '1')), HasSubstr("too long"));
  std::filesystem::remove(folder.path() / "sway.csv");
  std::filesystem::create_directory(folder.path() / "sway.csv");
  EXPECT_THROW(static_cast<void>(read(with(motion), source)), Error);
}

// The largest table that is read fits, with all its digits, into the case file that a run writes.
TEST(MovingCase, TheLargestTableIsWrittenAndRead) {
  Case c = read(with(sway));
  c.motion.law = {};
  c.motion.law.kind = ScalarMotion::Kind::table;
  for (int k = 0; k < 50000; ++k)
    c.motion.law.samples.push_back({(k + 1) * 1.2345678901234567e-05, -1.2345678901234567e-05 / 3});
  EXPECT_EQ(read(to_toml(c), "written.toml").motion.law.samples, c.motion.law.samples);
}

TEST(MovingCase, BadMotionsAreRefused) {
  const std::string at = "small.toml";
  EXPECT_THAT(refusal(sway, {"motion.direction=[0,0]"}), HasSubstr("found a zero vector"));
  EXPECT_THAT(refusal(sway, {"motion.period=0"}), HasSubstr("found 0, expected a number above 0"));
  EXPECT_THAT(refusal(sway, {"motion.amplitude=inf"}), HasSubstr("found inf"));
  EXPECT_THAT(refusal(sway, {"motion.law=sine"}), HasSubstr("expected one of \"harmonic\""));
  EXPECT_THAT(refusal(sway, {"motion.speed=1"}), HasSubstr("unknown key \"speed\""));
  EXPECT_THAT(refusal(gate, {"moving_wall.0.stop=0.1"}), HasSubstr("a number above 0.1"));
  EXPECT_THAT(refusal(gate, {"moving_wall.0.name=x-"}), HasSubstr("a name that is no side"));
  EXPECT_THAT(refusal(gate, {"moving_wall.0.upper=[0.085,0.12]"}), HasSubstr("4.5 spacings"));
  EXPECT_THAT(refusal(gate, {"moving_wall.0.lower=[0.03,0.0]"}),
              HasSubstr("found an overlap with moving_wall.0"));
  EXPECT_THAT(refusal(gate, {"moving_wall.0.upper=[0.13,0.12]"}),
              HasSubstr("the moving_wall inside the tank"));
  EXPECT_THAT(refusal(std::string(gate) + gate), HasSubstr("\"gate\" twice"));
  EXPECT_THAT(refusal("[motion]\nkind=\"translation\"\ndirection=[1,0]\nlaw=\"table\"\n"
                      "quantity=\"acceleration\"\n"),
              HasSubstr("either table = "));
}

TEST(MovingCase, ProgramsThatCannotComputeAMotionRefuseIt) {
  for (const std::string method : {"mps", "sph"}) {
    const Method& entry = method_named(method);
    for (const auto& [supported, tables, key] :
         {std::tuple{entry.supports.tank_motion, sway, "motion: found a tank that moves"},
          std::tuple{entry.supports.moving_walls, gate, "moving_wall: found walls that move"}}) {
      const std::string text = with(tables) + "[method]\nname = \"" + method + "\"\n";
      if (supported) {
        EXPECT_NO_THROW(static_cast<void>(parse_computation(text, "small.toml")));
        continue;
      }
      try {
        static_cast<void>(parse_computation(text, "small.toml"));
        ADD_FAILURE() << "accepted";
      } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr(key));
        EXPECT_THAT(error.what(), HasSubstr("none with " + method));
      }
    }
  }
}

TEST(Instruments, GaugesForcesAndDiametersAreRead) {
  const Case c = read(with(std::string(gate) + R"([[gauge]]
name = "H1"
position = [0.03, 0.0]
[[force]]
on = "x+"
[[force]]
name = "step"
on = "obstacle.0"
[[force]]
on = "gate"
)"),
                      "small.toml", {"probe.0.diameter=0.02"});
  EXPECT_EQ(c.probes[0].diameter, 0.02);
  ASSERT_EQ(c.gauges.size(), 1U);
  EXPECT_EQ(c.gauges[0].position, (Point{0.03, 0.0, 0.0}));
  ASSERT_EQ(c.forces.size(), 3U);
  EXPECT_EQ(c.forces[0].name, "x+");
  EXPECT_EQ(c.forces[0].index, 1U);
  EXPECT_EQ(c.forces[1].of, ForceSurface::Of::obstacle);
  EXPECT_EQ(c.forces[1].name, "step");
  EXPECT_EQ(c.forces[2].of, ForceSurface::Of::moving_wall);
  expect_written_reads_back(c);
}

TEST(Instruments, BadPlacesAndSurfacesAreRefused) {
  const auto gauge = [](const std::string& position) {
    return "[[gauge]]\nname = \"H\"\nposition = " + position + "\n";
  };
  const auto force = [](const std::string& on) { return "[[force]]\non = \"" + on + "\"\n"; };
  EXPECT_EQ(refusal(gauge("[0.03, -7.0]")), "accepted");  // its height does not matter
  EXPECT_EQ(refusal(gauge("[0.11, 0.0]")), "accepted");   // above the step
  EXPECT_THAT(refusal(gauge("[0.13, 0.0]")), HasSubstr("gauge.0.position: found x = 0.13"));
  EXPECT_THAT(refusal(gauge("[0.11, 0.0]"), {"obstacle.0.upper=[0.12,0.12]"}),
              HasSubstr("gauge.0.position: found a place inside obstacle.0"));
  EXPECT_THAT(refusal(gauge("[0.03, 0.0]"), {"fluid.gravity=[0,0]"}),
              HasSubstr("a gauge without gravity"));
  EXPECT_THAT(refusal(gauge("[0.03, 0.0]") + gauge("[0.04, 0.0]")), HasSubstr("\"H\" twice"));
  // With gravity along x it stands along x.
  EXPECT_THAT(refusal(gauge("[0.03, 0.2]"), {"fluid.gravity=[9.81,0]"}), HasSubstr("y = 0.2"));
  EXPECT_THAT(refusal(force("y+")), HasSubstr("force.0.on: found side y+ which is open"));
  EXPECT_THAT(refusal(force("x-"), {"tank.periodic=[\"x\"]"}), HasSubstr("on a periodic axis"));
  EXPECT_THAT(refusal(force("obstacle.1")), HasSubstr("found \"obstacle.1\""));
  EXPECT_THAT(refusal(force("z+")), HasSubstr("found \"z+\""));
  EXPECT_THAT(refusal(force("piston")), HasSubstr("or the name of a moving wall"));
  EXPECT_THAT(refusal("", {"probe.0.diameter=-1"}), HasSubstr("expected a number of at least 0"));
  EXPECT_THAT(refusal("", {"probe.0.diameter=1e300"}),
              HasSubstr("at most the tank's smallest size"));
}

}  // namespace
}  // namespace surge
