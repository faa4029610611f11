#include "compare/report/viewer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <regex>

#include "compare/report/report.hpp"
#include "compare/report/viewer_encoding.hpp"
#include "tests/compare/synthetic_study.hpp"

namespace surge::compare {
namespace {

using nlohmann::json;
using testing::read_text;
using testing::SyntheticStudy;

std::string base64_of(const std::string& text) {
  return base64(std::vector<std::uint8_t>(text.begin(), text.end()));
}

/// The decoder of the page, in C++: the inverse of base64().
std::vector<std::uint8_t> bytes_of(const std::string& text) {
  static const std::string letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  unsigned held = 0, bits = 0;
  for (char c : text) {
    if (c == '=') break;
    held = held << 6U | static_cast<unsigned>(letters.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(static_cast<std::uint8_t>(held >> bits & 0xffU));
  }
  return bytes;
}

double word(const json& track, const char* axis, std::size_t index) {
  const auto bytes = bytes_of(track["data"]);
  const auto q = static_cast<std::uint16_t>(bytes.at(2 * index) | bytes.at(2 * index + 1) << 8U);
  return restored(q, {track[axis][0], track[axis][1]});
}

TEST(ViewerEncoding, Base64IsThatOfRfc4648) {
  EXPECT_EQ(base64_of(""), "");
  EXPECT_EQ(base64_of("f"), "Zg==");
  EXPECT_EQ(base64_of("fo"), "Zm8=");
  EXPECT_EQ(base64_of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64(std::vector<std::uint8_t>{0xff, 0xfe}), "//4=");
}

TEST(ViewerEncoding, QuantisedNumbersComeBackWithinHalfAStep) {
  const Interval interval{-0.3, 7.9};
  const double half_step = 0.5 * 8.2 / 65535.0;
  for (int i = 0; i <= 1000; ++i) {
    const double value = -0.3 + 8.2 * i / 1000.0;
    EXPECT_NEAR(restored(quantise(value, interval), interval), value, half_step * (1.0 + 1e-9));
  }
  EXPECT_EQ(restored(quantise(-5.0, interval), interval), -0.3);
  EXPECT_EQ(quantise(99.0, interval), 65535);
  EXPECT_EQ(quantise(std::numeric_limits<double>::quiet_NaN(), interval), 0);
  EXPECT_EQ(quantise_unit(0.5), 128);
  EXPECT_EQ(quantise_unit(-2.0), 0);
  EXPECT_EQ(quantise_unit(3.0), 255);
}

TEST(ViewerEncoding, TracksHoldEachPatchInItsPlanes) {
  WaterTrack water(true);
  water.add({{1.0, 2.0, 0.05, 0.05, 0.5, 1.0, 0.25}, {3.0, 0.5, 0.05, 0.05, 2.0, 0.4, 0.0}});
  water.add({});
  water.add({{2.0, 1.0, 0.05, 0.05, 0.0, 0.2, 1.0}});
  const json track = water.encoded();
  EXPECT_EQ(track["counts"], (json{2, 0, 1}));
  const auto bytes = bytes_of(track["data"]);
  ASSERT_EQ(bytes.size(), 3U * 7U);
  EXPECT_NEAR(word(track, "x", 1), 3.0, 1e-6);
  EXPECT_NEAR(word(track, "x", 2), 2.0, 2.0 / 65535.0);
  EXPECT_NEAR(word(track, "y", 3), 2.0, 1e-6);
  EXPECT_EQ(std::vector<int>(bytes.begin() + 12, bytes.end()),
            (std::vector<int>{128, 255, 0, 64, 0, 255, 255, 102, 51}));

  SurfaceTrack surface;
  surface.add({{0.0, 1.0, 2.0, 3.0}});
  const json line = surface.encoded();
  EXPECT_NEAR(word(line, "x", 0), 0.0, 1e-6);
  EXPECT_NEAR(word(line, "y", 1), 1.0, 1e-6);
  EXPECT_NEAR(word(line, "x", 2), 2.0, 1e-6);
  EXPECT_NEAR(word(line, "y", 3), 3.0, 1e-6);
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

TEST(Viewer, PlanKeepsToItsBudgetAndToTheReference) {
  const SyntheticStudy files;
  const StudyResult study = files.collected();
  const ViewerPlan whole = plan_viewer(study);
  EXPECT_EQ(whole.runs.size(), 3U);
  EXPECT_TRUE(whole.left_out.empty());
  EXPECT_EQ(whole.times.size(), 22U);  // of 23, without the start
  EXPECT_DOUBLE_EQ(whole.times.back().value(), 0.22);
  const ViewerPlan small = plan_viewer(study, 1.0);
  ASSERT_EQ(small.runs.size(), 1U);
  EXPECT_EQ(small.runs[0], &study.reference());
  EXPECT_EQ(small.left_out.size(), 2U);
  EXPECT_LE(small.times.size(), 2U);
}

TEST(Viewer, DataOfThePageAreThoseOfTheMetricsAndOfTheRuns) {
  const SyntheticStudy files;
  const StudyResult study = files.collected();
  std::string warnings;
  const json metrics = write_report(study, files.out(), warnings);
  const std::string page = read_text(files.out() / "index.html");
  const std::string open = "id=\"viewer-data\">";
  const auto begin = page.find(open) + open.size();
  const json data = json::parse(page.substr(begin, page.find("</script>", begin) - begin));
  EXPECT_EQ(data["metrics"], metrics["viewer"]);
  ASSERT_EQ(data["runs"].size(), 3U);
  const auto times = metrics["viewer"]["times_s"].size();
  for (const json& run : data["runs"]) {
    EXPECT_EQ(run["counts"].size(), times);
    std::size_t total = 0;
    for (std::size_t n : run["counts"]) total += n;
    EXPECT_EQ(run["data"].get<std::string>().size(), (6 * total + 2) / 3 * 4);
    // The first particle of the column, in each frame at the same place.
    EXPECT_NEAR(word(run, "x", 0), 0.0025 / 0.145, 1e-4);
  }
  const json& front = metrics["viewer"]["Z_over_L"]["mps-a"];
  ASSERT_EQ(front.size(), times);
  EXPECT_NEAR(front[9].get<double>(), (0.145 + 2.0 * 0.1 + 0.02 * 0.145 + 0.0001) / 0.145, 1e-6);
  // The page does nothing with the start, for which there is no pressure.
  EXPECT_NEAR(metrics["viewer"]["times_s"][0].get<double>(), 0.01, 1e-12);
}

TEST(Viewer, RunThatEndedEarlyHasNoWaterAfterwards) {
  const SyntheticStudy files;
  std::filesystem::remove_all(files.runs() / "sph-a");
  files.write("sph-a", "sph", 0.0, false);
  const json metrics = report_metrics(files.collected());
  const json& front = metrics["viewer"]["Z_over_L"]["sph-a"];
  EXPECT_TRUE(front[9].is_number());
  EXPECT_TRUE(front[10].is_null());
}

}  // namespace
}  // namespace surge::compare
