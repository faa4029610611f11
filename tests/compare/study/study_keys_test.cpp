#include "compare/study/study_keys.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "compare/study/new_study.hpp"
#include "compare/study/study.hpp"
#include "compare/study/study_check.hpp"
#include "particle/support/toml.hpp"
#include "tests/compare/synthetic.hpp"
#include "tests/places.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

/// Lines of a table that the reader takes, by keys.
using Entries = std::map<std::string, std::string>;

const Entries head{{"title", "\"t\""},
                   {"reference", "\"r\""},
                   {"strip_height", "0.01"},
                   {"snapshot_times", "[0.1]"}};
const Entries run{{"name", "\"r\""}, {"program", "\"surge-particle\""}, {"case", "\"c.toml\""}};
const Entries files{{"name", "\"f\""}, {"program", "\"files\""}, {"source", "\"f\""}};
const Entries level{{"name", "\"l\""},
                    {"program", "\"surge-particle\""},
                    {"case", "\"c.toml\""},
                    {"role", "\"convergence\""},
                    {"group", "\"g\""}};
const Entries observable{{"name", "\"o\""}, {"kind", "\"front\""}};

std::string table(std::string_view heading, Entries entries, std::string_view at,
                  const std::string& key) {
  if (heading == at) entries[key] = "1979-05-27";  // no key takes a date
  std::string text = std::string(heading) + '\n';
  for (const auto& [name, value] : entries)
    text.append(name).append(" = ").append(value).append("\n");
  return text;
}

/// What the reader says of a study in which a key of the table `at` is a date; `last` stands after
/// a good run.
std::string answer(std::string_view at, const std::string& key, const Entries& last) {
  const TemporaryFolder folder;
  std::string text = table("", head, at, key);
  text += table("[defaults]", {}, at, key);
  text += table("[[run]]", run, "", "") + table("[[run]]", last, at, key);
  text += table("[[observable]]", observable, at, key);
  try {
    static_cast<void>(read_study(testing::write_text(folder / "study.toml", text)));
  } catch (const surge::Error& error) {
    return error.what();
  }
  return "";
}

TEST(StudyKeys, AreAllReadByTheReader) {
  for (const StudyKey& key : study_keys()) {
    bool looked_at = false;
    for (const Entries& last : {run, files, level}) {
      const std::string said = answer(key.table, std::string(key.key), last);
      EXPECT_FALSE(said.empty()) << key.table << key.key;
      looked_at = looked_at || said.find("unknown key") == std::string::npos;
    }
    EXPECT_TRUE(looked_at) << key.table << key.key;
  }
  EXPECT_THAT(answer("[[run]]", "colour", run), HasSubstr("unknown key"));
}

TEST(StudyKeys, HoldAllThatOurStudiesUse) {
  std::set<std::string> listed;
  for (const StudyKey& key : study_keys())
    EXPECT_TRUE(listed.insert(std::string(key.table) + std::string(key.key)).second) << key.key;
  int studies = 0;
  for (const auto& entry : fs::directory_iterator(tests::sources() + "/compare/studies")) {
    if (entry.path().extension() != ".toml") continue;
    ++studies;
    const TomlTable root = TomlTable::read(entry.path());
    for (const std::string& name : root.keys()) {
      const bool one = name == "defaults";
      if (!one && name != "run" && name != "observable") {
        EXPECT_TRUE(listed.contains(name)) << entry.path() << ' ' << name;
        continue;
      }
      const std::string heading = one ? "[defaults]" : "[[" + name + "]]";
      for (const TomlTable& part : one ? std::vector{root.table(name)} : root.tables(name))
        for (const std::string& key : part.keys())
          EXPECT_TRUE(listed.contains(heading + key)) << entry.path() << ' ' << heading << key;
    }
  }
  EXPECT_GT(studies, 10);
}

TEST(NewStudy, IsCheckedAsItStandsAndNamesAllKeys) {
  const TemporaryFolder folder;
  const std::string case_file = tests::sources() + "/particle/cases/square_column_3d.toml";
  for (const std::string& flow : {tests::sources() + "/particle/cases/dam_break.toml", case_file}) {
    const std::string text = new_study_text(flow, folder.path());
    Study study = read_study(testing::write_text(folder / "study.toml", text));
    check_study(study, tests::programs());
    ASSERT_EQ(study.runs.size(), 4U);
    EXPECT_EQ(study.runs[1].resolved["case"]["method"]["preset"], "delta-plus");
    EXPECT_EQ(study.runs[3].program, "interFoam");
    for (const StudyKey& key : study_keys()) {
      EXPECT_THAT(text, HasSubstr(std::string(key.table)));
      EXPECT_THAT(text, HasSubstr(std::string(key.key) + " ="));
      EXPECT_THAT(text, HasSubstr("# " + std::string(key.takes)));
    }
  }
  EXPECT_THROW(static_cast<void>(new_study_text("nowhere.toml", "")), surge::Error);
}

}  // namespace
}  // namespace surge::compare
