#include "compare/read/recorded.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

#include "compare/read/readers.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"
#include "particle/support/json.hpp"
#include "particle/support/regular_file.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

enum class Kind { text, truth, count, number, object, numbers, scalars, texts };

struct Entry {
  const char* pointer;
  Kind kind;
};

constexpr std::array recorded_entries{Entry{"/program", Kind::text},
                                      Entry{"/version", Kind::text},
                                      Entry{"/build", Kind::text},
                                      Entry{"/commit", Kind::text},
                                      Entry{"/compiler", Kind::text},
                                      Entry{"/flags", Kind::text},
                                      Entry{"/cpu", Kind::text},
                                      Entry{"/started", Kind::text},
                                      Entry{"/stopped", Kind::text},
                                      Entry{"/finished", Kind::truth},
                                      Entry{"/threads", Kind::count},
                                      Entry{"/steps", Kind::count},
                                      Entry{"/frames", Kind::count},
                                      Entry{"/simulated_s", Kind::count},
                                      Entry{"/cpu_s", Kind::count},
                                      Entry{"/output_thread_s", Kind::count},
                                      Entry{"/fluid_particles", Kind::count},
                                      Entry{"/wall_particles", Kind::count},
                                      Entry{"/cells", Kind::count},
                                      Entry{"/lost_particles", Kind::count},
                                      Entry{"/nonfinite", Kind::count},
                                      Entry{"/clipped", Kind::count},
                                      Entry{"/wall_collisions", Kind::count},
                                      Entry{"/particle_collisions", Kind::count},
                                      Entry{"/water_volume_change", Kind::number},
                                      Entry{"/alpha_min", Kind::number},
                                      Entry{"/alpha_max", Kind::number},
                                      Entry{"/fastest_m_s", Kind::count},
                                      Entry{"/fastest_at_s", Kind::count},
                                      Entry{"/warnings", Kind::texts},
                                      Entry{"/wall_s", Kind::numbers},
                                      Entry{"/ppe", Kind::numbers},
                                      Entry{"/case", Kind::object},
                                      Entry{"/case/title", Kind::text},
                                      Entry{"/case/fluid", Kind::object},
                                      Entry{"/case/time", Kind::numbers},
                                      Entry{"/case/output", Kind::numbers},
                                      Entry{"/case/search", Kind::scalars},
                                      Entry{"/case/method", Kind::object},
                                      Entry{"/case/method/name", Kind::text},
                                      Entry{"/case/method/preset", Kind::text},
                                      Entry{"/case/method/parameters", Kind::scalars}};

bool is_number(const json& value) {
  return value.is_number() && std::isfinite(value.get<double>());
}

bool all(const json& value, bool (*test)(const json&)) {
  return value.is_object() && std::all_of(value.begin(), value.end(), test);
}

bool is_of(Kind kind, const json& value) {
  switch (kind) {
    case Kind::text:
      return value.is_string();
    case Kind::truth:
      return value.is_boolean();
    case Kind::count:
      return is_number(value) && value.get<double>() >= 0.0;
    case Kind::number:
      return is_number(value);
    case Kind::object:
      return value.is_object();
    case Kind::numbers:
      return all(value, is_number);
    case Kind::scalars:
      return all(value, [](const json& v) { return v.is_primitive() && !v.is_null(); });
    case Kind::texts:
      return value.is_array() &&
             std::all_of(value.begin(), value.end(), [](const json& v) { return v.is_string(); });
  }
  return false;
}

const char* name_of(Kind kind) {
  constexpr std::array names{"a text",
                             "true or false",
                             "a finite number that is not negative",
                             "a finite number",
                             "an object",
                             "an object of finite numbers",
                             "an object of numbers and texts",
                             "a list of texts"};
  return names.at(static_cast<std::size_t>(kind));
}

[[noreturn]] void refuse(const fs::path& file, std::string pointer, const json& found,
                         const std::string& expected) {
  std::replace(pointer.begin(), pointer.end(), '/', '.');
  throw Error(file.string() + ": " + pointer.substr(1) + ": " + json_shown(found) + " found, " +
              expected + " expected");
}

void check_probes(const json& manifest, const fs::path& file) {
  const json::json_pointer pointer("/case/probes");
  if (!manifest.contains(pointer)) return;
  const json& probes = manifest.at(pointer);
  const auto is_probe = [](const json& probe) {
    return probe.is_object() && probe.contains("name") && probe.at("name").is_string() &&
           probe.contains("position") && probe.at("position").is_array() &&
           probe.at("position").size() == 3 &&
           std::all_of(probe.at("position").begin(), probe.at("position").end(), is_number);
  };
  if (!probes.is_array() || !std::all_of(probes.begin(), probes.end(), is_probe))
    refuse(file, "/case/probes", probes, "a list of probes with name and position");
}

