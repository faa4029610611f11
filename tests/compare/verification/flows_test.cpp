#include "compare/verification/flows.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <cmath>
#include <numbers>
#include <regex>

#include "compare/report/report.hpp"
#include "compare/study/levels.hpp"
#include "compare/verification/exact.hpp"
#include "tests/compare/synthetic_study.hpp"

namespace surge::compare {
namespace {

using testing::error_of;
using ::testing::HasSubstr;
using testing::lattice;

using Frames = std::vector<ParticleFrame>;

FlowResult measure(const std::string& group, const FlowCase& flow, const Frames& frames) {
  for (const KnownFlow& known : known_flows())
    if (known.group == group) return known.measure(flow, frames);
  throw std::logic_error(group);
}

double value(const FlowResult& result, const std::string& name) {
  for (const FlowMeasure& measure : result.measures)
    if (measure.name == name) return measure.value;
  throw std::logic_error(name);
}

FlowCase box_case(double width, double height, double spacing) {
  FlowCase flow;
  flow.spacing = spacing;
  flow.density = 1000.0;
  flow.upper = {width, height};
  flow.end = 1.0;
  return flow;
}

/// Frames at 0, 0.05, ... 1 s; `set` fills in what a particle that started at x is at time t.
template <class Set>
Frames frames_of(const std::vector<Vec3>& start, Set&& set, double end = 1.0) {
  Frames frames;
  for (int k = 0; k <= 20; ++k) {
    ParticleFrame frame;
    frame.time = Seconds(end * k / 20);
    for (const Vec3& x : start) {
      Vec3 position{}, velocity{};
      double pressure = 0.0;
      set(x, frame.time.value(), position, velocity, pressure);
      frame.position.push_back(position);
      frame.velocity.push_back(velocity);
      frame.pressure.push_back(pressure);
    }
    frames.push_back(std::move(frame));
  }
  return frames;
}

TEST(StillWater, ErrorIsThatOfThePressureAndNoiseItsFluctuation) {
  FlowCase flow = box_case(0.2, 0.2, 0.01);
  flow.gravity = {0.0, -10.0};
  const auto with = [&](double offset, double ripple) {
    return measure("hydrostatic_tank", flow,
                   frames_of(lattice({0, 0, 0}, {0.2, 0.2, 0}, 0.01),
                             [&](const Vec3& x, double t, Vec3& at, Vec3&, double& p) {
                               at = x;
                               const double sign = std::lround(20.0 * t) % 2 == 0 ? 1.0 : -1.0;
                               p = 1e4 * (0.2 - x[1]) + 2000.0 * (offset + sign * ripple);
                             }));
  };
  EXPECT_NEAR(with(0.0, 0.0).error, 0.0, 1e-12);
  EXPECT_NEAR(with(0.03, 0.0).error, 0.03, 1e-12);
  EXPECT_NEAR(value(with(0.03, 0.0), "noise"), 0.0, 1e-12);
  // Six frames lie in the last quarter, three of each sign.
  EXPECT_NEAR(value(with(0.03, 0.04), "noise"), 0.04, 1e-12);
  EXPECT_NEAR(with(0.03, 0.04).error, 0.05, 1e-12);
  EXPECT_NEAR(*with(0.0, 0.0).volume, 0.0, 1e-12);
  EXPECT_NEAR(*with(0.0, 0.0).energy, 0.0, 1e-12);
}

TEST(Drop, ErrorIsThatOfTheWorseAxis) {
  FlowCase flow = box_case(2.0, 2.0, 0.05);
  flow.lower = {-1.0, -1.0};
  flow.upper = {1.0, 1.0};
  flow.gradient = {{{-2.0, 0.0}, {0.0, 2.0}}};
  std::vector<Vec3> disc;
  for (const Vec3& x : lattice({-1, -1, 0}, {1, 1, 0}, 0.05))
    if (std::hypot(x[0], x[1]) < 1.0) disc.push_back(x);
  const auto with = [&](double swelling) {
    return measure("stretching_drop", flow,
                   frames_of(
                       disc,
                       [&](const Vec3& x, double t, Vec3& at, Vec3& v, double&) {
                         const DropAxes axes = drop_axes(2.0, t);
                         at = {x[0] * axes.x * (1.0 + swelling * t), x[1] * axes.y, 0.0};
                         v = {-x[0], x[1], 0.0};
                       },
                       0.4));
  };
  // A disc cut out of a lattice is a circle to some tenths of a percent.
  EXPECT_LT(with(0.0).error, 0.005);
  EXPECT_NEAR(with(0.25).error, 0.1, 0.006);
  EXPECT_NEAR(value(with(0.25), "short_axis_at_end"), 0.1, 0.006);
  EXPECT_NEAR(*with(0.25).volume, 0.1, 0.002);
  EXPECT_NEAR(*with(0.0).momentum, 0.0, 1e-12);
  EXPECT_NEAR(*with(0.0).energy, 0.0, 1e-12);
}

// Particles displaced by a small standing wave of another frequency and some decay.
TEST(Wave, PeriodAndDecayAreThoseOfTheParticles) {
  FlowCase flow = box_case(1.0, 0.5, 0.025);
  flow.gravity = {0.0, -9.81};
  flow.wave_amplitude = 1e-3;
  const double k = std::numbers::pi;
  const double omega = wave_frequency(9.81, k, 0.5);
  const auto frames = frames_of(
      lattice({0, 0, 0}, {1, 0.5, 0}, 0.025),
      [&](const Vec3& x, double t, Vec3& at, Vec3& v, double&) {
        const double s = 1e-3 / std::sinh(0.5 * k) * std::exp(-0.05 * t);
        const double wave = std::sin(omega / 1.02 * t);
        at = {x[0] - s * wave * std::sin(k * x[0]) * std::cosh(k * x[1]),
              x[1] + s * wave * std::cos(k * x[0]) * std::sinh(k * x[1]), 0.0};
        v = {t == 0.0 ? 1e-3 : 0.0, 0.0, 0.0};
      },
      3.0);
  const FlowResult still = measure("standing_wave", flow, frames);
  EXPECT_NEAR(still.error, 0.02, 1e-5);
  EXPECT_NEAR(value(still, "period"), 0.02, 1e-5);
  EXPECT_NEAR(value(still, "decay_per_s"), 0.05, 1e-4);
  EXPECT_NEAR(value(still, "amplitude"), 0.0, 1e-3);
  flow.viscosity = 0.04 / (2.0 * k * k);
  EXPECT_NEAR(measure("viscous_wave", flow, frames).error, 0.25, 0.003);
}

TEST(Patch, TellsFreeFlightFromTheExactStart) {
  FlowCase flow = box_case(1.0, 1.0, 0.05);
  flow.lower = {-0.5, -0.5};
  flow.upper = {0.5, 0.5};
  flow.gradient = {{{0.0, -1.0}, {1.0, 0.0}}};
  const auto with = [&](double c) {
    return measure("rotating_patch", flow,
                   frames_of(lattice({-0.5, -0.5, 0}, {0.5, 0.5, 0}, 0.05),
                             [&](const Vec3& x, double t, Vec3& at, Vec3& v, double&) {
                               const double grow = std::sqrt(1.0 + c * t * t);
                               at = {x[0] * grow, x[1] * grow, 0.0};
                               v = {-x[1], x[0], 0.0};
                             }));
  };
  // Each particle is a square whose own inertia does not grow.
  EXPECT_NEAR(with(patch_spreading()).error, 0.0, 5e-4);
  const FlowResult flight = with(1.0);
  EXPECT_NEAR(value(flight, "spreading"), 1.0, 3e-3);
  EXPECT_NEAR(value(flight, "corner_distance"), 0.0, 1e-9);
  EXPECT_GT(*flight.volume, 0.3);
  EXPECT_NEAR(*flight.energy, 0.0, 1e-12);
}

TEST(CoveredArea, OfALatticeIsItsOwn) {
  ParticleFrame frame;
  frame.position = lattice({0, 0, 0}, {1, 1, 0}, 0.02);
  // Less than a quarter of a spacing more on each side, and no hole.
  EXPECT_GT(covered_area(frame, 0.02), 1.0);
  EXPECT_LT(covered_area(frame, 0.02), std::pow(1.0 + 0.5 * 0.02, 2));
}

TEST(Channel, ErrorIsThatOfTheVelocity) {
  FlowCase flow = box_case(1.0, 1.0, 0.05);
  flow.gravity = {0.8, 0.0};
  flow.viscosity = 0.1;
  const auto with = [&](double factor) {
    return measure("channel", flow,
                   frames_of(lattice({0, 0, 0}, {1, 1, 0}, 0.05),
                             [&](const Vec3& x, double t, Vec3& at, Vec3& v, double&) {
                               at = x;
                               v = {factor * channel_speed(0.8, 0.1, 1.0, x[1], t), 0.0, 0.0};
                             }));
  };
  EXPECT_NEAR(with(1.0).error, 0.0, 1e-12);
  EXPECT_NEAR(*with(1.0).momentum, 0.0, 2e-3);
  EXPECT_NEAR(*with(1.1).momentum, 0.1, 2e-3);
  EXPECT_NEAR(*with(1.1).energy, 0.21, 5e-3);
  EXPECT_GT(with(1.1).error, 0.02);
  EXPECT_LT(with(1.1).error, 0.1);
}

TEST(ObservedOrder, OfAPower) {
  EXPECT_NEAR(*observed_order(0.04, 1.6e-3, 0.02, 4e-4), 2.0, 1e-12);
  EXPECT_FALSE(observed_order(0.04, 0.0, 0.02, 1e-3));
  EXPECT_FALSE(observed_order(0.02, 1e-3, 0.02, 1e-3));
}

/// A study of nothing but a known flow, on the disk.
class VerificationStudy {
 public:
  VerificationStudy() {
    std::string study = "title = \"Known flows\"\n";
    for (const auto& [name, spacing] :
         {std::pair{"still-a", 0.01}, std::pair{"still-b", 0.005}, std::pair{"gone", 0.0025}}) {
      study += "[[run]]\nname = \"" + std::string(name) +
               "\"\nprogram = \"surge-particle\"\ncase = \"c.toml\"\nrole = \"verification\"\n"
               "group = \"hydrostatic_tank\"\n";
      if (std::string(name) != "gone") write(name, spacing);
    }
    testing::write_text(folder_ / "study.toml", study);
  }

