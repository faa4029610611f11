#include <gmock/gmock.h>

#include <random>

#include "tests/compare/foam_dam.hpp"

namespace surge::compare {
namespace {

using testing::bytes_of;
using testing::foam_edge;
using testing::foam_tank;
using testing::foam_water;
using testing::FoamCaseWriter;
using testing::FoamLayout;
using testing::TemporaryFolder;
using testing::write_text;

namespace fs = std::filesystem;

/// One seeded damage to a case, as disks, copies and slips of the hand make them.
class Mutation {
 public:
  Mutation(fs::path folder, unsigned seed) : folder_(std::move(folder)), random_(seed) {}

  /// Damages the case and says how.
  std::string apply() {
    for (const auto& entry : fs::recursive_directory_iterator(folder_))
      if (entry.is_regular_file()) files_.push_back(entry.path());
    std::sort(files_.begin(), files_.end());
    switch (pick(12)) {
      case 0:
        return cut();
      case 1:
        return flip_bits(1);
      case 2:
        return flip_bits(20);
      case 3:
        return change_character("0123456789", "0123456789");
      case 4:
        return change_character("{}()[];\"", " ");
      case 5:
        return change_character("0123456789", "-.e");
      case 6:
        return exchange_times();
      case 7:
        return scale_points();
      case 8:
        return drop();
      case 9:
        return exchange_processors();
      case 10:
        return exchange_files();
      default:
        return replace_word();
    }
  }

 private:
  std::size_t pick(std::size_t count) { return random_() % count; }
  const fs::path& any_file() { return files_[pick(files_.size())]; }
  std::string told(const std::string& what, const fs::path& file) {
    return what + " " + fs::relative(file, folder_).string();
  }
  static void put(const fs::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
  }

  std::string cut() {
    const fs::path& file = any_file();
    const std::string text = bytes_of(file);
    put(file, text.substr(0, pick(text.size() + 1)));
    return told("cut", file);
  }
  std::string flip_bits(std::size_t count) {
    const fs::path& file = any_file();
    std::string text = bytes_of(file);
    for (std::size_t i = 0; i < count && !text.empty(); ++i) {
      char& c = text[pick(text.size())];
      c = static_cast<char>(c ^ (1 << pick(8)));
    }
    put(file, text);
    return told("flipped " + std::to_string(count), file);
  }
  std::string change_character(const std::string& from, const std::string& to) {
    const fs::path& file = any_file();
    std::string text = bytes_of(file);
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < text.size(); ++i)
      if (from.find(text[i]) != std::string::npos) places.push_back(i);
    if (!places.empty()) text[places[pick(places.size())]] = to[pick(to.size())];
    put(file, text);
    return told("one of " + from + " changed in", file);
  }
  std::string exchange(const fs::path& a, const fs::path& b) {
    fs::rename(a, folder_ / "moved");
    fs::rename(b, a);
    fs::rename(folder_ / "moved", b);
    return told(told("exchanged", a) + " and", b);
  }
  std::string exchange_times() {
    std::vector<fs::path> times;
    for (const fs::path& file : files_)
      if (file.parent_path().filename() == "0.1") times.push_back(file.parent_path());
    const fs::path& time = times[pick(times.size())];
    return exchange(time, time.parent_path() / (pick(2) == 0 ? "0.2" : "0"));
  }
  std::string exchange_processors() {
    std::vector<fs::path> folders;
    for (const auto& entry : fs::directory_iterator(folder_))
      if (entry.path().filename().string().starts_with("processor"))
        folders.push_back(entry.path());
    if (folders.size() < 2) return exchange_files();
    std::sort(folders.begin(), folders.end());
    const std::size_t first = pick(folders.size() - 1);
    return exchange(folders[first], folders[first + 1]);
  }
  std::string exchange_files() {
    // Files of one name: of two times, of two processors.
    const fs::path file = any_file();
    std::vector<fs::path> same;
    for (const fs::path& other : files_)
      if (other != file && other.filename() == file.filename()) same.push_back(other);
    return same.empty() ? cut() : exchange(file, same[pick(same.size())]);
  }
  std::string drop() {
    const fs::path& file = any_file();
    const fs::path gone = pick(3) == 0 ? file.parent_path() : file;
    fs::remove_all(gone);
    return told("dropped", gone);
  }
  /// Metres for millimetres, in one of the files with points (or all of the case's).
  std::string scale_points() {
    std::vector<fs::path> points;
    for (const fs::path& file : files_)
      if (file.filename() == "points") points.push_back(file);
    if (points.empty()) return drop();
    const bool all = pick(2) == 0;
    const std::size_t one = pick(points.size());
    for (std::size_t k = 0; k < points.size(); ++k)
      if (all || k == one) scale(points[k]);
    return told(all ? "scaled all" : "scaled", points[one]);
  }
  static void scale(const fs::path& file) {
    std::string text = bytes_of(file);
    const auto start = text.find("\n(", text.find("object"));
    if (text.find("format binary") != std::string::npos) {
      for (std::size_t i = start + 2; i + 9 < text.size(); i += 8) {
        double value;
        std::memcpy(&value, text.data() + i, 8);
        value *= 1000.0;
        std::memcpy(text.data() + i, &value, 8);
      }
      put(file, text);
      return;
    }
    std::istringstream in(text.substr(start + 2));
    std::string scaled = text.substr(0, start + 2);
    for (std::string line; std::getline(in, line);) {
      double x, y, z;
      const bool point = std::sscanf(line.c_str(), "(%lf %lf %lf)", &x, &y, &z) == 3;
      scaled +=
          point ? testing::joined("(", 1000 * x, " ", 1000 * y, " ", 1000 * z, ")\n") : line + "\n";
    }
    put(file, scaled);
  }
  std::string replace_word() {
    static const std::vector<std::string> words{"nan",  "1e400", "-1",  "99999999999999999999",
                                                "inf",  "{{{{",  "(",   "nonuniform",
                                                "$a$a", "1e-3",  "0x1", "4294967295"};
    const fs::path& file = any_file();
    std::string text = bytes_of(file);
    const std::string& word = words[pick(words.size())];
    std::size_t at = text.empty() ? 0 : pick(text.size());
    at = std::min(text.find_first_of("0123456789", at), text.size());
    const std::size_t end = std::min(text.find_first_not_of("0123456789.e-", at), text.size());
    text.replace(at, end - at, word);
    put(file, text);
    return told("a number became " + word + " in", file);
  }

