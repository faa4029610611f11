#include <gmock/gmock.h>

#include "compare/read/delimited.hpp"
#include "compare/read/particle_table.hpp"
#include "tests/compare/foreign_text_writers.hpp"
#include "tests/compare/foreign_vtk_writers.hpp"

namespace surge::compare {
namespace {

using ::testing::Contains;
using testing::error_of;
using testing::expect_known_front;
using testing::foreign_facts;
using testing::ForeignFlow;
using ::testing::HasSubstr;
using testing::TemporaryFolder;
using testing::write_text;

/// How a spreadsheet or a script writes its rows.
struct Sheet {
  std::string separator = ",";
  char decimal = '.';
  bool quoted = false;
  std::vector<std::string> names{"x", "y", "vx", "vy", "p", "kind"};
  std::vector<std::string> kinds{"1", "2"};  ///< of fluid and wall
};

void write_sheets(const std::filesystem::path& folder, const Sheet& sheet) {
  for (int i = 0; i < ForeignFlow::frames; ++i) {
    const auto p = ForeignFlow().particles(i, 0, 1);
    std::string text;
    const auto add = [&](const std::vector<std::string>& fields) {
      for (std::size_t k = 0; k < fields.size(); ++k)
        text +=
            (k > 0 ? sheet.separator : "") + (sheet.quoted ? "\"" + fields[k] + "\"" : fields[k]);
      text += '\n';
    };
    const auto number = [&](double value) {
      std::string written = testing::digits17(value);
      std::replace(written.begin(), written.end(), '.', sheet.decimal);
      return written;
    };
    add(sheet.names);
    for (std::size_t k = 0; k < p.position.size(); ++k)
      add({number(p.position[k][0]), number(p.position[k][1]), number(p.velocity[k][0]),
           number(p.velocity[k][1]), number(p.pressure[k]),
           sheet.kinds.at(static_cast<std::size_t>(p.type[k]))});
    write_text(folder / ("sheet_" + std::to_string(i) + ".csv"), text);
  }
}

SourceOptions sheet_options() {
  SourceOptions options = foreign_facts();
  options.time_step = Seconds(ForeignFlow::interval);
  options.velocity_array = {"vx", "vy"};
  options.pressure_array = "p";
  options.type_array = "kind";
  options.type_required = true;
  options.fluid_type = 1;
  return options;
}

TEST(Sheets, DecimalCommasAreReadAndTold) {
  for (const Sheet& sheet : {Sheet{";", ','}, Sheet{"\t", ','}, Sheet{" ", ','},
                             Sheet{",", ',', true}, Sheet{";", ',', true}}) {
    const TemporaryFolder folder;
    write_sheets(folder.path(), sheet);
    EXPECT_THAT(expect_known_front(folder.path(), sheet_options()),
                Contains(HasSubstr("decimal comma")))
        << sheet.separator;
  }
}

TEST(Sheets, OneDecimalSignInATable) {
  EXPECT_EQ(number_in("0,5", ','), 0.5);
  EXPECT_EQ(number_in("-1,5e-02", ','), -0.015);
  EXPECT_EQ(number_in("12", ','), 12.0);
  for (const char* word : {"0.5", "1.234,5", "1,234.5", "1,2,3", ""})
    EXPECT_FALSE(number_in(word, ',')) << word;
  EXPECT_FALSE(number_in("0,5"));
  const TemporaryFolder folder;
  const auto file = write_text(folder / "mixed_0.csv", "x;y\n0,5;1\n0,6;1\n0,7;1.5\n");
  EXPECT_THAT(error_of([&] { (void)read_csv(file, csv_parts(file, {}).front(), std::nullopt); }),
              HasSubstr("mixed_0.csv:4: y: found \"1.5\""));
  // Two columns, not one with a comma.
  EXPECT_EQ(describe_table(write_text(folder / "plain_0.csv", "x,y\n1,2\n3,4\n")).decimal, '.');
  EXPECT_EQ(describe_table(write_text(folder / "blank_0.csv", "x, y\n1, 2\n3, 4\n")).decimal, '.');
}

TEST(Sheets, TypesMayBeWords) {
  const TemporaryFolder folder;
  Sheet sheet;
  sheet.kinds = {"water", "wall"};
  write_sheets(folder.path(), sheet);
  SourceOptions options = sheet_options();
  options.fluid_type.reset();
  EXPECT_THAT(expect_known_front(folder.path(), options),
              Contains(HasSubstr("fluid where kind is water")));
  set_source_option(options, "fluid_type", std::vector<std::string>{"water"}, "fluid_type", "");
  (void)expect_known_front(folder.path(), options);
  options.fluid_type = 1;
  EXPECT_THAT(error_of([&] { (void)open_run(folder.path(), options); }),
              HasSubstr("kind: words found, fluid_type \"1\" expected"));
  // Nobody has said which array it is.
  options = sheet_options();
  options.type_array = "type";
  options.type_required = false;
  options.fluid_type.reset();
  EXPECT_THAT(error_of([&] { (void)open_run(folder.path(), options); }),
              HasSubstr("kind (text, 1 component: water x 200, wall x 102)"));
  sheet.kinds = {"a", "b"};
  write_sheets(folder.path(), sheet);
  options = sheet_options();
  options.fluid_type.reset();
  EXPECT_THAT(error_of([&] { (void)open_run(folder.path(), options); }),
              HasSubstr("which words of kind"));
}

TEST(Sheets, WordsAreNoNumbers) {
  const TemporaryFolder folder;
  const auto file = write_text(folder / "f_0.csv", "x,y,kind\nleft,0,1\nright,1,1\n");
  const ParticleTable table = read_csv(file, csv_parts(file, {}).front(), std::nullopt);
  EXPECT_EQ(table.arrays[0].words, (std::vector<std::string>{"left", "right"}));
  SourceOptions options = foreign_facts();
  options.time_step = Seconds(1);
  options.position_array = {"x", "y"};
  EXPECT_THAT(error_of([&] { (void)open_run(folder.path(), options); }),
              HasSubstr("point array x: \"left\" found, numbers expected"));
}

TEST(Sheets, PlaneOfYAndZIsReadAsItLies) {
  const TemporaryFolder folder;
  Sheet sheet;
  sheet.names = {"y", "z", "vx", "vy", "p", "kind"};
  write_sheets(folder.path(), sheet);
  SourceOptions options = sheet_options();
  options.velocity_array = {};
  auto run = open_run(folder.path(), options);
  const FrontHistory front = measure_front(run, testing::foreign_front());
  EXPECT_NEAR(front.back().position.value(), ForeignFlow::edge(ForeignFlow::frames - 1), 1e-9);
  EXPECT_THAT(run.notices, Contains(HasSubstr("y along the surge and z upwards")));
}

TEST(Sheets, OneNumberAboveTheTableIsItsTimeUnlessItCounts) {
  const TemporaryFolder folder;
  const auto time_of = [&](const std::string& first) {
    return describe_table(write_text(folder / "t_0.csv", first + "\nx,y\n1,2\n3,4\n"));
  };
  EXPECT_EQ(time_of("0.05").time, 0.05);
  EXPECT_EQ(time_of("0").time, 0.0);
  EXPECT_EQ(time_of("2").count, 2U);
  EXPECT_FALSE(time_of("2").time);
}

/// A .vtp of the flow whose type is an array of words.
TEST(WordsInVtk, TellTheFluid) {
  const TemporaryFolder folder;
  for (int i = 0; i < ForeignFlow::frames; ++i) {
    const auto p = ForeignFlow().particles(i, 1, 2);
    std::string words;
    for (const int type : p.type)
      for (const char c : std::string(type == 1 ? "water" : "steel") + '\0')
        words += std::to_string(static_cast<int>(c)) + " ";
    testing::write_vtu(folder / ("w_" + std::to_string(i) + ".vtu"), p.position,
                       testing::data_array("velocity", "Float64", 3, p.velocity) +
                           testing::data_array("pressure", "Float64", 1, p.pressure) +
                           "<Array type=\"String\" Name=\"stuff\" NumberOfTuples=\"" +
                           std::to_string(p.type.size()) + "\" format=\"ascii\">" + words +
                           "</Array>\n",
                       "Time", i * ForeignFlow::interval);
  }
  EXPECT_THAT(error_of([&] { (void)open_run(folder.path(), foreign_facts()); }),
              HasSubstr("stuff (text, 1 component: water x 200, steel x 102)"));
  SourceOptions options = foreign_facts();
  options.type_array = "stuff";
  options.type_required = true;
  (void)expect_known_front(folder.path(), options);
}

}  // namespace
}  // namespace surge::compare
