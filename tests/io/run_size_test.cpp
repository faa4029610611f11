#include "particle/io/run_size.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "particle/io/presets.hpp"
#include "tests/case/case_fixture.hpp"

namespace surge {
namespace {

using testing::HasSubstr;

TEST(RunSize, CountsWhatTheSolverMakes) {
  for (const Method& method : methods()) {
    const Computation c = test::make_computation(
        {"method.name=" + std::string(method.name),
         "method.preset=" + preset_names(method.name).front(), "time.courant=0.2"});
    const RunSize size = run_size(c);
    EXPECT_EQ(size.particles.fluid, 32.0);
    EXPECT_EQ(size.particles.all(), static_cast<double>(c.make_solver<2>()->particles().size()));
    EXPECT_EQ(size.frames, 5.0);
    EXPECT_LE(size.first_step, c.flow.time.initial_step);
    EXPECT_GT(size.memory, 0.0);
    EXPECT_GT(size.disk, 0.0);
    EXPECT_EQ(to_json(size)["fluid_particles"], 32.0);
  }
}

// The guess of the number of steps is made with the limits that the solver keeps.
TEST(RunSize, StepLimitIsTheSolvers) {
  const std::vector<std::vector<std::string>> choices{
      {"method.name=isph", "method.preset=shifted"},
      {"method.name=isph", "method.preset=shifted", "fluid.kinematic_viscosity=0.05"},
      {"method.name=mps"},
      {"method.name=mps", "method.preset=improved"},
      {"method.name=mps", "fluid.kinematic_viscosity=0.05"},
      {"method.name=sph"},
      {"method.name=sph", "sph.acoustic_courant=0.0"},
      {"method.name=sph", "sph.acoustic_damping=10"},
      {"method.name=sph", "fluid.kinematic_viscosity=0.05"},
      {"method.name=sph", "fluid.kinematic_viscosity=0.05", "sph.viscous_term=deformation"}};
  for (std::vector<std::string> choice : choices) {
    choice.emplace_back("block.0.velocity=[0.3,0.0]");
    const Computation c = test::make_computation(choice);
    const auto solver = c.make_solver<2>();
    const double v_max = solver->step(1e-9).v_max;
    EXPECT_DOUBLE_EQ(c.method->step_limit(c.flow, c.options, v_max), solver->stable_step())
        << testing::PrintToString(choice);
  }
}

TEST(RunSize, MoreThanTheMemoryIsRefusedWithBothNumbers) {
  const TomlTable root = TomlTable::parse("[resolution]\nspacing = 0.01\n", "case.toml");
  RunSize size;
  size.particles = {3e6, 1e5};
  size.memory = 2e9;
  EXPECT_NO_THROW(check_size(size, root, 2e9));
  try {
    check_size(size, root, 1.5e9);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("case.toml:2: resolution.spacing: found a size of"));
    EXPECT_THAT(error.what(), HasSubstr("about 2 GB"));
    EXPECT_THAT(error.what(), HasSubstr("memory of this machine, 1.5 GB"));
  }
  size.particles.fluid = 2.1e9;
  size.memory = 1.0;
  EXPECT_THROW(check_size(size, root, 2e9), Error);
}

TEST(RunSize, NoSizeIsTooLargeToBeTold) {
  for (const char* spacing : {"1e-7", "1e-9", "1e-12", "1e-300"}) {
    try {
      static_cast<void>(test::make_case({std::string("resolution.spacing=") + spacing}));
      ADD_FAILURE() << "accepted " << spacing;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr("expected at most")) << spacing;
    }
  }
}

TEST(RunSize, RunsWithoutAnEndAreRefused) {
  for (const char* setting : {"sph.acoustic_courant=1e-308", "fluid.kinematic_viscosity=1e300"}) {
    try {
      static_cast<void>(test::make_computation({"method.name=sph", setting}));
      ADD_FAILURE() << "accepted " << setting;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr("expected at most 1e+12 steps")) << setting;
    }
  }
}

TEST(RunSize, BytesForPeople) {
  EXPECT_EQ(bytes_text(0.0), "0 B");
  EXPECT_EQ(bytes_text(1540.0), "1.5 kB");
  EXPECT_EQ(bytes_text(2.0e9), "2 GB");
  EXPECT_EQ(bytes_text(3e18), "3000 PB");
}

}  // namespace
}  // namespace surge
