#include "compare/figures/figures.hpp"

#include "compare/figures/method.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <set>

#include "compare/figures/water.hpp"
#include "tests/compare/synthetic_study.hpp"

namespace surge::compare {
namespace {

using testing::error_of;
using ::testing::HasSubstr;
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
    EXPECT_EQ(figure.missing.empty(), std::filesystem::exists(files.out() / (figure.name + ".svg")))
        << figure.name;
    if (!figure.missing.empty()) continue;
    expect_drawn(files.out(), figure.name);
    for (const auto& table : figure.tables)
      EXPECT_FALSE(table.rows.empty() && table.name != "fig7_surface");
    EXPECT_FALSE(figure.tables.empty()) << figure.name;
  }
  const std::string fig8 = read_text(files.out() / "fig8.svg");
  EXPECT_THAT(fig8, HasSubstr("MPS paper, l0 = 5 mm"));
  EXPECT_THAT(fig8, HasSubstr("Late series"));
  EXPECT_THAT(fig8, HasSubstr("end of window"));
  EXPECT_THAT(read_text(files.out() / "fig6.svg"), HasSubstr("0.58 m"));
  EXPECT_THAT(read_text(files.out() / "fig7.svg"), HasSubstr("0.05 s"));
}

TEST(Figures, SurfacesOfAllRunsStandInOnePanelPerTime) {
  const SyntheticStudy files;
  const StudyResult study = files.collected();
  const Figure figure = surface_figure(study);
  const Table& table = figure.tables.at(0);
  std::set<std::pair<std::string, double>> seen;
  for (const auto& row : table.rows)
    seen.emplace(std::get<std::string>(row[0]), std::get<double>(row[1]));
  EXPECT_EQ(seen.size(), study.runs.size() * study.study.snapshot_times.size());
  // The legend of three has the two rows that there is room for; by itself it takes one column.
  EXPECT_THAT(figure.script, HasSubstr("maxrows 2"));
  EXPECT_EQ(draw(figure, files.out()), "");
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

double cell(const Table& table, std::size_t row, const std::string& column) {
  const auto found = std::find(table.columns.begin(), table.columns.end(), column);
  if (found == table.columns.end()) {
    ADD_FAILURE() << table.name << ": no column " << column;
    return 0.0;
  }
  return std::get<double>(
      table.rows.at(row).at(static_cast<std::size_t>(found - table.columns.begin())));
}

TEST(Figures, WeightAndKernelAreWhatTheRunsSay) {
  const SyntheticStudy files;
  const StudyResult study = files.collected();
  const Figure weight = weight_figure(study);
  const Table& w = weight.tables.at(0);
  ASSERT_EQ(w.rows.size(), 44U);
  for (std::size_t k = 0; k < 22; ++k) {
    const double r = cell(w, k, "r_over_l0");
    EXPECT_NEAR(cell(w, k, "w"), std::max(2.1 / r - 1.0, 0.0), 1e-12);
    EXPECT_NEAR(cell(w, k, "r_m"), 0.005 * r, 1e-15);
  }
  EXPECT_THAT(weight.script, HasSubstr("2.1 {/:Italic l}_0"));
  const Figure kernel = kernel_figure(study);
  const Table& table = kernel.tables.at(0);
  ASSERT_EQ(table.rows.size(), 22U);
  for (std::size_t k = 0; k < table.rows.size(); ++k) {
    EXPECT_NEAR(cell(table, k, "W_times_h2"), 3.0 - cell(table, k, "r_over_h"), 1e-12);
    EXPECT_NEAR(cell(table, k, "dW_dr_times_h3"), -1.0, 1e-12);
    EXPECT_NEAR(cell(table, k, "W_per_m2") * 36e-6, cell(table, k, "W_times_h2"), 1e-12);
  }
}

TEST(Figures, InteractionDomainCountsTheNeighboursOfARealFrame) {
  const SyntheticStudy files;
  const StudyResult study = files.collected();  // what is found points into it
  const auto found = find_interaction(study);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->run->study.name, "mps-a");
  EXPECT_NEAR(found->time.value(), 0.15, 1e-12);  // the study's second snapshot
  ASSERT_EQ(found->radii_over_l0.size(), 2U);
  EXPECT_NEAR(found->radii_over_l0[0], 3.9, 1e-12);
  // Points of a square lattice other than the origin with x^2 + y^2 < 3.9^2 and < 2.1^2.
  EXPECT_EQ(found->neighbours, (std::vector<std::size_t>{44, 12}));
  const Figure figure = interaction_figure(study);
  EXPECT_THAT(figure.caption, HasSubstr("2.1 l0 (12 neighbours) and 3.9 l0 (44 neighbours)"));
  std::array<std::size_t, 3> rings{};
  for (const auto& row : figure.tables.at(0).rows) {
    const auto ring = static_cast<std::size_t>(std::get<double>(row[3]));
    if (ring < rings.size()) ++rings[ring];
  }
  EXPECT_EQ(rings, (std::array<std::size_t, 3>{1, 12, 32}));
}

