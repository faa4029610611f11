#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string_view>

#include "particle/io/any_solver.hpp"

namespace surge {

/// A function that Solver::step() calls, as the build found it in the source.
struct Stage {
  std::string_view function;
  std::string_view does;       ///< first line of the comment on its declaration
  std::string_view equations;  ///< "Eq. (20)"; empty where the comment names none
  std::string_view options;  ///< "a or b=c": called where option a is on, or b is c; empty: always
};

/// The step of a method, in the order of the source. Defined in a source that the build generates.
[[nodiscard]] std::span<const Stage> stages_of(std::string_view method);

/// What a run computes with, for the run folder's method.json: the weight function or the kernel,
/// sampled from the very functions that the solver calls, and the functions of a time step:
///   {"method", "dimension", "spacing_m", "length_m" (h, SPH only),
///    "functions": [{"name", "unit", "support_m", "r_m": [...], "value": [...]}],
///    "loop": {"start", "until", "step"}, "stages": [{"function", "does", "equations", "if"}]}
/// Samples are equidistant from 0 (MPS: from the first step, because w(0) is infinite) to a tenth
/// beyond the support.
template <int D>
[[nodiscard]] nlohmann::json method_sheet(std::string_view method, const AnySolver<D>& solver,
                                          double spacing);

}  // namespace surge
