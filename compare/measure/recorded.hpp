#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compare/read/run.hpp"

namespace surge::compare {

/// What a program has recorded at its own steps: columns over time.
struct Recorded {
  std::vector<double> time;                 ///< s, increasing, as the frames count it
  std::vector<std::vector<double>> values;  ///< per column, one per time
};

/// Columns of a CSV file by name; the first column of the file is the time. Throws surge::Error
/// with file:line where a column is missing, a value is no finite number or a time is not later.
[[nodiscard]] Recorded read_recorded_csv(const std::filesystem::path& file,
                                         const std::vector<std::string>& columns);

/// postProcessing/NAME/TIME/FILE of an OpenFOAM case, in the order of the start times TIME: a
/// restart writes a folder of its own, whose values stand for those that the run before it had
/// after that time. A row is a time and as many numbers as it holds, brackets left out; comments
/// are kept.
struct FoamTable {
  std::vector<std::string> comments;  ///< of the last file
  std::vector<double> time;
  std::vector<std::vector<double>> rows;  ///< numbers after the time
};
[[nodiscard]] FoamTable read_foam_table(const Run& run, const std::string& name,
                                        const std::string& file);

/// Names of function objects of a case that have written a file of this name.
[[nodiscard]] std::vector<std::string> foam_function_objects(const Run& run,
                                                             const std::string& file);

/// What a function object `probes` has recorded of p.
struct FoamProbes {
  std::vector<Vec3> places;  ///< m, in the axes of the frames
  Recorded pressure;         ///< Pa, a column per place
};
[[nodiscard]] FoamProbes read_foam_probes(const Run& run, const std::string& name);

/// What a function object `forces` has recorded: total force, pressure and viscous, in N, along the
/// axes of the frames. As OpenFOAM v1906 and later write it, force.dat.
[[nodiscard]] Recorded read_foam_force(const Run& run, const std::string& name);

}  // namespace surge::compare
