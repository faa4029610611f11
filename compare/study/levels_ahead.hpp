#pragma once

#include <string>
#include <vector>

#include "compare/study/study.hpp"

namespace surge::compare {

/// Whether both compute the same but for how fine and how long, as far as their tables say it: by
/// their group, or else by program, case and settings.
[[nodiscard]] bool may_be_levels(const StudyRun& a, const StudyRun& b);

/// Of a study that was checked (check_study()), before a run is made: the runs of the comparison
/// whose uncertainty its levels cannot tell, so that their differences will get no verdict; a line
/// for each kind of lack, none where there is none. What other programs left is not judged, whose
/// spacing is known when it is read.
[[nodiscard]] std::vector<std::string> verdicts_out_of_reach(const Study& study);

}  // namespace surge::compare
