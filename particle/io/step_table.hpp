#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "particle/case/case.hpp"
#include "particle/core/step_report.hpp"

namespace surge {

/// steps.csv: a row per time step, with the probes' pressures (Pa) as the last columns.
class StepTable {
 public:
  /// Throws Error where the file cannot be written.
  StepTable(const std::filesystem::path& file, const std::vector<Probe>& probes);

  void add(double time, const StepReport& report, const std::vector<double>& pressures);
  /// Brings the rows so far to disk; throws Error where that failed.
  void flush();

 private:
  std::filesystem::path file_;
  std::ofstream stream_;
};

}  // namespace surge
