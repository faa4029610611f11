#include <algorithm>
#include <cmath>
#include <map>

#include "compare/report/scaling.hpp"
#include "compare/report/sections.hpp"
#include "compare/scaling.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

/// Repetitions of one computation.
struct Size {
  double spacing = 0.0;
  double fluid = 0.0, all = 0.0;  ///< particles
  double steps = 0.0, simulated = 0.0;
  std::vector<double> ms_per_step;
  std::map<std::string, std::vector<double>> share;
};

struct Curve {
  std::string method, preset, search;
  std::map<double, Size> sizes;  ///< by the number of fluid particles
};

double number(const json& from, const char* name) {
  return from.value(name, 0.0);
}

void add_run(const json& manifest, std::map<std::string, Curve>& curves) {
  const json& c = manifest["case"];
  const std::string method = c["method"].value("name", "");
  const std::string preset = c["method"].value("preset", "");
  const std::string search = c.contains("search") ? c["search"].value("neighbours", "") : "";
  Curve& curve = curves[method + " " + preset + " " + search];
  curve.method = method;
  curve.preset = preset;
  curve.search = search;
  Size& size = curve.sizes[number(manifest, "fluid_particles")];
  size.spacing = number(c, "spacing");
  size.fluid = number(manifest, "fluid_particles");
  size.all = size.fluid + number(manifest, "wall_particles");
  size.steps = number(manifest, "steps");
  size.simulated = number(manifest, "simulated_s");
  const json& wall = manifest["wall_s"];
  const double solve = number(wall, "total") - number(wall, "setup") - number(wall, "output");
  if (solve <= 0.0 || size.steps <= 0.0) return;
  size.ms_per_step.push_back(1e3 * solve / size.steps);
  for (const char* phase : {"neighbours", "pressure", "forces"})
    size.share[phase].push_back(number(wall, phase) / solve);
}

/// The study's run of a method and preset over the whole time: it tells how many steps that takes.
const json* whole_run(const StudyResult& study, const Curve& curve) {
  for (const RunResult* run : study.measured()) {
    const Run& r = run->measured->run;
    if (run->status == RunStatus::complete && r.method == curve.method &&
        r.preset == curve.preset && r.manifest.is_object() && number(r.manifest, "steps") > 0.0)
      return &r.manifest;
  }
  return nullptr;
}

/// Solving time of the whole run's simulated time. Both limits of the step are proportional to the
/// spacing, and so is the step itself where it is not at its upper bound.
json total_seconds(const Size& size, double ms_per_step, const json* whole) {
  if (whole == nullptr) return nullptr;
  if (size.simulated >= 0.999 * number(*whole, "simulated_s"))
    return 1e-3 * ms_per_step * size.steps;
  const double steps = number(*whole, "steps") * number((*whole)["case"], "spacing") / size.spacing;
  return 1e-3 * ms_per_step * steps;
}

json fit_json(const std::vector<std::pair<double, double>>& points) {
  const auto fit = fit_power(points);
  if (!fit) return nullptr;
  return {{"exponent", fit->exponent}, {"half_width", fit->half_width}, {"points", fit->points}};
}

json curve_json(const StudyResult& study, const Curve& curve) {
  const json* whole = whole_run(study, curve);
  json points = json::array();
  std::vector<std::pair<double, double>> per_step, total;
  for (const auto& [fluid, size] : curve.sizes) {
    if (size.ms_per_step.empty()) continue;
    const double ms = median_of(size.ms_per_step);
    json point{
        {"fluid_particles", size.fluid},
        {"all_particles", size.all},
        {"spacing_m", size.spacing},
        {"repeats", size.ms_per_step.size()},
        {"steps", size.steps},
        {"simulated_s", size.simulated},
        {"ms_per_step", ms},
        {"ms_per_step_least", *std::min_element(size.ms_per_step.begin(), size.ms_per_step.end())},
        {"ms_per_step_most", *std::max_element(size.ms_per_step.begin(), size.ms_per_step.end())},
        {"total_s", total_seconds(size, ms, whole)},
        {"extrapolated",
         whole == nullptr || size.simulated < 0.999 * number(*whole, "simulated_s")}};
    for (const auto& [phase, values] : size.share) point["share"][phase] = median_of(values);
    per_step.emplace_back(size.all, ms);
    if (point["total_s"].is_number()) total.emplace_back(size.all, point["total_s"].get<double>());
    points.push_back(point);
  }
  return {{"method", curve.method},
          {"preset", curve.preset},
          {"search", curve.search},
          {"label", (curve.method == "mps" ? "MPS, " : "SPH, ") +
                        std::string(curve.search == "all_pairs" ? "all pairs" : "cell grid")},
          {"points", points},
          {"fit_per_step", fit_json(per_step)},
          {"fit_total", fit_json(total)}};
}

std::string fit_cell(const Page& page, const std::string& at) {
  if (!page.values.has(at)) return "–";
  return page.values.number(at + "/exponent", 2) + " ± " +
         page.values.number(at + "/half_width", 2);
}

std::string fit_table(const Page& page) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, curve] : page.values.at("/scaling").items()) {
    const std::string at = key({"scaling", name});
    rows.push_back({page.values.text(at + "/label"), fit_cell(page, at + "/fit_per_step"),
                    fit_cell(page, at + "/fit_total")});
  }
  return html_table("Exponent of the growth with the number of all particles, walls included",
                    {"Method and search", "Time per step", "Total time"}, rows);
}

std::string point_table(const Page& page) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, curve] : page.values.at("/scaling").items()) {
    for (std::size_t i = 0; i < curve["points"].size(); ++i) {
      const std::string at = key({"scaling", name, "points", std::to_string(i)});
      const auto share = [&](const char* phase) {
        return page.values.has(at + "/share/" + phase)
                   ? page.values.number(at + "/share/" + phase, 2)
                   : std::string("–");
      };
      rows.push_back({page.values.text(key({"scaling", name, "label"})),
                      page.values.integer(at + "/fluid_particles"),
                      page.values.integer(at + "/all_particles"),
                      page.values.magnitude(at + "/ms_per_step"),
                      page.values.integer(at + "/repeats"), page.values.integer(at + "/steps"),
                      share("neighbours"), share("pressure"), share("forces"),
                      page.values.magnitude(at + "/total_s") +
                          (curve["points"][i]["extrapolated"].get<bool>() ? " extrapolated" : "")});
    }
  }
  return html_table("Solving time, median of the repeats, setup and output left out",
                    {"Method and search", "Fluid particles", "All particles", "ms per step",
                     "Repeats", "Steps timed", "Neighbours", "Pressure", "Forces", "Total, s"},
                    rows);
}

}  // namespace

void measure_scaling(const StudyResult& study, json& metrics) {
  std::map<std::string, Curve> curves;
  for (const RunResult* run : study.runs_of(Role::timing)) {
    if (run->status == RunStatus::complete && run->manifest.contains("case") &&
        run->manifest.contains("wall_s"))
      add_run(run->manifest, curves);
  }
  metrics["scaling"] = json::object();
  for (const auto& [name, curve] : curves) metrics["scaling"][name] = curve_json(study, curve);
}

std::string write_scaling(const Page& page) {
  if (page.values.at("/scaling").empty()) return "";
  return fit_table(page) + point_table(page) +
         "<p>Extrapolated: timed over the first steps of the collapse only. The number of steps of "
         "the whole time is that of the study’s own run of the method, times the ratio of the "
         "spacings, because the step is proportional to the spacing.</p>\n";
}

}  // namespace surge::compare
