#include "compare/report/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <map>
#include <regex>
#include <set>

#include "tests/compare/written_report.hpp"

namespace surge::compare {
namespace {

using nlohmann::json;
using testing::error_of;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::read_text;
using testing::report_without_figures;
using testing::SyntheticStudy;
using testing::written_report;
using testing::WrittenReport;

std::string unescape(std::string text) {
  const std::vector<std::pair<std::string, std::string>> entities{
      {"&lt;", "<"}, {"&gt;", ">"}, {"&#34;", "\""}, {"&#39;", "'"}, {"&amp;", "&"}};
  for (const auto& [entity, plain] : entities) {
    for (auto at = text.find(entity); at != std::string::npos; at = text.find(entity, at + 1)) {
      text.replace(at, entity.size(), plain);
    }
  }
  return text;
}

/// What lies between <tag ...> and </tag>, and the tags, goes; these elements hold none of their
/// kind.
std::string without(std::string page, const std::string& tag) {
  for (auto at = page.find("<" + tag); at != std::string::npos; at = page.find("<" + tag, at)) {
    const auto end = page.find("</" + tag + ">", at);
    if (end == std::string::npos) break;
    page.erase(at, end + tag.size() + 3 - at);
  }
  return page;
}

const std::regex data_element("<data data-key=\"([^\"]*)\" value=\"([^\"]*)\">([^<]*)</data>");

TEST(Report, PageIsStrictlyWellFormedAndSelfContained) {
  const SyntheticStudy files;
  const WrittenReport report = written_report(files);
  EXPECT_TRUE(vtkSmartPointer<vtkXMLDataElement>::Take(
                  vtkXMLUtilities::ReadElementFromString(report.page.c_str())) != nullptr);
  EXPECT_FALSE(std::regex_search(report.page, std::regex("<script[^>]*\\ssrc")));
  EXPECT_THAT(report.page, Not(HasSubstr("<b>break")));
  EXPECT_THAT(report.page, HasSubstr("Dam &lt;b&gt;break&lt;/b&gt; &amp; &#34;more&#34;"));
  EXPECT_FALSE(std::regex_search(
      report.page, std::regex("(src|<link|@import|url\\()\\s*=?\\s*['\"]?(https?:|figures/)")));
  // An id names one element.
  std::set<std::string> ids;
  const std::regex id("\\sid=['\"]([^'\"]+)['\"]");
  for (std::sregex_iterator it(report.page.begin(), report.page.end(), id), end; it != end; ++it) {
    EXPECT_TRUE(ids.insert((*it)[1]).second) << (*it)[1];
  }
}

/// The text alone. An attribute may hold an archive, which is too long for std::regex.
std::string without_tags(const std::string& page) {
  std::string text;
  for (std::size_t at = 0; at < page.size();) {
    const std::size_t begin = std::min(page.find('<', at), page.size());
    text.append(page, at, begin - at).push_back(' ');
    const std::size_t end = page.find('>', begin);
    at = end == std::string::npos ? page.size() : end + 1;
  }
  return text;
}

TEST(Report, EveryNumberOfThePageIsInTheMetrics) {
  const SyntheticStudy files;
  const WrittenReport report = report_without_figures(files);
  std::size_t numbers = 0;
  for (std::sregex_iterator it(report.page.begin(), report.page.end(), data_element), end;
       it != end; ++it) {
    const json::json_pointer pointer(unescape((*it)[1]));
    ASSERT_TRUE(report.metrics.contains(pointer)) << (*it)[1];
    const json& value = report.metrics.at(pointer);
    std::string shown = unescape((*it)[3]);
    if (!value.is_number()) continue;
    if (shown.starts_with("−")) shown = "-" + shown.substr(std::string("−").size());
    const auto point = shown.find('.');
    const auto decimals = point == std::string::npos ? 0 : shown.size() - point - 1;
    EXPECT_NEAR(std::stod(shown), value.get<double>(),
                0.5001 * std::pow(10.0, -static_cast<double>(decimals)))
        << (*it)[1];
    ++numbers;
  }
  EXPECT_GT(numbers, 40U);
}

TEST(Report, NoNumberStandsOutsideTheMetrics) {
  const SyntheticStudy files;
  std::string page = written_report(files).page;
  for (const char* tag : {"style", "script", "svg", "figcaption", "data", "title", "code"})
    page = without(page, tag);
  // Column headings name the levels of arrival, which are keys of the metrics.
  page = std::regex_replace(page, std::regex("Z/L = [0-9.]+"), "");
  page = std::regex_replace(page, std::regex("<caption>[^<]*</caption>"), "");
  page = without_tags(page);
  std::smatch found;
  EXPECT_FALSE(std::regex_search(page, found, std::regex("[^\\n]{0,40}[0-9][^\\n]{0,40}")))
      << found.str();
}

TEST(Report, SectionsComeInTheOrderOfThePaperAndShowEveryFigureOnce) {
  const SyntheticStudy files;
  const WrittenReport report = written_report(files);
  std::size_t last = 0;
  for (const char* id : {"summary",  "fig8",   "viewer",   "figures",   "fig1",          "fig2",
                         "fig3",     "fig4",   "fig5",     "fig6",      "fig7",          "surfaces",
                         "fig9",     "flow",   "patterns", "pressure",  "wall_pressure", "runs",
                         "verdicts", "claims", "errata",   "provenance"}) {
    const std::string anchor = std::string(" id=\"") + id + "\"";
    const auto at = report.page.find(anchor);
    ASSERT_NE(at, std::string::npos) << id;
    EXPECT_GT(at, last) << id;
    EXPECT_EQ(report.page.find(anchor, at + 1), std::string::npos) << id;
    last = at;
  }
  // Links within the page lead somewhere.
  const std::regex link("<a href=\"#([^\"]+)\"");
  for (std::sregex_iterator it(report.page.begin(), report.page.end(), link), end; it != end; ++it)
    EXPECT_THAT(report.page, HasSubstr("id=\"" + (*it)[1].str() + "\""));
  EXPECT_EQ(report.metrics["interaction"]["run"], "mps-a");
  EXPECT_EQ(report.metrics["interaction"]["radii"][1]["neighbours"], 12);
}

TEST(Report, SummaryCountsTheVerdicts) {
  const SyntheticStudy files;
  const json metrics = report_without_figures(files).metrics;
  std::map<std::string, int> counts;
  for (const json& claim : metrics["claims"]) {
    const std::string verdict = claim["verdict"];
    ++counts[verdict.starts_with("depends") ? "depends" : verdict];
  }
  const json& told = metrics["claim_counts"];
  for (const char* kind : {"reproduced", "not reproduced", "depends", "not decidable"})
    EXPECT_EQ(told[kind], counts[kind]) << kind;
  EXPECT_EQ(told["judged"].get<int>() + counts["not measured"],
            static_cast<int>(metrics["claims"].size()));
  EXPECT_GT(told["judged"], 3);
}

TEST(Report, AnswerIsThreeSentencesAndAFigure) {
  const SyntheticStudy files;
  const std::string page = written_report(files).page;
  const auto begin = page.find("<div class=\"answer\">");
  ASSERT_NE(begin, std::string::npos);
  const std::string answer = page.substr(begin, page.find("</div>", begin) - begin);
  const auto count = [](const std::string& text, const std::string& what) {
    std::size_t found = 0;
    for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count(answer, "<p>"), 3U);
  EXPECT_EQ(count(answer, ".</p>"), 3U);
  const std::string summary = page.substr(begin, page.find("<section id=", begin) - begin);
  EXPECT_EQ(count(summary, "<figure"), 1U);
}

TEST(Report, FrontByOtherChoicesIsTold) {
  const SyntheticStudy files;
  const WrittenReport report = report_without_figures(files);
  for (const char* run : {"mps-a", "sph-a", "vof-20"}) {
    const json& choices = report.metrics["front"][run]["front_sensitivity"];
    for (const char* name : {"strip_x2", "linking_1.5", "linking_2.5"})
      // A column of full height: no choice moves its front.
      EXPECT_NEAR(choices[name]["rms"], 0.0, 1e-9) << run << ' ' << name;
  }
  EXPECT_THAT(report.page, HasSubstr("Front by other choices"));
}

TEST(Report, StatesWhatTheRunsWereMadeToShow) {
  const SyntheticStudy files;
  files.refine_all();
  const WrittenReport report = report_without_figures(files);
  EXPECT_NEAR(report.metrics["front"]["mps-a"]["max_vs_vof"], 0.02, 1e-6);
  EXPECT_NEAR(report.metrics["front"]["sph-a"]["max_vs_vof"], 0.05, 1e-6);
  EXPECT_EQ(report.metrics["summary"]["nearer"], "MPS");
  EXPECT_THAT(report.page, HasSubstr("is reproduced by these runs"));
  EXPECT_THAT(report.table, HasSubstr("sph-a"));
  EXPECT_THAT(report.table, HasSubstr("0.0200"));
}

TEST(Report, WithoutUncertaintyTheHeadlineIsLeftOpen) {
  const SyntheticStudy files;
  const WrittenReport report = report_without_figures(files);
  EXPECT_THAT(report.page, HasSubstr("is not decidable by these runs"));
  EXPECT_THAT(report.page, HasSubstr("id=\"verdicts\""));
  EXPECT_TRUE(std::regex_search(report.table, std::regex("mps-a +complete .* not decidable")));
}

TEST(Report, WallPressureIsThatOfTheProbes) {
  const SyntheticStudy files;
  const WrittenReport report = written_report(files);
  const json& runs = report.metrics["wall_pressure"]["runs"];
  EXPECT_NEAR(runs["vof-20"]["peak"], 1.0, 1e-6);
  EXPECT_NEAR(runs["mps-a"]["impulse"], 4.0, 1e-6);
  EXPECT_NEAR(runs["mps-a"]["noise"], 0.0, 1e-6);
  EXPECT_NEAR(runs["sph-a"]["noise"], 0.5 / std::sqrt(2.0), 0.005);
  EXPECT_NEAR(runs["sph-a"]["median_step_s"], 1e-5, 1e-9);
  EXPECT_THAT(report.page, HasSubstr("id=\"wall_pressure\""));
}

TEST(Report, StudyWithoutAProbeHasNoWallPressure) {
  const SyntheticStudy files;
  const auto file = files.runs() / "vof-20/manifest.json";
  json manifest = json::parse(read_text(file));
  manifest["case"].erase("probes");
  testing::write_text(file, manifest.dump());
  const WrittenReport report = written_report(files);
  EXPECT_TRUE(report.metrics["wall_pressure"].empty());
  EXPECT_THAT(report.page, Not(HasSubstr("wall_pressure\"")));
}

TEST(Report, TheOtherVerdictIsWrittenToo) {
  const SyntheticStudy files;
  files.write("sph-a", "sph", 0.001 * SyntheticStudy::length);
  files.refine_all(0.02, 0.001);
  const WrittenReport report = report_without_figures(files);
  EXPECT_EQ(report.metrics["summary"]["nearer"], "SPH");
  EXPECT_THAT(report.page, HasSubstr("is not reproduced by these runs"));
}

TEST(Report, MissingRunIsShownAsMissing) {
  const SyntheticStudy files;
  std::filesystem::remove_all(files.runs() / "sph-a");
  const WrittenReport report = report_without_figures(files);
  EXPECT_EQ(report.metrics["runs"]["sph-a"]["status"], "missing");
  EXPECT_TRUE(report.metrics["summary"]["nearer"].is_null());
  EXPECT_THAT(report.page, HasSubstr("status-missing"));
  EXPECT_THAT(report.page, HasSubstr("cannot be said"));
  EXPECT_TRUE(std::regex_search(report.table, std::regex("sph-a +missing +-")));
}

TEST(Report, UnfinishedRunIsMeasuredAndMarkedButNoVerdictRestsOnIt) {
  const SyntheticStudy files;
  std::filesystem::remove_all(files.runs() / "sph-a");
  files.write("sph-a", "sph", 0.001 * SyntheticStudy::length, false);
  const WrittenReport report = report_without_figures(files);
  EXPECT_EQ(report.metrics["runs"]["sph-a"]["status"], "unfinished");
  EXPECT_EQ(report.metrics["runs"]["sph-a"]["note"], "ends at 0.1 s");
  EXPECT_TRUE(report.metrics["front"]["sph-a"]["rms_vs_vof"].is_number());
  EXPECT_TRUE(report.metrics["summary"]["nearer"].is_null());
}

TEST(Report, RunOfAnotherCaseIsUnusableAndSaysWhy) {
  const SyntheticStudy files;
  const auto file = files.runs() / "mps-a/manifest.json";
  json manifest = json::parse(read_text(file));
  manifest["case"]["fluid"]["gravity"] = {0, -1.62, 0};
  testing::write_text(file, manifest.dump());
  const WrittenReport report = report_without_figures(files);
  EXPECT_EQ(report.metrics["runs"]["mps-a"]["status"], "unusable");
  EXPECT_THAT(report.metrics["runs"]["mps-a"]["note"].get<std::string>(), HasSubstr("gravity"));
}

TEST(Report, MissingReferenceIsAnError) {
  const SyntheticStudy files;
  std::filesystem::remove_all(files.runs() / "vof-20");
  EXPECT_THAT(error_of([&] { static_cast<void>(files.collected()); }),
              HasSubstr("reference run vof-20"));
}

TEST(Report, DeparturesFromThePaperAreTold) {
  const SyntheticStudy files;
  const json metrics = report_without_figures(files).metrics;
  const json& sph = metrics["deviations"]["sph-a"];
  EXPECT_EQ(sph["gamma"]["agreement"], "as stated");
  EXPECT_EQ(sph["density_diffusion"]["agreement"], "departs");
  EXPECT_EQ(sph["h_over_l0"]["agreement"], "left open");
  EXPECT_EQ(sph["brand_new"]["agreement"], "not in the paper");
  EXPECT_EQ(metrics["deviation_counts"]["sph-a"]["departs"], 2);
}

TEST(Report, WhatDoesNotActIsNoDepartureFromThePaper) {
  const SyntheticStudy files;
  const auto file = files.runs() / "mps-a/manifest.json";
  json manifest = json::parse(read_text(file));
  json& options = manifest["case"]["method"]["parameters"];
  options = {
      {"source", "number_density"},    {"density_share", 0.01},      {"shifting", 0.0},
      {"viscous_term", "deformation"}, {"numerical_viscosity", 0.0}, {"collision_distance", 0.5},
      {"collision_speed", 0.1}};
  testing::write_text(file, manifest.dump());
  const json quiet = report_metrics(files.collected());
  const json& said = quiet["deviations"]["mps-a"];
  EXPECT_EQ(said["density_share"]["agreement"], "does not act");
  EXPECT_EQ(said["viscous_term"]["agreement"], "does not act");
  EXPECT_EQ(said["shifting"]["agreement"], "as stated");
  EXPECT_EQ(said["collision_speed"]["agreement"], "left open");
  EXPECT_EQ(quiet["deviation_counts"]["mps-a"]["departs"], 0);

  options["source"] = "divergence_and_density";
  options["numerical_viscosity"] = 0.03;
  testing::write_text(file, manifest.dump());
  const json loud = report_metrics(files.collected());
  EXPECT_EQ(loud["deviations"]["mps-a"]["density_share"]["agreement"], "left open");
  EXPECT_EQ(loud["deviations"]["mps-a"]["viscous_term"]["agreement"], "left open");
  EXPECT_EQ(loud["deviation_counts"]["mps-a"]["departs"], 2);
}

TEST(Report, StudyThatJudgesNoPaperHasNoWordOfItsStatements) {
  const SyntheticStudy files;
  std::string study = read_text(files.study());
  const std::string claims = "claims = \"alves_dreux\"\n";
  study.erase(study.find(claims), claims.size());
  testing::write_text(files.study(), study);
  const WrittenReport report = report_without_figures(files);
  for (const char* name : {"claims", "claim_counts", "deviations", "errata"})
    EXPECT_FALSE(report.metrics.contains(name)) << name;
  for (const char* word : {"id=\"claims\"", "id=\"errata\"", "paper’s statement", "statements"})
    EXPECT_THAT(report.page, Not(HasSubstr(word)));
  EXPECT_NEAR(report.metrics["front"]["mps-a"]["max_vs_vof"], 0.02, 1e-6);
  EXPECT_THAT(report.page, HasSubstr("uncertainty unknown."));
}

}  // namespace
}  // namespace surge::compare
