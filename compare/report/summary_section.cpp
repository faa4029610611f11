#include <algorithm>
#include <set>

#include "compare/report/sections.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

/// The complete run of a method that is nearest to the reference; null where there is none.
const RunResult* nearest_run(const StudyResult& study, const json& metrics,
                             const std::string& method, const std::string& rms) {
  const RunResult* best = nullptr;
  const auto error = [&](const RunResult& run) {
    return metrics["front"][run.study.name][rms].get<double>();
  };
  for (const RunResult* run : study.measured()) {
    const bool counts = run != &study.reference() && run->status == RunStatus::complete &&
                        run->note.empty() && run->measured->run.method == method;
    if (counts && (best == nullptr || error(*run) < error(*best))) best = run;
  }
  return best;
}

/// Numbers of the run that speaks for a method in the summary's sentences.
json entry_of(const RunResult* run, const json& metrics, const std::string& against) {
  if (run == nullptr) return nullptr;
  const json& front = metrics["front"][run->study.name];
  const json& timing = metrics["timing"][run->study.name];
  return {{"run", run->study.name},
          {"label", run->label()},
          {"rms", front["rms_vs_" + against]},
          {"max", front["max_vs_" + against]},
          {"bias", front["bias_vs_" + against]},
          {"wall_s", timing.contains("wall_s") ? timing["wall_s"] : json()}};
}

std::string accuracy_sentence(const Page& page, const std::string& method) {
  const std::string at = "/summary/methods/" + method;
  if (!page.values.has(at)) {
    return "No " + escape(method == "mps" ? "MPS" : "SPH") + " run of this study is complete.";
  }
  const Values& v = page.values;
  return v.text(at + "/label") + " stays within RMS " + v.number(at + "/rms", 3) + " (maximum " +
         v.number(at + "/max", 3) + ", bias " + v.signed_number(at + "/bias", 3) + ") of " +
         v.text("/summary/reference_label") + " in Z/L before the far wall.";
}

std::string verdict_sentence(const Page& page) {
  const Values& v = page.values;
  if (!v.has("/summary/nearer")) {
    return "Which of MPS and SPH is nearer to the reference cannot be said, because one of them is "
           "not there.";
  }
  const bool mps = v.at("/summary/nearer") == "MPS";
  return v.text("/summary/nearer") + " is the nearer of the two to " +
         v.text("/summary/reference_label") + ", its RMS difference is " +
         v.number("/summary/rms_ratio", 2) +
         " times that of the other: the paper’s finding, that MPS " + "is the more accurate, is " +
         (mps ? "" : "not ") + "reproduced by these runs.";
}

std::string cost_sentence(const Page& page) {
  const Values& v = page.values;
  std::string text;
  const auto add = [&](const std::string& label, const std::string& seconds) {
    if (!v.has(seconds)) return;
    text += (text.empty() ? "" : ", ") + v.magnitude(seconds) + " s for " + v.text(label);
  };
  for (const char* method : {"mps", "sph"}) {
    const std::string at = std::string("/summary/methods/") + method;
    if (v.has(at)) add(at + "/label", at + "/wall_s");
  }
  add("/summary/reference_label", "/summary/reference_wall_s");
  return text.empty() ? "No run states its cost." : "Wall time of the whole run: " + text + ".";
}

std::string claims_sentence(const Page& page) {
  const Values& v = page.values;
  const std::string at = "/claim_counts/";
  return "Of the statements that the paper makes from its results, these runs can judge " +
         v.integer(at + "judged") + ": " + v.integer(at + "reproduced") + " are reproduced, " +
         v.integer(at + "not reproduced") + " are not, and " + v.integer(at + "depends") +
         " depend on a choice that <a href=\"#claims\">the table</a> names.";
}

/// What was run, and on what.
std::string machine_sentence(const Page& page) {
  std::string text;
  for (std::size_t i = 0; i < page.values.at("/summary/processors").size(); ++i) {
    text += (i ? "; " : "") + page.values.text("/summary/processors/" + std::to_string(i));
  }
  return "<p>The same collapse of a water column by moving particle semi-implicit (MPS), smoothed "
         "particle hydrodynamics (SPH) and OpenFOAM’s volume-of-fluid solver (VOF), measured in "
         "one "
         "way. The reference is " +
         page.values.text("/summary/reference_label") + ". " +
         page.values.integer("/summary/complete") + " of " + page.values.integer("/summary/asked") +
         " runs are complete, computed on " +
         (text.empty() ? "a machine that the runs do not name" : text) + ".</p>\n";
}

}  // namespace

void measure_summary(const StudyResult& study, json& metrics) {
  const std::string against = study.reference_run().run.method == "vof" ? "vof" : "reference";
  json& out = metrics["summary"];
  metrics["study"] = {{"title", study.study.title},
                      {"reference", study.study.reference},
                      {"strip_height_m", study.study.strip_height.value()}};
  for (Seconds t : study.study.snapshot_times)
    metrics["study"]["snapshot_times_s"].push_back(t.value());
  out["against"] = against;
  out["reference_label"] = study.reference().label();
  const json& timing = metrics["timing"][study.study.reference];
  out["reference_wall_s"] = timing.contains("wall_s") ? timing["wall_s"] : json();
  out["asked"] = study.runs.size();
  out["complete"] = std::count_if(study.runs.begin(), study.runs.end(), [](const RunResult& run) {
    return run.status == RunStatus::complete;
  });
  std::set<std::string> processors;
  for (const RunResult* run : study.measured()) {
    const json& manifest = run->measured->run.manifest;
    if (manifest.is_object() && manifest.contains("cpu")) processors.insert(manifest["cpu"]);
  }
  out["processors"] = processors;
  for (const char* method : {"mps", "sph"}) {
    out["methods"][method] =
        entry_of(nearest_run(study, metrics, method, "rms_vs_" + against), metrics, against);
  }
  const json& mps = out["methods"]["mps"];
  const json& sph = out["methods"]["sph"];
  out["nearer"] = nullptr;
  if (mps.is_null() || sph.is_null()) return;
  const double a = mps["rms"], b = sph["rms"];
  out["nearer"] = a <= b ? "MPS" : "SPH";
  out["rms_ratio"] = std::max(a, b) > 0.0 ? std::min(a, b) / std::max(a, b) : 1.0;
}

std::string write_summary(const Page& page) {
  std::string html = machine_sentence(page);
  for (const auto& run : page.study.runs) {
    if (run.status == RunStatus::complete && run.note.empty()) continue;
    const std::string at = key({"runs", run.study.name});
    html += "<p class=\"warning\"><code>" + page.values.text(at + "/name") + "</code> is " +
            page.values.text(at + "/status") +
            (run.note.empty() ? "" : ": " + page.values.text(at + "/note")) + ".</p>\n";
  }
  html += "<div class=\"answer\">\n<p>" + accuracy_sentence(page, "mps") + " " +
          accuracy_sentence(page, "sph") + "</p>\n<p>" + verdict_sentence(page) + "</p>\n<p>" +
          claims_sentence(page) + "</p>\n<p>" + cost_sentence(page) + "</p>\n</div>\n";
  return html + figure_html(page, "fig8");
}

}  // namespace surge::compare
