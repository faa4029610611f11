#include "particle/core/neighbour_lanes.hpp"

#include <gtest/gtest.h>

namespace surge {
namespace {

TEST(Lanes, AreRoundedToSinglePrecision) {
  const Simd x([](auto lane) { return 1.0 / 3.0 + lane; });
  const Simd rounded = in_single_precision(x);
  for (std::size_t k = 0; k < simd_width; ++k) {
    const double exact = 1.0 / 3.0 + static_cast<double>(k);
    EXPECT_EQ(rounded[k], static_cast<double>(static_cast<float>(exact)));
    EXPECT_NE(rounded[k], exact);
  }
}

// Any number of neighbours, in order, the nearest images of a period; what is left over is the
// particle itself.
TEST(Lanes, AreTheNeighboursInOrderAndTheParticleItself) {
  const std::size_t n = 3 * simd_width + 1;
  std::array<Field, 2> x{Field(n), Field(n)};
  for (std::size_t k = 0; k < n; ++k) {
    x[0][k] = static_cast<double>(k);
    x[1][k] = 0.5 * static_cast<double>(k);
  }
  const double period = 2.0 * static_cast<double>(n);
  const Displacement<2> plain(x, {});
  const Displacement<2> wrapped(x, {{0.0, 0.0}, {period, 2.0}});
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, simd_width, n - 2}) {
    std::vector<std::uint32_t> neighbours(count);
    for (std::size_t k = 0; k < count; ++k) neighbours[k] = static_cast<std::uint32_t>(n - 1 - k);
    for (const auto* displacement : {&plain, &wrapped}) {
      std::size_t seen = 0;
      for_each_lanes<2>(0, neighbours, *displacement,
                        [&](const LaneIndices& j, const std::array<Simd, 2>& d, Simd r2) {
                          for (std::size_t k = 0; k < simd_width; ++k, ++seen) {
                            ASSERT_EQ(j[k], seen < count ? neighbours[seen] : 0u);
                            const Vec<2> exact = (*displacement)(0, j[k]);
                            ASSERT_EQ(d[0][k], exact[0]);
                            ASSERT_EQ(d[1][k], exact[1]);
                            ASSERT_DOUBLE_EQ(r2[k], squared_norm<2>(exact));
                            ASSERT_EQ(lanes_of(j, [](std::size_t p) { return 2.0 * double(p); })[k],
                                      2.0 * j[k]);
                            ASSERT_EQ(pick(x[1], j)[k], x[1][j[k]]);
                          }
                        });
      EXPECT_EQ(seen, (count + simd_width - 1) / simd_width * simd_width);
    }
  }
}

}  // namespace
}  // namespace surge
