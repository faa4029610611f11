#include "particle/case/stl_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstring>
#include <limits>

#include "particle/case/case_file.hpp"
#include "particle/support/error.hpp"
#include "tests/case/case_fixture.hpp"
#include "tests/case/surface_fixture.hpp"

namespace surge {
namespace {

using testing::HasSubstr;

class StlFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) /
              ("stl" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::filesystem::path put(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  [[nodiscard]] std::string refusal(const std::string& text) const {
    try {
      static_cast<void>(read_stl(put("bad.stl", text), 1.0));
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  /// The box from (0, 0, 0) to (0.1, 0.2, 0.3).
  static std::string ascii() {
    const auto [vertices, facets] = test::cube_triangles({0, 0, 0}, {0.1, 0.2, 0.3});
    std::ostringstream text;
    text << "solid a box\n";
    for (const auto& facet : facets) {
      text << "facet normal 0 0 0\nouter loop\n";
      for (const auto v : facet)
        text << "vertex " << vertices[v][0] << ' ' << vertices[v][1] << ' ' << vertices[v][2]
             << '\n';
      text << "endloop\nendfacet\n";
    }
    return text.str() + "endsolid a box\n";
  }
  static std::string binary() {
    const auto [vertices, facets] = test::cube_triangles({0, 0, 0}, {0.1, 0.2, 0.3});
    std::string bytes(80, ' ');
    bytes.replace(0, 5, "solid");  // as some programs begin binary files
    const auto put_bytes = [&](const auto& value) {
      bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    put_bytes(static_cast<std::uint32_t>(facets.size()));
    for (const auto& facet : facets) {
      for (int k = 0; k < 3; ++k) put_bytes(0.0F);
      for (const auto v : facet)
        for (const double entry : vertices[v]) put_bytes(static_cast<float>(entry));
      put_bytes(std::uint16_t{0});
    }
    return bytes;
  }
  std::filesystem::path folder_;
};

TEST_F(StlFile, AsciiAndBinaryGiveTheSameBody) {
  const ClosedSurface one = read_stl(put("a.stl", ascii()), 1.0);
  const ClosedSurface other = read_stl(put("b.stl", binary()), 1.0);
  EXPECT_EQ(one.vertices().size(), 8U);
  EXPECT_EQ(one.facets().size(), 12U);
  EXPECT_NEAR(one.volume(), 0.006, 1e-15);
  EXPECT_EQ(one.vertices(), other.vertices());
  EXPECT_EQ(one.facets(), other.facets());
}

TEST_F(StlFile, ScaleMakesMetresOfMillimetres) {
  EXPECT_NEAR(read_stl(put("a.stl", ascii()), 1e-3).bounds().upper[2], 3e-4, 1e-18);
}

TEST_F(StlFile, FilesThatAreNoneAreRefusedInOneLine) {
  EXPECT_THAT(refusal("hello"), HasSubstr("expected an STL file, ascii or binary"));
  EXPECT_THAT(refusal(""), HasSubstr("expected an STL file"));
  EXPECT_THAT(refusal("solid x\nendsolid x\n"), HasSubstr("found 0 triangles"));
  const std::string whole = ascii();
  EXPECT_THAT(refusal(whole.substr(0, whole.rfind("endsolid"))),
              HasSubstr("found the end of the file, expected \"facet\" or \"endsolid\""));
  EXPECT_THAT(refusal(whole.substr(0, whole.rfind("endfacet"))),
              HasSubstr("found the end of the file, expected \"endfacet\""));
  EXPECT_THAT(refusal(binary().substr(0, 300)), HasSubstr("bad.stl"));
  std::string word = ascii();
  word.replace(word.find("vertex 0"), 8, "vertex x");
  EXPECT_THAT(refusal(word), HasSubstr("bad.stl:4: found \"x\", expected a number"));
  std::string nan = ascii();
  nan.replace(nan.find("vertex 0"), 8, "vertex nan");
  EXPECT_THAT(refusal(nan), HasSubstr("triangle 1: found a number that is not finite"));
  std::string infinite = binary();
  const float huge = std::numeric_limits<float>::infinity();
  std::memcpy(infinite.data() + 84 + 12, &huge, 4);
  EXPECT_THAT(refusal(infinite), HasSubstr("not finite"));
  std::string flipped = ascii();
  flipped.replace(flipped.find("normal 0 0 0"), 12, "normal 0 0 1");  // the first faces down
  EXPECT_THAT(refusal(flipped), HasSubstr("a normal against the order of the corners"));
  EXPECT_THAT(refusal(ascii() + "junk\n"), HasSubstr("\"junk\""));
}

TEST_F(StlFile, MissingFilesFoldersAndPipesAreRefused) {
  const auto fault = [&](const std::filesystem::path& file) -> std::string {
    try {
      static_cast<void>(read_stl(file, 1.0));
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(fault(folder_ / "none.stl"), HasSubstr("none.stl: found no such file"));
  EXPECT_THAT(fault(folder_), HasSubstr("expected an STL file"));
  const auto pipe = folder_ / "pipe.stl";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(fault(pipe), HasSubstr("expected an STL file"));
}

TEST_F(StlFile, CaseHoldsTheGeometryItself) {
  const std::string text = R"(title = "box"
dimension = 3
[fluid]
density = 1000.0
gravity = [0.0, 0.0, -9.81]
[tank]
lower = [0.0, 0.0, 0.0]
upper = [0.6, 0.2, 0.6]
[[block]]
shape = "box"
lower = [0.3, 0.0, 0.0]
upper = [0.6, 0.2, 0.2]
[[obstacle]]
stl = "a.stl"
[resolution]
spacing = 0.02
[time]
end = 0.1
[output]
interval = 0.1
[method]
name = "sph"
preset = "paper"
)";
  static_cast<void>(put("a.stl", ascii()));
  const auto file = put("case.toml", text);
  const Computation computation = read_computation(file, {});
  const std::string resolved = to_toml(computation.flow);
  EXPECT_THAT(resolved, HasSubstr("triangles = [[0,1,2]"));
  static_cast<void>(put("a.stl", "gone"));
  std::string again = resolved + "\n[method]\nname = \"sph\"\npreset = \"paper\"\n";
  const Case copy = parse_computation(again, "again.toml", {}).flow;
  ASSERT_TRUE(copy.obstacles.at(0).surface);
  EXPECT_EQ(copy.obstacles[0].surface->vertices(),
            computation.flow.obstacles[0].surface->vertices());
  EXPECT_EQ(to_toml(copy), resolved);
}

}  // namespace
}  // namespace surge
