#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compare/measure/front.hpp"
#include "compare/read/run.hpp"
#include "compare/reference/series.hpp"
#include "compare/study/study.hpp"

namespace surge::compare {

/// Options that say what a source's files do not: `--spacing 0.01`, or `--spacing NAME=0.01` where
/// a comparison has several sources that need some (NAME as a run's folder is called, or the path
/// as it was typed). Each belongs to one source, never to all of them.
class SourceArguments {
 public:
  void add_to(CLI::App& app);
  /// The options of each source, in their order. A value without a name belongs to the only source
  /// that can take it: one without a manifest.json, for --alpha-array an OpenFOAM case. Throws
  /// surge::Error for a number that cannot be, for a name that no source has, for a value without a
  /// name where several sources could be meant, and for one that is given twice for a source.
  [[nodiscard]] std::vector<SourceOptions> get(
      const std::vector<std::filesystem::path>& sources) const {
    return get(sources, std::vector<SourceOptions>(sources.size()));
  }
  /// Of one source; what is said goes over what `before` has.
  [[nodiscard]] SourceOptions get(const std::filesystem::path& source,
                                  const SourceOptions& before = {}) const;

 private:
  [[nodiscard]] std::vector<SourceOptions> get(const std::vector<std::filesystem::path>& sources,
                                               std::vector<SourceOptions> options) const;
  struct Given {
    std::string key;
    std::vector<std::string> values;
    bool list = false;
  };
  std::vector<std::unique_ptr<Given>> given_;
};

/// What the `read` table and the map of a run of program "files" say, understood as the options of
/// the same names. Throws surge::Error with the run's place.
[[nodiscard]] SourceOptions source_options(const StudyRun& run);

/// A study, read and held against the disk and the programs, see check_study(). `programs`: their
/// folder, that of this program where it is empty.
[[nodiscard]] Study read_checked_study(const std::filesystem::path& file,
                                       const std::string& programs = {},
                                       const std::string& only = {},
                                       const std::filesystem::path& series = {});

/// Options that define the leading edge.
class FrontArguments {
 public:
  void add_to(CLI::App& app);
  /// With a study, its strip height; both at once is an error.
  [[nodiscard]] FrontOptions get(const std::optional<Study>& study) const;
  /// Whether anything was said.
  [[nodiscard]] bool given() const;

 private:
  std::optional<double> strip_height_;
  FrontOptions options_;
  std::vector<const CLI::Option*> added_;
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
