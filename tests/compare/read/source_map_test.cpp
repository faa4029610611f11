#include <gmock/gmock.h>

#include "compare/read/particle_fields.hpp"
#include "particle/support/toml.hpp"
#include "tests/compare/foreign_hdf5_writers.hpp"
#include "tests/compare/foreign_text_writers.hpp"
#include "tests/compare/foreign_vtk_writers.hpp"

namespace surge::compare {
namespace {

using testing::error_of;
using testing::expect_known_front;
using ::testing::HasSubstr;
using testing::TemporaryFolder;
using testing::write_text;

SourceOptions map_of(const TemporaryFolder& folder, const std::string& text) {
  return read_source_map(write_text(folder / "map.toml", text));
}

TEST(SourceMap, TableWithATimeColumnAndUnitsIsRead) {
  for (const char* separator : {",", ";", "\t", "  "}) {
    const TemporaryFolder folder;
    testing::write_time_table(folder / "all.csv", separator);
    const SourceOptions options = map_of(folder, R"(
spacing = 0.01
gravity = 9.81
position_array = ["px", "py"]
velocity_array = ["vx", "vy"]
pressure_array = "p"
type_array = "kind"
fluid_type = 1
length_unit = "mm"
pressure_unit = "kPa"
)");
    (void)expect_known_front(folder / "all.csv", options);
  }
}

TEST(SourceMap, Hdf5WithGroupsForTheTimesIsRead) {
  const TemporaryFolder folder;
  testing::write_h5part(folder / "run.h5part");
  const SourceOptions options = map_of(folder, R"(
spacing = 0.01
gravity = 9.81
groups = "Step#*"
position_array = ["x", "y"]
velocity_array = ["vel_x", "vel_y"]
pressure_array = "p"
type_array = "kind"
fluid_type = ["1-3", 4]
)");
  (void)expect_known_front(folder / "run.h5part", options);
}

TEST(SourceMap, FluidAndWallsAreNamedByPatterns) {
  const TemporaryFolder folder;
  testing::write_trixi(folder.path());
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("fluid_1_"))
      std::filesystem::rename(entry.path(), folder / ("a" + name.substr(7)));
    if (name.starts_with("boundary"))
      std::filesystem::rename(entry.path(), folder / ("b" + name.substr(10)));
  }
  SourceOptions options = testing::foreign_facts();
  EXPECT_THAT(error_of([&] { (void)open_run(folder.path(), options); }),
              HasSubstr("2 series of files found"));
  options.files = {"a_*.vtu"};
  (void)expect_known_front(folder.path(), options);
  options.files.clear();
  options.walls = {"b_*.vtu"};
  (void)expect_known_front(folder.path(), options);
}

TEST(SourceMap, AxesMapTheFilesAxesToTheSurgeAndUp) {
  // The surge goes along -y, z is up, as files of x-z codes turned by 90 degrees have it.
  const TemporaryFolder folder;
  for (int i = 0; i < testing::ForeignFlow::frames; ++i) {
    auto p = testing::ForeignFlow().particles(i, 0, std::nullopt);
    for (Vec3& x : p.position) x = {0.5, -x[0], x[1]};
    for (Vec3& v : p.velocity) v = {0.0, -v[0], v[1]};
    testing::write_vtu(folder / ("f_" + std::to_string(i) + ".vtu"), p.position,
                       testing::data_array("v", "Float64", 3, p.velocity) +
                           testing::data_array("p", "Float64", 1, p.pressure),
                       "Time", 0.02 * i);
  }
  const std::string facts = R"(
spacing = 0.01
gravity = 9.81
velocity_array = "v"
pressure_array = "p"
)";
  (void)expect_known_front(folder.path(), map_of(folder, facts + "axes = [\"-y\", \"z\"]"));
  const auto run = open_run(folder.path(), map_of(folder, facts + "axes = [\"-y\", \"-z\"]"));
  EXPECT_THAT(run.notices, ::testing::Contains(HasSubstr("cannot rise along the axis")));
}

TEST(FileAxes, AreRightHanded) {
  const auto axes = [](const std::vector<std::string>& words) {
    return FileAxes::parse(words, "axes");
  };
  EXPECT_EQ(axes({"x", "y"}).apply({1, 2, 3}), (Vec3{1, 2, 3}));
  EXPECT_EQ(axes({"x", "z"}).apply({1, 2, 3}), (Vec3{1, 3, -2}));
  EXPECT_EQ(axes({"-y", "z"}).apply({1, 2, 3}), (Vec3{-2, 3, -1}));
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"x"}, {"x", "x"}, {"x", "w"}, {"x", "--z"}, {}})
    EXPECT_THAT(error_of([&] { (void)axes(words); }), HasSubstr("axes: found"));
}

