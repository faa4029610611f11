#pragma once

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "compare/measure/observable.hpp"

namespace surge::compare {

/// What was measured of one source.
struct MeasuredSource {
  std::string name;
  std::string path;
  std::vector<std::string> requests;  ///< one per entry of `findings`
  std::vector<Findings> findings;
  std::vector<std::string> notices;  ///< of the source itself
};

/// A line per series: number of values, absent ones, first, last, least and largest with their
/// times; a line per profile; failures.
void write_table(std::ostream& out, const MeasuredSource& source);

/// Columns source,series,unit,time_s,x_m,value: a line per value; x_m for profiles only, value
/// empty where there is none (RFC 4180).
void write_csv(std::ostream& out, const std::vector<MeasuredSource>& sources);

/// [{"name", "path", "series": [{"name", "unit", "time_s": [], "value": [], "absent"}], "profiles":
/// [{"name", "unit", "asked_s", "time_s", "x_m": [], "value": []}], "notices": [], "failures":
/// {}}]; a value that is not there is null.
[[nodiscard]] nlohmann::json to_json(const std::vector<MeasuredSource>& sources);

}  // namespace surge::compare
