#include "particle/io/run_loop.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <sstream>

#include "tests/case/case_fixture.hpp"
#include "tests/places.hpp"

namespace surge {
namespace {

/// One particle that moves at 1 m/s with steps that the test prescribes.
class FakeSolver {
 public:
  explicit FakeSolver(std::function<double(long)> stable) : stable_(std::move(stable)) {
    particles_.resize(1);
    particles_.v[0][0] = 1.0;
  }
  StepReport step(double dt_limit) {
    StepReport report;
    report.dt = std::min(dt_limit, stable_step());
    time_ += report.dt;
    particles_.x[0][0] = steps_ == break_at_ ? std::nan("") : time_;
    particles_.pressure[0] = 1000.0 * time_;
    report.v_max = 1.0 + rush_ * static_cast<double>(steps_);
    report.clipped = 2;
    report.lost = steps_ % 3;
    steps_ += 1;
    taken_.push_back(report.dt);
    return report;
  }
  [[nodiscard]] double stable_step() const { return stable_(steps_); }
  [[nodiscard]] double time() const { return time_; }
  [[nodiscard]] const Particles<2>& particles() const { return particles_; }
  [[nodiscard]] Clock& clock() { return clock_; }

  [[nodiscard]] const std::vector<double>& taken() const { return taken_; }
  void break_at(long step) { break_at_ = step; }
  /// Speed (m/s) that each step adds.
  void rush(double rush) { rush_ = rush; }

 private:
  std::function<double(long)> stable_;
  Particles<2> particles_;
  Clock clock_;
  double time_ = 0.0;
  long steps_ = 0;
  long break_at_ = -1;
  double rush_ = 0.0;
  std::vector<double> taken_;
};

class RunLoopTest : public testing::Test {
 protected:
  RunEnd run(
      FakeSolver& solver, std::function<bool()> stop = [] { return false; }) {
    RunOutput output{FrameQueue(FrameWriter(folder_.path(), "density")),
                     StepTable(folder_.path() / "steps.csv", recorded_columns(case_)),
                     Progress(progress_, false, case_.time.end)};
    RunLoop<FakeSolver, 2> loop(solver, case_, output, record_, {std::move(stop)});
    return loop.run();
  }
  [[nodiscard]] std::string file(const char* name) const {
    return test::read_text(folder_.path() / name);
  }

