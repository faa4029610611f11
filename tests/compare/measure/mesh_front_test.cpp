#include <gtest/gtest.h>
#include <vtkAppendFilter.h>

#include "tests/compare/synthetic.hpp"

namespace surge::compare {
namespace {

using testing::box_mesh;

constexpr double h = 0.01;  // cell size, m

/// A tank 1 m x 0.4 m, a single slab of cells, whose floor is at zero.
MeshFrame slab(const std::function<double(Vec3)>& water, int samples = 1) {
  return box_mesh({1.0, 0.4, 0.01}, {100, 40, 1}, water, samples);
}

double edge_of(const MeshFrame& frame, const FrontOptions& options = {},
               const Physics& physics = testing::dam_break()) {
  FrameView view = testing::view_of(frame, physics, h);
  return leading_edge(view, options).value();
}

/// Water where `inside` says so, mean over each cell.
auto region(const std::function<bool(double, double)>& inside) {
  return [inside](Vec3 x) { return inside(x[0], x[1]) ? 1.0 : 0.0; };
}

TEST(MeshFront, OfAnUprightSharpFrontIsExact) {
  for (const double edge : {0.2, 0.2013, 0.205, 0.2075, 0.2099}) {
    const MeshFrame frame =
        slab([edge](Vec3 x) { return std::clamp((edge - x[0]) / h + 0.5, 0.0, 1.0); });
    EXPECT_NEAR(edge_of(frame), edge, 1e-12);
    // Between cell centres instead of corners the same front would be off by up to 9 % of a cell.
  }
}

TEST(MeshFront, OfALinearFieldIsExact) {
  // alpha = 0.5 along x + 0.5 y = 0.3; the strip of 0.015 m reaches from the floor, where corner
  // values are those of the lowest cell centres: x = 0.3 - 0.5 h/2.
  const MeshFrame frame = slab([](Vec3 x) { return 0.5 + 3.0 * (0.3 - x[0] - 0.5 * x[1]); });
  EXPECT_NEAR(edge_of(frame), 0.3 - 0.25 * h, 1e-12);
}

TEST(MeshFront, OfAnOverhangIsTakenAtTheTopOfTheStrip) {
  // The front leans forward: x = 0.3 + y. At the strip's top, between rows of corners.
  const MeshFrame frame = slab([](Vec3 x) { return 0.5 + 3.0 * (0.3 + x[1] - x[0]); });
  FrontOptions options;
  options.strip_height = Metres(0.0137);
  EXPECT_NEAR(edge_of(frame, options), 0.3137, 1e-6);
}

TEST(MeshFront, FollowsTheStripThatItIsAskedFor) {
  // One object, one mesh, other strips: what was found for the one before must not be used.
  const MeshFrame frame = slab([](Vec3 x) { return 0.5 + 3.0 * (0.3 + x[1] - x[0]); });
  FrameView view = testing::view_of(frame, testing::dam_break(), h);
  FrontOptions options;
  for (const double height : {0.0137, 0.1037, 0.0537}) {
    options.strip_height = Metres(height);
    EXPECT_NEAR(leading_edge(view, options).value(), 0.3 + height, 1e-6);
  }
}

TEST(MeshFront, OfAThinWedgeIsNearItsTip) {
  // A tongue that thins to nothing at x = 0.6: half of the lowest cell is full at 0.6 - h/2 /
  // slope.
  const double slope = 0.05;
  const MeshFrame frame =
      slab(region([&](double x, double y) { return y < slope * (0.6 - x); }), 40);
  EXPECT_NEAR(edge_of(frame), 0.6 - 0.5 * h / slope, 0.1 * h / slope);
}

bool column(double x, double y) {
  return x < 0.2 && y < 0.3;
}

TEST(MeshFront, LeavesDropsAheadAndWaterAboveTheStripOut) {
  const MeshFrame drop = slab(
      region([](double x, double y) { return column(x, y) || (x > 0.5 && x < 0.53 && y < 0.03); }));
  EXPECT_NEAR(edge_of(drop), 0.2, 1e-12);
  FrontOptions raw;
  raw.raw_maximum = true;
  EXPECT_NEAR(edge_of(drop, raw), 0.53, 1e-12);
  const MeshFrame shelf = slab(
      region([](double x, double y) { return column(x, y) || (x < 0.4 && y > 0.1 && y < 0.15); }));
  EXPECT_NEAR(edge_of(shelf), 0.2, 1e-12);
  const MeshFrame tongue =
      slab(region([](double x, double y) { return column(x, y) || (x < 0.4 && y < 0.05); }));
  EXPECT_NEAR(edge_of(tongue), 0.4, 1e-12);
}

TEST(MeshFront, TakesTheBodyWithTheMostWater) {
  // A fine spray of drops has more corners than its water is worth, but never more water.
  const MeshFrame frame = slab(
      [](Vec3 x) { return column(x[0], x[1]) ? 1.0 : (x[0] > 0.3 ? 0.5001 * (x[1] < 0.1) : 0.0); });
  EXPECT_NEAR(edge_of(frame), 0.2, 1e-12);
}

TEST(MeshFront, ReachesTheFarWall) {
  EXPECT_NEAR(edge_of(slab([](Vec3 x) { return x[1] < 0.05 ? 1.0 : 0.0; })), 1.0, 1e-12);
}

TEST(MeshFront, WorksInThreeDimensionsWithZUp) {
  Physics physics = testing::dam_break();
  physics.gravity = {0, 0, -9.81};
  const MeshFrame frame = box_mesh({1.0, 0.1, 0.3}, {100, 10, 30}, [](Vec3 x) {
    const bool tongue = x[2] < 0.03 && x[1] > 0.03 && x[1] < 0.07 && x[0] < 0.45;
    const bool shelf = x[2] > 0.1 && x[2] < 0.15 && x[0] < 0.8;
    return x[0] < 0.2 || tongue || shelf ? 1.0 : 0.0;
  });
  EXPECT_NEAR(edge_of(frame, {}, physics), 0.45, 1e-12);
}

/// The same mesh in two halves whose shared corners are doubled, as a decomposed case is read.
TEST(MeshFront, CrossesTheBorderBetweenProcessors) {
  const auto water = [](Vec3 x) {
    return x[1] < 0.1 ? std::clamp((0.617 - x[0]) / h + 0.5, 0.0, 1.0) : 0.0;
  };
  const MeshFrame left = box_mesh({0.5, 0.4, 0.01}, {50, 40, 1}, water);
  MeshFrame right = box_mesh({0.5, 0.4, 0.01}, {50, 40, 1}, [&](Vec3 x) {
    return water({x[0] + 0.5, x[1], x[2]});
  });
  vtkPoints* points = right.grid->GetPoints();
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i) {
    std::array<double, 3> x{};
    points->GetPoint(i, x.data());
    points->SetPoint(i, x[0] + 0.5, x[1], x[2]);
  }
  vtkNew<vtkAppendFilter> both;
  both->SetOutputPointsPrecision(1);
  both->AddInputData(left.grid);
  both->AddInputData(right.grid);
  both->Update();
  MeshFrame frame = left;
  frame.grid = both->GetOutput();
  frame.alpha.insert(frame.alpha.end(), right.alpha.begin(), right.alpha.end());
  EXPECT_NEAR(edge_of(frame), 0.617, 1e-12);
}

TEST(MeshFront, NoticesAnotherMesh) {
  const auto water = [](Vec3 x) { return x[0] < 0.2 ? 1.0 : 0.0; };
  FrameView view = testing::view_of(slab(water), testing::dam_break(), h);
  EXPECT_NEAR(leading_edge(view, {}).value(), 0.2, 1e-12);
  view.show(box_mesh({2.0, 0.4, 0.01}, {100, 40, 1}, water));
  EXPECT_NEAR(leading_edge(view, {}).value(), 0.2, 1e-12);
}

TEST(MeshFront, IsEmptyWithoutWater) {
  FrameView view = testing::view_of(slab([](Vec3) { return 0.0; }), testing::dam_break(), h);
  EXPECT_FALSE(leading_edge(view, {}).has_value());
}

}  // namespace
}  // namespace surge::compare
