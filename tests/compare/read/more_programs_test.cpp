#include <gmock/gmock.h>

#include "tests/compare/foreign_hdf5_writers.hpp"
#include "tests/compare/foreign_text_writers.hpp"
#include "tests/compare/foreign_vtk_writers.hpp"

namespace surge::compare {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using testing::error_of;
using testing::expect_known_front;
using testing::foreign_facts;
using testing::ForeignFlow;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::TemporaryFolder;

TEST(GpuSph, ParticlesOfItsCollectionAreReadAndPlanesLeftOut) {
  const TemporaryFolder folder;
  testing::write_gpusph(folder.path());
  const auto notices = expect_known_front(folder / "VTUinp.pvd", foreign_facts());
  EXPECT_THAT(notices, Contains(AllOf(HasSubstr("GPUSPH"), HasSubstr("Part type is 0"),
                                      HasSubstr("no fluid in PLANES.vtu"))));
  EXPECT_THAT(error_of([&] { (void)open_run(folder.path(), foreign_facts()); }),
              HasSubstr("name VTUinp.pvd"));
}

TEST(AquaGpuSph, MovingFlagTellsTheFluid) {
  const TemporaryFolder folder;
  testing::write_aquagpusph(folder.path());
  const auto notices = expect_known_front(folder / "set0.pvd", foreign_facts());
  EXPECT_THAT(notices, Contains(AllOf(HasSubstr("AQUAgpusph"), HasSubstr("imove is 1"))));
  EXPECT_THAT(error_of([&] { (void)open_run(folder.path(), foreign_facts()); }),
              HasSubstr("name the .pvd"));
}

TEST(Gadget, SnapshotsAreReadInTheirUnits) {
  const TemporaryFolder folder;
  testing::write_gadget(folder / "gadget", std::nullopt);
  EXPECT_THAT(expect_known_front(folder / "gadget", foreign_facts()),
              Contains(AllOf(HasSubstr("SWIFT and Gadget"), HasSubstr("fluid in PartType0"))));
  testing::write_gadget(folder / "swift", testing::GadgetUnits{0.01, 0.001, 0.5});
  EXPECT_THAT(expect_known_front(folder / "swift", foreign_facts()),
              Contains(HasSubstr("unit of length in m of 0.01 read from Units")));
}

TEST(Hdf5, TimeMayBeADataSet) {
  const TemporaryFolder folder;
  for (int i = 0; i < ForeignFlow::frames; ++i) {
    const auto p = ForeignFlow().particles(i, 0, std::nullopt);
    const testing::Hdf5Writer out(folder / ("f_" + std::to_string(i) + ".h5"));
    out.values("x", testing::component(p.position, 0));
    out.values("y", testing::component(p.position, 1));
    out.values("vel_x", testing::component(p.velocity, 0));
    out.values("vel_y", testing::component(p.velocity, 1));
    out.number("time", i * ForeignFlow::interval);
    out.number("clock", i * ForeignFlow::interval);
  }
  SourceOptions options = foreign_facts();
  options.velocity_array = {"vel_x", "vel_y"};
  (void)expect_known_front(folder.path(), options, false);
  options.time_array = "clock";
  (void)expect_known_front(folder.path(), options, false);
  options.time_array = "watch";
  EXPECT_THAT(error_of([&] { (void)open_run(folder.path(), options); }),
              HasSubstr("data set watch"));
}

TEST(Lammps, TiltOfZeroIsNoneAndScaledCoordinatesOfAnotherAreRefused) {
  const TemporaryFolder folder;
  SourceOptions options = foreign_facts();
  options.time_step = Seconds(1e-4);
  options.fluid_type = 1;
  const auto path = folder / "dump.lammpstrj";
  for (const bool scaled : {false, true}) {
    testing::write_lammps(folder.path(), {.scaled = scaled, .tilt = 0.0});
    (void)expect_known_front(path, options, false);
    testing::write_lammps(folder.path(), {.scaled = scaled, .tilt = 0.1});
    if (!scaled) (void)expect_known_front(path, options, false);
    if (scaled) {
      EXPECT_THAT(error_of([&] { (void)open_run(path, options); }), HasSubstr("tilted box"));
    }
  }
}

TEST(Lammps, PeriodAlongTheSurgeIsTold) {
  const TemporaryFolder folder;
  SourceOptions options = foreign_facts();
  options.time_step = Seconds(1e-4);
  options.fluid_type = 1;
  testing::write_lammps(folder.path(), {});
  EXPECT_THAT(expect_known_front(folder / "dump.lammpstrj", options, false),
              Not(Contains(HasSubstr("periodic"))));
  testing::write_lammps(folder.path(), {.bounds = "pp ff pp"});
  EXPECT_THAT(expect_known_front(folder / "dump.lammpstrj", options, false),
              Contains(HasSubstr("periodic along x")));
}

}  // namespace
}  // namespace surge::compare
