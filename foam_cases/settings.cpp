#include "foam_cases/settings.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

#include "foam_cases/text.hpp"
#include "particle/support/spelling.hpp"

namespace surge::foam {

namespace {

using Pair = std::pair<std::string_view, std::string_view>;

/// Names that may be used instead of those of the dictionary.
constexpr std::array<Pair, 2> synonyms{{{"cells_per_length", "cellsPerL"}, {"length", "L"}}};

/// What a case file says, by the name that caseParameters has for it.
constexpr std::array<Pair, 7> of_the_case{{{"title", "title"},
                                           {"wall", "tank.wall"},
                                           {"rhoWater", "fluid.density"},
                                           {"nuWater", "fluid.kinematic_viscosity"},
                                           {"gravity", "fluid.gravity"},
                                           {"endTime", "time.end"},
                                           {"writeInterval", "output.interval"}}};

/// Words that a setting takes; empty where a dictionary takes many.
std::vector<std::string_view> words_of(std::string_view key) {
  if (key == "solver") return {"interFoam", "interIsoFoam"};
  if (key == "momentumPredictor") return {"yes", "no"};
  if (key == "writeFormat") return {"ascii", "binary"};
  if (key == "writeCompression") return {"on", "off"};
  return {};
}

/// A dictionary takes these letters as they are: none of them ends an entry or starts a directive.
bool plain(std::string_view text) {
  constexpr std::string_view others = "_.+- ()";
  return !text.empty() && std::all_of(text.begin(), text.end(), [&](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           others.find(c) != std::string_view::npos;
  });
}

void read_text(const TomlTable& table, const char* key, std::string& member) {
  const std::vector<std::string_view> words = words_of(key);
  if (!words.empty()) {
    member = words[table.choice(key, words)];
    return;
  }
  member = table.text(key);
  if (!plain(member)) {
    throw table.error(key, '"' + member + '"',
                      "a scheme of letters, digits, blanks and . + - ( ) _");
  }
}

std::string key_of(const std::string& assignment) {
  return assignment.substr(0, assignment.find('='));
}

/// The assignment under the name that the dictionary has for its key.
std::string by_dictionary_name(const std::string& assignment) {
  const std::string key = key_of(assignment);
  for (const auto& [name, dictionary] : synonyms)
    if (key == name) return std::string(dictionary) + assignment.substr(key.size());
  return assignment;
}

void check_key(const std::string& assignment) {
  const std::string key = key_of(assignment);
  std::vector<std::string> known;
  for (const SettingText& setting : setting_texts({})) known.push_back(setting.key);
  for (const auto& [name, dictionary] : synonyms) known.emplace_back(name);
  if (std::find(known.begin(), known.end(), key) != known.end()) return;
  for (const auto& [name, entry] : of_the_case) {
    if (key != name) continue;
    throw Error("--foam " + assignment + ": found what the case says, expected --set " +
                std::string(entry) + "=...");
  }
  const std::string near = nearest(key, known);
  throw Error(
      "--foam " + assignment + ": found no such setting, expected " +
      (near.empty() ? "one of those that surge-foam list shows" : '"' + near + "\" perhaps"));
}

}  // namespace

std::vector<SettingText> setting_texts(const Settings& settings) {
  std::vector<SettingText> texts;
  visit_settings(settings, [&](const char* group, const char* key, const auto& member, Bounds,
                               const char* comment) {
    if constexpr (std::same_as<std::remove_cvref_t<decltype(member)>, std::string>) {
      texts.push_back({group, key, member, comment});
    } else {
      texts.push_back({group, key, number_text(static_cast<double>(member)), comment});
    }
  });
  return texts;
}

Settings read_settings(std::span<const std::string> assignments) {
  std::vector<std::string> entries;
  for (const std::string& assignment : assignments) {
    if (assignment.find('=') == std::string::npos)
      throw Error("--foam " + assignment + ": found no '=', expected key=value");
    check_key(assignment);
    // Values are read as TOML; a table gives the override a place.
    entries.push_back("foam." + by_dictionary_name(assignment));
  }
  Settings settings;
  try {
    const TomlTable table = TomlTable::parse("[foam]\n", "settings", entries).table("foam");
    visit_settings(settings,
                   [&](const char*, const char* key, auto& member, Bounds bounds, const char*) {
                     using Member = std::remove_reference_t<decltype(member)>;
                     if (!table.has(key)) return;
                     if constexpr (std::same_as<Member, std::string>) {
                       read_text(table, key, member);
                     } else if constexpr (std::integral<Member>) {
                       member = table.integer(key, bounds);
                     } else {
                       member = table.number(key, bounds);
                     }
                   });
  } catch (const Error& error) {
    std::string text = error.what();
    const std::string place = "--set foam.";
    if (text.starts_with(place)) text = "--foam " + text.substr(place.size());
    throw Error(text);
  }
  if (settings.write_compression == "on" && settings.write_format != "ascii")
    throw Error("--foam writeCompression=on: found writeFormat binary, expected ascii");
  return settings;
}

Settings resolved(Settings settings, const Case& c) {
  if (settings.length <= 0.0) {
    const Box& first = c.blocks.front().box;
    // Without the noise of the difference.
    settings.length = std::strtod(short_text(first.upper[0] - first.lower[0]).c_str(), nullptr);
  }
  if (settings.first_step <= 0.0) settings.first_step = c.time.initial_step;
  if (settings.maximum_step <= 0.0) settings.maximum_step = c.time.maximum_step;
  if (settings.first_step > settings.maximum_step) {
    throw Error("--foam deltaT: found " + number_text(settings.first_step) +
                " s, expected at most maxDeltaT = " + number_text(settings.maximum_step) + " s");
  }
  return settings;
}

}  // namespace surge::foam
