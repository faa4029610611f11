#include "particle/io/new_case.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "particle/case/case_keys.hpp"
#include "particle/io/computation.hpp"
#include "particle/io/presets.hpp"
#include "particle/io/run_size.hpp"
#include "particle/support/new_file.hpp"
#include "tests/case/case_fixture.hpp"
#include "tests/places.hpp"

namespace surge {
namespace {

using testing::HasSubstr;

TEST(NewCase, IsComputedAsItStands) {
  const tests::TemporaryFolder folder;
  for (const int dimension : {2, 3}) {
    const std::string file = (folder.path() / std::to_string(dimension)).string();
    write_new_file(file, new_case_text(dimension));
    const Computation computation = read_computation(file, {});
    EXPECT_EQ(computation.flow.dimension, dimension);
    // 15 x 30 particles of 10 mm; 6 x 6 x 12 of 25 mm
    EXPECT_EQ(run_size(computation).particles.fluid, dimension == 2 ? 450 : 432);
    EXPECT_EQ(computation.flow.gravity[dimension == 2 ? 1 : 2], -9.81);
  }
  EXPECT_THROW(static_cast<void>(new_case_text(4)), Error);
}

TEST(NewCase, NamesAllThatACaseFileTakes) {
  for (const int dimension : {2, 3}) {
    const std::string text = new_case_text(dimension);
    std::size_t at = 0;
    for (const CaseKey& key : case_keys()) {
      ASSERT_THAT(text, HasSubstr(std::string(key.table)));
      // In the order of the schema, each with what it takes.
      const std::string name = std::string(key.key) + " =";
      do {
        at = text.find(name, at + 1);  // "on =" is no part of "position ="
      } while (at != std::string::npos && std::isalpha(static_cast<unsigned char>(text[at - 1])));
      ASSERT_NE(at, std::string::npos) << key.table << key.key;
      const std::string line = text.substr(at, text.find('\n', at) - at);
      EXPECT_THAT(line, HasSubstr("# " + std::string(key.takes)));
      EXPECT_THAT(line, HasSubstr(std::string(key.does)));
    }
    for (const Method& method : methods())
      for (const std::string& preset : preset_names(method.name))
        EXPECT_THAT(text, HasSubstr(preset));
  }
}

TEST(NewFile, WritesOverNothing) {
  const tests::TemporaryFolder folder;
  const std::string file = (folder.path() / "a").string();
  write_new_file(file, "text\n");
  EXPECT_EQ(test::read_text(file), "text\n");
  EXPECT_THROW(write_new_file(file, "other"), Error);
  EXPECT_EQ(test::read_text(file), "text\n");
  EXPECT_THROW(write_new_file((folder.path() / "no/such/folder").string(), ""), Error);
}

}  // namespace
}  // namespace surge
