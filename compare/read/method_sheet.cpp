#include "compare/read/method_sheet.hpp"

#include <algorithm>
#include <fstream>

#include "particle/support/error.hpp"

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
    sheet.stages.push_back({entry.at("function"), entry.at("does"), entry.at("equations")});
  if (!(sheet.spacing > 0.0) || sheet.stages.empty())
    throw Error("spacing_m, stages: expected a length above 0 and at least one stage");
  return sheet;
}

}  // namespace

const MethodSheet::Function& MethodSheet::function(const std::string& wanted) const {
  for (const Function& f : functions) {
    if (f.name == wanted) return f;
  }
  throw Error("method.json: functions: no " + wanted + " found, one expected of " + method);
}

std::optional<MethodSheet> read_method_sheet(const Run& run) {
  const auto file = run.path / "method.json";
  std::ifstream in(file);
  if (!in) return std::nullopt;
  try {
    return sheet_from(json::parse(in));
  } catch (const std::exception& error) {
    throw Error(file.string() + ": " + error.what());
  }
}

}  // namespace surge::compare
