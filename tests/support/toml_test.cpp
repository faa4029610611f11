#include "particle/support/toml.hpp"
#include "tests/places.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <array>
#include <fstream>
#include <functional>

namespace surge {
namespace {

constexpr const char* text = R"(name = "column"
count = 3
flag = true
mixed = [1, "two"]
[size]
width = 0.145
point = [0.0, 1.5]
limit = nan
[[run]]
name = "a"
set = ["x=1", "y=2"]
[[run]]
name = "b"
set = []
)";

TomlTable open(const std::vector<std::string>& overrides = {}) {
  return TomlTable::parse(text, "study.toml", overrides);
}

TEST(TomlTable, ReadsEveryKindOfEntry) {
  const TomlTable root = open();
  EXPECT_EQ(root.text("name"), "column");
  EXPECT_EQ(root.integer("count"), 3);
  EXPECT_DOUBLE_EQ(root.number("count"), 3.0);
  EXPECT_TRUE(root.boolean("flag"));
  EXPECT_DOUBLE_EQ(root.table("size").number("width", Bounds::above(0.0)), 0.145);
  EXPECT_THAT(root.table("size").numbers("point", 2), testing::ElementsAre(0.0, 1.5));
  const std::vector<TomlTable> runs = root.tables("run");
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_THAT(runs[0].texts("set"), testing::ElementsAre("x=1", "y=2"));
  EXPECT_THAT(runs[1].texts("set"), testing::IsEmpty());
  EXPECT_TRUE(root.tables("nothing").empty());
  EXPECT_FALSE(root.optional_table("nothing").has_value());
  EXPECT_DOUBLE_EQ(root.number_or("nothing", 7.0), 7.0);
}

TEST(TomlTable, FinishAcceptsADocumentThatWasReadCompletely) {
  const TomlTable root = TomlTable::parse("a = 1\n[b]\nc = 2\n", "f.toml");
  static_cast<void>(root.number("a"));
  EXPECT_THROW(root.finish(), Error);  // b was not asked for
  static_cast<void>(root.table("b").number("c"));
  EXPECT_NO_THROW(root.finish());
}

struct Bad {
  const char* what;
  std::vector<std::string> overrides;
  std::function<void(const TomlTable&)> read;
  const char* message;
};

class TomlTableErrors : public testing::TestWithParam<Bad> {};

TEST_P(TomlTableErrors, NamePlaceFoundAndExpected) {
  const Bad& bad = GetParam();
  try {
    bad.read(open(bad.overrides));
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), bad.message);
  }
}

void finish_size(const TomlTable& t) {
  static_cast<void>(t.table("size").number("width"));
  static_cast<void>(t.table("size").has("points"));
  static_cast<void>(t.table("size").has("limit"));
  for (const char* key : {"name", "count", "flag", "mixed"}) static_cast<void>(t.has(key));
  for (const TomlTable& run : t.tables("run")) {
    static_cast<void>(run.has("name"));
    static_cast<void>(run.has("set"));
  }
  t.finish();
}

constexpr std::array<std::string_view, 2> shapes{"box", "ball"};

