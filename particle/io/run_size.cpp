#include "particle/io/run_size.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "particle/case/scales.hpp"
#include "particle/io/step_table.hpp"

namespace surge {

namespace {

constexpr double most_particles = 2e9;  ///< they are numbered in 32 bits
constexpr double most_steps = 1e12;     ///< a century at a millisecond each is 3e12
constexpr double program_bytes = 25e6;  ///< of the program itself with its libraries

// Compressed frames of a collapse, measured: particles that stand still take little.
constexpr double frame_bytes_per_fluid = 36.0;
constexpr double frame_bytes_per_wall = 8.0;
constexpr double row_bytes = 70.0;  ///< of steps.csv
constexpr double row_bytes_per_probe = 12.0;

double fastest_start(const Case& c) {
  double speed = 0.0;
  for (const FluidBlock& block : c.blocks) {
    for (int corner = 0; corner < 8; ++corner) {
      Point x;
      for (std::size_t a = 0; a < 3; ++a)
        x[a] = (corner >> a & 1) != 0 ? block.box.upper[a] : block.box.lower[a];
      speed = std::max(speed, length(initial_velocity(block, x)));
    }
  }
  return speed;
}

}  // namespace

RunSize run_size(const Computation& computation) {
  const Case& c = computation.flow;
  const Method& method = *computation.method;
  const auto step = [&](double speed) { return method.step_limit(c, computation.options, speed); };
  RunSize size;
  size.particles = count_particles(c, method.wall_layers(computation.options));
  size.frames = std::ceil(c.time.end / c.output_interval) + 1.0;
  size.steps = std::ceil(c.time.end / std::min(step(reference_speed(c)), c.output_interval));
  size.first_step = std::min(c.time.initial_step, step(fastest_start(c)));
  size.memory = program_bytes + method.memory(computation.options, c.dimension, size.particles);
  size.disk = size.frames * (frame_bytes_per_fluid * size.particles.fluid +
                             frame_bytes_per_wall * size.particles.wall) +
              size.steps * (row_bytes +
                            row_bytes_per_probe * static_cast<double>(recorded_columns(c).size()));
  return size;
}

nlohmann::json to_json(const RunSize& size) {
  return {{"fluid_particles", size.particles.fluid},
          {"wall_particles", size.particles.wall},
          {"frames", size.frames},
          {"steps", size.steps},
          {"first_step_s", size.first_step},
          {"memory_bytes", size.memory},
          {"disk_bytes", size.disk}};
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

void check_size(const RunSize& size, const TomlTable& root, double available) {
  const TomlTable resolution = root.table("resolution");
  const std::string key = resolution.has("spacing") ? "spacing" : "per";
  const std::string found = "a size of " + number_text(size.particles.fluid) + " fluid and " +
                            number_text(size.particles.wall) + " wall particles";
  if (size.particles.all() > most_particles)
    throw resolution.error(key, found, "at most " + number_text(most_particles) + " particles");
  // Whatever option makes the steps that short: such a run has no end.
  if (!(size.steps <= most_steps)) {
    throw root.table("time").error("end",
                                   "an end that takes about " + number_text(size.steps) +
                                       " steps, the first of " + number_text(size.first_step) +
                                       " s",
                                   "at most " + number_text(most_steps) + " steps");
  }
  if (size.memory > available) {
    throw resolution.error(key, found + ", which take about " + bytes_text(size.memory),
                           "at most the memory of this machine, " + bytes_text(available));
  }
}

std::string bytes_text(double bytes) {
  constexpr std::array units{"B", "kB", "MB", "GB", "TB", "PB"};
  std::size_t unit = 0;
  for (; bytes >= 1000.0 && unit + 1 < units.size(); ++unit) bytes /= 1000.0;
  return number_text(std::round(bytes * 10.0) / 10.0) + ' ' + units[unit];
}

}  // namespace surge
