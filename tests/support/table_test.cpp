#include "particle/support/table.hpp"
#include "tests/places.hpp"

#include <gtest/gtest.h>
#include <fstream>
#include <limits>
#include <sstream>

#include "particle/support/error.hpp"

namespace surge {
namespace {

class Csv : public testing::Test {
 protected:
  [[nodiscard]] std::string text(const std::string& name) const {
    std::ifstream in(folder_ / name);
    std::ostringstream all;
    all << in.rdbuf();
    return all.str();
  }

  tests::TemporaryFolder files_;
  const std::filesystem::path folder_ = files_.path();
};

TEST_F(Csv, QuotesWordsAndWritesNumbersThatReadBack) {
  Table table{"t", {"word", "value"}, {}};
  table.add({std::string("a, \"b\""), 0.1});
  table.add({std::string("c"), std::numeric_limits<double>::infinity()});
  write_csv(table, folder_);
  EXPECT_EQ(text("t.csv"), "word,value\n\"a, \"\"b\"\"\",0.1\nc,NaN\n");
}

TEST_F(Csv, RowsMakeTheirFolderAndReadBackTheSame) {
  write_csv(folder_ / "sub/f.csv", {"a", "b"},
            std::vector<std::vector<double>>{{1.0 / 3.0, 1e-300}});
  const std::string written = text("sub/f.csv");
  EXPECT_EQ(written.substr(0, 4), "a,b\n");
  EXPECT_EQ(std::stod(written.substr(4)), 1.0 / 3.0);
}

TEST_F(Csv, PlaceThatCannotBeWrittenIsAnError) {
  EXPECT_THROW(write_csv("/proc/nothing.csv", {"a"}, std::vector<std::vector<double>>{{1.0}}),
               Error);
}

}  // namespace
}  // namespace surge
