#include "compare/study/sweep.hpp"

#include <gmock/gmock.h>

#include <cstdint>
#include <fstream>
#include <map>

#include "compare/study/run_table.hpp"
#include "tests/compare/synthetic.hpp"
#include "tests/places.hpp"

namespace surge::compare {
namespace {

using ::testing::ElementsAre;
using testing::error_of;
using ::testing::HasSubstr;

const std::string head = "[[run]]\nprogram = \"surge-particle\"\ncase = \"c.toml\"\n";

std::vector<StudyRun> runs_of(const std::string& text) {
  const TomlTable root = TomlTable::parse(head + text, "s.toml");
  std::vector<StudyRun> runs = read_runs(root.tables("run")[0]);
  root.finish();
  return runs;
}

std::vector<std::string> names_of(const std::vector<StudyRun>& runs) {
  std::vector<std::string> names;
  for (const StudyRun& run : runs) names.push_back(run.name);
  return names;
}

TEST(Sweep, ListsOfOneTableGoTogether) {
  const auto runs = runs_of(
      "name = \"a-{per}\"\ngroup = \"{per} per L\"\nset = [\"method.name=mps\", "
      "\"resolution.spacing={spacing}\", \"time.end=1\"]\n"
      "sweep = {per = [15, 29], spacing = [0.0096666666666667, \"5e-3\"]}\n");
  EXPECT_THAT(names_of(runs), ElementsAre("a-15", "a-29"));
  EXPECT_THAT(runs[0].settings, ElementsAre("method.name=mps",
                                            "resolution.spacing=0.0096666666666667", "time.end=1"));
  EXPECT_THAT(runs[1].settings,
              ElementsAre("method.name=mps", "resolution.spacing=5e-3", "time.end=1"));
  EXPECT_EQ(runs[1].group, "29 per L");
}

TEST(Sweep, OfSeveralTablesEveryCombinationIsMade) {
  const auto runs = runs_of(
      "name = \"{m}-{per}\"\nset = [\"method.name={m}\"]\n"
      "sweep = [{m = [\"mps\", \"sph\"]}, {per = [1, 2, 3]}]\n");
  EXPECT_THAT(names_of(runs), ElementsAre("mps-1", "mps-2", "mps-3", "sph-1", "sph-2", "sph-3"));
}

TEST(Sweep, AKeyWithADotIsASettingAndThreadsAreThreads) {
  const auto runs = runs_of(
      "name = \"a-{mps.beta}-{threads}\"\nset = [\"time.end=1\"]\n"
      "sweep = {\"mps.beta\" = [0.95, 0.99], threads = [1, 4]}\n");
  EXPECT_THAT(names_of(runs), ElementsAre("a-0.95-1", "a-0.99-4"));
  EXPECT_THAT(runs[1].settings, ElementsAre("time.end=1", "mps.beta=0.99"));
  EXPECT_EQ(runs[1].threads, 4);
}

TEST(Sweep, RepeatsFollowTheirRun) {
  const auto runs = runs_of("name = \"a-{n}\"\nrepeats = 2\nsweep = {n = [1, 2]}\n");
  EXPECT_THAT(names_of(runs), ElementsAre("a-1", "a-1-repeat2", "a-2", "a-2-repeat2"));
}

TEST(Sweep, BracesWithoutASweepAreBraces) {
  EXPECT_EQ(runs_of("name = \"a\"\nset = [\"title={x} {{y}}\"]\n")[0].settings[0],
            "title={x} {{y}}");
  EXPECT_EQ(
      runs_of("name = \"a{n}\"\nset = [\"title={{x}} {n}\"]\nsweep = {n = [1]}\n")[0].settings[0],
      "title={x} 1");
}

TEST(Sweep, WhatTheRunsOfAFileHaveInCommonIsSaidOnce) {
  const TomlTable root = TomlTable::parse(
      "[defaults]\nprogram = \"interFoam\"\ncase = \"tank\"\nrole = \"timing\"\nthreads = 3\n"
      "repeats = 2\ntimed = false\n[[run]]\nname = \"a\"\n[[run]]\nname = \"b\"\nprogram = "
      "\"surge-particle\"\ncase = \"c.toml\"\nthreads = 1\nrepeats = 1\ntimed = true\n",
      "s.toml");
  const auto defaults = root.optional_table("defaults");
  check_defaults(*defaults);
  const auto a = read_runs(root.tables("run")[0], defaults);
  EXPECT_THAT(names_of(a), ElementsAre("a", "a-repeat2"));
  EXPECT_EQ(a[0].program, "interFoam");
  EXPECT_EQ(a[0].case_path, "tank");
  EXPECT_EQ(a[0].threads, 3);
  EXPECT_FALSE(a[0].timed);
  const auto b = read_runs(root.tables("run")[1], defaults);
  EXPECT_THAT(names_of(b), ElementsAre("b"));
  EXPECT_EQ(b[0].program, "surge-particle");
  EXPECT_EQ(b[0].case_path, "c.toml");
  EXPECT_TRUE(b[0].timed);
  EXPECT_EQ(b[0].role, Role::timing);
}

TEST(Sweep, MistakesAreNamed) {
  const auto refused = [](const std::string& text) {
    return error_of([&] { static_cast<void>(runs_of(text)); });
  };
  EXPECT_THAT(refused("name = \"a-{n}\"\nsweep = {n = [1, 2], m = [1]}\n"),
              HasSubstr("s.toml:5: run.0.sweep.n: found 2 values, expected 1 as in m"));
  EXPECT_THAT(refused("name = \"a-{per}\"\nsweep = {pre = [1, 2]}\n"),
              HasSubstr("s.toml:4: run.0.name: found \"a-{per}\" with {per}, expected {pre}"));
  EXPECT_THAT(refused("name = \"a-{\"\nsweep = {n = [1, 2]}\n"), HasSubstr("with {}"));
  EXPECT_THAT(refused("name = \"a\"\nsweep = {n = [1, 2]}\n"),
              HasSubstr("found \"a\" for two runs of the sweep"));
  EXPECT_THAT(refused("name = \"a\"\nsweep = {}\n"), HasSubstr("at least one list"));
  EXPECT_THAT(refused("name = \"a\"\nsweep = {n = []}\n"), HasSubstr("found no value"));
  EXPECT_THAT(refused("name = \"a\"\nsweep = {n = [[1]]}\n"), HasSubstr("sweep.n"));
  EXPECT_THAT(refused("name = \"a\"\nsweep = 3\n"), HasSubstr("sweep"));
  EXPECT_THAT(refused("name = \"a{n}\"\nsweep = [{n = [1]}, {n = [2]}]\n"),
              HasSubstr("a second list of it"));
  EXPECT_THAT(refused("name = \"a{n}\"\nsweep = {n = [\"/\"]}\n"), HasSubstr("\"a/\""));
  EXPECT_THAT(refused("name = \"a{threads}\"\nsweep = {threads = [0]}\n"),
              HasSubstr("\"0\" threads"));
  std::string list("1");
  for (int k = 2; k <= 101; ++k) list.append(",").append(std::to_string(k));
  EXPECT_THAT(refused("name = \"a{n}{m}\"\nsweep = [{n = [" + list + "]}, {m = [" + list + "]}]\n"),
              HasSubstr("10201 combinations"));
}

/// 64-bit FNV-1a.
std::string hash_of(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  std::array<char, 17> out{};
  std::snprintf(out.data(), out.size(), "%016llx", static_cast<unsigned long long>(hash));
  return out.data();
}

std::string line_of(const StudyRun& run) {
  const auto word = [](bool value) { return std::string(value ? "\ttrue" : "\tfalse"); };
  std::string line = run.name + '\t' + run.program + '\t' + run.case_path.string() + '\t' +
                     std::to_string(run.threads) + '\t' + std::string(role_text(run.role)) + '\t' +
                     run.group + word(run.timed) + word(run.may_break);
  for (const std::string& setting : run.settings) line += '\t' + setting;
  return line;
}

// The sweeps of the whole study stand for the very runs that were once written out one by one.
TEST(Sweep, TheStudiesOfThisRepositoryStandForTheRunsOfOnce) {
  const std::filesystem::path source(tests::sources());
  std::map<std::string, std::vector<std::array<std::string, 3>>> once;
  std::ifstream in(source / "tests/compare/study/written_out_runs.txt");
  for (std::string file, name, role, hash; in >> std::ws && in.good();) {
    if (in.peek() == '#') {
      std::getline(in, file);
    } else if (in >> file >> name >> role >> hash) {
      once[file].push_back({name, role, hash});
    }
  }
  ASSERT_EQ(once.size(), 4U);
  for (const auto& [file, expected] : once) {
    std::vector<StudyRun> found;
    const TomlTable root = TomlTable::read(source / "compare/studies" / (file + ".toml"));
    for (const TomlTable& table : root.tables("run"))
      for (StudyRun& run : read_runs(table, root.optional_table("defaults")))
        found.push_back(std::move(run));
    ASSERT_EQ(found.size(), expected.size()) << file;
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].name, expected[i][0]) << file;
      EXPECT_EQ(hash_of(line_of(found[i])), expected[i][2]) << file << ": " << line_of(found[i]);
    }
  }
}

}  // namespace
}  // namespace surge::compare