TEST(TypeValues, AreListsAndRanges) {
  const auto values = TypeValues::parse(std::vector<std::string>{"1-3", "-1", "7"}, "x");
  for (const double in : {1.0, 2.0, 3.0, -1.0, 7.0}) EXPECT_TRUE(values.contain(in));
  for (const double out : {0.0, 4.0, 1.5, 6.0, std::nan("")}) EXPECT_FALSE(values.contain(out));
  EXPECT_EQ(values.text(), "1-3,-1,7");
  for (const std::string word : {"1-", "3-1", "1.5", "", "-a", "1a"})
    EXPECT_THAT(
        error_of([&] { (void)TypeValues::parse(std::vector<std::string>{word}, "fluid_type"); }),
        HasSubstr("fluid_type: found"));
}

TEST(TypeValues, MayBeWords) {
  SourceOptions options;
  set_source_option(options, "fluid_type", std::vector<std::string>{"water", "Oil_2"}, "x", "");
  const FluidTypes types(options);
  EXPECT_EQ(types.text(), "water,Oil_2");
  ParticleArray stuff{"stuff", 1, "", {}};
  for (const char* word : {"water", "Water", "Oil_2", "wall", "water"}) stuff.add_word(word);
  EXPECT_EQ(types.fluid(stuff, "f"), (std::vector<bool>{true, false, true, false, true}));
  const ParticleArray number{"type", 1, "int", {0.0, 1.0}};
  EXPECT_THAT(error_of([&] { (void)types.fluid(number, "f"); }), HasSubstr("numbers found"));
  EXPECT_EQ(FluidTypes(SourceOptions{}).fluid(number, "f"), (std::vector<bool>{true, false}));
  EXPECT_THAT(error_of([&] { (void)FluidTypes(SourceOptions{}).fluid(stuff, "f"); }),
              HasSubstr("words found, fluid_type \"0\" expected"));
  EXPECT_THAT(error_of([&] {
                (void)TypeValues::parse(std::vector<std::string>{"1", "water"}, "x");
              }),
              HasSubstr("x: found \"water\""));
}

TEST(SourceMap, ErrorsNameFileLineAndKey) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& text) {
    return error_of([&] { (void)map_of(folder, text); });
  };
  EXPECT_THAT(refused("spacing = 0.01\nspacin = 1\n"),
              ::testing::AllOf(HasSubstr("map.toml:2: spacin"), HasSubstr("\"spacing\"")));
  EXPECT_THAT(refused("fluid-type = 3"), HasSubstr("did you mean \"fluid_type\""));
  EXPECT_THAT(refused("\nspacing = -1"), HasSubstr("map.toml:2: spacing: found \"-1\""));
  EXPECT_THAT(refused("gravity = nan"), HasSubstr("positive number"));
  EXPECT_THAT(refused("length_unit = \"inch\""), HasSubstr("one of cm, m, mm, um"));
  EXPECT_THAT(refused("format = \"xyz\""), HasSubstr("vtk, csv, hdf5 or lammps"));
  EXPECT_THAT(refused("spacing = [1, 2]"), HasSubstr("a positive number"));
  EXPECT_THAT(refused("spacing = {a = 1}"), HasSubstr("expected a number, a text"));
  EXPECT_THAT(refused("vertical = \"z\"\naxes = [\"x\", \"z\"]"), HasSubstr("both given"));
  EXPECT_THAT(error_of([&] { (void)read_source_map(folder / "none.toml"); }),
              HasSubstr("none.toml"));
}

TEST(SourceOptions, TableOfAStudyMayNameAMapAndChangeAFactOfIt) {
  const TemporaryFolder folder;
  write_text(folder / "code.toml", "spacing = 0.01\ngravity = 9.81\n");
  write_text(folder / "study.toml", "read = {map = \"code.toml\", spacing = 0.02}\n");
  const TomlTable study = TomlTable::read(folder / "study.toml");
  const SourceOptions options = source_options(study.table("read"));
  EXPECT_EQ(options.spacing->value(), 0.02);
  EXPECT_EQ(*options.gravity, 9.81);
  study.finish();
}

TEST(SourceKeys, EachIsAnOptionOnce) {
  std::set<std::string> names;
  for (const SourceKey& key : source_keys()) {
    EXPECT_TRUE(names.insert(key.name).second) << key.name;
    EXPECT_FALSE(key.help.empty());
  }
  EXPECT_TRUE(names.contains("fluid_type"));
}

}  // namespace
}  // namespace surge::compare
