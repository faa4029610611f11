#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "compare/measure/front.hpp"
#include "compare/measure/observable.hpp"
#include "compare/read/source_options.hpp"

namespace surge::compare {

/// Where a baseline comes from.
struct Provenance {
  std::string by;
  std::string date;  ///< UTC, ISO 8601
  std::string version;
  std::string commit;
  std::string compiler;
  std::string cpu;
  std::string reason;
};

/// How far a value may be off: max(absolute, relative |expected|). A curve may also be early or
/// late by `time`: the expected value must lie between what was found within that time, widened by
/// the rest.
struct Tolerance {
  double absolute = 0.0;  ///< in the unit of the values
  double relative = 0.0;
  double time = 0.0;  ///< s; of profiles it is how far their time may be off

  [[nodiscard]] double of(double expected) const;
};

/// A result of an observable, over time or, of a profile, over a position at one time.
struct BaselineCurve {
  std::string observable;      ///< as it is asked for, "gauge:x=0.3"
  std::string series;          ///< name of the result, "centre-of-mass.x"
  std::string unit;            ///< of the values
  std::optional<double> time;  ///< s, of a profile
  std::vector<double> at;      ///< s or, of a profile, m; increasing
  std::vector<double> values;
  double interval = 0.0;  ///< largest one between neighbours in the source, s or m
  Tolerance tolerance;

  /// "gauge:x=0.3", "profile:times=0.1 at 0.1 s"
  [[nodiscard]] std::string name() const;
};

/// What a source gave when somebody found it right, with tolerances. Stored as JSON, which
/// read_baseline() accepts only as write_baseline() wrote it.
struct Baseline {
  struct Value {
    double value = 0.0;
    double tolerance = 0.0;
  };

  Provenance measured;
  std::map<std::string, std::vector<std::string>> read;  ///< SourceOptions::stated
  std::map<std::string, std::string> identity;           ///< method, preset, how it was read
  FrontOptions front;
  /// The comparison's window, s, and why it ends there.
  double from = 0.0;
  double until = 0.0;
  std::string because;
  std::vector<BaselineCurve> curves;
  std::map<std::string, Value> values;  ///< impact_time_s, lost_particles, spacing_m, ...

  /// Observables as they are asked for, each once.
  [[nodiscard]] std::vector<std::string> observables() const;
};

/// Of all that a baseline says but for its checksum.
[[nodiscard]] std::string baseline_checksum(nlohmann::json root);

/// Throws surge::Error for what is unknown, missing or not finite, where nothing is there to be
/// compared, and for a file that was changed by other means than write_baseline().
[[nodiscard]] Baseline read_baseline(const std::filesystem::path& file);
void write_baseline(const std::filesystem::path& file, const Baseline& baseline);

/// The options that the baseline's source was opened with, for another source. `place`: what errors
/// begin with.
[[nodiscard]] SourceOptions stored_options(const Baseline& baseline,
                                           const std::filesystem::path& source,
                                           const std::string& place);
/// What a baseline keeps of them.
[[nodiscard]] std::map<std::string, std::vector<std::string>> options_to_store(
    const SourceOptions& options, const std::filesystem::path& source);

/// Who blesses (git's user.name, else $USER), when, with what. `reason` must say something.
[[nodiscard]] Provenance provenance_now(const std::string& reason);

}  // namespace surge::compare
