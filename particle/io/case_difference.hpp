#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace surge {

/// An entry in which two case files differ; "nothing" stands for one that is missing.
struct CaseDifference {
  std::string key;  ///< such as fluid.density or block.0.lower
  std::string first;
  std::string second;
};

/// The first entry in which two cases written by to_toml() differ and which decides about the run:
/// how often it keeps checkpoints does not.
[[nodiscard]] std::optional<CaseDifference> case_difference(std::string_view first,
                                                            std::string_view second);

}  // namespace surge
