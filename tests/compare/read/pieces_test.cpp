#include "compare/read/pieces.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <set>

#include "tests/compare/synthetic.hpp"

namespace surge::compare {
namespace {

/// Pieces by the definition: spread from particle to particle over all pairs.
std::vector<std::set<std::size_t>> all_pairs_pieces(const std::vector<Vec3>& x, double distance) {
  std::vector<int> label(x.size(), -1);
  std::vector<std::set<std::size_t>> pieces;
  for (std::size_t seed = 0; seed < x.size(); ++seed) {
    if (label[seed] >= 0) continue;
    std::vector<std::size_t> open{seed};
    label[seed] = static_cast<int>(pieces.size());
    pieces.emplace_back();
    while (!open.empty()) {
      const std::size_t i = open.back();
      open.pop_back();
      pieces.back().insert(i);
      for (std::size_t j = 0; j < x.size(); ++j) {
        const double r = std::hypot(x[i][0] - x[j][0], x[i][1] - x[j][1], x[i][2] - x[j][2]);
        if (label[j] >= 0 || r > distance) continue;
        label[j] = label[seed];
        open.push_back(j);
      }
    }
  }
  return pieces;
}

TEST(Pieces, AgreeWithAllPairs) {
  std::mt19937 random(7);
  for (const double depth : {0.0, 1.0}) {
    std::uniform_real_distribution<double> place(-1.0, 1.0);
    std::vector<Vec3> x(300);
    for (Vec3& p : x) p = {place(random), place(random), depth * place(random)};
    const double distance = depth == 0.0 ? 0.09 : 0.2;
    const Pieces pieces = connected_pieces(x, distance);
    std::vector<std::set<std::size_t>> found(pieces.sizes.size());
    for (std::size_t i = 0; i < x.size(); ++i) found.at(pieces.piece_of[i]).insert(i);
    const auto expected = all_pairs_pieces(x, distance);
    ASSERT_GT(expected.size(), 5U);
    EXPECT_EQ((std::set(found.begin(), found.end())), (std::set(expected.begin(), expected.end())));
    EXPECT_TRUE(std::is_sorted(pieces.sizes.rbegin(), pieces.sizes.rend()));
    EXPECT_EQ(std::accumulate(pieces.sizes.begin(), pieces.sizes.end(), std::size_t{0}), x.size());
  }
}

TEST(Pieces, LatticeOfExactlyTheLinkingDistanceIsOnePiece) {
  EXPECT_EQ(
      connected_pieces(testing::lattice({0, 0, 0}, {0.145, 0.29, 0}, 0.005), 0.005).sizes.size(),
      1U);
}

TEST(Pieces, ParticleFarAwayIsItsOwnPiece) {
  const Pieces pieces = connected_pieces({{0, 0, 0}, {0.01, 0, 0}, {1e300, -1e300, 0}}, 0.02);
  EXPECT_EQ(pieces.sizes, (std::vector<std::size_t>{2, 1}));
}

}  // namespace
}  // namespace surge::compare
