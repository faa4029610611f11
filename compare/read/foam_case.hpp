#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compare/read/foam_reader.hpp"
#include "compare/read/run.hpp"

namespace surge::compare {

/// A number as messages show it.
[[nodiscard]] std::string six_digits(double value);

/// The case that a path means: the folder of `name.foam` or `name.OpenFOAM`, else the path itself.
[[nodiscard]] std::filesystem::path foam_case_folder(const std::filesystem::path& path);

/// Axes in which the surge runs along x: `empty` is the axis normal to the plane of a 2D case;
/// in 3D the water at the start says along which way it does not fill the tank. Throws surge::Error
/// where gravity is oblique, zero, or along `empty`.
[[nodiscard]] FoamAxes foam_axes(const Vec3& gravity, std::optional<std::size_t> empty,
                                 const MeshFrame& start, const std::optional<FileAxes>& stated);

/// Mean depth of the water (m) over equal bins of length `bin` from x = `begin` on.
struct WaterDepths {
  double begin = 0.0;
  double bin = 0.0;
  std::vector<double> depth;
};
[[nodiscard]] WaterDepths water_depths(const MeshFrame& frame, const std::vector<double>& volumes,
                                       const Extent& tank, std::size_t vertical, double bin);

/// x where the column that stands at the lower wall along x ends. Throws surge::Error where the
/// water is no such column: what there is instead, and --column-width.
[[nodiscard]] double column_edge(const WaterDepths& depths, const std::string& source);

/// Checks a case that states itself in a manifest.json: the water at time zero against its blocks,
/// the times against its output interval. Throws surge::Error where the water is not there.
void check_foam_case(Run& run);

}  // namespace surge::compare
