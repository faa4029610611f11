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
using ::testing::IsEmpty;
using testing::TemporaryFolder;

// Files laid out the way each program writes them need no option but what their files do not say.

SourceOptions stepped(double step) {
  SourceOptions options = foreign_facts();
  options.time_step = Seconds(step);
  return options;
}

TEST(DualSPHysics, RunFolderNeedsNoOption) {
  const TemporaryFolder folder;
  testing::write_dualsphysics_vtk(folder / "out/vtks");
  testing::write_dualsphysics_run(folder / "out");
  const auto notices = expect_known_front(folder / "out", {});
  EXPECT_THAT(notices, Contains(AllOf(HasSubstr("DualSPHysics"), HasSubstr("Type is 3"),
                                      HasSubstr("velocity Vel"), HasSubstr("z upwards"))));
  EXPECT_THAT(notices, Contains(HasSubstr("spacing 0.01 m read from Run.csv")));
  EXPECT_THAT(notices, Contains(HasSubstr("gravity 9.81 m/s2 read from Run.out")));
}

TEST(DualSPHysics, FolderOfFilesAsksForWhatIsElsewhere) {
  const TemporaryFolder folder;
  testing::write_dualsphysics_vtk(folder / "out/vtks");
  testing::write_dualsphysics_run(folder / "out");
  const std::string error = error_of([&] { (void)open_run(folder / "out/vtks"); });
  for (const char* part :
       {"--spacing", "nearest neighbours are 0.01", "--gravity", "--time-step", "--time-file",
        "302 particles", "Type (short, 1 component, 0 to 3: 0 x 102, 3 x 200)"})
    EXPECT_THAT(error, HasSubstr(part));
  SourceOptions options = foreign_facts();
  options.time_file = folder / "out/RunPARTs.csv";
  (void)expect_known_front(folder / "out/vtks", options);
  (void)expect_known_front(folder / "out/vtks", stepped(0.02));
}

TEST(DualSPHysics, SolversCsvIsRead) {
  const TemporaryFolder folder;
  testing::write_dualsphysics_csv(folder / "out/data");
  testing::write_dualsphysics_run(folder / "out");
  (void)expect_known_front(folder / "out", {}, false);
}

TEST(DualSPHysics, PartVtksCsvStatesItsTimeAboveTheTable) {
  for (const char* separator : {";", ","}) {
    const TemporaryFolder folder;
    testing::write_partvtk_csv(folder.path(), separator);
    (void)expect_known_front(folder.path(), foreign_facts());
  }
}

TEST(DualSPHysics, MeasuringToolsTableIsNoParticleFile) {
  const TemporaryFolder folder;
  testing::write_text(folder / "p_0.csv",
                      " ;PosX [m]:;0.1;0.2\n ;PosY [m]:;0;0\n ;PosZ [m]:;0.1;0.1\nPart;Time "
                      "[s];Press_0 [Pa];Press_1 [Pa]\n0;0;1;2\n1;0.02;1;2\n");
  EXPECT_THAT(error_of([&] { (void)open_run(folder / "p_0.csv", foreign_facts()); }),
              HasSubstr("values at points over time"));
}

TEST(PySph, FilesAreReadWithoutAMap) {
  const TemporaryFolder folder;
  testing::write_pysph(folder.path());
  const auto notices = expect_known_front(folder.path(), foreign_facts());
  EXPECT_THAT(notices, Contains(AllOf(HasSubstr("PySPH"), HasSubstr("particles/fluid"))));
}

TEST(Trixi, FluidIsReadAndBoundariesAreLeftOut) {
  const TemporaryFolder folder;
  testing::write_trixi(folder.path());
  const auto notices = expect_known_front(folder.path(), foreign_facts());
  EXPECT_THAT(notices, Contains(AllOf(HasSubstr("TrixiParticles"),
                                      HasSubstr("no fluid in boundary_1_*.vtu"))));
  (void)expect_known_front(folder / "fluid_1.pvd", foreign_facts());
  (void)expect_known_front(folder / "fluid_1_*.vtu", foreign_facts());
}

TEST(SphinXsys, NumbersAreMillionthsAndTheWallIsWrittenOnce) {
  for (const bool time_value : {false, true}) {
    const TemporaryFolder folder;
    testing::write_sphinxsys(folder.path(), time_value);
    const auto notices = expect_known_front(folder.path(), foreign_facts());
    EXPECT_THAT(notices, Contains(HasSubstr("no fluid in WallBoundary_*.vtp")));
    EXPECT_EQ(notices[0].find("millionths") == std::string::npos, time_value);
  }
}

TEST(SPlisHSPlasH, FramesStartAtOneAndTheRateIsAskedFor) {
  const TemporaryFolder folder;
  testing::write_splishsplash(folder.path());
  EXPECT_THAT(error_of([&] { (void)open_run(folder.path(), foreign_facts()); }),
              HasSubstr("25 frames per second"));
  (void)expect_known_front(folder.path(), stepped(0.02));
}

TEST(MpsBasic, AllThreeOutputsAreRead) {
  const TemporaryFolder folder;
  testing::write_mps_basic(folder / "vtu");
  testing::write_mps_basic_csv(folder / "csv");
  testing::write_mps_basic_prof(folder / "prof");
  EXPECT_THAT(expect_known_front(folder / "vtu", foreign_facts()),
              Contains(HasSubstr("fluid where Particle Type is 1")));
  (void)expect_known_front(folder / "csv", foreign_facts(), false);
  (void)expect_known_front(folder / "prof", foreign_facts(), false);
  EXPECT_THAT(error_of([&] { (void)open_run(folder.path(), foreign_facts()); }),
              HasSubstr("files of particles are in"));
}

TEST(PolyMps, TypeIsKnownAndTheTimeIsAskedFor) {
  const TemporaryFolder folder;
  testing::write_polymps(folder.path());
  EXPECT_THAT(error_of([&] { (void)open_run(folder.path(), foreign_facts()); }),
              HasSubstr("--time-step"));
  (void)expect_known_front(folder.path(), stepped(0.02));
}

TEST(OpenMps, ColumnsAreKnownAndTheTimeIsAskedFor) {
  const TemporaryFolder folder;
  testing::write_openmps(folder.path());
  EXPECT_THAT(error_of([&] { (void)open_run(folder.path(), foreign_facts()); }),
              HasSubstr("--time-step"));
  (void)expect_known_front(folder.path(), stepped(0.02));
}

TEST(Lammps, DumpsOfAllLayoutsAreRead) {
  for (const bool scaled : {false, true})
    for (const bool one_file : {false, true})
      for (const bool time : {false, true}) {
        const TemporaryFolder folder;
        testing::write_lammps(folder.path(), {scaled, one_file, time});
        const auto path = one_file ? folder / "dump.lammpstrj" : folder.path();
        SourceOptions options = time ? foreign_facts() : stepped(1e-4);
        EXPECT_THAT(error_of([&] { (void)open_run(path, options); }),
                    HasSubstr("--fluid-type: which values of type"));
        options.fluid_type = 1;
        (void)expect_known_front(path, options, false);
      }
}

TEST(Lammps, MissingStepIsAskedFor) {
  const TemporaryFolder folder;
  testing::write_lammps(folder.path(), {});
  EXPECT_THAT(error_of([&] { (void)open_run(folder / "dump.lammpstrj", foreign_facts()); }),
              HasSubstr("the seconds of one time step of the dump"));
}

}  // namespace
}  // namespace surge::compare
