#include "compare/study/statements.hpp"

#include <gmock/gmock.h>

#include <set>

#include "compare/study/study.hpp"
#include "tests/compare/synthetic_study.hpp"
#include "tests/places.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;
using testing::error_of;
using ::testing::HasSubstr;

const fs::path alves_dreux = fs::path(tests::sources()) / "compare/studies/alves_dreux";

/// The folder of the repository with one text changed in one of its files.
Statements changed(const std::string& file, const std::string& what, const std::string& with) {
  const testing::TemporaryFolder folder;
  fs::copy(alves_dreux, folder / "paper");
  std::string text = testing::read_text(folder / "paper" / file);
  text.replace(text.find(what), what.size(), with);
  testing::write_text(folder / "paper" / file, text);
  return read_statements(folder / "paper");
}

TEST(Statements, OfTheRepositoryAreRead) {
  const Statements statements = read_statements(alves_dreux);
  EXPECT_TRUE(statements.is_about("paper"));
  EXPECT_FALSE(statements.is_about("improved"));
  ASSERT_NE(statements.of_rule("more_accurate"), nullptr);
  EXPECT_EQ(statements.of_rule("more_accurate")->methods, (std::vector<std::string>{"mps", "sph"}));
  EXPECT_DOUBLE_EQ(statements.of_rule("alike")->numbers.at("overlap"), 0.9);
  ASSERT_NE(statements.setting("mps", "re_gradient"), nullptr);
  EXPECT_EQ(statements.setting("mps", "re_gradient")->value, 2.1);
  EXPECT_EQ(statements.setting("mps", "lambda")->value, "paper");
  EXPECT_TRUE(statements.setting("sph", "h_over_l0")->value.is_null());
  EXPECT_EQ(statements.setting("isph", "h_over_l0"), nullptr);
  std::set<std::string> rules;
  for (const Statement& claim : statements.claims) rules.insert(claim.rule);
  EXPECT_EQ(rules.size(), statement_rules().size());  // all of them are in use
  EXPECT_FALSE(statements.errata.empty());
}

TEST(Statements, MistakesAreNamedWithTheirLine) {
  const auto refused = [](const char* file, const char* what, const char* with) {
    return error_of([&] { (void)changed(file, what, with); });
  };
  EXPECT_THAT(refused("claims.toml", "\"agrees\"", "\"agree\""),
              HasSubstr("claims.toml:12: claim.0.rule: found"));
  EXPECT_THAT(refused("claims.toml", "overlap = 0.9", "overlap = -0.9"), HasSubstr("overlap"));
  EXPECT_THAT(refused("claims.toml", "overlap = 0.9", "part = 0.9"), HasSubstr("overlap"));
  EXPECT_THAT(refused("claims.toml", "methods = [\"mps\", \"sph\"]", "methods = [\"mps\"]"),
              HasSubstr("claim.2.methods: found 1 methods, expected 2"));
  EXPECT_THAT(refused("claims.toml", "\"leading_edge_sph\"", "\"leading_edge_mps\""),
              HasSubstr("a second time"));
  EXPECT_THAT(
      refused("settings.toml", "parameter = \"re_laplacian\"", "parameter = \"re_gradient\""),
      HasSubstr("a second time"));
  EXPECT_THAT(refused("errata.toml", "\nprinted", "\nprint"), HasSubstr("errata.toml"));
}

// Whose statements are judged is found before anything runs.
TEST(Statements, AStudyNamesAFolderThatIsThere) {
  const testing::TemporaryFolder folder;
  const auto study = [&](const std::string& name) {
    return testing::write_text(folder / "study.toml",
                               "title = \"T\"\nreference = \"r\"\nstrip_height = "
                               "0.01\nsnapshot_times = [0.1]\nclaims = \"" +
                                   name +
                                   "\"\n[[run]]\nname = \"r\"\nprogram = \"surge-particle\"\ncase "
                                   "= \"c.toml\"\nset = []\n");
  };
  EXPECT_THAT(error_of([&] { (void)read_study(study("nobody")); }),
              HasSubstr("study.toml:5: claims: found \"nobody\""));
  fs::copy(alves_dreux, folder / "mine");
  EXPECT_EQ(read_study(study("mine")).statements.claims.size(), 10U);
}

}  // namespace
}  // namespace surge::compare