std::string test_name(const testing::TestParamInfo<Bad>& bad) {
  std::string name = bad.param.what;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, TomlTableErrors,
    testing::Values(
        Bad{"missing",
            {},
            [](const TomlTable& root) { (void)root.table("size").number("height"); },
            "study.toml:5: size.height: found no such key, expected a number"},
        Bad{"misspelt",
            {},
            [](const TomlTable& root) { (void)root.table("size").number("widht"); },
            "study.toml:5: size.widht: found no such key (but \"width\"), expected a number"},
        Bad{"type",
            {},
            [](const TomlTable& root) { (void)root.number("name"); },
            "study.toml:1: name: found \"column\", expected a number"},
        Bad{"whole",
            {},
            [](const TomlTable& root) { (void)root.table("size").integer("width"); },
            "study.toml:6: size.width: found 0.145, expected a whole number"},
        Bad{"boolean",
            {},
            [](const TomlTable& root) { (void)root.boolean("count"); },
            "study.toml:2: count: found 3, expected true or false"},
        Bad{"range",
            {},
            [](const TomlTable& root) { (void)root.integer("count", Bounds::closed(1, 2)); },
            "study.toml:2: count: found 3, expected a whole number between 1 and 2"},
        Bad{"nan",
            {},
            [](const TomlTable& root) { (void)root.table("size").number("limit"); },
            "study.toml:8: size.limit: found nan, expected a number"},
        Bad{"choice",
            {},
            [](const TomlTable& root) { (void)root.choice("name", shapes); },
            "study.toml:1: name: found \"column\", expected one of \"box\", \"ball\""},
        Bad{"length",
            {},
            [](const TomlTable& root) { (void)root.table("size").numbers("point", 3); },
            "study.toml:7: size.point: found a list of 2, expected a list of 3 numbers"},
        Bad{"element",
            {},
            [](const TomlTable& root) { (void)root.numbers("mixed"); },
            "study.toml:4: mixed: found \"two\" in the list, expected a number"},
        Bad{"text element",
            {},
            [](const TomlTable& root) { (void)root.texts("mixed"); },
            "study.toml:4: mixed: found 1 in the list, expected a text"},
        Bad{"table",
            {},
            [](const TomlTable& root) { (void)root.table("run"); },
            "study.toml:9: run: found an array of tables, expected a table"},
        Bad{"tables",
            {},
            [](const TomlTable& root) { (void)root.tables("size"); },
            "study.toml:5: size: found a table, expected an array of tables [[size]]"},
        Bad{"unknown",
            {},
            finish_size,
            "study.toml:7: size.point: found unknown key \"point\", expected \"points\""},
        Bad{"in array",
            {},
            [](const TomlTable& root) { (void)root.tables("run")[1].number("name"); },
            "study.toml:13: run.1.name: found \"b\", expected a number"},
        Bad{"override",
            {"size.width=-1"},
            [](const TomlTable& root) {
              (void)root.table("size").number("width", Bounds::above(0));
            },
            "--set size.width=-1: found -1, expected a number above 0"},
        Bad{"override of an element",
            {"run.1.name=[1]"},
            [](const TomlTable& root) { (void)root.tables("run")[1].text("name"); },
            "--set run.1.name=[1]: found a list of 1, expected a text"},
        Bad{"override beyond the end",
            {"run.2.name=c"},
            [](const TomlTable&) {},
            "--set run.2.name=c: found \"2\", expected an index below 2"},
        Bad{"override below a value",
            {"count.x=1"},
            [](const TomlTable&) {},
            "--set count.x=1: found \"x\" below 3, expected a table there"},
        Bad{"override without value",
            {"count"},
            [](const TomlTable&) {},
            "--set count: found \"count\", expected table.key=value"},
        Bad{"override with an empty part",
            {"size..width=1"},
            [](const TomlTable&) {},
            "--set size..width=1: found \"size..width=1\", expected table.key=value"},
        Bad{"override of nothing known",
            {"size.wdth=1"},
            [](const TomlTable& root) {
              (void)root.table("size").has("point");
              finish_size(root);
            },
            "--set size.wdth=1: found unknown key \"wdth\", expected \"width\""}),
    test_name);

TEST(TomlOverrides, AreReadAsTomlAndElseAsText) {
  const TomlTable root = open({"name=wendland_c2", "count=4", "flag=false", "size.point=[1, 2]",
                               "size.point.1=5", "run.0.name=\"c d\"", "new.table.key=1e-3"});
  EXPECT_EQ(root.text("name"), "wendland_c2");
  EXPECT_EQ(root.integer("count"), 4);
  EXPECT_FALSE(root.boolean("flag"));
  EXPECT_THAT(root.table("size").numbers("point"), testing::ElementsAre(1.0, 5.0));
  EXPECT_EQ(root.tables("run")[0].text("name"), "c d");
  EXPECT_DOUBLE_EQ(root.table("new").table("table").number("key"), 1e-3);
}

