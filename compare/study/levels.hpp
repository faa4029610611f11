#pragma once

#include <string>
#include <vector>

#include "compare/study/study_result.hpp"

namespace surge::compare {

/// The runs of one method and preset of a flow, from coarse to fine.
struct FlowLevels {
  struct Level {
    std::string run;
    const FlowResult* result;
  };
  std::string label;         ///< "MPS improved"
  bool recommended = false;  ///< whether the preset is held to the flow's bar
  std::vector<Level> levels;
};

/// Of a flow's complete runs, in the order of the study's presets.
[[nodiscard]] std::vector<FlowLevels> levels_of(const StudyResult& study, const std::string& group);

}  // namespace surge::compare
