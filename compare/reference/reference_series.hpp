#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compare/read/physics.hpp"
#include "compare/reference/expression.hpp"

namespace surge::compare {

enum class ReferenceKind { experiment, computation, theory };
[[nodiscard]] std::string_view kind_text(ReferenceKind kind);

/// A published or exact curve of any observable, as docs/studies.md says it is written. Columns
/// stay as published; curve_for() makes SI values of them.
struct ReferenceSeries {
  struct Point {
    double first = 0.0;  ///< time or position
    double value = 0.0;
    double limit = 0.0;  ///< 95 % limit of the value
  };

  std::string name;   ///< of the file, without .csv
  std::string place;  ///< of the file, for errors
  std::string label, citation, axes, gate, note;
  std::string case_name;
  Physics of;               ///< of that case
  bool moves_wall = false;  ///< the case has a wall that is lifted, such as a gate
  std::string observable;   ///< kind
  std::string component;    ///< "x", "y", "z"; empty where the kind has one value
  std::string stated;       ///< name of a probe, gauge or force surface of the case
  std::array<std::optional<std::string>, 3> at;  ///< place: an expression per axis
  std::optional<std::string> at_time;            ///< of a profile
  std::string first_unit, value_unit;
  std::string first_zero = "0", value_zero = "0";
  ReferenceKind kind = ReferenceKind::experiment;
  double first_uncertainty = 0.0;  ///< 95 % limit, in the column's unit
  std::optional<std::string> shift_within;
  std::string clock;  ///< series of one clock are shifted together; empty: it has its own
  std::vector<Point> points;

  [[nodiscard]] bool is_profile() const { return at_time.has_value(); }
  /// Whether it belongs to one size of its case, because no unit has a length of the case in it.
  [[nodiscard]] bool of_one_size() const;
};

/// Reads a series. Throws surge::Error with file:line for what is missing, unknown, twice, no
/// number or no expression; and where its case cannot be read. `known`: observables that there are.
[[nodiscard]] ReferenceSeries read_reference(const std::filesystem::path& file,
                                             const std::vector<std::string>& known);

/// A series in SI units and in the coordinates of a run of its case.
struct ReferenceCurve {
  std::vector<double> first;  ///< s, or m along x; increasing
  std::vector<double> value;
  std::vector<double> limit;      ///< 95 % limits of the values
  double first_limit = 0.0;       ///< 95 % limit of the times or positions
  std::optional<double> at_time;  ///< of a profile, s
  double shift_within = 0.0;      ///< s; 0: the times are as they are
};
/// `unit`: of the observable. Throws surge::Error, with the series' file, where the value's unit
/// has another dimension, or a symbol is not known of the run.
[[nodiscard]] ReferenceCurve curve_for(const ReferenceSeries& series, const Physics& run,
                                       const std::string& unit);

/// Why a run is not of the case that a series belongs to; empty where it is. See docs/studies.md.
[[nodiscard]] std::optional<std::string> other_case(const ReferenceSeries& series,
                                                    const Physics& run);

/// Why a place in a run (m) is not the one of the series; empty where it is, or where the series
/// states none. Places agree within 2 % of L, or within `slack` (m) where that is more.
[[nodiscard]] std::optional<std::string> other_place(const ReferenceSeries& series,
                                                     const Physics& run,
                                                     const std::optional<Vec3>& place,
                                                     double slack);

}  // namespace surge::compare
