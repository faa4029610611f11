#include "compare/read/delimited.hpp"

#include <gmock/gmock.h>

#include <filesystem>

#include "compare/read/particle_table.hpp"
#include "tests/compare/synthetic.hpp"

namespace surge::compare {
namespace {

using ::testing::ElementsAre;
using testing::error_of;
using ::testing::HasSubstr;
using testing::TemporaryFolder;
using testing::write_text;

std::vector<std::string_view> fields(std::string_view line, char delimiter) {
  std::vector<std::string_view> found;
  split_fields(line, delimiter, found);
  return found;
}

TEST(Fields, AreTrimmedAndQuotesHold) {
  EXPECT_THAT(fields("a, b ,\"c,d\"", ','), ElementsAre("a", "b", "c,d"));
  EXPECT_THAT(fields("1;2;", ';'), ElementsAre("1", "2"));
  EXPECT_THAT(fields("1;;2;", ';'), ElementsAre("1", "", "2"));
  EXPECT_THAT(fields("  1  2\t3 \r", ' '), ElementsAre("1", "2", "3"));
}

TEST(Numbers, AreThoseOfCAndNoOthers) {
  EXPECT_EQ(number_in("5.0e-02"), 0.05);
  EXPECT_EQ(number_in("+1"), 1.0);
  EXPECT_EQ(number_in("1e-400"), 0.0);
  EXPECT_TRUE(std::isnan(number_in("nan").value()));
  EXPECT_TRUE(std::isinf(number_in("-inf").value()));
  for (const char* none : {"5.0D-02", "0,5", "", "1e400", "1 2", "0x1", "abc", "1.0f", "+"})
    EXPECT_EQ(number_in(none), std::nullopt) << none;
}

TEST(ColumnNames, LoseTheirUnits) {
  EXPECT_EQ(plain_name("Pos.x [m]"), "pos.x");
  EXPECT_EQ(plain_name("\"Points:0\""), "points:0");
  EXPECT_EQ(plain_name("position[0]"), "position[0]");
  EXPECT_EQ(plain_name("time(s)"), "time");
}

class DelimitedFile {
 public:
  explicit DelimitedFile(const std::string& text) : file(write_text(folder_ / "t_0.csv", text)) {}

 private:
  TemporaryFolder folder_;

 public:
  std::filesystem::path file;

