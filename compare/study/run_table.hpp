#pragma once

#include <optional>
#include <vector>

#include "compare/study/study.hpp"
#include "particle/support/toml.hpp"

namespace surge::compare {

/// The runs that a [[run]] table stands for: those of its sweep, each with its repetitions, in
/// their order.
///
///   name      of the folder below runs/: letters, digits, . _ and -
///   program   "surge-particle", "interFoam" or "files"
///   role, group
///   surge-particle and interFoam:
///     case      case file; for interFoam also the folder of an OpenFOAM case
///     set       list of "key=value"; with interFoam and a case file, those that begin with foam.
///               are settings of the OpenFOAM case
///     threads, repeats, timed, may_break, sweep
///     allow     of role convergence: what may differ from the case of the reference, where the
///     lattice
///               of a level does not hold its sizes; keys as `surge-compare metrics --allow` has
///               them
///   files, what some other program has left:
///     source    folder, file or pattern, as for `surge-compare front`
///     map       file that says what the arrays are, where one is needed
///     read      table of options of `surge-compare front` without the dashes
///
/// What a table lacks of program, case, role, group, threads, repeats, timed and may_break is
/// that of `defaults`, the study file's [defaults]. Files and folders are named relative to the
/// study's folder, or to the one that the program is started in, which is the repository's. Throws
/// surge::Error with file:line.
[[nodiscard]] std::vector<StudyRun> read_runs(const TomlTable& table,
                                              const std::optional<TomlTable>& defaults = {});

/// Checks [defaults] by itself. Throws surge::Error.
void check_defaults(const TomlTable& defaults);

}  // namespace surge::compare
