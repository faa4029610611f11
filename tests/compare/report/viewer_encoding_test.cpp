#include "compare/report/viewer_encoding.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/compare/viewer_reader.hpp"

namespace surge::compare {
namespace {

using nlohmann::json;
using testing::unpacked_lines;
using testing::unpacked_particles;
using testing::unpacked_squares;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::string base64_of(const std::string& text) {
  return base64(std::vector<std::uint8_t>(text.begin(), text.end()));
}

TEST(ViewerPack, Base64IsThatOfRfc4648) {
  EXPECT_EQ(base64_of(""), "");
  EXPECT_EQ(base64_of("f"), "Zg==");
  EXPECT_EQ(base64_of("fo"), "Zm8=");
  EXPECT_EQ(base64_of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64(std::vector<std::uint8_t>{0xff, 0xfe}), "//4=");
}

TEST(ViewerPack, NumbersComeBack) {
  ByteStream stream;
  const std::vector<std::int32_t> numbers{
      0, -1, 1, 63, -64, 64, 8191, -8192, 1 << 29, -(1 << 29), 1 << 30, -(1 << 30) - 5};
  for (const std::int32_t n : numbers) stream.signed_number(n);
  stream.number(0xffffffffU);
  testing::StreamReader reader(stream.bytes());
  for (const std::int32_t n : numbers) EXPECT_EQ(reader.signed_number(), n);
  EXPECT_EQ(reader.number(), 0xffffffffU);
  EXPECT_TRUE(reader.at_end());
  EXPECT_EQ(steps_of(0.26, 0.1), 3);
  EXPECT_EQ(steps_of(-1e300, 0.1), -(1 << 29));
  EXPECT_EQ(steps_of(nan, 0.1), 0);
  EXPECT_EQ(quantise_unit(0.5), 128);
  EXPECT_EQ(quantise_unit(-2.0), 0);
  EXPECT_EQ(quantise_unit(3.0), 255);
  EXPECT_EQ(quantise_unit(nan), 0);
}

/// Particles of a lattice that fly apart, in another order at each time; at the fifth time every
/// seventh is gone, and at the sixth eleven new ones are there.
std::vector<std::vector<WaterPatch>> flight(int dimension, double spacing) {
  std::mt19937 random(7);
  std::vector<std::vector<WaterPatch>> frames;
  for (int t = 0; t < 8; ++t) {
    std::vector<WaterPatch> frame;
    const int depth = dimension == 3 ? 4 : 1;
    for (int n = 0; n < 12 * 12 * depth; ++n) {
      if (t >= 4 && n % 7 == 0) continue;
      const double x = (n % 12 + 0.5) * spacing, y = (n / 12 % 12 + 0.5) * spacing;
      const double z = (n / 144 + 0.5) * spacing, grown = 1.0 + 0.03 * t + 0.004 * t * t;
      frame.push_back({x * grown, y / grown, 0.5 * spacing, 0.5 * spacing, 0.1 * t + 0.3 * y, 1.0,
                       x, dimension == 3 ? z * grown : 0.0, 0.0});
    }
    for (int n = 0; t >= 5 && n < 11; ++n)
      frame.push_back({3.0 + n * spacing, -0.4, 0.5 * spacing, 0.5 * spacing, 0.9, 1.0, 0.2,
                       dimension == 3 ? 0.3 : 0.0});
    std::shuffle(frame.begin(), frame.end(), random);
    frames.push_back(frame);
  }
  return frames;
}

/// Whether each patch has one particle of the frame to itself, no farther than the bound.
void expect_same(const std::vector<WaterPatch>& patches,
                 const std::vector<std::array<double, 5>>& frame, double bound) {
  ASSERT_EQ(frame.size(), patches.size());
  std::vector<bool> used(frame.size(), false);
  for (const WaterPatch& patch : patches) {
    bool found = false;
    for (std::size_t i = 0; i < frame.size() && !found; ++i) {
      const auto& [x, y, z, pressure, speed] = frame[i];
      found = !used[i] && std::abs(x - patch.x) <= bound && std::abs(y - patch.y) <= bound &&
              std::abs(z - patch.z) <= bound &&
              std::abs(pressure - std::clamp(patch.pressure, 0.0, 1.0)) <= 0.5001 / 255.0 &&
              std::abs(speed - std::clamp(patch.speed, 0.0, 1.0)) <= 0.5001 / 255.0;
      if (found) used[i] = true;
    }
    ASSERT_TRUE(found) << patch.x << ' ' << patch.y << ' ' << patch.z;
  }
}

TEST(ViewerEncoding, ParticlesComeBackWithinA128thOfTheirSpacing) {
  const double spacing = 0.0345;
  for (const int dimension : {2, 3}) {
    ParticleTrack track(spacing, dimension);
    const auto frames = flight(dimension, spacing);
    for (const auto& frame : frames) track.add(frame);
    track.add({});
    track.add(frames[0]);
    const json packed = track.encoded();
    EXPECT_DOUBLE_EQ(packed["step"].get<double>(), spacing / 64.0);
    const auto found = unpacked_particles(packed);
    ASSERT_EQ(found.size(), frames.size() + 2);
    const double bound = spacing / 128.0 * (1.0 + 1e-9);
    for (std::size_t t = 0; t < frames.size(); ++t) expect_same(frames[t], found[t], bound);
    EXPECT_TRUE(found[8].empty());
    expect_same(frames[0], found[9], bound);
    EXPECT_DOUBLE_EQ(track.span()[0], 0.5 * spacing);
    EXPECT_DOUBLE_EQ(track.span()[1], 3.0 + 10 * spacing);
    for (testing::StreamReader& stream : testing::streams_of(packed)) EXPECT_FALSE(stream.at_end());
  }
}

TEST(ViewerEncoding, SmoothFlowTakesFewBytesInWhateverOrderItsParticlesAre) {
  ParticleTrack track(0.0345, 2);
  std::mt19937 random(3);
  constexpr int times = 60, many = 900;
  for (int t = 0; t < times; ++t) {
    std::vector<WaterPatch> frame;
    for (int n = 0; n < many; ++n) {
      const double x = (n % 30 + 0.5) * 0.0345, y = (n / 30 + 0.5) * 0.0345;
      const double grown = 1.0 + 0.002 * t * t;
      frame.push_back({x * grown, y / grown, 0.01725, 0.01725, 0.9 - 0.8 * y, 1.0, 0.01 * t * x});
    }
    std::shuffle(frame.begin(), frame.end(), random);
    track.add(frame);
  }
  // Six bytes a particle and time, and a third more in base64, is what it takes without all this.
  EXPECT_LT(double(track.encoded()["data"].get<std::string>().size()), 2.0 * times * many);
}

TEST(ViewerEncoding, WhatIsNotKnownIsSaid) {
  ParticleTrack track(0.1, 2);
  track.add({{1.0, 2.0, 0.05, 0.05, nan, 1.0, 0.25}});
  track.add({{1.0, 2.0, 0.05, 0.05, 0.5, 1.0, nan}});
  EXPECT_EQ(track.encoded()["known"],
            (json{{"pressure", true}, {"speed", false}, {"start", false}}));
}

TEST(ViewerEncoding, SquaresOfAMeshComeBackAsTheyAre) {
  for (const int dimension : {2, 3}) {
    MeshTrack track(0.05, dimension);
    const double z = dimension == 3 ? 0.325 : 0.0, half_z = dimension == 3 ? 0.025 : 0.0;
    track.add({{-0.025, 0.975, 0.025, 0.025, 0.5, 1.0, 0.25, z, half_z},
               {3.025, 0.525, 0.025, 0.025, 2.0, 0.4, 0.0, z, half_z}});
    track.add({});
    track.add({{1.975, 1.025, 0.025, 0.025, 0.0, 0.001, 1.0, z + 0.35, half_z}});
    const json packed = track.encoded();
    const auto found = unpacked_squares(packed);
    ASSERT_EQ(found.size(), 3U);
    ASSERT_EQ(found[0].size(), 2U);
    EXPECT_TRUE(found[1].empty());
    ASSERT_EQ(found[2].size(), 1U);
    EXPECT_NEAR(found[0][1][0], -0.025, 1e-12);
    EXPECT_NEAR(found[0][0][0], 3.025, 1e-12);
    EXPECT_NEAR(found[0][0][1], 0.525, 1e-12);
    EXPECT_NEAR(found[0][0][3], 0.4, 1e-12);
    EXPECT_NEAR(found[0][0][4], 1.0, 1e-12);
    EXPECT_NEAR(found[2][0][0], 1.975, 1e-12);
    if (dimension == 3) {
      EXPECT_NEAR(found[0][0][2], 0.325, 1e-12);
      EXPECT_NEAR(found[2][0][2], 0.675, 1e-12);
    }
    EXPECT_GT(found[2][0][3], 0.0);  // what holds water at all is not lost
  }
}

TEST(ViewerEncoding, LinesComeBackPieceByPiece) {
  SurfaceTrack track(0.1);
  const std::vector<Segment> ring{{0.0, 0.0, 1.0, 0.0}, {1.0, 1.0, 1.0, 0.0}, {0.0, 1.0, 1.0, 1.0},
                                  {0.0, 1.0, 0.0, 0.0}, {2.0, 0.0, 2.5, 0.3}, {1.0, 1.0, 1.0, 1.0}};
  track.add(ring);
  track.add({});
  track.add({{-0.5, 0.25, 0.75, 0.5}});
  const json packed = track.encoded();
  const auto found = unpacked_lines(packed);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].size(), 5U);  // without that of no length
  EXPECT_TRUE(found[1].empty());
  const double bound = 0.1 / 128.0 * (1.0 + 1e-9);
  for (std::size_t k = 0; k < 5; ++k) {
    const auto same = [&](const std::array<double, 4>& piece) {
      const auto& s = ring[k];
      const auto near = [&](double a, double b) { return std::abs(a - b) <= bound; };
      return (near(piece[0], s.x0) && near(piece[1], s.y0) && near(piece[2], s.x1) &&
              near(piece[3], s.y1)) ||
             (near(piece[0], s.x1) && near(piece[1], s.y1) && near(piece[2], s.x0) &&
              near(piece[3], s.y0));
    };
    EXPECT_EQ(std::count_if(found[0].begin(), found[0].end(), same), 1) << k;
  }
  EXPECT_NEAR(std::min(found[2][0][0], found[2][0][2]), -0.5, bound);
  EXPECT_NEAR(std::max(found[2][0][0], found[2][0][2]), 0.75, bound);
  // A closed line is one line of its corners and the first again.
  EXPECT_EQ(packed["sizes"][1], packed["sizes"][2]);
}

