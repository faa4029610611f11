#include "compare/study/study_keys.hpp"

#include <array>

namespace surge::compare {
namespace {

constexpr std::array known_keys{
    StudyKey{"", "title", "text", "heading of the report"},
    StudyKey{"", "include", "list of studies; none",
             "whose runs, and what is not said here, count"},
    StudyKey{"", "reference", "name of a run",
             "of role comparison; all others are held against it"},
    StudyKey{"", "strip_height", "m", "above the floor, in which the leading edge is looked for"},
    StudyKey{"", "snapshot_times", "list of s", "of the pictures"},
    StudyKey{"", "published", "list of series; none", "of the leading edge, files NAME.csv"},
    StudyKey{"", "claims", "folder beside the study; none", "statements that are to be judged"},
    StudyKey{"[defaults]", "program", "as of a run", "what stands for a key that a run lacks"},
    StudyKey{"[defaults]", "case", "as of a run", ""},
    StudyKey{"[defaults]", "threads", "as of a run", ""},
    StudyKey{"[defaults]", "timed", "as of a run", ""},
    StudyKey{"[defaults]", "may_break", "as of a run", ""},
    StudyKey{"[defaults]", "repeats", "as of a run", ""},
    StudyKey{"[defaults]", "role", "as of a run", ""},
    StudyKey{"[defaults]", "group", "as of a run", ""},
    StudyKey{"[[run]]", "name", "letters, digits, . _ -", "its folder's, runs/NAME"},
    StudyKey{"[[run]]", "program", "surge-particle | interFoam | files", ""},
    StudyKey{"[[run]]", "case", "case file, or an OpenFOAM case", "named relative to this file"},
    StudyKey{"[[run]]", "set", "list of \"table.key=value\"; none",
             "changes of the case; interFoam's settings begin with foam."},
    StudyKey{"[[run]]", "threads", "number; 1", ""},
    StudyKey{"[[run]]", "timed", "true | false; true", "whether it has the machine for itself"},
    StudyKey{"[[run]]", "may_break", "true | false; false", "whether it may end before its time"},
    StudyKey{"[[run]]", "repeats", "number; 1", "the report takes the median of their times"},
    StudyKey{"[[run]]", "role",
             "comparison | timing | sensitivity | convergence | verification; comparison",
             "what it is made for"},
    StudyKey{"[[run]]", "group", "text",
             "choice, sequence or flow of the last three roles, which must have one; of a "
             "comparison the sequence whose levels give its uncertainty"},
    StudyKey{"[[run]]", "allow", "list; none", "what of a level's physics may be another"},
    StudyKey{"[[run]]", "sweep", "table of lists, or a list of them; none",
             "many runs by one table, {key} in name, case, set, group"},
    StudyKey{"[[run]]", "source", "folder, file or pattern", "program files: instead of case"},
    StudyKey{"[[run]]", "read", "table; none", "program files: options of surge-compare front"},
    StudyKey{"[[run]]", "map", "map file; none", "program files: what the files do not say"},
    StudyKey{"[[run]]", "cpu_s", "s; none",
             "program files: what they cost, CPU time of all threads"},
    StudyKey{"[[observable]]", "name", "letters, digits, . _ -",
             "without any table of these: those of the case"},
    StudyKey{"[[observable]]", "kind", "one that surge-compare measure --list names", ""},
    StudyKey{"[[observable]]", "parameters", "table; none", "of that kind"},
    StudyKey{"[[observable]]", "title", "text; kind and parameters", ""},
    StudyKey{"[[observable]]", "component", "x | y | z; all", "of kinds with a value per axis"},
    StudyKey{"[[observable]]", "references", "list of series; none", "published or exact"},
    StudyKey{"[[observable]]", "compare",
             "list of rms, arrival, peak, peak-time, impulse, final, amplitude, phase; rms", ""},
    StudyKey{"[[observable]]", "window", "[s, s]; all", "in which it is compared"},
    StudyKey{"[[observable]]", "threshold", "number or expression", "of arrival"},
    StudyKey{"[[observable]]", "period", "s", "of amplitude and phase"},
    StudyKey{"[[observable]]", "tolerance", "table by words of compare; 5 % of the range",
             "up to which two results are the same"},
};

}  // namespace

std::span<const StudyKey> study_keys() {
  return known_keys;
}

}  // namespace surge::compare