  void write(const std::string& name, double spacing) const {
    nlohmann::json manifest = testing::dam_break_manifest();
    manifest["case"]["spacing"] = spacing;
    manifest["case"]["time"] = {{"end", 0.3}};
    manifest["case"]["blocks"][0]["velocity_gradient"] =
        std::vector<std::vector<double>>(3, std::vector<double>(3, 0.0));
    manifest["case"]["blocks"][0]["wave_amplitude"] = 0.0;
    testing::write_run(
        folder_ / ("runs/" + name), {0.0, 0.1, 0.2, 0.3},
        [spacing](double) { return 0.15 + spacing; }, manifest);
  }

  [[nodiscard]] StudyResult collected() const {
    return collect(read_study(folder_ / "study.toml"), folder_ / "runs", folder_ / "none");
  }
  [[nodiscard]] std::filesystem::path out() const { return folder_ / "report"; }

 private:
  testing::TemporaryFolder folder_;
};

TEST(VerificationReport, NeedsNoReferenceRun) {
  const VerificationStudy files;
  const StudyResult study = files.collected();
  EXPECT_FALSE(study.has_reference());
  ASSERT_EQ(study.flows.size(), 2U);
  const auto sequences = levels_of(study, "hydrostatic_tank");
  ASSERT_EQ(sequences.size(), 1U);
  EXPECT_EQ(sequences[0].label, "MPS paper");
  EXPECT_EQ(sequences[0].levels[0].run, "still-a") << "coarse first";
  std::string warnings;
  const nlohmann::json metrics = write_report(study, files.out(), warnings);
  EXPECT_EQ(warnings, "");
  const std::string page = testing::read_text(files.out() / "index.html");
  EXPECT_TRUE(vtkSmartPointer<vtkXMLDataElement>::Take(
                  vtkXMLUtilities::ReadElementFromString(page.c_str())) != nullptr);
  EXPECT_THAT(page, HasSubstr("verification_hydrostatic_tank"));
  EXPECT_THAT(page, HasSubstr("<code>gone</code>: missing"));
  const auto& levels = metrics["verification"]["hydrostatic_tank"]["sequences"][0]["levels"];
  ASSERT_EQ(levels.size(), 2U);
  EXPECT_GT(levels[0]["error"].get<double>(), 0.0);
  EXPECT_TRUE(levels[0]["order"].is_null());
  EXPECT_TRUE(levels[1]["order"].is_number());
  EXPECT_THAT(summary_table(study, metrics), HasSubstr("still-b"));
}

TEST(MeasureFlow, NamesWhatIsWrong) {
  const VerificationStudy files;
  const StudyResult study = files.collected();
  const RunResult& run = *study.runs_of(Role::verification).front();
  const auto refused = [&](const std::string& group, const nlohmann::json& manifest) {
    return error_of([&] { static_cast<void>(measure_flow(group, run.folder, manifest)); });
  };
  EXPECT_THAT(refused("tank", run.manifest), HasSubstr("found \"tank\", expected one of hydro"));
  EXPECT_THAT(refused("stretching_drop", run.manifest), HasSubstr("expected (-A x, A y)"));
  EXPECT_THAT(refused("hydrostatic_tank", nlohmann::json::object()), HasSubstr("manifest.json"));
}

}  // namespace
}  // namespace surge::compare