TEST(Figures, FlowchartsHaveABoxForEveryStage) {
  const SyntheticStudy files;
  const StudyResult study = files.collected();
  const Figure figure = mps_algorithm_figure(study);
  EXPECT_EQ(draw(figure, files.out()), "");
  const std::string svg = read_text(files.out() / "fig3.svg");
  for (const char* text : {"push()", "Pushes &lt;it>", "Eq. (99)", "pull()", "t &lt; end?",
                           "RunLoop::run", "Solver(case)"})
    EXPECT_THAT(svg, HasSubstr(text));
  EXPECT_LT(svg.find("push()"), svg.find("pull()"));
  EXPECT_THAT(sph_algorithm_figure(study).script, HasSubstr("kick()"));
}

TEST(Figures, RunsThatDoNotSayWhatTheyComputedWithLeaveTheFigureEmpty) {
  const SyntheticStudy files;
  std::filesystem::remove(files.runs() / "mps-a/method.json");
  std::filesystem::remove(files.runs() / "sph-a/method.json");
  const StudyResult study = files.collected();
  for (const char* name : {"1", "2", "3", "4", "5"}) {
    const Figure figure = find_figure(name)->make(study);
    EXPECT_THAT(figure.missing, HasSubstr("has a method.json"));
    EXPECT_EQ(draw(figure, files.out()), "");
    EXPECT_FALSE(std::filesystem::exists(files.out() / (figure.name + ".svg")));
  }
}

TEST(Figures, ADamagedSheetIsAnErrorThatNamesTheFile) {
  const SyntheticStudy files;
  const auto file = files.runs() / "mps-a/method.json";
  const std::string good = read_text(file);
  nlohmann::json sheet = nlohmann::json::parse(good);
  sheet["functions"][0]["value"].erase(0);
  for (const std::string& text : {std::string("{"), std::string("{}"), sheet.dump()}) {
    testing::write_text(file, text);
    EXPECT_THAT(error_of([&] { static_cast<void>(weight_figure(files.collected())); }),
                HasSubstr("mps-a/method.json: "));
  }
  testing::write_text(file, good);
  EXPECT_FALSE(weight_figure(files.collected()).tables.empty());
}

TEST(Figures, PatternsGiveTheEffectOfTheLinkingLength) {
  const SyntheticStudy files;
  const Figure figure = pattern_figure(files.collected());
  const Table& table = figure.tables.at(0);
  ASSERT_GT(table.rows.size(), 60U);
  for (std::size_t k = 0; k < table.rows.size(); ++k) {
    EXPECT_LE(cell(table, k, "detached_part_least"), cell(table, k, "detached_part"));
    EXPECT_LE(cell(table, k, "detached_part"), cell(table, k, "detached_part_most"));
    EXPECT_LE(cell(table, k, "pieces_least"), cell(table, k, "pieces_most"));
  }
  EXPECT_THAT(figure.script, HasSubstr("set arrow 1"));  // the impact
}

TEST(Figures, AreFoundByNumberAndName) {
  EXPECT_EQ(find_figure("8")->name, "fig8");
  EXPECT_EQ(find_figure("fig8_shifted")->name, "fig8_shifted");
  EXPECT_EQ(find_figure("leading_edge")->name, "fig8");
  for (int number = 1; number <= 9; ++number)
    EXPECT_EQ(find_figure(std::to_string(number))->name, "fig" + std::to_string(number));
  std::set<std::string> names;
  for (const auto& figure : all_figures()) {
    EXPECT_TRUE(names.insert(figure.name).second);
    EXPECT_TRUE(names.insert(figure.word).second);
    EXPECT_EQ(find_figure(figure.word)->name, figure.name);
  }
  EXPECT_EQ(find_figure("88"), nullptr);
}

TEST(Figures, OfAStudyAreFoundByTheirNames) {
  const SyntheticStudy files;
  const StudyResult study = files.collected();
  std::string names;
  for (const Figure& figure : figures_of(study)) {
    EXPECT_EQ(figure_of(study, figure.name).name, figure.name);
    names += figure.name + " ";
  }
  EXPECT_THAT(names, HasSubstr("wall_pressure"));  // not in the catalogue
  EXPECT_THAT(error_of([&] { static_cast<void>(figure_of(study, "88")); }),
              AllOf(HasSubstr("found \"88\", expected one of fig1 (weight), fig2"),
                    HasSubstr("wall_pressure")));
}

TEST(Figures, WithoutPublishedSeriesNoneIsShownShifted) {
  const SyntheticStudy files;
  std::string text = read_text(files.study());
  const std::string published = "published = [\"late\"]\n";
  text.erase(text.find(published), published.size());
  testing::write_text(files.study(), text);
  const StudyResult study = files.collected();
  for (const Figure& figure : figures_of(study)) EXPECT_NE(figure.name, "fig8_shifted");
  EXPECT_THAT(error_of([&] { static_cast<void>(figure_of(study, "fig8_shifted")); }),
              HasSubstr("without published series of the leading edge"));
}

}  // namespace
}  // namespace surge::compare
