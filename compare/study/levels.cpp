#include "compare/study/levels.hpp"

#include <algorithm>

namespace surge::compare {

std::vector<FlowLevels> levels_of(const StudyResult& study, const std::string& group) {
  std::vector<FlowLevels> all;
  for (const RunResult* run : study.runs_of(Role::verification)) {
    const auto found = study.flows.find({group, run->study.name});
    if (run->study.group != group || found == study.flows.end()) continue;
    const FlowCase& flow = found->second.flow;
    const std::string label = (flow.method == "mps" ? "MPS " : "SPH ") + flow.preset;
    auto place =
        std::find_if(all.begin(), all.end(), [&](const auto& l) { return l.label == label; });
    if (place == all.end()) {
      const bool recommended = label == "MPS improved" || label == "SPH delta-plus";
      place = all.insert(all.end(), {label, recommended, {}});
    }
    place->levels.push_back({run->study.name, &found->second});
  }
  for (FlowLevels& sequence : all) {
    std::sort(sequence.levels.begin(), sequence.levels.end(), [](const auto& a, const auto& b) {
      return a.result->flow.spacing > b.result->flow.spacing;
    });
  }
  return all;
}

}  // namespace surge::compare
