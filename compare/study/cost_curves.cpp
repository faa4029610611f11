#include "compare/study/cost_curves.hpp"

#include <algorithm>
#include <boost/math/statistics/univariate_statistics.hpp>
#include <cctype>
#include <cmath>
#include <map>

#include "compare/study/scaling.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

constexpr const char* phases[] = {"neighbours", "pressure", "forces"};

double number_of(const json& from, const char* name) {
  return from.value(name, 0.0);
}

/// Repetitions of one computation.
struct Sample {
  double steps = 0.0, simulated = 0.0;
  std::vector<double> solve_s, setup_s, output_s;
  std::map<std::string, std::vector<double>> share;

  [[nodiscard]] bool empty() const { return solve_s.empty(); }
  [[nodiscard]] double ms_per_step() const { return 1e3 * median_of(solve_s) / steps; }

  void add(const json& manifest) {
    const json& wall = manifest["wall_s"];
    const double solve =
        number_of(wall, "total") - number_of(wall, "setup") - number_of(wall, "output");
    steps = number_of(manifest, "steps");
    simulated = number_of(manifest, "simulated_s");
    if (solve <= 0.0 || steps <= 0.0) return;
    solve_s.push_back(solve);
    setup_s.push_back(number_of(wall, "setup"));
    output_s.push_back(number_of(wall, "output"));
    for (const char* phase : phases) share[phase].push_back(number_of(wall, phase) / solve);
  }
};

struct Size {
  double spacing = 0.0;
  double fluid = 0.0, all = 0.0;  ///< particles
  Sample window, whole;
};

struct CostCurve {
  std::string method, preset, search, solver;
  std::string cpu;
  int threads = 0;
  std::map<double, Size> sizes;  ///< by the number of fluid particles

  [[nodiscard]] std::string key() const {
    std::string text = method;
    for (const std::string& part : {preset, search, solver})
      if (!part.empty()) text += ' ' + part;
    return text;
  }

  /// Times on different processors, or on more threads, make no curve.
  [[nodiscard]] std::string machine() const {
    return cpu + ", " + std::to_string(threads) + (threads == 1 ? " thread" : " threads");
  }

  [[nodiscard]] std::string label() const {
    std::string text = method;
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    text += ", ";
    text += search == "all_pairs" ? "all pairs" : "cell grid";
    if (solver.empty()) return text;
    return text + ", " + (solver == "iccg" ? "ICCG" : solver);
  }

  /// Time per step of whole runs over that of windows, at the largest size that has both.
  [[nodiscard]] const Size* largest_with_both() const {
    const Size* found = nullptr;
    for (const auto& [fluid, size] : sizes)
      if (!size.whole.empty() && !size.window.empty()) found = &size;
    return found;
  }
};

/// Steps of whole runs of a method over the spacing: the search and the solver of the pressure
/// change none of them.
struct Steps {
  std::map<double, double> by_spacing;

  /// Both limits of the step are proportional to the spacing, but the fastest particle of a finer
  /// run is faster: the exponent is fitted, and is -1 where there are too few runs for that.
  [[nodiscard]] PowerFit fit() const {
    const auto found = fit_power({by_spacing.begin(), by_spacing.end()});
    return found ? *found : PowerFit{-1.0, 0.0, 0.0, 0};
  }
  [[nodiscard]] std::optional<double> at(double spacing) const {
    if (by_spacing.empty()) return std::nullopt;
    const auto& [finest, steps] = *by_spacing.begin();
    return steps * std::pow(spacing / finest, fit().exponent);
  }
};

void add_run(const json& manifest, double whole_time, std::map<std::string, CostCurve>& curves,
             std::map<std::string, Steps>& steps) {
  const json& c = manifest["case"];
  CostCurve of;
  of.method = c["method"].value("name", "");
  of.preset = c["method"].value("preset", "");
  of.search = c.contains("search") ? c["search"].value("neighbours", "") : "";
  of.solver = c["method"].value(json::json_pointer("/parameters/ppe_solver"), "");
  of.cpu = manifest.value("cpu", "");
  of.threads = manifest.value("threads", 0);
  CostCurve& curve = curves.try_emplace(of.key() + '\n' + of.machine(), of).first->second;
  Size& size = curve.sizes[number_of(manifest, "fluid_particles")];
  size.spacing = number_of(c, "spacing");
  size.fluid = number_of(manifest, "fluid_particles");
  size.all = size.fluid + number_of(manifest, "wall_particles");
  const bool whole = number_of(manifest, "simulated_s") >= 0.999 * whole_time;
  (whole ? size.whole : size.window).add(manifest);
  if (whole) steps[of.method + of.preset].by_spacing[size.spacing] = number_of(manifest, "steps");
}

