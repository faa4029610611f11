#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "compare/read/run.hpp"
#include "compare/read/units.hpp"
#include "compare/study/observables.hpp"
#include "compare/study/statements.hpp"

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

/// One computation of a study, in one role; or, program = "files", what another program has left.
struct StudyRun {
  std::string name;                   ///< folder under runs/
  std::string program;                ///< "surge-particle", "interFoam" or "files"
  std::filesystem::path case_path;    ///< as written; of files: their folder, file or pattern
  std::filesystem::path case_file;    ///< where that is, from the working folder
  std::vector<std::string> settings;  ///< "key=value"
  int threads = 1;
  bool timed = true;       ///< alone on the machine
  bool may_break = false;  ///< an end before its time is a result, as of equations that break up
  Role role = Role::comparison;
  /// Keys of compare_physics in which it may differ from the reference: a coarser level whose
  /// lattice holds the sizes of the case no better.
  std::set<std::string> allowed_differences;
  std::string group;                         ///< never empty in the roles that explain it above
  std::optional<std::filesystem::path> map;  ///< files: says what their arrays are
  std::vector<std::pair<std::string, std::string>> read;  ///< files: options, as on a command line
  std::string place;     ///< file:line of its table, for errors about it
  SourceOptions source;  ///< what `read` says, once an interface has understood it
  /// What it is to compute, see check_study(); null before. Of files "cpu_s", where the study says
  /// it.
  nlohmann::json resolved;

  [[nodiscard]] bool is_files() const { return program == "files"; }
  /// Whether a case file says what is computed, and not the folder of an OpenFOAM case.
  [[nodiscard]] bool made_from_case_file() const { return case_path.extension() == ".toml"; }
  /// Whether the other is the same computation, in whatever role.
  [[nodiscard]] bool computes_the_same_as(const StudyRun& other) const;
  /// Its folder below that of the runs, or where its files are.
  [[nodiscard]] std::filesystem::path folder(const std::filesystem::path& runs) const {
    return is_files() ? case_file : runs / name;
  }
};

/// compare/studies/*.toml
struct Study {
  std::string title;
  /// Name of the run that the others are measured against; empty where all runs are verification.
  std::string reference;
  Metres strip_height;
  std::vector<Seconds> snapshot_times;
  std::vector<std::string> published;  ///< names, see series_file()
  /// Those of the first file that has some; empty: those of the case, see study_observables().
  std::vector<StudyObservable> observables;
  /// Whose statements the runs are held against, the name of a folder beside the study or in
  /// compare/studies of the working folder; empty: nobody's.
  std::string claims;
  Statements statements;  ///< those of that folder
  /// Those of the included files, then the file's own. A run stands here once in each role and
  /// group that it has.
  std::vector<StudyRun> runs;
  std::vector<std::filesystem::path> files;  ///< itself and what it includes
  std::string published_place;               ///< file:line of the entry, for errors about it
  std::string reference_place;
  std::string snapshot_place;
};

/// The file of a published series: NAME.csv in `folder` where that is given, else beside the study,
/// in ../reference beside it, or in compare/reference of the working folder. Throws surge::Error
/// where there is none.
[[nodiscard]] std::filesystem::path series_file(const Study& study, const std::string& name,
                                                const std::filesystem::path& folder = {});

/// All series that a study names, published ones first, each once.
[[nodiscard]] std::vector<std::string> named_series(const Study& study);
/// Whether the study asks for the leading edge by itself: names it, or names no observable.
[[nodiscard]] bool asks_for_front(const Study& study);

/// `named` relative to `folder` if it exists there, else as it is, relative to the working folder.
[[nodiscard]] std::filesystem::path place_of(const std::filesystem::path& folder,
                                             const std::filesystem::path& named);

/// Reads a study and all that it includes, as far as the files of the study themselves say it; what
/// they name is held against the disk and the programs by check_study(). One whose runs are all of
/// role verification needs no more than a title. A head entry that the study does not have (title,
/// reference, strip_height, snapshot_times, published, claims) is that of the first included file
/// that has it. Throws surge::Error with file:line for unknown, missing or impossible values, and
/// where two runs of one name compute different things.
[[nodiscard]] Study read_study(const std::filesystem::path& file);

}  // namespace surge::compare