TEST(ViewerEncoding, CoarseSquaresKeepTheWater) {
  std::vector<WaterPatch> cells;
  for (int i = 0; i < 9; ++i) {
    for (int j = 0; j < 7; ++j) {
      cells.push_back({(i + 0.5) / 30, (j + 0.5) / 30, 0.5 / 30, 0.5 / 30, 0.1 * j, 0.9, 0.3});
    }
  }
  double water = 0.0, weight = 0.0;
  for (const auto& square : coarse_cells(cells, 0.1)) {
    water += square.fraction * 0.01;
    weight += square.fraction * 0.01 * square.pressure;
    EXPECT_NEAR(square.speed, 0.3, 1e-12);
    EXPECT_LE(square.fraction, 0.9 + 1e-12);
  }
  EXPECT_NEAR(water, 63 * 0.9 / 900, 1e-12);
  EXPECT_NEAR(weight, 63 * 0.9 / 900 * 0.3, 1e-12);
  // Squares of the mesh's own size are its cells, whatever the rounding of their edges.
  EXPECT_EQ(coarse_cells(cells, 1.0 / 30).size(), cells.size());
}

TEST(ViewerEncoding, CoarseCubesKeepTheWater) {
  std::vector<WaterPatch> cells;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 5; ++k)
        cells.push_back({(i + 0.5) / 30, (j + 0.5) / 30, 0.5 / 30, 0.5 / 30, 0.5, 0.9, 0.3,
                         (k + 0.5) / 30, 0.5 / 30});
  double water = 0.0;
  for (const auto& cube : coarse_cells(cells, 0.1)) {
    water += cube.fraction * 1e-3;
    EXPECT_NEAR(cube.pressure, 0.5, 1e-12);
    EXPECT_NEAR(cube.half_z, 0.05, 1e-15);
  }
  EXPECT_NEAR(water, 120 * 0.9 / 27000, 1e-12);
}

}  // namespace
}  // namespace surge::compare
