#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <sstream>

#include "tests/compare/written_report.hpp"

namespace surge::compare {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::SyntheticStudy;

json answer_of(const SyntheticStudy& files) {
  return report_metrics(files.collected()).at("answer");
}

/// The sentences that stand first on the page, without their markup.
std::vector<std::string> sentences_of(const SyntheticStudy& files) {
  const std::string page = testing::report_without_figures(files).page;
  const auto begin = page.find("<div class=\"answer\">");
  const std::string text = page.substr(begin, page.find("</div>", begin) - begin);
  std::vector<std::string> sentences;
  const std::regex paragraph("<p>([^]*?)</p>");
  for (std::sregex_iterator it(text.begin(), text.end(), paragraph), end; it != end; ++it)
    sentences.push_back(std::regex_replace((*it)[1].str(), std::regex("<[^>]*>"), ""));
  return sentences;
}

void expect_short(const std::vector<std::string>& sentences) {
  ASSERT_EQ(sentences.size(), 3U);
  for (const std::string& sentence : sentences) {
    std::istringstream words(sentence);
    const auto count = std::distance(std::istream_iterator<std::string>(words),
                                     std::istream_iterator<std::string>());
    EXPECT_LE(count, 20) << sentence;
    EXPECT_GE(count, 4) << sentence;
    EXPECT_EQ(sentence.back(), '.') << sentence;
  }
}

void append(const SyntheticStudy& files, const std::string& text) {
  std::ofstream(files.study(), std::ios::app) << text;
}

TEST(Answer, WithoutRefinementGivesTheDifferenceAndNoOrder) {
  const SyntheticStudy files;
  const json answer = answer_of(files);
  ASSERT_EQ(answer["rows"].size(), 3U);
  EXPECT_EQ(answer["rows"][2]["run"], "vof-20");
  EXPECT_EQ(answer["reference_row"], 2);
  EXPECT_EQ(answer["rows"][answer["nearest"].get<std::size_t>()]["run"], "mps-a");
  EXPECT_TRUE(answer["rows"][0]["U"].is_null());
  EXPECT_EQ(answer["order"], "unknown");
  const auto sentences = sentences_of(files);
  expect_short(sentences);
  EXPECT_THAT(sentences[0], HasSubstr("uncertainty unknown"));
  EXPECT_THAT(sentences[1], HasSubstr("cannot be decided"));
}

TEST(Answer, OrderIsSureWhereTheGapIsMoreThanTheUncertaintyOfBoth) {
  const SyntheticStudy files;
  files.refine_all();
  const json answer = answer_of(files);
  // At constant leads of 0.02 and 0.05; all levels are alike, so only the frames are uncertain.
  EXPECT_NEAR(answer["gap"], 0.03, 2e-3);
  EXPECT_LT(answer["gap_U"], answer["gap"]);
  EXPECT_EQ(answer["order"], "sure");
  const auto sentences = sentences_of(files);
  expect_short(sentences);
  EXPECT_THAT(sentences[0], HasSubstr("±"));
  EXPECT_THAT(sentences[1], HasSubstr("The order is sure"));
}

TEST(Answer, OrderIsOpenWhereTwoAreAlike) {
  const SyntheticStudy files;
  files.write("sph-a", "sph", -0.02 * SyntheticStudy::length);
  files.refine_all(0.02, -0.02);
  EXPECT_EQ(answer_of(files)["order"], "open");
  expect_short(sentences_of(files));
}

TEST(Answer, RunsThatAreNotCompleteAreNotRanked) {
  const SyntheticStudy files;
  std::filesystem::remove_all(files.runs() / "sph-a");
  json answer = answer_of(files);
  EXPECT_EQ(answer["rows"].size(), 2U);
  EXPECT_TRUE(answer["next"].is_null());
  expect_short(sentences_of(files));
  std::filesystem::remove_all(files.runs() / "mps-a");
  answer = answer_of(files);
  EXPECT_EQ(answer["rows"].size(), 1U);
  EXPECT_TRUE(answer["nearest"].is_null());
  const auto sentences = sentences_of(files);
  expect_short(sentences);
  EXPECT_THAT(sentences[0], HasSubstr("nothing is ranked"));
}

TEST(Answer, OfOneKindTheFinestStandsForAllAndTheOthersAreCounted) {
  const SyntheticStudy files;
  json coarse = testing::dam_break_manifest();
  coarse["case"]["spacing"] = 0.0145;
  coarse["case"]["method"]["name"] = "mps";
  std::vector<double> times;
  for (int k = 0; k <= 22; ++k) times.push_back(0.01 * k);
  testing::write_run(files.runs() / "mps-coarse", times, SyntheticStudy::front_with(0.0), coarse);
  append(files,
         "[[run]]\nname = \"mps-coarse\"\nprogram = \"surge-particle\"\ncase = \"c.toml\"\n");
  const json answer = answer_of(files);
  ASSERT_EQ(answer["rows"].size(), 3U);
  EXPECT_EQ(answer["rows"][0]["run"], "mps-a");  // not the nearer, coarser one
  EXPECT_EQ(answer["more"], 1);
}

TEST(Answer, WithoutALeadingEdgeTheFirstObservableWithADifferenceRanks) {
  const SyntheticStudy files;
  append(files,
         "[[observable]]\nname = \"level\"\nkind = \"gauge\"\nparameters = {x = 0.1}\n"
         "compare = [\"peak\"]\n[[observable]]\nname = \"height\"\nkind = \"gauge\"\n"
         "parameters = {x = 0.2}\ntitle = \"Height of the water at a fifth of a metre\"\n"
         "compare = [\"rms\", \"arrival\"]\nthreshold = \"0.002\"\n");
  StudyResult study = files.collected();
  study.has_front = false;
  json metrics = report_metrics(study);
  const json& answer = metrics["answer"];
  EXPECT_EQ(answer["quantity"]["key"], "height");
  EXPECT_EQ(answer["quantity"]["measure"], "rms");
  EXPECT_EQ(answer["quantity"]["short"], "height");  // its title is too long for a sentence
  EXPECT_TRUE(answer["rows"][0]["E"].is_number());
}

}  // namespace
}  // namespace surge::compare
