#include "compare/figures/style.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "compare/figures/image.hpp"

namespace surge::compare {
namespace {

TEST(Style, MapOfPressureGrowsBrighterSteadily) {
  double last = -1.0;
  for (int i = 0; i <= 100; ++i) {
    const Colour c = viridis(i / 100.0);
    const double brightness = 0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue;
    EXPECT_GE(brightness, last) << i;
    last = brightness;
  }
  EXPECT_EQ(viridis(-3.0).hex(), "#440154");
  EXPECT_EQ(viridis(7.0).hex(), "#fde725");
}

TEST(Style, EverySeriesHasItsOwnLookAndTextsCanBeRead) {
  std::set<std::string> runs, published;
  for (std::size_t i = 0; i < 12; ++i) {
    const LineStyle style = run_style(i);
    EXPECT_TRUE(runs.insert(style.colour.hex() + style.dash).second) << i;
    EXPECT_GE(contrast_on_white(readable(style.colour)), 4.5) << i;
  }
  for (std::size_t i = 0; i < 8; ++i) {
    const LineStyle style = published_style(i);
    EXPECT_TRUE(published.insert(style.colour.hex()).second) << i;
    for (std::size_t k = 0; k < 12; ++k) {
      EXPECT_NE(style.colour.hex(), run_style(k).colour.hex()) << i << ' ' << k;
      EXPECT_NE(style.point, run_style(k).point) << i << ' ' << k;
    }
  }
  // WCAG's own bounds: black 21, white 1.
  EXPECT_NEAR(contrast_on_white({0, 0, 0}), 21.0, 1e-12);
  EXPECT_NEAR(contrast_on_white({255, 255, 255}), 1.0, 1e-12);
}

TEST(Image, DiscCoversItsArea) {
  Image image(0.0, 2.0, 0.0, 1.0, 100.0);
  image.disc(0.7, 0.4, 0.25, {10, 20, 30});
  double covered = 0.0;
  for (int i = 0; i < 200; ++i) {
    for (int j = 0; j < 100; ++j) covered += image.at((i + 0.5) / 100, (j + 0.5) / 100)[3] / 255.0;
  }
  EXPECT_NEAR(covered / 1e4, std::numbers::pi * 0.25 * 0.25, 1e-3);
  EXPECT_EQ(image.at(0.7, 0.4), (std::array<std::uint8_t, 4>{10, 20, 30, 255}));
  EXPECT_EQ(image.at(0.7, 0.9)[3], 0);
}

TEST(Image, AdjoiningRectanglesNeitherOverlapNorLeaveAGap) {
  Image image(0.0, 1.0, 0.0, 1.0, 37.0);
  for (int i = 0; i < 10; ++i) image.rectangle(i / 10.0, (i + 1) / 10.0, 0.0, 1.0, {}, 0.5);
  for (int i = 0; i < 37; ++i) EXPECT_EQ(image.at((i + 0.5) / 37.0, 0.5)[3], 128) << i;
}

}  // namespace
}  // namespace surge::compare
