#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compare/measure/front.hpp"
#include "compare/read/run.hpp"
#include "compare/reference/series.hpp"
#include "compare/study/study.hpp"

namespace surge::compare {

/// Options that say what a source's files do not.
class SourceArguments {
 public:
  void add_to(CLI::App& app);
  /// Throws surge::Error for a number that cannot be.
  [[nodiscard]] SourceOptions get() const;

 private:
  SourceOptions options_;
  std::optional<double> column_width_;
  std::optional<double> column_height_;
  std::optional<double> bed_depth_;
  std::optional<double> tank_width_;
  std::optional<double> spacing_;
  std::optional<double> time_step_;
  std::optional<std::string> type_array_;
  std::string vertical_ = "y";
};

/// Options that define the leading edge.
class FrontArguments {
 public:
  void add_to(CLI::App& app);
  /// With a study, its strip height; both at once is an error.
  [[nodiscard]] FrontOptions get(const std::optional<Study>& study) const;

 private:
  std::optional<double> strip_height_;
  FrontOptions options_;
};

/// Runs and published series of a comparison: named one by one, or those of a study.
class StudyArguments {
 public:
  void add_to(CLI::App& app);
  [[nodiscard]] std::optional<Study> study() const;
  [[nodiscard]] std::vector<std::filesystem::path> runs(const std::optional<Study>& study) const;
  /// Name of the reference run.
  [[nodiscard]] std::string reference(const std::optional<Study>& study) const;
  [[nodiscard]] std::vector<PublishedSeries> published(const std::optional<Study>& study) const;

 private:
  std::vector<std::string> runs_;
  std::string reference_;
  std::string study_;
  std::string folder_ = "runs";
  std::vector<std::string> published_;
};

/// What was left out of a source or assumed about it, a line each on the standard error.
void print_notices(const Run& run);

}  // namespace surge::compare