std::optional<double> number_of(const json& manifest, const char* pointer) {
  const json::json_pointer at(pointer);
  if (!manifest.contains(at)) return std::nullopt;
  return manifest.at(at).get<double>();
}

/// Rows of a table without its header; empty where there is no such file.
std::optional<double> rows_of(const fs::path& file) {
  std::error_code failed;
  if (!fs::exists(fs::symlink_status(file, failed))) return std::nullopt;
  require_inside(file, file.parent_path());
  std::ifstream in = open_regular(file, most_table_bytes, "a table of steps");
  double rows = -1.0;
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) ++rows;
  return rows;
}

[[noreturn]] void incomplete(const Run& run, const std::string& found,
                             const std::string& expected) {
  throw Error(run.path.string() + ": " + found + " found, " + expected +
              " expected (manifest.json says finished; was it written to or cut short since?)");
}

void check_particle_run(Run& run) {
  const auto frames = number_of(run.manifest, "/frames");
  if (!frames) return;  // an older manifest
  const std::vector<Seconds>& times = run.frames->times();
  if (static_cast<double>(times.size()) != *frames)
    incomplete(run, std::to_string(times.size()) + " frames in particles.pvd",
               number_text(*frames));
  const auto end = number_of(run.manifest, "/simulated_s");
  if (end && std::abs(times.back().value() - *end) > 1e-6 * *end + 1e-12)
    incomplete(run, "a last frame at " + number_text(times.back().value()) + " s",
               number_text(*end) + " s");
  const auto steps = number_of(run.manifest, "/steps");
  const auto rows = rows_of(run.path / "steps.csv");
  if (steps && rows && *rows != *steps)
    incomplete(run, number_text(std::max(*rows, 0.0)) + " rows in steps.csv", number_text(*steps));
  if (steps && !rows)
    run.notices.push_back(
        "steps.csv is gone: what was recorded at every step (probes, forces) is not known");
}

/// Times that the case says it writes, from 0 in its interval.
void check_foam_run(const Run& run) {
  const auto end = number_of(run.manifest, "/simulated_s");
  const auto interval = number_of(run.manifest, "/case/output/interval");
  if (!end || !interval || *interval <= 0.0 || *end / *interval > 1e7) return;
  const std::vector<Seconds>& times = run.frames->times();
  const double slack = 1e-3 * *interval;  // names of times are rounded
  for (double k = 0.0; k * *interval <= *end + slack; ++k) {
    const Seconds expected(k * *interval);
    const auto next = std::lower_bound(times.begin(), times.end(), expected - Seconds(slack));
    if (next == times.end() || *next > expected + Seconds(slack))
      incomplete(run, "no time " + number_text(expected.value()) + " s",
                 "one every " + number_text(*interval) + " s");
  }
}

}  // namespace

void check_manifest(const json& manifest, const fs::path& file) {
  if (!manifest.is_object())
    throw Error(file.string() + ": " + json_shown(manifest) + " found, an object expected");
  for (const Entry& entry : recorded_entries) {
    const json::json_pointer pointer(entry.pointer);
    // What hangs below an entry of the wrong kind is not looked for: that entry was named before.
    if (!manifest.contains(pointer)) continue;
    if (!is_of(entry.kind, manifest.at(pointer)))
      refuse(file, entry.pointer, manifest.at(pointer), name_of(entry.kind));
  }
  check_probes(manifest, file);
  if (manifest.value("finished", false) && manifest.value("steps", 1.0) < 1.0)
    refuse(file, "/steps", manifest.at("steps"), "at least one in a run that is finished");
}

json read_manifest(const fs::path& file) {
  require_inside(file, file.parent_path());
  json manifest = read_json(file);
  check_manifest(manifest, file);
  return manifest;
}

void check_recorded(Run& run) {
  if (!run.manifest.is_object()) return;
  if (const auto said = run.manifest.find("warnings"); said != run.manifest.end())
    for (const json& warning : *said)
      run.notices.push_back("the run warns: " + warning.get<std::string>());
  if (is_unfinished(run)) {
    const std::string why = run.manifest.value("stopped", "");
    run.notices.insert(run.notices.begin(),
                       "the run did not finish" + (why.empty() ? "" : " (" + why + ")") +
                           ": what it has ends at " +
                           number_text(run.frames->times().back().value()) + " s");
    return;
  }
  if (run.is_mesh()) {
    check_foam_run(run);
  } else {
    check_particle_run(run);
  }
}

bool is_unfinished(const Run& run) {
  return run.manifest.is_object() && !run.manifest.value("finished", true);
}

}  // namespace surge::compare
