#include <gmock/gmock.h>
#include <sys/stat.h>

#include "compare/read/foam_file.hpp"
#include "tests/compare/foam_dam.hpp"

namespace surge::compare {
namespace {

using testing::bytes_of;
using testing::error_of;
using testing::foam_tank;
using testing::foam_water;
using testing::FoamCaseWriter;
using testing::FoamLayout;
using ::testing::HasSubstr;
using testing::TemporaryFolder;
using testing::write_text;

namespace fs = std::filesystem;

/// Cases that are damaged in one known place, and what is said of each.
class FoamHostile : public ::testing::Test {
 protected:
  void write(const FoamLayout& layout = {}) const {
    FoamCaseWriter(path(), foam_tank(), layout).write(foam_water);
  }
  [[nodiscard]] fs::path path() const { return folder_ / "case"; }
  void change(const std::string& file, const std::string& from, const std::string& to) const {
    std::string text = bytes_of(path() / file);
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << file << ": " << from;
    text.replace(at, from.size(), to);
    write_text(path() / file, text);
  }
  [[nodiscard]] std::string refusal() const {
    return error_of([&] {
      auto run = open_run(path());
      (void)measure_front(run, {});
    });
  }

  TemporaryFolder folder_;
};

TEST_F(FoamHostile, PipesDevicesLinksAndSparseFilesAreRefused) {
  write();
  const fs::path faces = path() / "constant/polyMesh/faces";
  fs::copy_file(faces, folder_ / "outside");
  fs::remove(faces);
  ASSERT_EQ(::mkfifo(faces.c_str(), 0600), 0);
  EXPECT_THAT(refusal(), HasSubstr("faces: no regular file"));
  fs::remove(faces);
  fs::create_symlink("/dev/zero", faces);
  EXPECT_THAT(refusal(), HasSubstr("leads out of"));
  fs::remove(faces);
  fs::create_symlink(folder_ / "outside", faces);
  EXPECT_THAT(refusal(), HasSubstr("leads out of"));
  fs::remove(faces);
  write_text(faces, "FoamFile { format ascii; }\n");
  fs::resize_file(faces, std::uintmax_t{1} << 30U);
  EXPECT_THAT(refusal(), HasSubstr("a sparse file"));
  fs::resize_file(faces, std::uintmax_t{1} << 40U);
  EXPECT_THAT(refusal(), HasSubstr("at most expected"));
  fs::remove(faces);
  fs::create_directory(faces);
  EXPECT_THAT(refusal(), HasSubstr("no regular file"));
  fs::remove(faces);
  fs::copy_file(folder_ / "outside", faces);
  write_text(faces.string() + ".gz", "x");
  EXPECT_THAT(refusal(), HasSubstr("faces: there is faces.gz besides"));
}

TEST_F(FoamHostile, MeshesThatDoNotFitAreNamed) {
  const std::string mesh = "constant/polyMesh/";
  const auto refused = [&](const std::string& file, const std::string& from,
                           const std::string& to) {
    write();
    change(mesh + file, from, to);
    return refusal();
  };
  EXPECT_THAT(refused("points", "1722\n(", "1723\n("), HasSubstr("points:"));
  EXPECT_THAT(refused("points", "1722\n(", "99999999\n("),
              HasSubstr("points: ends before 99999999 values"));
  EXPECT_THAT(refused("points", "(0.01 ", "(nan "), HasSubstr("\"nan\" found, not finite"));
  EXPECT_THAT(refused("faces", "\n4(", "\n5("), HasSubstr("faces:"));
  EXPECT_THAT(refused("faces", "\n4(", "\n4(9999"), HasSubstr("found, 0 to 1721"));
  EXPECT_THAT(refused("owner", "\n(\n0", "\n(\n-7"), HasSubstr("cell -7 found"));
  EXPECT_THAT(refused("owner", "\n(\n0", "\n(\n2000000000"), HasSubstr("fewer cells expected"));
  EXPECT_THAT(refused("neighbour", "\n(\n1", "\n(\n9"), HasSubstr("cell"));
  EXPECT_THAT(refused("boundary", "nFaces 120", "nFaces 119"), HasSubstr("boundary:"));
  EXPECT_THAT(refused("boundary", "startFace", "start"), HasSubstr("no nFaces and startFace"));
  EXPECT_THAT(refused("owner", "nCells:800", "nCells:801"), HasSubstr("files of two meshes?"));
  // A note that ends where its number should stand says nothing.
  write();
  change(mesh + "owner", "nInternalFaces:1540", "nInternalFaces:");
  EXPECT_NO_THROW(static_cast<void>(open_run(path())));
  write();
  fs::resize_file(path() / "constant/polyMesh/faces", 5000);
  EXPECT_THAT(refusal(), HasSubstr("faces: ends before"));
}

TEST_F(FoamHostile, FieldsThatDoNotFitAreNamed) {
  const auto refused = [&](const std::string& from, const std::string& to) {
    write();
    change("0.1/alpha.water", from, to);
    return refusal();
  };
  EXPECT_THAT(refused("800\n(\n1", "799\n("), HasSubstr("799 values found, 800 cells expected"));
  EXPECT_THAT(refused("800\n(", "800000\n("), HasSubstr("0.1/alpha.water: ends before"));
  EXPECT_THAT(refused("800\n(\n1", "800\n(\n7"), HasSubstr("7 in cell 0, a volume fraction"));
  EXPECT_THAT(refused("800\n(\n1", "800\n(\ninf"), HasSubstr("not finite"));
  EXPECT_THAT(refused("volScalarField", "volVectorField"), HasSubstr("volScalarField expected"));
  EXPECT_THAT(refused("List<scalar>", "List<vector>"), HasSubstr("List<scalar> expected"));
  EXPECT_THAT(refused("nonuniform", "constant"), HasSubstr("uniform or nonuniform expected"));
  EXPECT_THAT(refused("boundaryField\n{", "boundaryField\n"), HasSubstr("0.1/alpha.water"));
  write({.binary = true});
  change("0.1/alpha.water", "label=32;scalar=64", "label=32;scalar=77");
  EXPECT_THAT(refusal(), HasSubstr("32 or 64 bits expected"));
  write({.binary = true});
  change("0.1/alpha.water", "LSB", "MSB");
  EXPECT_THAT(refusal(), HasSubstr("other byte order"));
}

TEST_F(FoamHostile, TimesThatAreExchangedAreRefused) {
  write();
  fs::rename(path() / "0.1", path() / "moved");
  fs::rename(path() / "0.2", path() / "0.1");
  fs::rename(path() / "moved", path() / "0.2");
  EXPECT_THAT(refusal(), HasSubstr("written for time"));
}

TEST_F(FoamHostile, ProcessorsThatAreExchangedOrOfAnotherCaseAreRefused) {
  write({.processors = 3});
  const auto exchange = [&](const std::string& a, const std::string& b) {
    fs::rename(path() / a, path() / "moved");
    fs::rename(path() / b, path() / a);
    fs::rename(path() / "moved", path() / b);
  };
  exchange("processor0", "processor1");
  EXPECT_THAT(refusal(), HasSubstr("folders of two processors exchanged?"));
  exchange("processor0", "processor1");
  exchange("processor0/0.1/alpha.water", "processor2/0.1/alpha.water");
  EXPECT_THAT(refusal(), HasSubstr("0.1/alpha.water"));
  exchange("processor0/0.1/alpha.water", "processor2/0.1/alpha.water");
  fs::remove_all(path() / "processor1");
  EXPECT_THAT(refusal(), HasSubstr("processor1 not there"));
  FoamLayout moved{.processors = 3};
  moved.place = [](Vec3 x) { return Vec3{2.0 * x[0], x[1], x[2]}; };
  FoamCaseWriter(folder_ / "other", foam_tank(), moved).write(foam_water);
  fs::copy(folder_ / "other/processor1", path() / "processor1", fs::copy_options::recursive);
  EXPECT_THAT(refusal(), HasSubstr("lies elsewhere on the other side"));
}

TEST_F(FoamHostile, BlocksOfCollatedFilesAreComplete) {
  write({.processors = 3, .collated = true});
  const std::string file = "processors3/0.1/alpha.water";
  const std::string whole = bytes_of(path() / file);
  write_text(path() / file, whole.substr(0, whole.find("// Processor2")));
  EXPECT_THAT(refusal(), HasSubstr("alpha.water of 2 processors found, 3 expected"));
  write_text(path() / file, whole.substr(0, whole.size() - 100));
  EXPECT_THAT(refusal(), HasSubstr("ends before"));
  write_text(path() / file, whole);
  fs::rename(path() / "processors3", path() / "processors4");
  EXPECT_THAT(refusal(), HasSubstr("points of 3 processors found, 4 expected"));
}

TEST(FoamFile, CompressedFilesAreReadWhole) {
  const TemporaryFolder folder;
  std::string text;
  for (int k = 0; k < 20000; ++k) text += std::to_string(k * k) + "\n";
  testing::write_packed(folder / "a.gz", text);
  EXPECT_TRUE(has_foam_file(folder / "a"));
  EXPECT_EQ(read_foam_file(folder / "a", folder.path()), text);
  std::string packed = bytes_of(folder / "a.gz");
  write_text(folder / "a.gz", packed.substr(0, packed.size() / 2));
  EXPECT_THROW((void)read_foam_file(folder / "a", folder.path()), FoamCutShort);
  packed[packed.size() / 2] = static_cast<char>(packed[packed.size() / 2] ^ 1);
  write_text(folder / "a.gz", packed);
  EXPECT_THAT(error_of([&] { (void)read_foam_file(folder / "a", folder.path()); }),
              HasSubstr("cannot be unpacked"));
  write_text(folder / "a.gz", "not packed");
  EXPECT_THAT(error_of([&] { (void)read_foam_file(folder / "a", folder.path()); }),
              HasSubstr("a file made by gzip expected"));
}

}  // namespace
}  // namespace surge::compare
