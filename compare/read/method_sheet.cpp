#include "compare/read/method_sheet.hpp"

#include <algorithm>
#include <sstream>

#include "particle/support/error.hpp"
#include "particle/support/json.hpp"
#include "particle/support/regular_file.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

MethodSheet::Function function_from(const json& entry) {
  MethodSheet::Function f{entry.at("name"), entry.at("unit"), entry.at("support_m"),
                          entry.at("r_m"), entry.at("value")};
  if (f.r.empty() || f.r.size() != f.value.size() || !std::is_sorted(f.r.begin(), f.r.end()) ||
      !(f.support > 0.0)) {
    throw Error(f.name + ": " + std::to_string(f.r.size()) + " places and " +
                std::to_string(f.value.size()) +
                " values found, as many of both and increasing places expected");
  }
  return f;
}

MethodSheet sheet_from(const json& file) {
  MethodSheet sheet;
  sheet.method = file.at("method");
  sheet.dimension = file.at("dimension");
  sheet.spacing = file.at("spacing_m");
  if (file.contains("length_m")) sheet.length = file["length_m"].get<double>();
  for (const json& entry : file.at("functions")) sheet.functions.push_back(function_from(entry));
  const json& loop = file.at("loop");
  sheet.start = loop.at("start");
  sheet.until = loop.at("until");
  sheet.step = loop.at("step");
  for (const json& entry : file.at("stages"))
    sheet.stages.push_back({entry.at("function"), entry.at("does"), entry.at("equations"),
                            entry.value("if", std::string())});
  if (!(sheet.spacing > 0.0) || sheet.stages.empty())
    throw Error("spacing_m, stages: expected a length above 0 and at least one stage");
  return sheet;
}

/// Whether an option is on: "shifting", or has a value: "negative_pressure=difference".
bool is_on(const std::string& word, const json& stated) {
  const auto equals = word.find('=');
  const std::string name = word.substr(0, equals);
  json value = true;  // what is not stated may well act
  for (const char* part : {"", "/fluid", "/method/parameters"}) {
    json::json_pointer pointer(part);
    pointer /= name;
    if (stated.contains(pointer)) value = stated.at(pointer);
  }
  if (equals != std::string::npos) return value == word.substr(equals + 1) || value == true;
  if (value.is_number()) return value.get<double>() != 0.0;
  return !value.empty() && value != "none" && value != false;
}

}  // namespace

bool is_any_on(const std::string& options, const json& stated) {
  if (options.empty()) return true;
  std::istringstream words(options);
  for (std::string word; words >> word;)
    if (word != "or" && is_on(word, stated)) return true;
  return false;
}

std::vector<MethodSheet::Stage> MethodSheet::stages_with(const json& stated) const {
  std::vector<Stage> called;
  for (const Stage& stage : stages)
    if (is_any_on(stage.options, stated)) called.push_back(stage);
  return called;
}

const MethodSheet::Function& MethodSheet::function(const std::string& wanted) const {
  for (const Function& f : functions) {
    if (f.name == wanted) return f;
  }
  throw Error("method.json: functions: no " + wanted + " found, one expected of " + method);
}

std::optional<MethodSheet> read_method_sheet(const Run& run) {
  const auto file = run.path / "method.json";
  std::error_code failed;
  if (!std::filesystem::exists(file, failed)) return std::nullopt;
  require_inside(file, run.path);
  const json document = read_json(file);
  try {
    return sheet_from(document);
  } catch (const std::exception& error) {
    throw Error(file.string() + ": " + error.what());
  }
}

}  // namespace surge::compare
