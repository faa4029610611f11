#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "compare/read/run.hpp"

namespace surge::compare {

/// The box of the finite points.
[[nodiscard]] Extent extent_of(const std::vector<Vec3>& points);

/// "(0.1, 0.2, 0)"
[[nodiscard]] std::string vector_text(const Vec3& x);

/// Spacing, gravity, column and tank of a particle source that has no manifest: from its first
/// frame and from what the user says. Checks that frame (check_first_frame) and that the water
/// falls downwards, which only where the axes are not stated is an error; `expect` is told what all
/// other frames are to be held against. Throws surge::Error.
void settle_column(
    Run& run, const SourceOptions& options, bool axes_stated,
    const std::function<void(Metres spacing, const std::optional<Extent>& tank)>& expect);

/// What the user says about column and tank goes over what was found.
void apply_options(Run& run, const SourceOptions& options);

}  // namespace surge::compare
