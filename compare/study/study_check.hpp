#pragma once

#include <filesystem>
#include <string>

#include "compare/study/study.hpp"

namespace surge::compare {

/// Folder of the program that is running, where its sisters are.
[[nodiscard]] std::filesystem::path own_folder();

/// What a study names held against the disk and the programs, before anything is computed:
/// that the published series can be read; that each run's case is there and is one that its program
/// computes, with settings that it has; that the files of other programs are there; that runs which
/// are compared state the same physics as the reference; that no snapshot is asked for later than
/// the reference ends. Fills StudyRun::resolved:
///   surge-particle            {"case", "size"} as `surge-particle check --json` prints them
///   interFoam, a case file    {"case"} of it, {"size"} as `surge-foam check --json` prints it
///   interFoam, a folder       {"parameters"}, its system/caseParameters with the settings
///   files                     null
/// `programs` has surge-particle and surge-foam. With `only`, runs of other names are left alone.
/// Throws surge::Error with file:line of the run.
void check_study(Study& study, const std::filesystem::path& programs, const std::string& only = {},
                 const std::filesystem::path& series_folder = {});

}  // namespace surge::compare
