#pragma once

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "compare/study/baseline_check.hpp"

namespace surge::compare {

/// What a check came to: of a source against a baseline, or against a live reference.
struct CheckReport {
  std::string source;   ///< name of the run
  std::string against;  ///< the baseline's file or the reference's name
  std::string window;   ///< "0 s to 0.24 s: ..."
  std::vector<Finding> findings;
  std::vector<std::string> notices;
  std::string error;  ///< why nothing could be compared; empty where it could

  /// Something was compared and all of it passed.
  [[nodiscard]] bool passed() const;
  [[nodiscard]] std::size_t failed() const;
};

/// A line per quantity with its worst point, then the window and the verdict.
void write_table(std::ostream& out, const CheckReport& report);

/// A test suite of a test case per quantity, as CI services read it (the de facto JUnit schema of
/// Apache Ant): <failure> where it failed, <error> where nothing could be compared. Text is UTF-8
/// without what XML 1.0 forbids.
void write_junit(std::ostream& out, const std::vector<CheckReport>& reports);

/// {"source", "against", "passed", "error", "window", "findings": [{"quantity", "status", "worst",
/// "found", "expected", "unit", "deviation", "tolerance", "why"}], "notices": []}; a deviation that
/// is no number is null.
[[nodiscard]] nlohmann::json to_json(const CheckReport& report);

}  // namespace surge::compare
