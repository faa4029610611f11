#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compare/figures/solids.hpp"
#include "compare/measure/open_space.hpp"
#include "compare/read/readers.hpp"
#include "compare/study/identity.hpp"
#include "tests/case/surface_fixture.hpp"
#include "tests/compare/synthetic.hpp"

namespace surge::compare {
namespace {

using testing::dam_break;
using testing::dam_break_manifest;
using ::testing::HasSubstr;

SolidBody wedge_body(double top) {
  return SolidBody(
      ClosedSurface::polygon({{0.29, 0.0, 0.0}, {0.435, 0.0, 0.0}, {0.435, top, 0.0}}));
}

nlohmann::json with_wedge() {
  nlohmann::json manifest = dam_break_manifest();
  manifest["case"]["obstacles"] = nlohmann::json::parse(
      R"([{"lower": [0.29, 0, 0], "upper": [0.435, 0.145, 0],
           "polygon": [[0.29, 0], [0.435, 0], [0.435, 0.145]]}])");
  return manifest;
}

TEST(SolidBodies, PolygonOfAManifestIsRead) {
  compare::Run run;
  apply_case(run, with_wedge().at("case"), "manifest.json: case");
  const SolidBody& wedge = run.physics.obstacles->at(0);
  ASSERT_TRUE(wedge.surface);
  EXPECT_NEAR(wedge.surface->volume(), 0.5 * 0.145 * 0.145, 1e-15);
  EXPECT_EQ(wedge.upper[1], 0.145);
}

TEST(SolidBodies, PolygonThatIsNoneIsRefusedWithItsPlace) {
  nlohmann::json manifest = with_wedge();
  manifest["case"]["obstacles"][0]["polygon"] = {{0, 0}, {1, 1}};
  compare::Run run;
  EXPECT_THAT(
      testing::error_of([&] { apply_case(run, manifest.at("case"), "manifest.json: case"); }),
      HasSubstr("obstacles.0: found 2 corners"));
}

TEST(SolidBodies, AnotherShapeIsAnotherCase) {
  const auto differences = [](const SolidBody& x, const SolidBody& y) {
    Physics a = dam_break(), b = dam_break();
    a.obstacles->push_back(x);
    b.obstacles->push_back(y);
    return compare_physics(a, "a", b, "b").differences.size();
  };
  const SolidBody wedge = wedge_body(0.145);
  EXPECT_EQ(differences(wedge, wedge_body(0.145)), 0U);
  EXPECT_EQ(differences(wedge, wedge_body(0.14)), 1U);
  EXPECT_EQ(differences(wedge, SolidBody(wedge.lower, wedge.upper)), 1U);
}

TEST(SolidBodies, RunWithTheBoxAroundAPolygonIsAnotherRun) {
  const nlohmann::json expected = with_wedge().at("case");
  nlohmann::json found = expected;
  EXPECT_FALSE(first_difference(found, expected));
  found["obstacles"][0].erase("polygon");
  EXPECT_TRUE(first_difference(found, expected));
  EXPECT_TRUE(first_difference(expected, found));
  found["obstacles"][0]["polygon"] = {{0.29, 0}, {0.435, 0}, {0.435, 0.144}};
  EXPECT_TRUE(first_difference(found, expected));
}

TEST(SolidBodies, OpenSpaceIsWithoutThePolygon) {
  Physics physics = dam_break();
  physics.obstacles->push_back(wedge_body(0.145));
  FrameView view(physics, Metres(0.0145));
  view.show(ParticleFrame{});
  double area = 0.0, cut = 0.0;
  for_each_open(view, 1.0, [&](const Extent& box, double part) {
    const double size = (box.upper[0] - box.lower[0]) * (box.upper[1] - box.lower[1]);
    area += part * size;
    if (part < 0.0) cut -= part * size;
  });
  EXPECT_NEAR(cut, 0.5 * 0.145 * 0.145, 1e-12);
  EXPECT_NEAR(area, 0.58 - cut, 1e-12);
}

TEST(SolidBodies, OutlineIsThePolygonOverTheWidthOfTheColumn) {
  compare::Run run;
  run.physics = dam_break();
  run.physics.obstacles->push_back(wedge_body(0.145));
  const Solids solids = solids_of(run);
  EXPECT_TRUE(solids.obstacles.empty());
  ASSERT_EQ(solids.outlines.size(), 1U);
  const Outline& wedge = solids.outlines[0];
  ASSERT_EQ(wedge.size(), 3U);
  EXPECT_NEAR(wedge[0][0], 2.0, 1e-12);
  EXPECT_NEAR(wedge[2][1], 1.0, 1e-12);
  EXPECT_TRUE(is_near(wedge, 2.8, 0.4, 0.0));
  EXPECT_FALSE(is_near(wedge, 2.2, 0.4, 0.1));
  EXPECT_TRUE(is_near(wedge, 2.2, 0.4, 0.15));
  EXPECT_THAT(outline_object(wedge, "fs solid"),
              HasSubstr("set object polygon from 2,0 to 3,0 to 3,1 to 2,0 fs solid"));
}

TEST(SolidBodies, SectionOfABodyInSpaceIsWhereThePlaneCutsIt) {
  compare::Run run;
  run.physics = dam_break();
  run.physics.dimension = 3;
  run.physics.tank = Extent{{0, 0, 0}, {0.58, 1.16, 0.29}};
  run.physics.obstacles->push_back(
      SolidBody(surge::test::cube_surface({0.29, 0.0, 0.1}, {0.435, 0.145, 0.2})));
  run.physics.obstacles->push_back(
      SolidBody(surge::test::cube_surface({0.29, 0.29, 0.2}, {0.435, 0.435, 0.25})));
  const Solids solids = solids_of(run);
  ASSERT_EQ(solids.surfaces.size(), 2U);
  EXPECT_EQ(solids.surfaces[0].size(), 12U * 9U);
  ASSERT_EQ(solids.outlines.size(), 1U);  // the plane is z = 0.145 m
  double x0 = 9, x1 = -9, y0 = 9, y1 = -9;
  for (const auto& [x, y] : solids.outlines[0]) {
    x0 = std::min(x0, x), x1 = std::max(x1, x);
    y0 = std::min(y0, y), y1 = std::max(y1, y);
  }
  EXPECT_NEAR(x0, 2.0, 1e-12);
  EXPECT_NEAR(x1, 3.0, 1e-12);
  EXPECT_NEAR(y0, 0.0, 1e-12);
  EXPECT_NEAR(y1, 1.0, 1e-12);
  EXPECT_TRUE(is_near(solids.outlines[0], 2.5, 0.5, 0.0));
}

}  // namespace
}  // namespace surge::compare
