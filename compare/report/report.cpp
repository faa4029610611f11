#include "compare/report/report.hpp"

#include <fstream>
#include <iomanip>
#include <sstream>

#include "compare/figures/figures.hpp"
#include "compare/report/page.hpp"
#include "compare/report/sections.hpp"
#include "particle/support/write_error.hpp"

namespace surge::compare {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

void write_text(const fs::path& file, const std::string& text) {
  errno = 0;
  std::ofstream out(file);
  out << text;
  out.close();
  if (!out) throw write_error(file);
}

}  // namespace

json report_metrics(const StudyResult& study) {
  MetricsOptions options;
  options.front = study.front_options();
  options.with_front = study.has_front;
  json out{{"study", {{"title", study.study.title}}}};
  if (study.has_reference()) {
    std::vector<PublishedSeries> published = study.published;
    published.insert(published.end(), study.published_elsewhere.begin(),
                     study.published_elsewhere.end());
    out = metrics(study.measured_runs, study.study.reference, published, options);
  }
  for (const Section& section : report_sections())
    if ((!section.needs_reference || study.has_reference()) &&
        (!section.of_the_paper || study.judges_paper()) &&
        (!section.needs_front || study.has_front))
      section.measure(study, out);
  return out;
}

json write_report(const StudyResult& study, const fs::path& out, std::string& warnings) {
  json numbers = report_metrics(study);
  const fs::path folder = out / "figures";
  fs::create_directories(folder);
  const std::vector<Figure> figures = figures_of(study);
  const std::vector<std::string> said = draw_all(figures, folder);
  for (std::size_t i = 0; i < figures.size(); ++i)
    if (!said[i].empty()) warnings += figures[i].name + ": " + said[i];
  write_text(out / "metrics.json",
             numbers.dump(1, ' ', false, json::error_handler_t::replace) + "\n");
  write_page(study, numbers, figures, out);
  return numbers;
}

namespace {

/// The error of each run of a flow with a known answer.
std::string verification_table(const StudyResult& study) {
  std::ostringstream out;
  for (const RunResult* run : study.runs_of(Role::verification)) {
    const auto found = study.flows.find({run->study.group, run->study.name});
    out << std::left << std::setw(30) << run->study.name << std::setw(11)
        << status_text(run->status);
    if (found != study.flows.end()) out << "error " << fixed_text(found->second.error, 5);
    if (!run->note.empty()) out << run->note;
    out << '\n';
  }
  return out.str();
}

}  // namespace

namespace {

/// What the verdict on a run's leading edge is; empty where there is none.
std::string verdict_in(const json& metrics, const StudyResult& study, const std::string& run) {
  json::json_pointer pointer("/verdicts/runs");
  pointer /= run;
  pointer /= "leading_edge";
  pointer /= study.study.reference;
  return metrics.contains(pointer) ? metrics.at(pointer).at("verdict").get<std::string>() : "";
}

}  // namespace

std::string summary_table(const StudyResult& study, const json& metrics) {
  if (!study.has_reference()) return verification_table(study);
  const std::string against = metrics["summary"]["against"];
  std::ostringstream out;
  const auto cell = [&](const json& entry, const std::string& name, int width, int decimals) {
    const bool there = entry.contains(name) && entry[name].is_number();
    out << std::setw(width) << (there ? fixed_text(entry[name].get<double>(), decimals) : "-");
  };
  std::size_t longest = 3;
  for (const auto& run : study.runs) longest = std::max(longest, run.study.name.size());
  const int width = static_cast<int>(longest) + 2;
  out << std::left << std::setw(width) << "run" << std::setw(11) << "status" << std::right
      << std::setw(9) << "RMS Z/L" << std::setw(9) << "max Z/L" << std::setw(9) << "bias"
      << std::setw(11) << "impact s" << std::setw(9) << "steps" << std::setw(9) << "wall s"
      << "  leading edge\n";
  for (const auto& run : study.runs) {
    const std::string& name = run.study.name;
    const json none = json::object();
    const json& front = metrics["front"].contains(name) ? metrics["front"][name] : none;
    const json& timing = metrics["timing"].contains(name) ? metrics["timing"][name] : none;
    out << std::left << std::setw(width) << name << std::setw(11) << status_text(run.status)
        << std::right;
    cell(front, "rms_vs_" + against, 9, 4);
    cell(front, "max_vs_" + against, 9, 4);
    cell(front, "bias_vs_" + against, 9, 4);
    cell(front, "impact_time_s", 11, 4);
    cell(timing, "steps", 9, 0);
    cell(timing, "wall_s", 9, 1);
    out << "  " << verdict_in(metrics, study, name) << '\n';
  }
  for (const auto& run : study.runs) {
    if (!run.note.empty()) out << run.study.name << ": " << run.note << '\n';
  }
  return out.str();
}

}  // namespace surge::compare