TEST(TomlOverrides, LaterOnesWin) {
  const std::vector<std::string> overrides{"count=4", "count=5"};
  EXPECT_EQ(open(overrides).integer("count"), 5);
}

TEST(TomlTable, SyntaxErrorsHaveALine) {
  try {
    static_cast<void>(TomlTable::parse("a = 1\nb = = 2\n", "broken.toml"));
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("broken.toml:2: found text that is not TOML"));
    EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
  }
}

TEST(TomlTable, ReadsFilesAndMissesThem) {
  const tests::TemporaryFolder folder;
  const auto file = folder / "a.toml";
  std::ofstream(file) << "a = 2\n";
  EXPECT_EQ(TomlTable::read(file).integer("a"), 2);
  EXPECT_THROW(static_cast<void>(TomlTable::read(folder / "missing.toml")), Error);
  EXPECT_THROW(static_cast<void>(TomlTable::read(std::filesystem::temp_directory_path())), Error);
}

/// a.a.a, `parts` names.
std::string chain(std::size_t parts) {
  std::string toml = "a";
  for (std::size_t k = 1; k < parts; ++k) toml += ".a";
  return toml;
}

// Each of these ended in a crash: the parser, and what walks its tables, go down by recursion.
TEST(TomlTable, DepthIsBounded) {
  const auto refused = [](const std::string& toml) -> std::string {
    try {
      static_cast<void>(TomlTable::parse(toml, "deep.toml"));
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  };
  const std::string deep = chain(200000);
  const std::string found = "deep.toml: found a key of 200000 names, expected at most 32";
  EXPECT_EQ(refused(deep + " = 1\n"), found);
  EXPECT_EQ(refused("[" + deep + "]\nb = 1\n"), found);
  EXPECT_EQ(refused("x = [\"\"\"\n\"\"\", {" + deep + " = 1}]\n"), found);
  EXPECT_EQ(refused("x = ['''\n'\\''', {" + deep + " = 1}]\n"), found);
  EXPECT_EQ(refused("x = \"a\\\"#\"\n" + deep + " = 1\n"), found);
  EXPECT_THAT(refused("x = " + std::string(100000, '[')), testing::HasSubstr("not TOML"));
  std::string braces = "x = ";
  for (int k = 0; k < 100000; ++k) braces += "{a=";
  EXPECT_THAT(refused(braces), testing::HasSubstr("not TOML"));

  EXPECT_EQ(refused(chain(32) + " = 1\n"), "accepted");
  EXPECT_NE(refused(chain(33) + " = 1\n"), "accepted");
  // Dots that join no names: in texts, comments and numbers.
  const std::string dots(1000, '.');
  EXPECT_EQ(refused("x = \"" + dots + "\" # " + dots + "\ny = '" + dots + "'\n"), "accepted");
  EXPECT_EQ(refused("z = \"\"\"\n" + dots + "\n\"\" " + dots + "\"\"\"\n"), "accepted");
  std::string numbers = "x = [0.0";
  for (int k = 0; k < 1000; ++k) numbers += ", 0.5";
  EXPECT_EQ(refused(numbers + "]\n"), "accepted");
}

TEST(TomlOverrides, DepthIsBounded) {
  EXPECT_THROW(open({chain(200000) + "=1"}), Error);
  // What is no TOML value of a reasonable depth is a text.
  EXPECT_EQ(open({"name={" + chain(100) + "=1}"}).text("name"), "{" + chain(100) + "=1}");
}

TEST(TomlTable, SizeIsBounded) {
  const tests::TemporaryFolder folder;
  const auto file = folder / "large.toml";
  std::ofstream(file) << "a = 2\n";
  std::filesystem::resize_file(file, std::uintmax_t{1} << 36);  // sparse: it takes no disk
  try {
    static_cast<void>(TomlTable::read(file));
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("expected at most 3145728"));
  }
}

TEST(NumberText, ReadsBackAsTheSameNumber) {
  for (const double value : {0.1, 1.0 / 3.0, 1e-300, -9.81, 1682.0}) {
    EXPECT_EQ(std::stod(number_text(value)), value);
  }
}

}  // namespace
}  // namespace surge
