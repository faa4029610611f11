#include "particle/support/regular_file.hpp"
#include "tests/places.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "particle/support/error.hpp"
#include "particle/support/json.hpp"
#include "particle/support/toml.hpp"

namespace surge {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// Files that a reader must not wait for, nor believe.
class RegularFile : public ::testing::Test {
 protected:
  template <class Read>
  static std::string refusal(Read&& read) {
    try {
      read();
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  tests::TemporaryFolder files_;
  const fs::path folder_ = files_.path();
};

TEST_F(RegularFile, IsReadWhole) {
  const std::string content("a\0b\r\n", 5);
  std::ofstream(folder_ / "a", std::ios::binary) << content;
  EXPECT_EQ(read_regular(folder_ / "a", 5, "a text"), content);
  fs::create_symlink(folder_ / "a", folder_ / "link");
  EXPECT_EQ(read_regular(folder_ / "link", 5, "a text"), content);
  EXPECT_THAT(refusal([&] { (void)read_regular(folder_ / "a", 4, "a text"); }),
              HasSubstr("a: found 5 bytes, expected at most 4 of a text"));
}

TEST_F(RegularFile, PipesDevicesFoldersAndNothingAreRefusedByEveryReader) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  const std::vector<std::pair<fs::path, std::string>> hostile{
      {folder_ / "pipe", "a pipe or a device"},
      {"/dev/zero", "a pipe or a device"},
      {folder_, "a folder"},
      {folder_ / "none", "no such file"}};
  for (const auto& [path, found] : hostile) {
    const fs::path& file = path;  // a lambda takes no structured binding in clang 14
    EXPECT_THAT(refusal([&] { (void)read_regular(file, 9, "a text"); }), HasSubstr(found));
    EXPECT_THAT(refusal([&] { (void)TomlTable::read(file); }), HasSubstr(found));
    EXPECT_THAT(refusal([&] { (void)read_json(file); }), HasSubstr(found));
  }
}

TEST_F(RegularFile, SparseFilesAreRefused) {
  std::ofstream(folder_ / "a") << "x";
  fs::resize_file(folder_ / "a", std::uintmax_t{1} << 31U);
  EXPECT_THAT(refusal([&] { require_regular(folder_ / "a", most_table_bytes, "a table"); }),
              HasSubstr("a: found a sparse file without content, expected a table"));
}

TEST(Json, DepthIsBounded) {
  const auto nested = [](std::size_t depth) {
    return std::string(depth, '[') + std::string(depth, ']');
  };
  EXPECT_TRUE(parse_json(nested(64), "a").is_array());
  for (const std::size_t depth : {std::size_t{65}, std::size_t{3'000'000}}) {
    try {
      (void)parse_json(nested(depth), "a.json");
      FAIL() << depth;
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()),
                "a.json: found brackets " + std::to_string(depth) + " deep, expected at most 64");
    }
  }
  // Brackets in texts are none.
  EXPECT_EQ(parse_json("\"" + std::string(100, '[') + "\\\"[\"", "a").get<std::string>().size(),
            102U);
}

TEST(Json, ErrorsAreOneShortLine) {
  for (const std::string text : {"{\"a\": \x1b]0;x\x07}", "[1e999]", "", "{\"a\": \xff}"}) {
    try {
      (void)parse_json(text, "a.json");
      FAIL() << text;
    } catch (const Error& error) {
      const std::string said = error.what();
      EXPECT_EQ(said.find_first_of("\n\x1b\x07"), std::string::npos) << said;
      EXPECT_LT(said.size(), 350U);
    }
  }
  EXPECT_LT(json_shown(std::string(1000, 'x')).size(), 70U);
}

}  // namespace
}  // namespace surge
