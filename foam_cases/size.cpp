#include "foam_cases/size.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "particle/case/scales.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::foam {

namespace {

// Measured with interFoam 1912: 57 600 cells in 2D take 233 MB and 81 bytes a cell and frame, 256
// 000 in 3D 552 MB and 99 bytes.
constexpr double program_bytes = 140e6;
constexpr double memory_per_cell = 1700.0;
constexpr double frame_bytes_per_cell = 100.0;  ///< binary: U, p, p_rgh, alpha.water, phi
constexpr double ascii_factor = 1.6;
constexpr double row_bytes = 120.0;  ///< of what function objects write at a step
constexpr double row_bytes_per_instrument = 40.0;
/// The fastest flow, air included, over the reference speed, as the mean over the run. Measured by
/// the steps of 36 cells over L behind a step in the dam break: 4.3, of 24 cells: 3.6, of a column
/// of 60 cells over a dry floor and back: 2.5. A tank that sways has 1.5.
constexpr double splash = 4.0;

}  // namespace

CaseSize case_size(const FoamCase& c) {
  CaseSize size;
  size.cells = c.mesh.cells();
  size.cell = c.mesh.cell;
  size.frames = std::ceil(c.flow.time.end / c.flow.output_interval) + 1.0;
  const double speed = splash * reference_speed(c.flow);
  const double courant = std::min(c.settings.courant, c.settings.alpha_courant);
  double step = c.settings.maximum_step;
  if (speed > 0.0) step = std::min(step, courant * c.mesh.cell / speed);
  size.steps = std::ceil(c.flow.time.end / step);
  size.memory =
      program_bytes * static_cast<double>(c.settings.processes) + memory_per_cell * size.cells;
  const auto instruments =
      static_cast<double>(c.flow.probes.size() + c.flow.gauges.size() + 3 * c.flow.forces.size());
  const double factor = c.settings.write_format == "ascii" ? ascii_factor : 1.0;
  size.disk = size.frames * frame_bytes_per_cell * factor * size.cells +
              size.steps * (row_bytes + row_bytes_per_instrument * instruments);
  return size;
}

nlohmann::json to_json(const CaseSize& size) {
  return {{"cells", size.cells}, {"cell", size.cell},           {"frames", size.frames},
          {"steps", size.steps}, {"memory_bytes", size.memory}, {"disk_bytes", size.disk}};
}

double available_memory() {
  double bytes =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  // "max" where there is no limit, which is no number.
  double limit = 0.0;
  if (std::ifstream file("/sys/fs/cgroup/memory.max"); file >> limit && limit > 0.0)
    bytes = std::min(bytes, limit);
  return bytes;
}

void check_size(const CaseSize& size, double memory) {
  if (size.memory <= memory) return;
  throw Error("--foam cellsPerL: found a mesh of " + number_text(size.cells) +
              " cells, which take about " + bytes_text(size.memory) +
              ", expected at most the memory of this machine, " + bytes_text(memory));
}

void check_disk(const CaseSize& size, const std::filesystem::path& folder) {
  std::filesystem::path there = std::filesystem::absolute(folder);
  while (!std::filesystem::exists(there) && there.has_relative_path()) there = there.parent_path();
  std::error_code error;
  const auto space = std::filesystem::space(there, error);
  if (error || size.disk <= static_cast<double>(space.available)) return;
  throw Error("--out " + folder.string() + ": found " +
              bytes_text(static_cast<double>(space.available)) + " free, expected the " +
              bytes_text(size.disk) + " that " + number_text(size.frames) + " frames of " +
              number_text(size.cells) + " cells take (output.interval is the time between them)");
}

std::string bytes_text(double bytes) {
  constexpr std::array units{"B", "kB", "MB", "GB", "TB", "PB"};
  std::size_t unit = 0;
  for (; bytes >= 1000.0 && unit + 1 < units.size(); ++unit) bytes /= 1000.0;
  return number_text(std::round(bytes * 10.0) / 10.0) + ' ' + units[unit];
}

}  // namespace surge::foam
