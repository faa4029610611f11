#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "compare/units.hpp"

namespace surge::compare {

/// One computation of a study.
struct StudyRun {
  std::string name;                   ///< folder under runs/
  std::string program;                ///< "surge-particle" or "interFoam"
  std::filesystem::path case_path;    ///< as written, relative to the repository
  std::vector<std::string> settings;  ///< "key=value"
  int threads = 1;
  bool timing = false;  ///< made to be timed only: it counts for the cost, not for the flow
};

/// compare/studies/*.toml
struct Study {
  std::string title;
  std::string reference;  ///< name of the run that the others are measured against
  Metres strip_height;
  std::vector<Seconds> snapshot_times;
  std::vector<std::string> published;  ///< compare/reference/<name>.csv
  std::vector<StudyRun> runs;
};

/// Throws surge::Error with file:line for unknown, missing, doubled or impossible values.
[[nodiscard]] Study read_study(const std::filesystem::path& file);

}  // namespace surge::compare
