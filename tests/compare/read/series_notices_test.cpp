#include <gmock/gmock.h>

#include "compare/read/particle_reader.hpp"
#include "tests/compare/foreign_text_writers.hpp"
#include "tests/compare/foreign_vtk_writers.hpp"

namespace surge::compare {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using testing::error_of;
using testing::foreign_facts;
using testing::ForeignFlow;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::TemporaryFolder;

/// A series of .vtu files with their times, one frame at a time.
class Series {
 public:
  void write(int number, int frame, double time, const ForeignFlow& flow = {}) const {
    write(number, flow.fluid(frame), time);
  }
  void write(int number, const std::vector<Vec3>& points, double time) const {
    testing::write_vtu(path() / ("f_" + std::to_string(number) + ".vtu"), points, "", "Time", time);
  }
  [[nodiscard]] std::filesystem::path path() const { return folder_.path(); }
  [[nodiscard]] std::vector<std::string> notices(
      const SourceOptions& options = foreign_facts()) const {
    auto run = open_run(path(), options);
    (void)measure_front(run, testing::foreign_front());
    return run.notices;
  }
  [[nodiscard]] std::string error() const {
    return error_of([&] { (void)notices(); });
  }

 private:
  TemporaryFolder folder_;
};

TEST(Notices, GoodSeriesHasNone) {
  const Series series;
  for (int i = 0; i < 6; ++i) series.write(i, i, 0.02 * i);
  EXPECT_THAT(series.notices(), IsEmpty());
}

TEST(Notices, IntervalThatDiffersFromTheOthersIsTold) {
  const Series series;
  for (int i = 0; i < 6; ++i) series.write(i, i, i < 3 ? 0.02 * i : 0.02 * i + 0.01);
  EXPECT_THAT(series.notices(),
              ElementsAre(HasSubstr("from 0.04 s to 0.07 s are 0.03 s, between most frames 0.02")));
}

TEST(Notices, FramesWrittenAtAnyTimeAreNoIrregularity) {
  std::vector<SeriesEntry> entries(6);
  const std::vector<Seconds> times{Seconds(0.0),  Seconds(0.01), Seconds(0.05),
                                   Seconds(0.07), Seconds(0.2),  Seconds(0.23)};
  EXPECT_THAT(irregularities(entries, times), IsEmpty());
}

TEST(Notices, NumberOfParticlesThatChangesIsTold) {
  const Series series;
  for (int i = 0; i < 6; ++i) series.write(i, i, 0.02 * i);
  std::vector<Vec3> points = ForeignFlow().fluid(3);
  points.pop_back();
  series.write(3, points, 0.06);
  EXPECT_THAT(series.notices(), Contains(HasSubstr("200 at 0 s, 199 at 0.06 s; by up to 1 in 1")));
}

TEST(Notices, ParticlesOutsideOfTheTankAreCounted) {
  const Series series;
  for (int i = 0; i < 6; ++i) series.write(i, i, 0.02 * i);
  std::vector<Vec3> points = ForeignFlow().fluid(5);
  points[0] = {0.5, 0.005, 0.0};
  points[1] = {0.05, -0.2, 0.0};
  series.write(5, points, 0.1);
  SourceOptions options = foreign_facts();
  options.tank_width = Metres(0.4);
  EXPECT_THAT(series.notices(options),
              Contains(HasSubstr("outside of the tank: up to 2 in 1 frames, first at 0.1 s")));
}

TEST(Notices, ParticlesThatLeakAreCountedWhereNobodyStatesTheTank) {
  Series series;
  for (int i = 0; i < 4; ++i) {
    auto points = ForeignFlow().fluid(i);
    if (i > 1) points.push_back({-0.5, 0.05, 0.0});
    if (i > 2) points.push_back({0.1, -3.0, 0.0});
    series.write(i, points, 0.02 * i);
  }
  EXPECT_THAT(
      series.notices(),
      Contains(HasSubstr("behind the column's wall or below its floor: up to 2 in 2 frames, "
                         "first at 0.04 s")));
}

TEST(Notices, ParticleThrownToNowhereIsCountedWhereNobodyStatesTheTank) {
  Series series;
  for (int i = 0; i < 4; ++i) {
    auto points = ForeignFlow().fluid(i);
    if (i == 3) points.back() = {1e30, 0.05, 0.0};
    series.write(i, points, 0.02 * i);
  }
  EXPECT_THAT(series.notices(),
              Contains(HasSubstr("farther away than 100 times the size of all water of the first "
                                 "frame: up to 1 in 1 frames, first at 0.06 s")));
}

TEST(Notices, FramesThatAreTheSameAreTold) {
  const Series series;
  for (int i = 0; i < 6; ++i) series.write(i, i == 3 ? 2 : i, 0.02 * i);
  EXPECT_THAT(series.notices(), Contains(HasSubstr("at 0.04 s and 0.06 s hold the same")));
}

TEST(Notices, FrontThatGoesBackOrJumpsIsTold) {
  const Series exchanged;
  for (int i = 0; i < 6; ++i) exchanged.write(i, i == 2 ? 3 : i == 3 ? 2 : i, 0.02 * i);
  EXPECT_THAT(exchanged.notices(),
              Contains(HasSubstr("goes back in 1 frames, first from 0.13 m to 0.12 m at 0.06 s")));
  const Series other_run;
  for (int i = 0; i < 6; ++i) other_run.write(i, i > 3 ? i + 4 : i, 0.02 * i);
  EXPECT_THAT(other_run.notices(),
              Contains(HasSubstr("jumps in 1 frames, first by 0.05 m at 0.08 s")));
}

TEST(Notices, FrontThatOneParticleMakesIsTold) {
  const Series series;
  for (int i = 0; i < 6; ++i) series.write(i, i, 0.02 * i);
  std::vector<Vec3> points = ForeignFlow().fluid(3);
  points[195][0] += 0.007;
  series.write(3, points, 0.06);
  EXPECT_THAT(series.notices(), Contains(HasSubstr("in 1 of 6 frames one particle makes")));
}

TEST(Notices, FaceOfTheColumnThatOneParticleMakesIsTold) {
  const Series series;
  for (int i = 0; i < 6; ++i) series.write(i, i, 0.02 * i);
  std::vector<Vec3> points = ForeignFlow().fluid(0);
  points[55][0] = 0.0;
  series.write(0, points, 0.0);
  EXPECT_THAT(series.notices(), Contains(HasSubstr("makes the column's face at 0 m along x")));
}

TEST(Frames, OneInOtherUnitsIsRefused) {
  for (const double scale : {1000.0, 10.0, 0.1}) {
    const Series series;
    for (int i = 0; i < 6; ++i) series.write(i, i, 0.02 * i);
    series.write(3, 3, 0.06, ForeignFlow{.scale = scale});
    EXPECT_THAT(series.error(), HasSubstr("f_3.vtu: particles are")) << scale;
  }
}

TEST(Series, TimesOfTheNameAreDecimalNumbers) {
  const TemporaryFolder folder;
  for (int i = 0; i < 6; ++i)
    testing::write_vtu(folder / ("water_0." + testing::padded(20 * i, 3) + ".vtu"),
                       ForeignFlow().fluid(i), "", "", std::nullopt);
  auto run = open_run(folder.path(), foreign_facts());
  EXPECT_NEAR(run.frames->times()[5].value(), 0.1, 1e-12);
}

TEST(Series, TwoRunsInOneFolderAreRefused) {
  const Series series;
  for (int i = 0; i < 6; ++i) series.write(i, i, 0.02 * i);
  testing::write_vtu(series.path() / "g_7.vtu", ForeignFlow().fluid(0), "", "Time", 1.0);
  EXPECT_THAT(series.error(), HasSubstr("2 series of files found"));
  // The pattern of a user may take both by mistake.
  EXPECT_THAT(error_of([&] { (void)open_run(series.path() / "*.vtu", foreign_facts()); }),
              HasSubstr("2 series of files found"));
  EXPECT_EQ(
      testing::refusal_of([&] { (void)open_run(series.path() / "f_*.vtu", foreign_facts()); }), "");
}

TEST(Series, NumbersWithAndWithoutZerosAreTwoRuns) {
  const TemporaryFolder folder;
  for (const char* name : {"f_0000.vtu", "f_0001.vtu", "f_2.vtu"})
    testing::write_vtu(folder / name, ForeignFlow().fluid(0), "", "Time", 0.0);
  EXPECT_THAT(error_of([&] { (void)open_run(folder.path(), foreign_facts()); }),
              HasSubstr("of 1 and of 4 digits"));
}

TEST(TimeFile, IsReadAndChecked) {
  const TemporaryFolder folder;
  const auto file = testing::write_text(folder / "t.csv", "number;time [s]\n0;0\n3;0.25\n");
  EXPECT_EQ(read_time_file(file).at(3), 0.25);
  testing::write_text(file, "number;time\n0;0\n0;0.1\n");
  EXPECT_THAT(error_of([&] { (void)read_time_file(file); }),
              HasSubstr("t.csv:3: number 0 a second"));
  testing::write_text(file, "number;time\n0;0\n1;nan\n");
  EXPECT_THAT(error_of([&] { (void)read_time_file(file); }), HasSubstr("t.csv:3"));
}

}  // namespace
}  // namespace surge::compare
