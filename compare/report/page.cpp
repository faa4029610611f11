#include "compare/report/page.hpp"

#include <fstream>
#include <set>

#include "compare/report/viewer.hpp"
#include "compare/verification/flows.hpp"
#include "particle/support/error.hpp"
#include "particle/support/process.hpp"
#include "particle/support/write_error.hpp"

namespace surge::compare {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr const char* python = "/usr/bin/python3";  // Debian's, which has Debian's Jinja2

json figure_json(const Figure& figure, const fs::path& folder) {
  json tables = json::array();
  for (const Table& table : figure.tables) tables.push_back(table.name);
  json curves = json::array();
  for (const PlottedCurve& c : figure.curves)
    curves.push_back({{"table", c.table},
                      {"key", c.key},
                      {"x", c.x},
                      {"y", c.y},
                      {"label", c.label},
                      {"colour", c.colour},
                      {"points", c.points}});
  return {{"name", figure.name},
          {"missing", figure.missing},
          {"curves", curves},
          {"x_label", figure.x_label},
          {"y_label", figure.y_label},
          {"title", figure.title},
          {"caption", figure.caption},
          {"wide", figure.width_mm > single_column_mm},
          {"svg", fs::absolute(folder / (figure.name + ".svg")).string()},
          {"tables", tables}};
}

json run_json(const StudyResult& study, const RunResult& run) {
  return {{"name", run.study.name},
          {"label", run.label()},
          {"status", status_text(run.status)},
          {"note", run.note},
          {"measured", run.measured != nullptr},
          {"reference", study.has_reference() && &run == &study.reference()}};
}

json runs_of_role(const StudyResult& study, Role role) {
  json runs = json::array();
  for (const RunResult* run : study.runs_of(role)) runs.push_back(run_json(study, *run));
  return runs;
}

/// The methods that were measured, each once, the reference's last.
json methods_of(const StudyResult& study) {
  json methods = json::array();
  std::set<std::string> seen;
  if (!study.has_reference()) return methods;
  const std::string& reference = study.reference_run().run.method;
  seen.insert(reference);
  for (const RunResult* run : study.measured())
    if (seen.insert(run->measured->run.method).second) methods.push_back(run->measured->run.method);
  methods.push_back(reference);
  return methods;
}

json page_json(const StudyResult& study, const json& metrics, const std::vector<Figure>& figures,
               const fs::path& out) {
  json page{{"title", study.study.title},
            {"has_reference", study.has_reference()},
            {"of_the_paper", study.judges_paper()},
            {"has_front", study.has_reference() && study.has_front},
            {"reference", study.study.reference},
            {"methods", methods_of(study)},
            {"usual_cohesion", usual_cohesion},
            {"runs", json::array()},
            {"convergence_runs", runs_of_role(study, Role::convergence)},
            {"verification_runs", runs_of_role(study, Role::verification)},
            {"figures", json::array()},
            {"elsewhere", json::object()},
            {"series", json::array()},
            {"known_flows", json::array()},
            {"viewer", nullptr}};
  for (const RunResult& run : study.runs) page["runs"].push_back(run_json(study, run));
  for (const Figure& figure : figures)
    page["figures"].push_back(figure_json(figure, out / "figures"));
  for (const auto& [name, what, where] : figures_elsewhere()) page["elsewhere"][name] = where;
  for (const PublishedSeries& series : study.published)
    page["series"].push_back({{"name", series.name}, {"experiment", series.experiment}});
  for (const KnownFlow& flow : known_flows())
    page["known_flows"].push_back(
        {{"group", flow.group}, {"title", flow.title}, {"setup", flow.setup}});
  if (study.has_reference()) page["viewer"] = viewer_json(study, metrics);
  return page;
}

/// A file that is gone when this is.
class TemporaryFile {
 public:
  TemporaryFile(fs::path path, const std::string& text) : path_(std::move(path)) {
    std::ofstream out(path_);
    out << text;
    out.close();
    if (!out) throw write_error(path_);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }

 private:
  fs::path path_;
};

}  // namespace

std::span<const std::array<const char*, 3>> figures_elsewhere() {
  static constexpr std::array<std::array<const char*, 3>, 4> elsewhere{
      {{"differences", "The map of the difference to the reference",
        "below, with the flow patterns"},
       {"wall_pressure", "The figure of the wall pressure", "below, with its table"},
       {"patterns", "The figure of the flow patterns", "below, with its tables"},
       {"fig8", "Fig. 8, motion of the leading edge", "in the summary"}}};
  return elsewhere;
}

void write_page(const StudyResult& study, const json& metrics, const std::vector<Figure>& figures,
                const fs::path& out) {
  json source{{"metrics", metrics}, {"page", page_json(study, metrics, figures, out)}};
  std::string script;
  for (const auto& [name, text] : page_files()) {
    if (name == "render.py") script = text;
    const bool is_template = name.ends_with(".html");
    source[is_template ? "templates" : "files"][std::string(name)] = text;
  }
  source["files"]["viewer_controls.html"] = source["templates"]["viewer_controls.html"];
  const TemporaryFile input(out / ".page.json",
                            source.dump(-1, ' ', false, json::error_handler_t::replace));
  const ProcessEnd end = run_process(python, {"-I", "-B", "-c", script, ".page.json", "index.html"},
                                     out, "python3, with python3-jinja2");
  if (end.status != 0)
    throw Error((out / "index.html").string() + ": the page could not be made: " + end.said);
}

}  // namespace surge::compare
