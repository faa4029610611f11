#include "particle/io/new_case.hpp"

#include <algorithm>
#include <array>

#include "particle/case/case_keys.hpp"
#include "particle/io/methods.hpp"
#include "particle/io/presets.hpp"
#include "particle/support/error.hpp"

namespace surge {
namespace {

/// What the file states of its example; any other key is a comment.
struct Example {
  std::string_view table, key, plane, space;  ///< value in 2D and in 3D
};
constexpr std::array examples{
    Example{"", "title", "\"My case\"", "\"My case\""},
    Example{"", "dimension", "2", "3"},
    Example{"[fluid]", "density", "1000.0", "1000.0"},
    Example{"[fluid]", "gravity", "[0.0, -9.81]", "[0.0, 0.0, -9.81]"},
    Example{"[tank]", "lower", "[0.0, 0.0]", "[0.0, 0.0, 0.0]"},
    Example{"[tank]", "upper", "[0.6, 0.9]", "[0.6, 0.15, 0.9]"},
    Example{"[tank]", "open", "[\"y+\"]", "[\"z+\"]"},
    Example{"[[block]]", "shape", "\"box\"", "\"box\""},
    Example{"[[block]]", "lower", "[0.0, 0.0]", "[0.0, 0.0, 0.0]"},
    Example{"[[block]]", "upper", "[0.15, 0.3]", "[0.15, 0.15, 0.3]"},
    Example{"[resolution]", "spacing", "0.01", "0.025"},
    Example{"[time]", "end", "0.5", "0.5"},
    Example{"[output]", "interval", "0.01", "0.01"},
};
constexpr std::size_t comment_column = 34;

const Example* example_of(const CaseKey& key) {
  const auto found = std::find_if(examples.begin(), examples.end(), [&](const Example& example) {
    return example.table == key.table && example.key == key.key;
  });
  return found == examples.end() ? nullptr : found;
}

std::string line(std::string entry, const std::string& comment) {
  entry.resize(std::max(entry.size() + 2, comment_column), ' ');
  return entry + "# " + comment + '\n';
}

std::string key_line(const CaseKey& key, int dimension) {
  std::string comment(key.takes);
  if (!key.does.empty()) comment.append(": ").append(key.does);
  std::string entry(key.key);
  const Example* example = example_of(key);
  if (example == nullptr) return line("# " + entry + " =", comment);
  return line(entry.append(" = ").append(dimension == 2 ? example->plane : example->space),
              comment);
}

bool has_example(std::string_view table) {
  return std::any_of(examples.begin(), examples.end(),
                     [&](const Example& example) { return example.table == table; });
}

std::string toml_text(std::string_view word) {
  return std::string("\"").append(word).append("\"");
}

std::string method_tables() {
  const std::string_view method = methods().front().name;
  const std::string preset = preset_names(method).front();
  std::string names, presets;
  for (const Method& one : methods()) names.append(names.empty() ? "" : " | ").append(one.name);
  for (const Method& one : methods()) {
    presets.append("# ").append(one.name).append(": ");
    std::string list;
    for (const std::string& name : preset_names(one.name))
      list.append(list.empty() ? "" : ", ").append(name);
    presets.append(list).append("\n");
  }
  return "\n# [search]\n" + line("# neighbours =", "cell_grid | all_pairs; cell_grid") +
         "\n[method]\n" + line("name = " + toml_text(method), names) +
         line("preset = " + toml_text(preset),
              "one of those of the method, which set its options:") +
         presets + "\n# Options of the method one by one: surge-particle list --options\n# [" +
         std::string(method) + "]\n";
}

}  // namespace

std::string new_case_text(int dimension) {
  if (dimension != 2 && dimension != 3)
    throw Error("--dimension: found " + std::to_string(dimension) + ", expected 2 or 3");
  std::string text =
      "# A case to start from. Lengths in m, times in s, SI units throughout; points are [x, y" +
      std::string(dimension == 2 ? "" : ", z") +
      "].\n# After each entry: what it takes; what stands for it where it is left out: what it "
      "is.\n# Entries that begin with # are left out. A table in double brackets may be there "
      "several times.\n";
  std::string_view table = "-";
  for (const CaseKey& key : case_keys()) {
    if (key.table != table) text += '\n';
    if (key.table != table && !key.table.empty())
      text.append(has_example(key.table) ? "" : "# ").append(key.table).append("\n");
    table = key.table;
    text += key_line(key, dimension);
  }
  return text + method_tables();
}

}  // namespace surge
