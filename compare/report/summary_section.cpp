#include <algorithm>
#include <set>

#include "compare/report/claim_parts.hpp"
#include "compare/report/sections.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

/// The complete run of a method that is nearest to the reference, among those of the paper or the
/// others; null where there is none.
const RunResult* nearest_run(const StudyResult& study, const json& metrics,
                             const std::string& method, bool of_the_paper, const std::string& rms) {
  const RunResult* best = nullptr;
  const auto error = [&](const RunResult& run) {
    return metrics["front"][run.study.name][rms].get<double>();
  };
  for (const RunResult* run : study.measured()) {
    const bool counts = run != &study.reference() && run->status == RunStatus::complete &&
                        run->note.empty() && run->measured->run.method == method &&
                        is_of_the_paper(*run) == of_the_paper;
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

std::string method_at(const char* method) {
  return std::string("/summary/methods/") + method;
}

/// "by RMS 0.01 (at most 0.02) for MPS ... and by RMS ..." of one of the summary's tables.
std::string differences(const Values& v, const std::string& table) {
  std::string text;
  for (const char* method : {"mps", "sph"}) {
    const std::string at = "/summary/" + table + "/" + method;
    if (!v.has(at)) continue;
    text += (text.empty() ? "" : " and ") + std::string("by RMS ") + v.number(at + "/rms", 3) +
            " (at most " + v.number(at + "/max", 3) + ") for " + v.text(at + "/label");
  }
  return text;
}

/// What was run, and on what.
std::string runs_sentence(const Page& page) {
  const Values& v = page.values;
  std::string machine;
  for (std::size_t i = 0; i < v.at("/summary/processors").size(); ++i)
    machine += (i ? "; " : "") + v.text("/summary/processors/" + std::to_string(i));
  return "The same collapse of a water column was computed by moving particle semi-implicit (MPS), "
         "smoothed particle hydrodynamics (SPH) and OpenFOAM’s volume-of-fluid solver (VOF), and "
         "measured in one way against " +
         v.text("/summary/reference_label") + ": " + v.integer("/summary/complete") + " of " +
         v.integer("/summary/asked") + " runs are complete, on " +
         (machine.empty() ? "a machine that they do not name" : machine) + ".";
}

/// How near each method comes to the reference, and what that makes of the paper's finding.
std::string accuracy_sentence(const Page& page) {
  const Values& v = page.values;
  const std::string papers = differences(v, "methods"), beyond = differences(v, "beyond");
  std::string text;
  if (!papers.empty())
    text = "Until it is at the far wall, the leading edge Z/L differs from that of the reference " +
           papers + (beyond.empty() ? "" : ", with newer formulations " + beyond) + "; ";
  if (!v.has("/summary/nearer")) {
    return text + (text.empty() ? "W" : "w") +
           "hich of MPS and SPH is nearer to the reference cannot be said, because one of them is "
           "not there.";
  }
  return text + "of the paper’s two methods " + v.text("/summary/nearer") +
         " is the nearer, its difference is " + v.number("/summary/rms_ratio", 2) +
         " times that of the other, and the paper’s finding that MPS is the more accurate is " +
         (v.at("/summary/nearer") == "MPS" ? "" : "not ") + "reproduced by these runs.";
}

/// What it cost, and how the paper's statements fare.
std::string cost_sentence(const Page& page) {
  const Values& v = page.values;
  std::string cost;
  const auto add = [&](const std::string& label, const std::string& seconds) {
    if (!v.has(seconds)) return;
    cost += (cost.empty() ? "" : ", ") + v.magnitude(seconds) + " s for " + v.text(label);
  };
  for (const char* method : {"mps", "sph"})
    if (v.has(method_at(method))) add(method_at(method) + "/label", method_at(method) + "/wall_s");
  add("/summary/reference_label", "/summary/reference_wall_s");
  const std::string at = "/claim_counts/";
  const auto verb = [&](const std::string& count, const char* of_one, const char* of_more) {
    return v.at(at + count) == 1 ? of_one : of_more;
  };
  return (cost.empty() ? "No run states its cost" : "The whole runs took " + cost) +
         "; of the statements that the paper makes from its results these runs can judge " +
         v.integer(at + "judged") + ", of which " + v.integer(at + "reproduced") +
         verb("reproduced", " is reproduced, ", " are reproduced, ") +
         v.integer(at + "not reproduced") +
         verb("not reproduced", " is not, and ", " are not, and ") + v.integer(at + "depends") +
         verb("depends", " depends", " depend") +
         " on a choice that <a href=\"#claims\">their table</a> names.";
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
    for (const auto& [table, of_the_paper] : {std::pair{"methods", true}, {"beyond", false}}) {
      out[table][method] = entry_of(
          nearest_run(study, metrics, method, of_the_paper, "rms_vs_" + against), metrics, against);
    }
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
  std::string html = "<div class=\"answer\">\n";
  for (const std::string& sentence :
       {runs_sentence(page), accuracy_sentence(page), cost_sentence(page)})
    html += "<p>" + sentence + "</p>\n";
  html += "</div>\n";
  for (const auto& run : page.study.runs) {
    if (run.status == RunStatus::complete && run.note.empty()) continue;
    const std::string at = key({"runs", run.study.name});
    html += "<p class=\"warning\"><code>" + page.values.text(at + "/name") + "</code> is " +
            page.values.text(at + "/status") +
            (run.note.empty() ? "" : ": " + page.values.text(at + "/note")) + ".</p>\n";
  }
  return html + figure_html(page, "fig8");
}

}  // namespace surge::compare
