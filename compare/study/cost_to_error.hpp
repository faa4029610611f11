#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "compare/study/study_result.hpp"

namespace surge::compare {

/// CPU time of a run, all threads or processes together, output included, s: what the run states;
/// of interFoam that of one process times their number; of files what the study states. Empty where
/// nobody says.
[[nodiscard]] std::optional<double> cpu_seconds_of(const RunResult& run);

/// cost_to_error: what an error costs. The runs of the comparison and their coarser and finer
/// levels, with their error against the finest VOF run of the study, where it has levels of VOF
/// over the spacing, else against its reference: the RMS of the leading edge, or of the first
/// observable that has one. Levels end at other times than the runs, and so cost is told per
/// simulated second.
///   {"against", "quantity", "unit", "against_u": standard uncertainty of what they are held
///    against, "points": [{"run", "label", "method", "spacing_m", "threads", "cpu", "cpu_s_per_s",
///    "wall_s_per_s", "E", "U", "files", "speedup": wall time on one thread over its own}], from
///    cheap to costly, "cpu": the processor that most of them ran on, "methods": [names],
///    "levels": [{"E": error at most, "cells": [{"method", "point": index of that method's cheapest
///    run on one thread with at most this error, or null, "factor": its CPU time over that of the
///    cheapest method}]}]}
/// Empty where nothing can be compared.
void measure_cost_to_error(const StudyResult& study, nlohmann::json& metrics);

}  // namespace surge::compare
