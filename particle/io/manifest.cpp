#include "particle/io/manifest.hpp"

#include <algorithm>
#include <ctime>
#include <fstream>

#include "particle/case/scales.hpp"
#include "particle/support/bounds.hpp"
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
  f("fastest", r.fastest);
  f("fastest_at", r.fastest_at);
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

std::vector<std::string> warnings_of(const RunRecord& record, const Case& c) {
  constexpr double doubtful = 10.0;
  std::vector<std::string> warnings;
  if (record.ppe_unconverged > 0)
    warnings.push_back("the pressure solver gave up in " + std::to_string(record.ppe_unconverged) +
                       " of " + std::to_string(record.steps) + " steps, with a residual of up to " +
                       number_text(record.ppe_worst_residual) +
                       " (ppe_tolerance, ppe_max_iterations)");
  const double reference = reference_speed(c);
  if (reference > 0.0 && record.fastest > doubtful * reference)
    warnings.push_back("a particle reached " + number_text(record.fastest) + " m/s at " +
                       number_text(record.fastest_at) + " s, more than ten times the " +
                       number_text(reference) +
                       " m/s of the flow: the run is unstable, or fluid.reference_speed too low");
  return warnings;
}

void RunRecord::add(const StepReport& report, double time) {
  ++steps;
  lost_particles = report.lost;
  clipped += report.clipped;
  wall_collisions += report.wall_collisions;
  particle_collisions += report.particle_collisions;
  if (report.v_max > fastest) {
    fastest = report.v_max;
    fastest_at = time;
  }
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
  j["fastest_m_s"] = record.fastest;
  j["fastest_at_s"] = record.fastest_at;
  j["warnings"] = warnings_of(record, computation.flow);
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
