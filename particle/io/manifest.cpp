#include "particle/io/manifest.hpp"

#include <algorithm>
#include <ctime>
#include <fstream>

#include "particle/support/version.hpp"

namespace surge {

namespace {

std::string cpu_name() {
  std::ifstream stream("/proc/cpuinfo");
  for (std::string line; std::getline(stream, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

nlohmann::ordered_json wall_json(const RunRecord& record) {
  nlohmann::ordered_json wall;
  wall["total"] = record.wall_total;
  for (std::size_t i = 0; i < phase_names.size(); ++i) wall[phase_names[i]] = record.wall[i];
  return wall;
}

}  // namespace

void RunRecord::add(const StepReport& report) {
  ++steps;
  lost_particles = report.lost;
  clipped += report.clipped;
  wall_collisions += report.wall_collisions;
  particle_collisions += report.particle_collisions;
  ppe_iterations += report.ppe_iterations;
  if (!report.ppe_converged) {
    ++ppe_unconverged;
    ppe_worst_residual = std::max(ppe_worst_residual, report.ppe_residual);
  }
  ppe_setup += report.ppe_setup_s;
  ppe_solve += report.ppe_solve_s;
}

std::string manifest_text(const RunRecord& record, const Computation& computation) {
  const BuildInfo build = build_info();
  nlohmann::ordered_json j;
  j["program"] = "surge-particle";
  j["version"] = build.version;
  j["commit"] = build.commit;
  j["compiler"] = build.compiler;
  j["flags"] = build.flags;
  j["cpu"] = cpu_name();
  j["threads"] = record.threads;
  j["started"] = record.started;
  j["finished"] = record.finished;
  j["stopped"] = record.stopped;
  j["wall_s"] = wall_json(record);
  j["cpu_s"] = record.cpu;
  j["output_thread_s"] = record.output_thread;
  j["steps"] = record.steps;
  j["frames"] = record.frames;
  j["simulated_s"] = record.simulated;
  j["fluid_particles"] = record.fluid_particles;
  j["wall_particles"] = record.wall_particles;
  j["lost_particles"] = record.lost_particles;
  j["clipped"] = record.clipped;
  j["wall_collisions"] = record.wall_collisions;
  j["particle_collisions"] = record.particle_collisions;
  if (computation.method->solves_pressure) {
    j["ppe"] = {{"iterations", record.ppe_iterations},
                {"unconverged", record.ppe_unconverged},
                {"worst_residual", record.ppe_worst_residual},
                {"setup_s", record.ppe_setup},
                {"solve_s", record.ppe_solve}};
  }
  j["nonfinite"] = record.nonfinite;
  j["case"] = to_json(computation);
  return j.dump(2) + '\n';
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text.data();
}

}  // namespace surge
