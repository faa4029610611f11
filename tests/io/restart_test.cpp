// A restart is the run that went on: for every preset, in two and three dimensions.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <omp.h>

#include <cstdlib>
#include <iostream>
#include <random>
#include <tuple>

#include "particle/io/checkpoint.hpp"
#include "tests/case/case_fixture.hpp"
#include "tests/io/restart_fixture.hpp"
#include "tests/places.hpp"

namespace surge {
namespace {

/// Seeded moments of a run at which it is taken up again; the fault campaign asks for more.
int moments() {
  const char* asked = std::getenv("SURGE_MOMENTS");
  return asked == nullptr ? 3 : std::atoi(asked);
}

/// Of the whole run.
int steps() {
  return std::min(120, 20 * moments());
}

constexpr double no_limit = std::numeric_limits<double>::max();

/// Steps of several lengths, as the times of frames make them.
double limit_of(int step) {
  return step % 7 == 3 ? 2e-4 : no_limit;
}

template <int D>
void expect_restarts_to_agree(const Computation& computation) {
  const tests::TemporaryFolder folder;
  std::mt19937 random(20100503);
  std::vector<int> at;
  for (int k = 0; k < moments(); ++k)
    at.push_back(std::uniform_int_distribution(1, steps() - 10)(random));

  const auto whole = computation.make_solver<D>();
  std::vector<std::uint64_t> expected;
  for (int k = 1; k <= steps(); ++k) {
    whole->step(limit_of(k));
    expected.push_back(test::fingerprint(whole->state()));
    if (std::find(at.begin(), at.end(), k) == at.end()) continue;
    std::filesystem::create_directories(folder.path() / std::to_string(k));
    write_checkpoint(folder.path() / std::to_string(k), computation, {}, whole->state());
  }
  for (const int begin : at) {
    Checkpoint checkpoint(folder.path() / std::to_string(begin), computation);
    const auto taken_up = computation.restore_solver<D>(checkpoint.state());
    EXPECT_EQ(test::fingerprint(taken_up->state()), expected[static_cast<std::size_t>(begin - 1)]);
    for (int k = begin + 1; k <= steps(); ++k) {
      taken_up->step(limit_of(k));
      ASSERT_EQ(test::fingerprint(taken_up->state()), expected[static_cast<std::size_t>(k - 1)])
          << "taken up at step " << begin << ", other at step " << k;
    }
  }
  std::cout << "restarts of " << computation.method_name() << '-' << computation.preset << ", " << D
            << "D, " << omp_get_max_threads() << " threads: " << at.size() << " of " << at.size()
            << " moments the same bit for bit\n";
}

void expect_restarts_to_agree(const Computation& computation) {
  if (computation.flow.dimension == 2) return expect_restarts_to_agree<2>(computation);
  expect_restarts_to_agree<3>(computation);
}

class Restart : public testing::TestWithParam<std::tuple<std::string, int, int>> {
 protected:
  ~Restart() override { omp_set_num_threads(before_); }
  int before_ = omp_get_max_threads();
};

TEST_P(Restart, IsTheRunThatWentOn) {
  const auto& [preset, dimension, threads] = GetParam();
  omp_set_num_threads(threads);
  expect_restarts_to_agree(test::collapse_of(preset, dimension));
}

INSTANTIATE_TEST_SUITE_P(Presets, Restart,
                         testing::Combine(testing::ValuesIn(test::all_presets()),
                                          testing::Values(2, 3), testing::Values(1, 2)),
                         [](const auto& test) {
                           std::string name = std::get<0>(test.param) + "_" +
                                              std::to_string(std::get<1>(test.param)) + "D_" +
                                              std::to_string(std::get<2>(test.param)) + "threads";
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

class MovingRestart : public testing::TestWithParam<std::string> {};

/// What moves by its own law is where the time says, whatever was before.
TEST_P(MovingRestart, IsTheRunThatWentOn) {
  Computation c = test::collapse_of(GetParam(), 2);
  c.flow.motion.kind = TankMotion::Kind::rotation;
  c.flow.motion.centre = {0.1, 0.0, 0.0};
  c.flow.motion.direction = {0.0, 0.0, 1.0};
  c.flow.motion.law.kind = ScalarMotion::Kind::harmonic;
  c.flow.motion.law.amplitude = 0.05;
  c.flow.motion.law.period = 0.1;
  MovingWall gate{"gate", {{0.06, 0.0, 0.0}, {0.08, 0.14, 0.0}}, {0.0, 1.0, 0.0}, {}};
  gate.law.kind = ScalarMotion::Kind::constant;
  gate.law.speed = 0.5;
  gate.law.stop = 0.1;
  c.flow.moving_walls.push_back(gate);
  expect_restarts_to_agree(c);
}

INSTANTIATE_TEST_SUITE_P(Presets, MovingRestart, testing::ValuesIn(test::all_presets()),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

/// Every pair against every other one, periodic axes, other solvers of the pressure: the
/// choices that no preset makes.
TEST(RestartOfChoices, IsTheRunThatWentOn) {
  const auto with = [](const std::vector<std::string>& overrides) {
    return parse_computation(test::collapse(2, "mps", "paper"), "collapse.toml", overrides);
  };
  for (const char* solver : {"iccg", "cholmod", "multigrid"})
    expect_restarts_to_agree(with({std::string("mps.ppe_solver=") + solver}));
  expect_restarts_to_agree(with({"search.neighbours=all_pairs"}));
  expect_restarts_to_agree(with({"method.name=sph", "search.neighbours=all_pairs"}));
  const auto periodic = [](const std::vector<std::string>& overrides) {
    return read_computation(tests::sources() + "/particle/cases/poiseuille.toml", overrides);
  };
  expect_restarts_to_agree(periodic({"method.preset=improved"}));
  expect_restarts_to_agree(periodic({"method.name=sph", "method.preset=delta-plus"}));
}

}  // namespace
}  // namespace surge
