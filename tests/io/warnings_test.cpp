#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "particle/case/scales.hpp"
#include "particle/io/manifest.hpp"
#include "tests/case/case_fixture.hpp"

namespace surge {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(Warnings, ARunSaysThatItBecameUnstable) {
  const Computation computation = test::make_computation();
  const double reference = reference_speed(computation.flow);
  ASSERT_GT(reference, 0.0);
  RunRecord record;
  StepReport step;
  step.v_max = 9.9 * reference;
  record.add(step, 0.1);
  EXPECT_THAT(warnings_of(record, computation.flow), IsEmpty());
  step.v_max = 10.1 * reference;
  record.add(step, 0.2);
  step.v_max = 1.0 * reference;
  record.add(step, 0.3);
  EXPECT_EQ(record.fastest, 10.1 * reference);
  EXPECT_EQ(record.fastest_at, 0.2);
  EXPECT_THAT(warnings_of(record, computation.flow),
              ElementsAre(HasSubstr("m/s at 0.2 s, more than ten times")));
  const auto manifest = nlohmann::json::parse(manifest_text(record, computation));
  EXPECT_EQ(manifest["warnings"].size(), 1U);
  EXPECT_EQ(manifest["fastest_at_s"], 0.2);
  EXPECT_EQ(run_record(to_json(record)).fastest, record.fastest);
}

TEST(Warnings, APressureSolverThatGaveUpIsOne) {
  RunRecord record;
  StepReport step;
  step.ppe_converged = false;
  step.ppe_residual = 0.01;
  record.add(step, 0.1);
  EXPECT_THAT(warnings_of(record, test::make_computation().flow),
              ElementsAre(HasSubstr("gave up in 1 of 1 steps, with a residual of up to 0.01")));
}

}  // namespace
}  // namespace surge
