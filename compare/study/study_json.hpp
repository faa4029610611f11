#pragma once

#include <nlohmann/json.hpp>

#include "compare/study/study.hpp"

namespace surge::compare {

/// A study as other programs read it:
///   {"title", "files": [...], "reference", "strip_height", "snapshot_times", "claims",
///    "published": [{"name", "file"}], "notices": [lines of verdicts_out_of_reach()],
///    "runs": [{"name", "program", "case" (file or folder), "settings": [...], "threads", "timed",
///              "may_break", "roles": [{"role", "group"}], "map", "read": {...}, "resolved"}]}
/// A run stands there once, with all of its roles; "timed" and "may_break" are true where they are
/// so in any of them. With `only`, the other runs are left out.
[[nodiscard]] nlohmann::json to_json(const Study& study, const std::string& only = {});

}  // namespace surge::compare
