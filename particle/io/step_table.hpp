#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "particle/case/case.hpp"
#include "particle/core/step_report.hpp"

namespace surge {

/// What a case records at every step, as columns of steps.csv: NAME of each probe (Pa), then
/// force_NAME_x, force_NAME_y (and _z) of each force surface (N; N/m in 2D).
[[nodiscard]] std::vector<std::string> recorded_columns(const Case& c);

/// steps.csv: a row per time step, the recorded columns last. The file always ends with a whole
/// row. Throws Error with the cause where it cannot be written.
class StepTable {
 public:
  StepTable(std::filesystem::path file, const std::vector<std::string>& recorded);
  /// Goes on with the table that is there, of so many rows until `time`, s.
  StepTable(std::filesystem::path file, long rows, double time);
  StepTable(const StepTable&) = delete;
  StepTable& operator=(const StepTable&) = delete;
  ~StepTable();

  void add(double time, const StepReport& report, const std::vector<double>& recorded);
  /// Brings the rows so far to the file.
  void flush();

  /// Rows that the file has, and the time of the last of them, s.
  [[nodiscard]] long written() const { return written_; }
  [[nodiscard]] double written_until() const { return written_until_; }

 private:
  void open(int flags);
  [[noreturn]] void fail(int cause) const;

  std::filesystem::path file_;
  int descriptor_ = -1;
  std::string waiting_;  ///< rows that are not in the file yet
  long rows_ = 0;
  double time_ = 0.0;  ///< s, of the last row
  long written_ = 0;
  double written_until_ = 0.0;  ///< s
  long written_bytes_ = 0;
};

/// Throws RestartError where a table has fewer rows, or another time (s) in the last of these.
void check_rows(const std::filesystem::path& file, long rows, double time);

/// Leaves the header and so many rows.
void cut_rows(const std::filesystem::path& file, long rows);

}  // namespace surge
