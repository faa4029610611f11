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

std::string write_provenance(const Page& page) {
  std::vector<std::vector<std::string>> rows;
  const auto row = [&](const std::string& pointer, const std::string& name,
                       const std::string& date) {
    std::vector<std::string> cells{"<code>" + name + "</code>"};
    for (const char* entry : {"program", "version", "commit", "compiler", "cpu", "threads"}) {
      const std::string at = pointer + '/' + entry;
      cells.push_back(page.values.has(at) ? page.values.text(at) : "–");
    }
    cells.push_back(page.values.text(pointer + date));
    rows.push_back(cells);
  };
  for (const RunResult* run : page.study.measured()) {
    row(key({"provenance", "runs", run->study.name}),
        page.values.text(key({"runs", run->study.name, "name"})), "/started");
  }
  row("/provenance/report", "this report", "/generated");
  std::string html = "<div class=\"words\">" +
                     html_table("What computed what, and where",
                                {"Part", "Program", "Version", "Commit", "Compiler", "Processor",
                                 "Threads", "Date"},
                                rows) +
                     "</div>\n";
  return html +
         "<p>Every number of this page is an entry of <a href=\"metrics.json\"><code>"
         "metrics.json</code></a>; the attribute <code>data-key</code> of its element names "
         "it.</p>\n";
}

}  // namespace surge::compare
