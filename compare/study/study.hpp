#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "compare/read/units.hpp"

namespace surge::compare {

/// What a run is made for, and so where the report shows it.
enum class Role {
  comparison,   ///< the study's story: figures, viewer, tables
  timing,       ///< only what it cost counts
  sensitivity,  ///< one choice made otherwise; its group names the choice
  convergence,  ///< one resolution of a sequence; its group names the sequence
  verification  ///< a flow with a known answer; its group names the flow
};
[[nodiscard]] std::string_view role_text(Role role);

/// One computation of a study, in one role.
struct StudyRun {
  std::string name;                   ///< folder under runs/
  std::string program;                ///< "surge-particle" or "interFoam"
  std::filesystem::path case_path;    ///< as written, relative to the repository
  std::vector<std::string> settings;  ///< "key=value"
  int threads = 1;
  Role role = Role::comparison;
  std::string group;  ///< never empty in the roles that explain it above

  /// Whether the other is the same computation, in whatever role.
  [[nodiscard]] bool computes_the_same_as(const StudyRun& other) const;
  [[nodiscard]] bool operator==(const StudyRun& other) const = default;
};

/// compare/studies/*.toml
struct Study {
  std::string title;
  /// Name of the run that the others are measured against; empty where all runs are verification.
  std::string reference;
  Metres strip_height;
  std::vector<Seconds> snapshot_times;
  std::vector<std::string> published;  ///< compare/reference/<name>.csv
  /// Whose statements the runs are held against, the name of a folder beside the study; empty:
  /// nobody's.
  std::string claims;
  /// Those of the included files, then the file's own. A run stands here once in each role and
  /// group that it has.
  std::vector<StudyRun> runs;
};

/// Reads a study and all that it includes. One whose runs are all of role verification needs no
/// more than a title. A head entry that the study does not have (title,
/// reference, strip_height, snapshot_times, published, claims) is that of the first included file
/// that has it. Throws surge::Error with file:line for unknown, missing or impossible values, and
/// where two runs of one name compute different things.
[[nodiscard]] Study read_study(const std::filesystem::path& file);

}  // namespace surge::compare