  tests::TemporaryFolder folder_;
  Case case_ = test::make_case();  // 0.02 s, a frame every 0.005 s
  RunRecord record_;
  std::ostringstream progress_;
};

TEST_F(RunLoopTest, LandsOnFrameTimesWithoutTinySteps) {
  FakeSolver solver([](long) { return 0.0007; });
  EXPECT_EQ(run(solver), RunEnd::finished);
  EXPECT_NEAR(solver.time(), 0.02, 1e-15);
  EXPECT_EQ(record_.frames, 5);
  EXPECT_EQ(record_.steps, static_cast<long>(solver.taken().size()));
  for (const double dt : solver.taken()) EXPECT_GE(dt, 0.5 * 0.0007 * (1.0 - 1e-9));
  // 0.005 s are 6 whole steps and the rest of 0.0008 s in two halves.
  EXPECT_EQ(record_.steps, 4 * 8);
  EXPECT_NEAR(solver.taken()[6], 0.0004, 1e-12);
  EXPECT_THAT(file("particles.pvd"), testing::HasSubstr("timestep=\"0.015\""));
}

TEST_F(RunLoopTest, EndsAtTheEndWhereTheIntervalDoesNotDivideIt) {
  case_.time.end = 0.012;
  FakeSolver solver([](long step) { return step == 0 ? 1e-4 : 1e-3; });
  EXPECT_EQ(run(solver), RunEnd::finished);
  EXPECT_NEAR(solver.time(), 0.012, 1e-15);
  EXPECT_EQ(record_.frames, 4);  // 0, 0.005, 0.01, 0.012
  EXPECT_THAT(file("particles.pvd"), testing::HasSubstr("timestep=\"0.012\""));
}

TEST_F(RunLoopTest, StepsThatFitExactlyAreNotSplit) {
  FakeSolver solver([](long) { return 0.001; });
  run(solver);
  EXPECT_EQ(record_.steps, 20);
}

TEST_F(RunLoopTest, TableHasARowPerStepAndTheProbes) {
  FakeSolver solver([](long) { return 0.001; });
  run(solver);
  std::istringstream table(file("steps.csv"));
  std::string row;
  std::getline(table, row);
  EXPECT_EQ(row,
            "time,dt,courant,v_max,ppe_iterations,ppe_residual,ppe_setup_s,ppe_solve_s,"
            "particle_collisions,wall_collisions,clipped,lost,corner");
  // What Probes find of the one particle, whose pressure grows by 1 Pa per step as it passes.
  Probes<2> probes(case_);
  Particles<2> particle = solver.particles();
  int rows = 0;
  while (std::getline(table, row)) {
    ++rows;
    if (rows == 1) {
      EXPECT_EQ(row.substr(0, row.rfind(',')), "0.001,0.001,0,1,0,0,0,0,0,0,2,0");
    }
    particle.x[0][0] = 0.001 * rows;
    particle.pressure[0] = rows;
    const double expected = probes.measure(particle)[0];
    EXPECT_GT(expected, 0.0);
    EXPECT_NEAR(std::stod(row.substr(row.rfind(',') + 1)), expected, 1e-6 * expected) << rows;
  }
  EXPECT_EQ(rows, 20);
}

TEST_F(RunLoopTest, CountsWhatTheStepsReport) {
  FakeSolver solver([](long) { return 0.001; });
  run(solver);
  EXPECT_EQ(record_.clipped, 2 * 20);
  EXPECT_EQ(record_.lost_particles, 19 % 3);  // those outside at the end, not a sum
  EXPECT_NEAR(record_.simulated, 0.02, 1e-15);
  EXPECT_EQ(record_.nonfinite, 0);
}

TEST_F(RunLoopTest, NonfiniteValuesStopTheRunAfterTheLastGoodState) {
  FakeSolver solver([](long) { return 0.00025; });
  solver.break_at(38);  // the frame at 0.005 s is step 20, the copy is of step 32
  try {
    run(solver);
    FAIL() << "went on";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("step 39"));
    EXPECT_THAT(error.what(), testing::HasSubstr("found 1 infinite or undefined"));
    EXPECT_THAT(error.what(), testing::HasSubstr("the last good state is frame 2 at 0.008"));
  }
  EXPECT_EQ(record_.nonfinite, 1);
  EXPECT_EQ(record_.frames, 3);
}

TEST_F(RunLoopTest, AVanishingStepStopsTheRun) {
  FakeSolver solver([](long step) { return step < 10 ? 0.001 : 1e-18; });
  EXPECT_THROW(run(solver), Error);
  EXPECT_LT(record_.steps, 100);
}

TEST_F(RunLoopTest, AParticleThatIsTooFastForTheFlowStopsTheRun) {
  case_.reference_speed = 0.5;
  FakeSolver solver([](long) { return 0.001; });
  solver.rush(10.0);  // past 50 m/s at the sixth step
  try {
    run(solver);
    FAIL() << "went on";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("step 6"));
    EXPECT_THAT(error.what(),
                testing::HasSubstr("found a particle at 51 m/s, expected at most 50"));
  }
}

TEST_F(RunLoopTest, AnInterruptedRunWritesItsLastState) {
  FakeSolver solver([](long) { return 0.001; });
  EXPECT_EQ(run(solver, [&] { return solver.time() > 0.0075; }), RunEnd::interrupted);
  EXPECT_EQ(record_.frames, 3);  // 0, 0.005, 0.008
  EXPECT_THAT(file("particles.pvd"), testing::HasSubstr("frame_00002.vtp"));
  EXPECT_EQ(record_.steps, 8);
}

TEST(StepLimit, SplitsWhatIsLeftBelowTwoSteps) {
  EXPECT_DOUBLE_EQ(step_limit(1.0, 5.0), 1.0);
  EXPECT_DOUBLE_EQ(step_limit(1.0, 2.0), 1.0);
  EXPECT_DOUBLE_EQ(step_limit(1.0, 1.1), 0.55);
  EXPECT_DOUBLE_EQ(step_limit(1.0, 1.0), 1.0);
  EXPECT_DOUBLE_EQ(step_limit(1.0, 0.3), 0.3);
}

}  // namespace
}  // namespace surge
