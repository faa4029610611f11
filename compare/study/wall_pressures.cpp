#include "compare/study/wall_pressures.hpp"

#include <cmath>

#include "compare/study/run_fault.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {

namespace {

bool same_place(const Vec3& a, const Vec3& b, Metres length) {
  // The third coordinate means nothing in two dimensions.
  return std::hypot(a[0] - b[0], a[1] - b[1]) <= 1e-3 * length.value();
}

WallPressureResult find(const RunResult& result, const Vec3& place) {
  WallPressureResult out;
  out.run = &result;
  const Run& run = result.measured->run;
  const auto probe = wall_probe(run);
  if (!probe || !same_place(*probe, place, run.physics.column_width())) {
    out.note = probe ? "its probe is at another place" : "it has no probe on the wall";
    return out;
  }
  try {
    out.signal = guarded(result.study.name, run.path, [&] { return read_wall_pressure(run); });
  } catch (const Error& error) {
    out.note = error.what();
    return out;
  }
  const auto far = run.physics.far_wall();
  const auto hit = far ? impact(result.measured->history, *far, run.spacing) : std::nullopt;
  if (!hit) {
    out.note = "its front does not reach the wall";
    return out;
  }
  out.impact = hit->time;
  out.found = impact_pressure(*out.signal, run.physics, hit->time);
  if (!out.found) out.note = "it ends before the impact is over";
  return out;
}

}  // namespace

std::vector<WallPressureResult> wall_pressures(const StudyResult& study) {
  std::vector<WallPressureResult> results;
  const auto place = wall_probe(study.reference_run().run);
  if (!place) return results;
  for (const RunResult* run : study.measured()) results.push_back(find(*run, *place));
  return results;
}

}  // namespace surge::compare
