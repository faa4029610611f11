#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "compare/measure/front.hpp"
#include "compare/study/metrics.hpp"

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

/// A run's front and counts as they were when somebody found them right, with tolerances. Stored
/// as JSON; read_baseline() accepts nothing unknown, missing or not finite.
struct Baseline {
  struct Value {
    double value = 0.0;
    double tolerance = 0.0;
  };

  Provenance measured;
  Metres strip_height;
  double linking_length = 2.0;
  std::map<std::string, std::string> identity;  ///< method, preset
  DimensionlessLength front_tolerance;          ///< of Z/L at each T of front
  DimensionlessFront front;
  DimensionlessTime arrival_tolerance;               ///< of T at each level
  std::map<std::string, DimensionlessTime> arrival;  ///< "1.5": T
  std::map<std::string, Value> scalars;  ///< impact_time_s, lost_particles, spacing_m, ...
};

[[nodiscard]] Baseline read_baseline(const std::filesystem::path& file);
void write_baseline(const std::filesystem::path& file, const Baseline& baseline);

enum class Status { passed, failed, skipped };
[[nodiscard]] const char* status_text(Status status);

/// One quantity of a baseline held against a run; for a list of values, its worst point.
struct Finding {
  std::string quantity;
  Status status = Status::failed;
  std::string worst;  ///< "T = 1.2", empty for a single value
  std::string found;  ///< "missing" where the run has none
  std::string expected;
  double deviation = 0.0;  ///< not finite where the quantity is missing
  double tolerance = 0.0;
};

/// Every quantity of the baseline. One that the run lacks or that is not finite has failed.
[[nodiscard]] std::vector<Finding> check(const MeasuredRun& run, const Baseline& baseline);

/// Tolerances of a new baseline.
struct Tolerances {
  DimensionlessLength front{0.02};
  DimensionlessTime time{0.02};
};

/// A baseline from a run: its front at even steps of 0.1 in T up to `wall_distance` before the far
/// wall, arrivals, impact and counts. Throws surge::Error for a run that did not finish or whose
/// front does not get there.
[[nodiscard]] Baseline bless(const MeasuredRun& run, const FrontOptions& options,
                             const Tolerances& tolerances, const Provenance& measured);

/// Who blesses (git's user.name, else $USER), when, with what. `reason` must say something.
[[nodiscard]] Provenance provenance_now(const std::string& reason);

}  // namespace surge::compare