json sample_json(const Sample& sample) {
  if (sample.empty()) return nullptr;
  const auto [least, most] = std::minmax_element(sample.solve_s.begin(), sample.solve_s.end());
  const double ms = 1e3 / sample.steps;
  const double spread = sample.solve_s.size() > 1
                            ? std::sqrt(boost::math::statistics::sample_variance(sample.solve_s)) /
                                  median_of(sample.solve_s)
                            : 0.0;
  json out{{"repeats", sample.solve_s.size()},
           {"scatter", spread},
           {"steps", sample.steps},
           {"simulated_s", sample.simulated},
           {"solve_s", median_of(sample.solve_s)},
           {"setup_s", median_of(sample.setup_s)},
           {"output_s", median_of(sample.output_s)},
           {"ms_per_step", sample.ms_per_step()},
           {"ms_per_step_least", ms * *least},
           {"ms_per_step_most", ms * *most}};
  for (const auto& [phase, values] : sample.share) out["share"][phase] = median_of(values);
  return out;
}

json ratio_json(const Size& size) {
  if (size.whole.empty() || size.window.empty()) return nullptr;
  return size.whole.ms_per_step() / size.window.ms_per_step();
}

json total_seconds(const Size& size, const json& ratio, const Steps& steps) {
  if (!size.whole.empty()) return median_of(size.whole.solve_s);
  const auto count = steps.at(size.spacing);
  if (!ratio.is_number() || !count) return nullptr;
  return 1e-3 * size.window.ms_per_step() * ratio.get<double>() * *count;
}

json fit_json(const std::vector<std::pair<double, double>>& points) {
  const auto fit = fit_power(points);
  if (!fit) return nullptr;
  return {{"exponent", fit->exponent}, {"half_width", fit->half_width}, {"points", fit->points}};
}

json curve_json(const CostCurve& curve, const Steps& steps) {
  const Size* both = curve.largest_with_both();
  const json ratio = both ? ratio_json(*both) : json();
  json points = json::array();
  std::map<std::string, std::vector<std::pair<double, double>>> data;
  for (const auto& [fluid, size] : curve.sizes) {
    const Sample& compared = size.window.empty() ? size.whole : size.window;
    if (compared.empty()) continue;
    json point{{"fluid_particles", size.fluid},
               {"all_particles", size.all},
               {"spacing_m", size.spacing},
               {"ms_per_step", compared.ms_per_step()},
               {"window", sample_json(size.window)},
               {"whole", sample_json(size.whole)},
               {"whole_over_window", ratio_json(size)},
               {"total_s", total_seconds(size, ratio, steps)},
               {"extrapolated", size.whole.empty()}};
    point["shares"] = point[size.whole.empty() ? "window" : "whole"]["share"];
    for (const auto& [over, count] : {std::pair{"all", size.all}, std::pair{"fluid", size.fluid}}) {
      data[std::string("step/") + over].emplace_back(count, compared.ms_per_step());
      if (point["total_s"].is_number())
        data[std::string("total/") + over].emplace_back(count, point["total_s"].get<double>());
    }
    points.push_back(point);
  }
  const PowerFit step_fit = steps.fit();
  return {{"method", curve.method},
          {"preset", curve.preset},
          {"search", curve.search},
          {"solver", curve.solver},
          {"label", curve.label()},
          {"cpu", curve.cpu},
          {"threads", curve.threads},
          {"points", points},
          {"whole_over_window", ratio},
          {"whole_over_window_at", both ? json(both->fluid) : json()},
          {"steps_exponent", step_fit.points > 0 ? json(step_fit.exponent) : json()},
          {"fit_per_step", fit_json(data["step/all"])},
          {"fit_per_step_over_fluid", fit_json(data["step/fluid"])},
          {"fit_total", fit_json(data["total/all"])},
          {"fit_total_over_fluid", fit_json(data["total/fluid"])}};
}

}  // namespace

void measure_scaling(const StudyResult& study, json& metrics) {
  std::map<std::string, CostCurve> curves;
  std::map<std::string, Steps> steps;
  const double whole_time = study.reference().last_time()->value();
  for (const RunResult* run : study.runs_of(Role::timing)) {
    if (run->status == RunStatus::complete && run->manifest.contains("case") &&
        run->manifest.contains("wall_s"))
      add_run(run->manifest, whole_time, curves, steps);
  }
  metrics["scaling"] = json::object();
  for (const auto& [whole, curve] : curves) {
    const auto same = [key = curve.key()](const auto& other) { return other.second.key() == key; };
    const bool alone = std::count_if(curves.begin(), curves.end(), same) == 1;
    json out = curve_json(curve, steps[curve.method + curve.preset]);
    if (!alone) out["label"] = curve.label() + ", " + curve.machine();
    metrics["scaling"][alone ? curve.key() : curve.key() + ", " + curve.machine()] = out;
  }
}

}  // namespace surge::compare
