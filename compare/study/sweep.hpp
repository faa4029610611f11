#pragma once

#include <string>
#include <utility>
#include <vector>

#include "particle/support/toml.hpp"

namespace surge::compare {

/// What a sweep makes of one [[run]] table: a value for each of its keys, as text.
///
///   sweep = {per = [15, 29], "resolution.spacing" = [0.01, 0.005]}     two runs: the lists of one
///       table go together, entry by entry, and are of one length
///   sweep = [{preset = ["paper", "improved"]}, {per = [15, 29]}]       four runs: of several
///       tables every combination is made, the first table changing slowest
///
/// In name, group, case and set, `{key}` stands for the value, {{ and }} for braces. A key with a
/// dot is a setting: where no {key} in `set` takes its value, `key=value` is added at the end of
/// `set`. The key `threads` is the run's number of threads.
class Combination {
 public:
  Combination() = default;
  explicit Combination(std::vector<std::pair<std::string, std::string>> values)
      : values_(std::move(values)) {}

  /// The entry `key` of a run's table, a text, with the values filled in. Throws surge::Error for
  /// what stands in braces and is not swept.
  [[nodiscard]] std::string filled(const TomlTable& run, std::string_view key,
                                   const std::string& text) const;
  /// `set` of a run's table, with the swept settings.
  [[nodiscard]] std::vector<std::string> settings(const TomlTable& run) const;
  [[nodiscard]] const std::string* find(std::string_view key) const;
  [[nodiscard]] bool empty() const { return values_.empty(); }

 private:
  std::vector<std::pair<std::string, std::string>> values_;
};

/// All combinations of a run's sweep, in their order; a single empty one where it has none. Throws
/// surge::Error for lists of different length, a key given twice, and more than 10000 combinations.
[[nodiscard]] std::vector<Combination> read_sweep(const TomlTable& run);

}  // namespace surge::compare
