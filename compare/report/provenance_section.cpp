#include <array>
#include <chrono>
#include <ctime>

#include "compare/report/sections.hpp"
#include "particle/support/version.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

std::string utc_now() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text.data();
}

}  // namespace

void measure_provenance(const StudyResult& study, json& metrics) {
  const BuildInfo build = build_info();
  json& provenance = metrics["provenance"];
  provenance["report"] = {{"program", "surge-compare"},
                          {"version", build.version},
                          {"commit", build.commit},
                          {"compiler", build.compiler},
                          {"generated", utc_now()}};
  provenance["runs"] = json::object();
  for (const RunResult* run : study.measured()) {
    const json& manifest = run->measured->run.manifest;
    json& entry = provenance["runs"][run->study.name];
    for (const char* name :
         {"program", "version", "commit", "compiler", "flags", "cpu", "threads", "started"}) {
      entry[name] = manifest.is_object() && manifest.contains(name) ? manifest[name] : json();
    }
  }
}

}  // namespace surge::compare
