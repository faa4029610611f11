#include "compare/read/tables_ahead.hpp"

#include <gmock/gmock.h>

#include "tests/compare/synthetic.hpp"

namespace surge::compare {
namespace {

using ::testing::HasSubstr;
using testing::refusal_of;
using testing::TemporaryFolder;
using testing::write_vtp;

/// A series of .vtp files; file k has k + 1 particles.
struct VtpSeries {
  static constexpr std::size_t count = 40;
  TemporaryFolder folder;
  std::vector<SeriesEntry> entries;

  VtpSeries() {
    for (std::size_t k = 0; k < count; ++k) {
      const std::filesystem::path file = folder / ("f_" + std::to_string(k) + ".vtp");
      write_vtp(file, std::vector<Vec3>(k + 1, Vec3{double(k), 0, 0}), {});
      entries.push_back({Seconds(double(k)), std::nullopt, {file}, {}});
    }
  }
};

const ArrayNames pressure_alone{std::vector<std::string>{"pressure"}};

TEST(TablesAhead, AreThoseOfTheFilesWhateverTheOrder) {
  const VtpSeries series;
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < series.count; ++k) order.push_back(k);
  order.insert(order.end(), {39, 3, 4, 5, 4, 5, 6, 20, 21, 0});
  TablesAhead ahead;
  for (const std::size_t k : order) {
    const ParticleTable table = ahead.read(series.entries, k, pressure_alone, {});
    EXPECT_EQ(table.count, k + 1);
    EXPECT_EQ(table.points.at(3 * k), double(k));
    ASSERT_EQ(table.arrays.size(), 1U);
    EXPECT_EQ(table.arrays[0].values.back(), 100.0 * double(k));
  }
}

TEST(TablesAhead, HaveTheArraysThatAreWantedNow) {
  const VtpSeries series;
  TablesAhead ahead;
  for (std::size_t k = 0; k < 3; ++k) (void)ahead.read(series.entries, k, pressure_alone, {});
  const ArrayNames two{std::vector<std::string>{"pressure", "velocity"}};
  EXPECT_EQ(ahead.read(series.entries, 3, two, {}).arrays.size(), 2U);
  EXPECT_EQ(ahead.read(series.entries, 4, two, {}).arrays.size(), 2U);
}

TEST(TablesAhead, AFaultyFileIsToldInItsTurn) {
  const VtpSeries series;
  const std::filesystem::path bad = series.folder / "f_7.vtp";
  std::filesystem::resize_file(bad, std::filesystem::file_size(bad) / 2);
  std::filesystem::remove(series.folder / "f_9.vtp");
  TablesAhead ahead;
  for (std::size_t k = 0; k < series.count; ++k) {
    const auto read = [&] { return ahead.read(series.entries, k, pressure_alone, {}); };
    if (k == 7 || k == 9)
      EXPECT_THAT(refusal_of([&] { (void)read(); }), HasSubstr("f_" + std::to_string(k) + ".vtp"));
    else
      EXPECT_EQ(read().count, k + 1);
  }
}

}  // namespace
}  // namespace surge::compare
