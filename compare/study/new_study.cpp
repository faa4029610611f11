#include "compare/study/new_study.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "compare/study/study_keys.hpp"
#include "particle/case/case_checks.hpp"
#include "particle/case/case_file.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"
#include "particle/support/toml.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

using Examples = std::map<std::pair<std::string_view, std::string_view>, std::string>;

constexpr std::size_t comment_column = 40;
constexpr double strip_in_spacings = 3.0;  ///< what the leading edge of particles needs

/// Text as a string of TOML: what a title holds is not said by us.
std::string toml_text(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) >= ' ' && c != '\x7f') out += c;
  }
  return out + '"';
}

std::string line(std::string entry, std::string_view comment) {
  entry.resize(std::max(entry.size() + 2, comment_column), ' ');
  return entry.append("# ").append(comment).append("\n");
}

std::string key_lines(const Examples& examples, std::string_view table) {
  std::string text;
  for (const StudyKey& key : study_keys()) {
    if (key.table != table) continue;
    std::string comment(key.takes);
    if (!key.does.empty()) comment.append(": ").append(key.does);
    const auto found = examples.find({table, key.key});
    text += found == examples.end() ? line("# " + std::string(key.key) + " =", comment)
                                    : line(std::string(key.key) + " = " + found->second, comment);
  }
  return text;
}

/// A product of what a user wrote as he would write it: 0.0435, not 0.043500000000000004.
std::string without_rounding(double value) {
  return number_text(std::round(1e9 * value) / 1e9);
}

Examples examples_of(const Case& flow, const std::string& case_name) {
  std::string times;
  for (int k = 1; k <= 4; ++k)
    times += (times.empty() ? "" : ", ") + without_rounding(0.25 * k * flow.time.end);
  return {{{"", "title"}, toml_text(flow.title + ", by several methods")},
          {{"", "reference"}, "\"vof\""},
          {{"", "strip_height"}, without_rounding(strip_in_spacings * flow.spacing)},
          {{"", "snapshot_times"}, "[" + times + "]"},
          {{"[defaults]", "program"}, "\"surge-particle\""},
          {{"[defaults]", "case"}, toml_text(case_name)},
          {{"[[run]]", "name"}, "\"mps\""},
          {{"[[run]]", "set"}, R"(["method.name=mps", "method.preset=improved"])"}};
}

}  // namespace

std::string new_study_text(const fs::path& case_file, const fs::path& folder) {
  if (!fs::is_regular_file(case_file))
    throw Error("--case: found \"" + case_file.string() + "\", expected an existing case file");
  const TomlTable root = TomlTable::read(case_file);
  const Case flow = read_case(root);
  check_case(flow, root);
  const fs::path named = fs::proximate(case_file, folder.empty() ? fs::path(".") : folder);
  const Examples examples = examples_of(flow, named.string());
  return "# A study to start from: one flow by three methods, held against interFoam (VOF).\n"
         "# After each entry: what it takes; what stands for it where it is left out: what it is.\n"
         "# Entries that begin with # are left out. docs/study-files.md and docs/studies.md tell "
         "more.\n" +
         key_lines(examples, "") + "\n[defaults]\n" + key_lines(examples, "[defaults]") +
         "\n[[run]]\n" + key_lines(examples, "[[run]]") +
         "\n[[run]]\nname = \"sph\"\nset = [\"method.name=sph\", \"method.preset=delta-plus\"]\n"
         "\n[[run]]\nname = \"isph\"\nset = [\"method.name=isph\", \"method.preset=shifted\"]\n"
         "\n# \"foam.cellsPerL=40\" in `set` makes the mesh finer; surge-foam list shows all "
         "settings.\n"
         "[[run]]\nname = \"vof\"\nprogram = \"interFoam\"\n\n# [[observable]]\n" +
         key_lines(examples, "[[observable]]");
}

}  // namespace surge::compare
