#include "particle/io/manifest.hpp"

#include <algorithm>
#include <ctime>
#include <fstream>

#include "particle/support/version.hpp"

namespace surge {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Restart, at, step, time, threads, cpu)

namespace {

/// Calls f(name, member) for all that a checkpoint keeps of a record.
template <class Record, class F>
void each_entry(Record& r, F&& f) {
  f("started", r.started);
  f("threads", r.threads);
  f("wall_total", r.wall_total);
  f("wall", r.wall);
  f("cpu", r.cpu);
  f("output_thread", r.output_thread);
  f("steps", r.steps);
  f("frames", r.frames);
  f("simulated", r.simulated);
  f("fluid_particles", r.fluid_particles);
  f("wall_particles", r.wall_particles);
  f("lost_particles", r.lost_particles);
  f("clipped", r.clipped);
  f("wall_collisions", r.wall_collisions);
  f("particle_collisions", r.particle_collisions);
  f("ppe_iterations", r.ppe_iterations);
  f("ppe_unconverged", r.ppe_unconverged);
  f("ppe_worst_residual", r.ppe_worst_residual);
  f("ppe_setup", r.ppe_setup);
  f("ppe_solve", r.ppe_solve);
  f("restarts", r.restarts);
}

nlohmann::ordered_json restarts_json(const RunRecord& record) {
  auto list = nlohmann::ordered_json::array();
  for (const Restart& r : record.restarts)
    list.push_back({{"at", r.at},
                    {"step", r.step},
                    {"time_s", r.time},
                    {"threads", r.threads},
                    {"cpu", r.cpu}});
  return list;
}

nlohmann::ordered_json wall_json(const RunRecord& record) {
  nlohmann::ordered_json wall;
  wall["total"] = record.wall_total;
  for (std::size_t i = 0; i < phase_names.size(); ++i) wall[phase_names[i]] = record.wall[i];
  return wall;
}

}  // namespace

std::string cpu_name() {
  std::ifstream stream("/proc/cpuinfo");
  for (std::string line; std::getline(stream, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

nlohmann::json to_json(const RunRecord& record) {
  nlohmann::json j;
  each_entry(record, [&](const char* name, const auto& member) { j[name] = member; });
  return j;
}

RunRecord run_record(const nlohmann::json& j) {
  RunRecord record;
  each_entry(record, [&](const char* name, auto& member) { j.at(name).get_to(member); });
  return record;
}

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
  j["restarts"] = restarts_json(record);
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