  fs::path folder_;
  std::mt19937 random_;
  std::vector<fs::path> files_;
};

struct Outcome {
  bool refused = false;
  bool noticed = false;
  double off = 0.0;  ///< of the front, in L of the clean case
  std::size_t frames = 0;
};

Outcome outcome_of(const fs::path& folder) {
  Outcome outcome;
  try {
    auto run = open_run(folder);
    const FrontHistory front = measure_front(run, {});
    outcome.noticed = !run.notices.empty();
    outcome.frames = front.size();
    for (const FrontSample& sample : front) {
      const double off = sample.position.value() - foam_edge(sample.time.value());
      outcome.off = std::max(outcome.off, std::abs(off) / foam_edge(0.0));
    }
  } catch (const Error&) {
    outcome.refused = true;
  }
  return outcome;
}

class FoamMutations : public ::testing::TestWithParam<std::pair<const char*, FoamLayout>> {};

/// Of seeded damages none crashes the reader (that would end this program) and none gives another
/// front without an error or a notice.
TEST_P(FoamMutations, NoneGivesAnotherFrontInSilence) {
  const unsigned tries = testing::mutation_count();
  const TemporaryFolder folder;
  const int layers = GetParam().second.binary ? 2 : 1;
  FoamCaseWriter(folder / "clean", foam_tank(layers), GetParam().second).write(foam_water);
  ASSERT_EQ(outcome_of(folder / "clean").frames, 3U);
  ASSERT_LT(outcome_of(folder / "clean").off, 1e-9);
  unsigned refused = 0, noticed = 0, harmless = 0;
  for (unsigned seed = 1; seed <= tries; ++seed) {
    fs::copy(folder / "clean", folder / "case", fs::copy_options::recursive);
    const std::string what = Mutation(folder / "case", seed).apply();
    const Outcome outcome = outcome_of(folder / "case");
    EXPECT_TRUE(outcome.refused || outcome.noticed || (outcome.off <= 0.02 && outcome.frames == 3))
        << "seed " << seed << ": " << what << ": front " << outcome.off << " L off, "
        << outcome.frames << " frames";
    refused += outcome.refused ? 1 : 0;
    noticed += !outcome.refused && outcome.noticed ? 1 : 0;
    harmless += !outcome.refused && !outcome.noticed ? 1 : 0;
    fs::remove_all(folder / "case");
  }
  std::printf("%s: %u mutations: %u refused, %u with a notice, %u harmless\n", GetParam().first,
              tries, refused, noticed, harmless);
}

INSTANTIATE_TEST_SUITE_P(
    All, FoamMutations,
    ::testing::Values(std::pair("Ascii2D", FoamLayout{}),
                      std::pair("Binary3D", FoamLayout{.binary = true}),
                      std::pair("Packed2D", FoamLayout{.packed = true}),
                      std::pair("Decomposed2D", FoamLayout{.processors = 3}),
                      std::pair("BinaryCollated3D",
                                FoamLayout{.binary = true, .processors = 2, .collated = true})),
    [](const auto& given) { return std::string(given.param.first); });

}  // namespace
}  // namespace surge::compare
