#include "compare/figures/figures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <numbers>

#include "compare/figures/water.hpp"
#include "synthetic_study.hpp"

namespace surge::compare {
namespace {

using testing::error_of;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::read_text;
using ::testing::StartsWith;
using testing::SyntheticStudy;
using testing::TemporaryFolder;

void expect_drawn(const std::filesystem::path& folder, const std::string& name) {
  const std::string svg = read_text(folder / (name + ".svg"));
  EXPECT_TRUE(vtkSmartPointer<vtkXMLDataElement>::Take(
                  vtkXMLUtilities::ReadElementFromString(svg.c_str())) != nullptr)
      << name;
  EXPECT_LT(svg.size(), 1000000U) << name;
  const std::string pdf = read_text(folder / (name + ".pdf"));
  EXPECT_THAT(pdf, StartsWith("%PDF-"));
  EXPECT_THAT(pdf.substr(pdf.size() - 16), HasSubstr("%%EOF"));
  EXPECT_LT(pdf.size(), 1000000U) << name;
}

TEST(Table, QuotesWordsAndWritesNumbersThatReadBack) {
  const TemporaryFolder folder;
  Table table{"t", {"word", "value"}, {}};
  table.add({std::string("a, \"b\""), 0.1});
  table.add({std::string("c"), std::numeric_limits<double>::infinity()});
  write_csv(table, folder.path());
  EXPECT_EQ(read_text(folder / "t.csv"), "word,value\n\"a, \"\"b\"\"\",0.1\nc,NaN\n");
}

TEST(Style, MapOfPressureGrowsBrighterSteadily) {
  double last = -1.0;
  for (int i = 0; i <= 100; ++i) {
    const Colour c = viridis(i / 100.0);
    const double brightness = 0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue;
    EXPECT_GE(brightness, last) << i;
    last = brightness;
  }
  EXPECT_EQ(viridis(-3.0).hex(), "#440154");
  EXPECT_EQ(viridis(7.0).hex(), "#fde725");
}

TEST(Image, DiscCoversItsArea) {
  Image image(0.0, 2.0, 0.0, 1.0, 100.0);
  image.disc(0.7, 0.4, 0.25, {10, 20, 30});
  double covered = 0.0;
  for (int i = 0; i < 200; ++i) {
    for (int j = 0; j < 100; ++j) covered += image.at((i + 0.5) / 100, (j + 0.5) / 100)[3] / 255.0;
  }
  EXPECT_NEAR(covered / 1e4, std::numbers::pi * 0.25 * 0.25, 1e-3);
  EXPECT_EQ(image.at(0.7, 0.4), (std::array<std::uint8_t, 4>{10, 20, 30, 255}));
  EXPECT_EQ(image.at(0.7, 0.9)[3], 0);
}

TEST(Image, AdjoiningRectanglesNeitherOverlapNorLeaveAGap) {
  Image image(0.0, 1.0, 0.0, 1.0, 37.0);
  for (int i = 0; i < 10; ++i) image.rectangle(i / 10.0, (i + 1) / 10.0, 0.0, 1.0, {}, 0.5);
  for (int i = 0; i < 37; ++i) EXPECT_EQ(image.at((i + 0.5) / 37.0, 0.5)[3], 128) << i;
}

TEST(WaterPicture, MeshSurfaceLiesWhereHalfTheCellIsWater) {
  const double edge = 0.2345;  // m
  MeshFrame frame = testing::box_mesh(
      {0.58, 0.29, 0.01}, {58, 29, 1}, [&](const Vec3& x) { return x[0] < edge ? 1.0 : 0.0; }, 100);
  vtkNew<vtkDoubleArray> pressure;
  pressure->SetName("p");
  for (std::size_t i = 0; i < frame.alpha.size(); ++i) pressure->InsertNextValue(1422.45);
  frame.grid->GetCellData()->AddArray(pressure);
  compare::Run run;
  run.physics = testing::dam_break();
  const WaterPicture picture = water_picture(frame, run);
  ASSERT_FALSE(picture.surface.empty());
  for (const auto& s : picture.surface) {
    EXPECT_NEAR(s.x0 * 0.145, edge, 0.01) << s.y0;  // corner means smear over one cell
    EXPECT_NEAR(s.x1 * 0.145, edge, 0.01);
  }
  // rho g H = 1000 * 9.81 * 0.29 Pa.
  EXPECT_NEAR(picture.patches.front().pressure, 1422.45 / 2844.9, 1e-12);
  EXPECT_NEAR(picture.height_of(0.5), 1.0, 0.07);
  EXPECT_NEAR(picture.part_above(1.0), 0.5, 0.03);
}

TEST(WaterPicture, WithoutPressureIsAnError) {
  const MeshFrame frame = testing::box_mesh({1, 1, 1}, {2, 2, 1}, [](const Vec3&) { return 1.0; });
  compare::Run run;
  run.path = "somewhere";
  run.physics = testing::dam_break();
  EXPECT_THAT(error_of([&] { static_cast<void>(water_picture(frame, run)); }),
              HasSubstr("somewhere: no cell array p"));
}

TEST(Draw, GnuplotsOwnMessageIsTheError) {
  const TemporaryFolder folder;
  Figure figure;
  figure.name = "bad";
  figure.script = "plot nonsense(x)\n";
  EXPECT_THAT(error_of([&] { static_cast<void>(draw(figure, folder.path())); }),
              HasSubstr("undefined function: nonsense"));
}

TEST(Draw, LabelsAreShownAsTheyAre) {
  const TemporaryFolder folder;
  Figure figure;
  figure.name = "label";
  figure.script = "set label 1 " + plot_label("a_b^{c} \"d\" @e <f>") + " at 0,0\nplot [-1:1] x\n";
  EXPECT_EQ(draw(figure, folder.path()), "");
  EXPECT_THAT(read_text(folder / "label.svg"), HasSubstr("a_b^{c} \"d\" @e &lt;f>"));
  expect_drawn(folder.path(), "label");
}

TEST(Figures, AllAreDrawnWithTheirLabelsAndData) {
  const SyntheticStudy files;
  const StudyResult study = files.collected();
  for (const auto& definition : all_figures()) {
    const Figure figure = definition.make(study);
    EXPECT_EQ(figure.name, definition.name);
    EXPECT_EQ(draw(figure, files.out()), "") << figure.name;
    expect_drawn(files.out(), figure.name);
    for (const auto& table : figure.tables)
      EXPECT_FALSE(table.rows.empty() && table.name != "fig7_surface");
  }
  const std::string fig8 = read_text(files.out() / "fig8.svg");
  EXPECT_THAT(fig8, HasSubstr("MPS paper, l0 = 5 mm"));
  EXPECT_THAT(fig8, HasSubstr("Late series"));
  EXPECT_THAT(fig8, HasSubstr("end of window"));
  EXPECT_THAT(read_text(files.out() / "fig6.svg"), HasSubstr("0.58 m"));
  EXPECT_THAT(read_text(files.out() / "fig7.svg"), HasSubstr("0.05 s"));
}

TEST(Figures, LeadingEdgeDrawsTheCurves) {
  const SyntheticStudy files;
  const Figure figure = leading_edge_figure(files.collected());
  EXPECT_EQ(draw(figure, files.out()), "");
  // A curve is one path with a vertex per frame: none of the three may be empty.
  const std::string svg = read_text(files.out() / "fig8.svg");
  for (const char* colour : {"rgb(  0, 114, 178)", "rgb(213,  94,   0)", "rgb(  0,   0,   0)"}) {
    std::size_t longest = 0;
    for (auto at = svg.find(colour); at != std::string::npos; at = svg.find(colour, at + 1)) {
      const auto path = svg.find(" d='", at);
      if (path == std::string::npos) break;
      longest = std::max(longest, svg.find("'", path + 4) - path);
    }
    EXPECT_GT(longest, 150U) << colour;
  }
}

TEST(Figures, DifferenceToTheReferenceIsTheKnownLead) {
  const SyntheticStudy files;
  const Figure figure = leading_edge_figure(files.collected());
  const Table& differences = figure.tables.at(1);
  std::size_t checked = 0;
  for (const auto& row : differences.rows) {
    if (std::get<double>(row[1]) == 0.0) continue;
    const double lead = std::get<std::string>(row[0]) == "mps-a" ? 0.02 : -0.05;
    EXPECT_NEAR(std::get<double>(row[2]), lead, 1e-6);
    ++checked;
  }
  EXPECT_GT(checked, 20U);
}

TEST(Figures, ShiftOfAPublishedSeriesIsFoundAndStated) {
  const SyntheticStudy files;
  const Figure figure = shifted_leading_edge_figure(files.collected());
  EXPECT_THAT(figure.script, HasSubstr("Late series, T − 0.20"));
  EXPECT_THAT(leading_edge_figure(files.collected()).script, Not(HasSubstr("T − ")));
}

TEST(Figures, MissingAndEndedRunsKeepTheirPanels) {
  const SyntheticStudy files;
  std::filesystem::remove_all(files.runs() / "mps-a");
  std::filesystem::remove_all(files.runs() / "sph-a");
  files.write("sph-a", "sph", 0.0, false);
  const Figure figure = snapshot_figure(files.collected());
  EXPECT_THAT(figure.script, HasSubstr("\"missing\""));
  EXPECT_THAT(figure.script, HasSubstr("\"ends at 0.1 s\""));
  EXPECT_THAT(leading_edge_figure(files.collected()).script, HasSubstr("(ends at 0.1 s)"));
}

TEST(Figures, AreFoundByNumberAndName) {
  EXPECT_EQ(find_figure("8").name, "fig8");
  EXPECT_EQ(find_figure("fig8_shifted").name, "fig8_shifted");
  EXPECT_THAT(error_of([] { static_cast<void>(find_figure("88")); }),
              HasSubstr("found \"88\", expected one of fig6"));
}

}  // namespace
}  // namespace surge::compare