  [[nodiscard]] std::string error() const {
    return error_of([&] {
      for (const FilePart& part : parts_of(file, {}))
        (void)read_table(file, part, std::nullopt, {});
    });
  }
};

TEST(Tables, HeadsOfAllKindsAreUnderstood) {
  EXPECT_THAT(describe_table(DelimitedFile("# a comment\n# x y z\n1 2 3\n4 5 6\n").file).columns,
              ElementsAre("x", "y", "z"));
  EXPECT_THAT(describe_table(DelimitedFile("1,2\n3,4\n").file).columns, ElementsAre("1", "2"));
  EXPECT_THAT(describe_table(DelimitedFile("\xEF\xBB\xBFx;y\r\n1;2\r\n").file).columns,
              ElementsAre("x", "y"));
  EXPECT_EQ(describe_table(DelimitedFile("% time = 0.25 s\nx,y\n1,2\n").file).time, 0.25);
  // An hour is no time of a run.
  EXPECT_EQ(describe_table(DelimitedFile("# time: 12:30:05\nx,y\n1,2\n").file).time, std::nullopt);
  const TextTable table = describe_table(DelimitedFile("0.5\n2\n0 1 2\n0 3 4\n").file);
  EXPECT_EQ(table.time, 0.5);
  EXPECT_EQ(table.count, 2U);
}

TEST(Tables, FaultsAreErrorsWithTheirLine) {
  EXPECT_THAT(DelimitedFile("x,y\n1,2\n3\n").error(),
              HasSubstr("t_0.csv:3: 1 fields found, 2 expected"));
  EXPECT_THAT(DelimitedFile("time,x,y\n0,1,2\n0,3,4\n0.1,1,2\n0.05,1,2\n").error(),
              HasSubstr("t_0.csv:5: time 0.05 after 0.1"));
  EXPECT_THAT(DelimitedFile("time,x,y\n0,1,2\ninf,3,4\n").error(), HasSubstr("time inf"));
  EXPECT_THAT(DelimitedFile("time,x,y\n0,1,2\nnan,3,4\n").error(), HasSubstr("time nan"));
  EXPECT_THAT(DelimitedFile("x,x\n1,2\n3,4\n").error(), HasSubstr("two columns"));
  EXPECT_THAT(DelimitedFile("a\nb\nc\n").error(), HasSubstr("no rows of numbers"));
  EXPECT_THAT(DelimitedFile("0.5\n3\n0 1 2\n0 3 4\n").error(), HasSubstr("announces 3"));
  EXPECT_THAT(DelimitedFile("x,y,z\n1,2\n3,4\n").error(), HasSubstr("3 names"));
}

TEST(Tables, FortranExponentsAreNoNumbers) {
  const DelimitedFile table("x,y\n1,2\n3,4\n5.0D-02,5\n");
  const std::vector<std::string> names{"x"};
  EXPECT_THAT(
      error_of([&] { (void)read_table(table.file, parts_of(table.file, {}).front(), names, {}); }),
      HasSubstr("t_0.csv:4: x: found \"5.0D-02\", expected a number such as 5.0e-02"));
}

TEST(Tables, ColumnOfWordsIsNoHindrance) {
  const DelimitedFile table("x,y,phase\n1,2,water\n3,4,water\n");
  const ParticleTable all =
      read_table(table.file, parts_of(table.file, {}).front(), std::nullopt, {});
  EXPECT_EQ(all.find("phase")->type, "text");
  EXPECT_THAT(all.find("y")->values, ElementsAre(2.0, 4.0));
}

TEST(Tables, LastLineWithoutAnEndIsTold) {
  const DelimitedFile table("x,y\n1,2\n3,4");
  const auto read = read_table(table.file, parts_of(table.file, {}).front(), std::nullopt, {});
  ASSERT_EQ(read.notes.size(), 1U);
  EXPECT_THAT(read.notes[0], HasSubstr("cut short"));
}

TEST(Tables, LinesLongerThanABlockAreWhole) {
  std::string text = "x,y\n";
  for (int i = 0; i < 200000; ++i) text += std::to_string(i) + ",0.25\n";
  const DelimitedFile table(text);
  const auto read = read_table(table.file, parts_of(table.file, {}).front(), std::nullopt, {});
  ASSERT_EQ(read.count, 200000U);
  EXPECT_EQ(read.find("x")->values.back(), 199999.0);
  EXPECT_THAT(DelimitedFile("x,y\n1,2\n3,4\n" + std::string(6 << 20, '1')).error(),
              HasSubstr("4 MiB"));
}

TEST(Formats, OthersAreRefusedWithWhatToExport) {
  const TemporaryFolder folder;
  for (const auto& [name, word] : {std::pair{"ParticleData_1.bgeo", "VTK exporter"},
                                   {"Part_0001.bi4", "PartVTK"},
                                   {"water_1.plt", "BodyStatesRecordingToVtp"},
                                   {"dam_0.npz", "h5py"}}) {
    const std::filesystem::path file = folder / name;
    write_text(file, "binary");
    EXPECT_THAT(error_of([&] { (void)format_of(file, {}); }), HasSubstr(word));
  }
  write_text(folder / "x_0.csv", "");
  EXPECT_THAT(error_of([&] { (void)format_of(folder / "x_0.csv", {}); }), HasSubstr("empty"));
  EXPECT_THAT(error_of([&] { (void)format_of("/dev/zero", {}); }), HasSubstr("not a regular file"));
}

}  // namespace
}  // namespace surge::compare
