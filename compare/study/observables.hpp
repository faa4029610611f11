#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "particle/support/toml.hpp"

namespace surge::compare {

/// What of a curve is compared; see docs/studies.md. In the order of their words.
enum class CurveMeasure { rms, arrival, peak, peak_time, impulse, final, amplitude, phase };
[[nodiscard]] std::string_view measure_text(CurveMeasure measure);

/// One [[observable]] of a study. Texts are expressions (reference/expression.hpp), whose symbols
/// are known once a run is.
struct StudyObservable {
  std::string name;
  std::string kind;                               ///< registry.hpp
  std::map<std::string, std::string> parameters;  ///< of the kind
  std::string title;
  std::string component;  ///< "x", "y", "z"; empty: all that the kind has
  std::vector<std::string> references;
  std::vector<CurveMeasure> compare{CurveMeasure::rms};
  std::optional<std::array<std::string, 2>> window;
  std::optional<std::string> threshold, period;
  std::map<CurveMeasure, std::string> tolerance;
  std::string place;  ///< file:line of its table

  /// "gauge:x=0.3", as on a command line.
  [[nodiscard]] std::string request() const;
};

/// The [[observable]] tables of a study's file. Throws surge::Error with file:line for what is
/// missing, unknown or twice.
[[nodiscard]] std::vector<StudyObservable> read_observables(const TomlTable& root);

}  // namespace surge::compare
