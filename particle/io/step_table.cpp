#include "particle/io/step_table.hpp"

#include <array>
#include <cstdio>

#include "particle/support/error.hpp"

namespace surge {

StepTable::StepTable(const std::filesystem::path& file, const std::vector<Probe>& probes)
    : file_(file), stream_(file) {
  stream_ << "time,dt,courant,v_max,ppe_iterations,ppe_residual,ppe_setup_s,ppe_solve_s,"
             "particle_collisions,wall_collisions,clipped,lost";
  for (const Probe& probe : probes) stream_ << ',' << probe.name;
  stream_ << '\n';
  flush();
}

void StepTable::add(double time, const StepReport& r, const std::vector<double>& pressures) {
  std::array<char, 256> row{};
  std::snprintf(row.data(), row.size(), "%.10g,%.6g,%.6g,%.6g,%d,%.4g,%.3g,%.3g,%ld,%ld,%ld,%ld",
                time, r.dt, r.courant, r.v_max, r.ppe_iterations, r.ppe_residual, r.ppe_setup_s,
                r.ppe_solve_s, r.particle_collisions, r.wall_collisions, r.clipped, r.lost);
  stream_ << row.data();
  for (const double pressure : pressures) {
    std::snprintf(row.data(), row.size(), ",%.7g", pressure);
    stream_ << row.data();
  }
  stream_ << '\n';
}

void StepTable::flush() {
  stream_.flush();
  if (!stream_) throw Error(file_.string() + ": found no way to write, expected a writable place");
}

}  // namespace surge
