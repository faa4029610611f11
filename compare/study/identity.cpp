#include "compare/study/identity.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>

#include "compare/read/foam_dictionary.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Entries of a case that decide about no result.
constexpr std::array no_matter{"title"};
/// What an OpenFOAM case states of the case that it was made from. Its time steps, its mesh and its
/// method are its own.
constexpr std::array of_any_program{"dimension", "fluid",        "tank",  "blocks",
                                    "obstacles", "moving_walls", "output"};

/// Entries that make an obstacle another body than the box around it.
bool is_surface(const std::string& key) {
  return key == "polygon" || key == "vertices" || key == "triangles";
}

bool same_number(double a, double b) {
  return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b));
}

std::optional<JsonDifference> difference_at(const std::string& path, const json& found,
                                            const json& expected) {
  if (found.is_number() && expected.is_number()) {
    if (same_number(found.get<double>(), expected.get<double>())) return std::nullopt;
    return JsonDifference{path, found, expected};
  }
  if (found.is_object() && expected.is_object()) {
    for (const auto& [key, value] : found.items())
      if (is_surface(key) && !expected.contains(key)) return JsonDifference{path, found, expected};
    for (const auto& [key, value] : expected.items()) {
      if (!found.contains(key) && is_surface(key)) return JsonDifference{path, found, expected};
      if (!found.contains(key)) continue;
      std::string below = path;
      if (!below.empty()) below += '.';
      if (auto difference = difference_at(below + key, found.at(key), value)) return difference;
    }
    return std::nullopt;
  }
  if (found.is_array() && expected.is_array() && found.size() == expected.size()) {
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (auto difference =
              difference_at(path + "." + std::to_string(i), found.at(i), expected.at(i)))
        return difference;
    }
    return std::nullopt;
  }
  if (found == expected) return std::nullopt;
  return JsonDifference{path, found, expected};
}

std::string value_text(const json& value) {
  std::string text = value.is_string() ? value.get<std::string>()
                                       : value.dump(-1, ' ', false, json::error_handler_t::replace);
  if (text.size() > 60) text = text.substr(0, 60) + "...";
  return text;
}

std::string told(const JsonDifference& difference, const std::string& method) {
  std::string name = difference.path;  // as a user names it in a case file
  if (name == "spacing") name = "resolution.spacing";
  const std::string parameters = "method.parameters.";
  if (name.starts_with(parameters)) name = method + "." + name.substr(parameters.size());
  return "made with " + name + " = " + value_text(difference.found) + ", the study asks for " +
         value_text(difference.expected);
}

/// The parts of a case that any program's manifest states alike.
json common_parts(const json& stated) {
  json parts = json::object();
  for (const char* name : of_any_program)
    if (stated.contains(name)) parts[name] = stated.at(name);
  if (stated.contains("time") && stated.at("time").is_object() && stated.at("time").contains("end"))
    parts["time"]["end"] = stated.at("time").at("end");
  return parts;
}

/// Words of a dictionary's entry, as numbers where they are.
json words_json(const std::vector<std::string>& words) {
  json list = json::array();
  for (const std::string& word : words) {
    double number = 0.0;
    const char* last = word.data() + word.size();
    const auto [end, failed] = std::from_chars(word.data(), last, number);
    if (failed == std::errc() && end == last) {
      list.push_back(number);
    } else {
      list.push_back(word);
    }
  }
  return list.size() == 1 ? list.front() : list;
}

}  // namespace

json case_parameters(const fs::path& case_folder) {
  const FoamDictionary dictionary =
      FoamDictionary::read(case_folder / "system/caseParameters", case_folder);
  json parameters = json::object();
  for (const std::string& key : dictionary.keys())
    parameters[key] = words_json(dictionary.words(key));
  return parameters;
}

json parameter_value(const std::string& text) {
  std::string plain = text;
  for (char& c : plain)
    if (c == '(' || c == ')' || c == '"') c = ' ';
  std::istringstream in(plain);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words_json(words);
}

std::optional<JsonDifference> first_difference(const json& found, const json& expected) {
  return difference_at("", found, expected);
}

std::optional<std::string> other_run(const StudyRun& run, const fs::path& folder,
                                     const json& manifest) {
  if (!run.resolved.is_object()) return std::nullopt;
  if (const int threads = manifest.is_object() ? manifest.value("threads", run.threads) : 0;
      manifest.is_object() && threads != run.threads)
    return told({"threads", threads, run.threads}, "");
  if (run.resolved.contains("parameters")) {
    json expected = run.resolved.at("parameters");
    expected.erase("nProcs");  // a matter of the machine
    const auto difference = first_difference(case_parameters(folder), expected);
    return difference ? std::optional(told(*difference, "")) : std::nullopt;
  }
  if (!run.resolved.contains("case") || !manifest.is_object() || !manifest.contains("case"))
    return std::nullopt;
  json expected = run.resolved.at("case"), found = manifest.at("case");
  if (run.program == "interFoam") {
    expected = common_parts(expected);
    found = common_parts(found);
  }
  for (const char* name : no_matter) expected.erase(name);
  const std::string method =
      found.contains("method") ? found.at("method").value("name", "") : std::string();
  // The method first: with another one, all its options differ.
  if (expected.contains("method") && found.contains("method")) {
    for (const char* name : {"name", "preset"}) {
      const json& theirs = found.at("method").value(name, json());
      const json& ours = expected.at("method").value(name, json());
      if (theirs != ours) return told({std::string("method.") + name, theirs, ours}, method);
    }
  }
  const auto difference = first_difference(found, expected);
  return difference ? std::optional(told(*difference, method)) : std::nullopt;
}

}  // namespace surge::compare
