#include "particle/case/case_keys.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "particle/case/case_file.hpp"
#include "tests/case/case_fixture.hpp"

namespace surge {
namespace {

/// A case with one of each table.
std::string full_case(const std::string& law) {
  const std::string text = test::small_case;
  std::string more =
      "[[moving_wall]]\nname = \"gate\"\nlower = [0.04, 0.0]\nupper = [0.08, 0.12]\n";
  more += "direction = [0.0, 1.0]\n" + law;
  more += "[motion]\nkind = \"rotation\"\ncentre = [0.0, 0.0]\n" + law;
  more += "[[gauge]]\nname = \"H\"\nposition = [0.0, 0.0]\n[[force]]\non = \"gate\"\n";
  return text.substr(0, text.find("[search]")) + more;
}

const std::vector<std::string> laws{
    "law = \"harmonic\"\namplitude = 1.0\nperiod = 1.0\n",
    "law = \"constant\"\nspeed = 1.0\nstop = 1.0\n",
    "law = \"table\"\nquantity = \"acceleration\"\nsamples = [[0.0, 0.0], [1.0, 1.0]]\n"};

/// What the reader says of a case with an override; empty where it takes it.
std::string answer(const std::string& text, const std::string& override) {
  const std::vector<std::string> overrides{override};
  try {
    const TomlTable root = TomlTable::parse(text, "full.toml", overrides);
    static_cast<void>(read_case(root));
    root.finish();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string dotted(const CaseKey& key) {
  std::string table(key.table);
  std::erase_if(table, [](char c) { return c == '[' || c == ']'; });
  if (key.table.starts_with("[[")) table += ".0";
  return (table.empty() ? "" : table + ".") + std::string(key.key);
}

TEST(CaseKeys, AreAllReadByTheReader) {
  for (const CaseKey& key : case_keys()) {
    // No key takes a date. The reader looks at it with one of the laws, or of the kinds of motion.
    bool looked_at = false;
    for (const std::string& law : laws) {
      std::string text = full_case(law);
      for (const bool moves : {false, true}) {
        if (moves) {
          const std::string turn = "kind = \"rotation\"\ncentre = [0.0, 0.0]";
          text.replace(text.find(turn), turn.size(),
                       "kind = \"translation\"\ndirection = [1.0, 0.0]");
        }
        const std::string error = answer(text, dotted(key) + "=1979-05-27");
        EXPECT_FALSE(error.empty()) << dotted(key);
        looked_at = looked_at || error.find("unknown key") == std::string::npos;
      }
    }
    EXPECT_TRUE(looked_at) << dotted(key);
  }
}

TEST(CaseKeys, AreAllThereAre) {
  std::set<std::string> listed;
  for (const CaseKey& key : case_keys()) {
    EXPECT_TRUE(listed.insert(dotted(key)).second) << dotted(key) << " twice";
    // A moving wall's law has the keys of the tank's.
    const std::string motion = "motion.";
    if (dotted(key).starts_with(motion) && key.key != "kind" && key.key != "centre" &&
        key.key != "direction")
      listed.insert("moving_wall.0." + std::string(key.key));
  }
  // What is written is all that was read.
  for (const std::string& law : laws) {
    const TomlTable root = TomlTable::parse(full_case(law), "full.toml");
    const TomlTable written = TomlTable::parse(to_toml(read_case(root)), "written.toml");
    for (const std::string& name : written.keys()) {
      if (name == "title" || name == "dimension") {
        EXPECT_TRUE(listed.contains(name)) << name;
        continue;
      }
      const bool one = name == "fluid" || name == "tank" || name == "motion" ||
                       name == "resolution" || name == "time" || name == "output";
      const TomlTable table = one ? written.table(name) : written.tables(name).at(0);
      for (const std::string& key : table.keys()) {
        const std::string full = name + (one ? "." : ".0.") + key;
        EXPECT_TRUE(listed.contains(full)) << full;
      }
    }
  }
}

}  // namespace
}  // namespace surge
