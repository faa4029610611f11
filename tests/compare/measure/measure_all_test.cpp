#include "compare/measure/measure_all.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compare/measure/measured_text.hpp"
#include "compare/measure/registry.hpp"
#include "tests/compare/measure/frames_in_memory.hpp"

namespace surge::compare {
namespace {

using testing::error_of;
using ::testing::HasSubstr;
using testing::lattice;
using testing::MemoryRun;

constexpr double l0 = 0.005;

/// A column that falls apart upwards: the layer on the floor reaches 0.145 + t.
std::vector<Frame> frames(const std::vector<double>& times) {
  std::vector<Frame> all;
  for (const double t : times) {
    ParticleFrame frame = testing::particles(lattice({0, 0, 0}, {0.145, 0.29, 0}, l0), t);
    testing::append(frame.position, lattice({0.145, 0, 0}, {0.145 + t, 0.01, 0}, l0));
    frame.velocity.assign(frame.position.size(), {3.0, 4.0, 9.0});
    all.emplace_back(frame);
  }
  return all;
}

std::vector<std::unique_ptr<Observable>> observables(const Run& run,
                                                     const std::vector<std::string>& requests) {
  std::vector<std::unique_ptr<Observable>> made;
  for (const std::string& request : requests)
    made.push_back(make_observable(request, {run, {}, nullptr}));
  return made;
}

TEST(MeasureAll, ReadsEachFrameOnceWithTheFieldsOfAll) {
  MemoryRun memory(frames({0.0, 0.05, 0.1}), testing::dam_break(), l0);
  const auto found = measure_all(
      memory.run, observables(memory.run, {"front", "gauge:x=0.1", "kinetic-energy", "volume"}));
  ASSERT_EQ(found.size(), 4U);
  for (const auto& reads : memory.frames->reads) {
    ASSERT_EQ(reads.size(), 1U);
    EXPECT_TRUE(reads.front().velocity);
    EXPECT_FALSE(reads.front().pressure);
  }
  EXPECT_EQ(found[0].series[0].name, "front");
  EXPECT_EQ(found[0].series[0].unit, "m");
  ASSERT_EQ(found[0].series[0].values.size(), 3U);
  EXPECT_NEAR(*found[0].series[0].values[2], 0.245, 1e-12);
  EXPECT_NEAR(*found[1].series[0].values[1], 0.29, 1e-12);
  EXPECT_EQ(memory.run.notices, (std::vector<std::string>{"told once"}));
}

TEST(MeasureAll, LeavesFramesOutAtWhichNothingLooks) {
  MemoryRun memory(frames({0.0, 0.05, 0.1}), testing::dam_break(), l0);
  const auto found = measure_all(memory.run, observables(memory.run, {"profile:times=0.06"}));
  EXPECT_TRUE(memory.frames->reads[0].empty());
  EXPECT_EQ(memory.frames->reads[1].size(), 1U);
  EXPECT_TRUE(memory.frames->reads[2].empty());
  ASSERT_EQ(found[0].profiles.size(), 1U);
  EXPECT_EQ(found[0].profiles[0].time, Seconds(0.05));
  EXPECT_EQ(found[0].profiles[0].asked, Seconds(0.06));
}

TEST(MeasureAll, OneThatFailsDoesNotKeepTheOthers) {
  Physics physics = testing::dam_break();
  physics.column.upper[0] = 0.3;  // not what the first frame shows
  MemoryRun memory(frames({0.0, 0.05}), physics, l0);
  const auto found = measure_all(memory.run, observables(memory.run, {"front", "volume"}));
  ASSERT_TRUE(found[0].failure);
  EXPECT_THAT(*found[0].failure, HasSubstr("first frame"));
  EXPECT_TRUE(found[0].series.empty());
  EXPECT_FALSE(found[1].failure);
  EXPECT_EQ(found[1].series[0].values.size(), 2U);
}

TEST(MeasureAll, CountsWhatIsNotThere) {
  std::vector<Frame> all = frames({0.0, 0.05});
  std::get<ParticleFrame>(all[1]).velocity.clear();
  MemoryRun memory(all, testing::dam_break(), l0);
  const auto found = measure_all(memory.run, observables(memory.run, {"kinetic-energy"}));
  EXPECT_EQ(found[0].series[0].absent(), 1U);
  EXPECT_FALSE(found[0].series[0].values[1]);
  ASSERT_EQ(found[0].notices.size(), 1U);
  EXPECT_THAT(found[0].notices[0], HasSubstr("no value at 1 of 2 times, first at 0.05 s"));
  MeasuredSource source{"a, b", "p", {"kinetic-energy"}, found, {}};
  std::ostringstream csv;
  write_csv(csv, {source});
  EXPECT_THAT(csv.str(), HasSubstr("source,series,unit,time_s,x_m,value\n\"a, b\",kinetic-energy,"
                                   "J/m,0,,"));
  EXPECT_THAT(csv.str(), HasSubstr("\"a, b\",kinetic-energy,J/m,0.05,,\n"));
  EXPECT_TRUE(to_json({source})[0]["series"][0]["value"][1].is_null());
}

TEST(MakeObservable, RefusesWhatItDoesNotKnow) {
  const MemoryRun memory(frames({0.0}), testing::dam_break(), l0);
  const auto refusal = [&](const std::string& request) {
    return error_of([&] { (void)make_observable(request, {memory.run, {}, nullptr}); });
  };
  EXPECT_THAT(refusal("guage:x=1"), HasSubstr("\"gauge\"?"));
  EXPECT_THAT(refusal("gauge"), HasSubstr("x: found nothing"));
  EXPECT_THAT(refusal("gauge:x=no"), HasSubstr("found \"no\", expected a finite number"));
  EXPECT_THAT(refusal("gauge:x=0.1,y=3"), HasSubstr("y: found an unknown parameter"));
  EXPECT_THAT(refusal("gauge:x=0.1,x=3"), HasSubstr("found x twice"));
  EXPECT_THAT(refusal("gauge:x"), HasSubstr("expected key=value"));
  EXPECT_THAT(refusal("front:strip=-1"), HasSubstr("expected a number above 0"));
  EXPECT_THAT(refusal("profile"), HasSubstr("times: found nothing"));
  EXPECT_THAT(refusal("profile:times=3"), HasSubstr("found no frame"));
}

TEST(MakeObservable, ListsEveryKindOnce) {
  std::set<std::string_view> names;
  for (const ObservableKind& kind : observable_kinds()) {
    EXPECT_FALSE(kind.measures.empty());
    EXPECT_TRUE(names.insert(kind.name).second) << kind.name;
  }
}

// A study is held against its cases before there are frames.
TEST(MakeObservable, EveryKindIsCheckedOfARunThatIsOnlyPlanned) {
  MemoryRun memory(frames({0.0}), testing::dam_break(), l0);
  memory.run.frames.reset();
  memory.run.manifest = {
      {"case", {{"probes", {{{"name", "wall"}}}}, {"forces", {{{"name", "end"}}}}}}};
  const std::map<std::string, std::map<std::string, std::string>> parameters{
      {"gauge", {{"x", "0.3"}}},
      {"profile", {{"times", "0.1;0.2"}}},
      {"force", {{"on", "end"}}},
      {"pressure", {{"probe", "wall"}}}};
  for (const ObservableKind& kind : observable_kinds()) {
    const auto found = parameters.find(std::string(kind.name));
    const auto given =
        found == parameters.end() ? std::map<std::string, std::string>() : found->second;
    try {
      check_observable("q", std::string(kind.name), given, {memory.run, {}, &memory.run});
    } catch (const Error& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with("q: "))
          << kind.name << ": " << error.what();
    }
  }
}

TEST(MeasureFront, EndsWhereTheLeadingEdgeIsLost) {
  std::vector<Frame> all = frames({0.0, 0.05, 0.1, 0.15});
  for (Vec3& x : std::get<ParticleFrame>(all[2]).position) x[1] += 0.1;
  MemoryRun memory(all, testing::dam_break(), l0);
  EXPECT_EQ(measure_front(memory.run, {}).size(), 2U);
  // What a broken run holds after that is not read.
  EXPECT_TRUE(memory.frames->reads[3].empty());
}

}  // namespace
}  // namespace surge::compare
