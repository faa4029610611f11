#pragma once

#include <zlib.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "particle/io/checkpoint.hpp"
#include "particle/io/presets.hpp"
#include "particle/io/source_hash.hpp"
#include "particle/support/version.hpp"

namespace surge::fuzz {

// Checkpoints whose checksum is right: what stands in them is not believed for that. An input is a
// line of JSON, {"preset", "run", "fields"}, and the bytes of the state; what names the build and
// the case is put around it, so that an input holds for every build.

inline constexpr const char* small_collapse = R"(title = "Fuzz"
dimension = 2
[fluid]
density = 1000.0
gravity = [0.0, -9.81]
[tank]
lower = [0.0, 0.0]
upper = [0.05, 0.05]
[[block]]
shape = "box"
lower = [0.0, 0.0]
upper = [0.02, 0.03]
[resolution]
spacing = 0.01
[time]
end = 0.1
[output]
interval = 0.01
)";

/// "sph-paper" and so on.
inline std::vector<std::string> presets_with_checkpoints() {
  std::vector<std::string> names;
  for (const Method& method : methods())
    for (const std::string& preset : preset_names(method.name))
      names.push_back(std::string(method.name) + '-' + preset);
  return names;
}

/// The case by a preset; by the first one where there is none of that name.
inline const Computation& computation_of(const std::string& preset) {
  static const std::map<std::string, Computation> all = [] {
    std::map<std::string, Computation> read;
    for (const std::string& name : presets_with_checkpoints()) {
      const std::size_t dash = name.find('-');
      const std::vector<std::string> method{"method.name=" + name.substr(0, dash),
                                            "method.preset=" + name.substr(dash + 1)};
      read.emplace(name, parse_computation(small_collapse, "fuzz.toml", method));
    }
    return read;
  }();
  const auto found = all.find(preset);
  return found == all.end() ? all.begin()->second : found->second;
}

struct CheckpointInput {
  std::string bytes;  ///< of the whole file
  const Computation* computation = nullptr;
};

/// The checkpoint around an input.
inline CheckpointInput checkpoint_around(std::string_view text) {
  CheckpointInput made;
  const std::size_t line = std::min(text.find('\n'), text.size());
  nlohmann::json header = nlohmann::json::parse(text.substr(0, line), nullptr, false);
  std::string head(text.substr(0, line)), preset;
  if (header.is_object()) {
    if (header.contains("preset") && header["preset"].is_string()) preset = header["preset"];
    header.erase("preset");
    const BuildInfo build = build_info();
    header["build"] = source_hash();
    header["compiler"] = build.compiler;
    header["flags"] = build.flags;
    header["case"] = to_toml(computation_of(preset));
    head = header.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
  }
  made.computation = &computation_of(preset);
  made.bytes = "surge-particle checkpoint, format 1\n" + std::to_string(head.size()) + '\n' + head;
  made.bytes += line < text.size() ? text.substr(line + 1) : std::string_view();
  char sum[32];
  std::snprintf(sum, sizeof sum, "crc32 %08lx\n",
                crc32_z(0, reinterpret_cast<const Bytef*>(made.bytes.data()), made.bytes.size()));
  made.bytes += sum;
  return made;
}

/// The input that stands for a real checkpoint, after three steps.
inline std::string checkpoint_seed(const std::string& preset) {
  const auto solver = computation_of(preset).make_solver<2>();
  RunRecord record;
  for (int k = 0; k < 3; ++k) record.add(solver->step(1e-3), solver->time());
  nlohmann::json fields = nlohmann::json::array();
  std::string bytes;
  for (const StateField& field : solver->state()) {
    fields.push_back({field.name, field.type, field.count, field.value_bytes});
    bytes.append(reinterpret_cast<const char*>(field.data), field.bytes());
  }
  return nlohmann::json{{"preset", preset}, {"run", to_json(record)}, {"fields", fields}}.dump() +
         '\n' + bytes;
}

}  // namespace surge::fuzz
