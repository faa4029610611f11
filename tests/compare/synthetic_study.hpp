#pragma once

#include "compare/study/study_result.hpp"
#include "tests/compare/synthetic.hpp"
#include "tests/places.hpp"

namespace surge::compare::testing {

/// A study on the disk whose answers are known: the reference's front moves at 2 m/s, MPS leads it
/// by 0.02 L and SPH lags by 0.05 L at all times after the start. The published series is the
/// reference, 0.2 late in T.
class SyntheticStudy {
 public:
  static constexpr double length = 0.145;

  SyntheticStudy() {
    write("vof-20", "vof", 0.0);
    write("mps-a", "mps", 0.02 * length);
    write("sph-a", "sph", -0.05 * length);
    write_text(folder_ / "reference/late.csv", late_series());
    std::filesystem::create_directories(folder_ / "studies");
    std::filesystem::copy(std::filesystem::path(tests::sources()) / "compare/studies/alves_dreux",
                          folder_ / "studies/alves_dreux");
    write_text(folder_ / "studies/study.toml", text("Dam <b>break</b> & \"more\""));
  }

  void write(const std::string& name, const std::string& method, double lead,
             bool finished = true) const {
    nlohmann::json manifest = dam_break_manifest();
    manifest["finished"] = finished;
    manifest["case"]["method"]["name"] = method;
    manifest["case"]["probes"] = {{{"name", "wall_pressure"}, {"position", {0.58, 0.0145, 0}}}};
    if (method == "sph") {
      manifest["case"]["method"]["parameters"] = {
          {"gamma", 7.0}, {"density_diffusion", 0.1}, {"h_over_l0", 1.2}, {"brand_new", "x<y"}};
    }
    std::vector<double> times;
    const double end = finished ? 0.22 : 0.1;
    for (double t = 0.0; t <= end + 1e-9; t += 0.01) times.push_back(t);
    write_run(folder_ / ("runs/" + name), times, front_with(lead), manifest);
    if (method != "vof") write_sheet(name, method);
    write_steps(name, method, finished ? 0.5 : end);
  }

  /// Two coarser levels of a run with the same front, so that refining it says that it is exact.
  /// `settings`: what its table says in `set`.
  void refine(const std::string& name, const std::string& method, double lead,
              const std::string& settings = "",
              const std::vector<double>& spacings = {0.0145, 0.029}) const {
    std::ofstream study(this->study(), std::ios::app);
    for (const double spacing : spacings) {
      const std::string level = name + "-at-" + std::to_string(spacing);
      nlohmann::json manifest = dam_break_manifest();
      manifest["case"]["method"]["name"] = method;
      manifest["case"]["spacing"] = spacing;
      std::vector<double> times;
      for (double t = 0.0; t <= 0.22 + 1e-9; t += 0.01) times.push_back(t);
      write_run(folder_ / ("runs/" + level), times, front_with(lead), manifest);
      study << "[[run]]\nname = \"" << level
            << "\"\nprogram = \"surge-particle\"\ncase = \"c.toml\"\nset = [" << settings
            << "]\nrole = \"convergence\"\ngroup = \"" << name << ", spacing\"\n";
    }
  }
  /// Of all three runs.
  void refine_all(double mps = 0.02, double sph = -0.05) const {
    refine("vof-20", "vof", 0.0);
    refine("mps-a", "mps", mps * length);
    refine("sph-a", "sph", sph * length);
  }

  static std::function<double(double)> front_with(double lead) {
    return [lead](double t) { return length + 2.0 * t + (t > 0.0 ? lead + 0.0001 : 0.0001); };
  }

  /// The probe on the wall, in units of rho g H = 2844.9 Pa: 1 for the reference, 2 for MPS, and
  /// for SPH 1.5 with a wave of amplitude 0.5 and 1 kHz.
  void write_steps(const std::string& name, const std::string& method, double end) const {
    std::string csv = "time,dt,wall_pressure\n";
    for (int k = 0; k * 1e-5 <= end; ++k) {
      const double t = k * 1e-5, wave = 1.5 + 0.5 * std::sin(2e3 * std::acos(-1.0) * t);
      const double p = method == "vof" ? 1.0 : method == "mps" ? 2.0 : wave;
      csv += std::to_string(t) + ",1e-05," + std::to_string(1000 * 9.81 * 0.29 * p) + "\n";
    }
    write_text(folder_ / ("runs/" + name + "/steps.csv"), csv);
  }

  /// What a run computed with, as surge-particle writes it; radii of 2.1 and 3.9 spacings, h = 6
  /// mm.
  void write_sheet(const std::string& name, const std::string& method) const {
    const double l0 = 0.005, h = 0.006;
    const auto sampled = [](const char* what, const char* unit, double support, auto f) {
      nlohmann::json out{{"name", what}, {"unit", unit}, {"support_m", support}};
      for (int k = 1; k <= 22; ++k) {
        out["r_m"].push_back(support * k / 20.0);
        out["value"].push_back(f(support * k / 20.0));
      }
      return out;
    };
    nlohmann::json sheet{{"method", method},
                         {"dimension", 2},
                         {"spacing_m", l0},
                         {"loop", {{"start", "Solver(case)"}, {"until", "RunLoop::run"}}}};
    sheet["loop"]["step"] = "Solver::step";
    if (method == "mps") {
      sheet["functions"] = {
          sampled("w", "1", 2.1 * l0, [&](double r) { return std::max(2.1 * l0 / r - 1.0, 0.0); }),
          sampled("w_laplacian", "1", 3.9 * l0,
                  [&](double r) { return std::max(3.9 * l0 / r - 1.0, 0.0); })};
      sheet["stages"] = {{{"function", "push"}, {"does", "Pushes <it>"}, {"equations", "Eq. (99)"}},
                         {{"function", "pull"}, {"does", ""}, {"equations", ""}}};
    } else {
      sheet["length_m"] = h;
      sheet["functions"] = {
          sampled("W", "1/m2", 3.0 * h, [&](double r) { return (3.0 - r / h) / (h * h); }),
          sampled("dW/dr", "1/m3", 3.0 * h, [&](double) { return -1.0 / (h * h * h); })};
      sheet["stages"] = {{{"function", "kick"}, {"does", "Kicks it"}, {"equations", ""}}};
    }
    write_text(folder_ / ("runs/" + name + "/method.json"), sheet.dump());
  }

  [[nodiscard]] std::filesystem::path study() const { return folder_ / "studies/study.toml"; }
  [[nodiscard]] std::filesystem::path runs() const { return folder_ / "runs"; }
  [[nodiscard]] std::filesystem::path out() const { return folder_ / "report"; }
  [[nodiscard]] std::filesystem::path series() const { return folder_ / "reference"; }
  [[nodiscard]] StudyResult collected() const {
    return collect(read_study(study()), runs(), series());
  }

 private:
  static std::string text(const std::string& title) {
    const auto run = [](const std::string& name) {
      return "[[run]]\nname = \"" + name +
             "\"\nprogram = \"surge-particle\"\ncase = \"c.toml\"\nset = []\nthreads = 1\n";
    };
    return "title = '" + title +
           "'\nreference = \"vof-20\"\nstrip_height = 0.015\nclaims = "
           "\"alves_dreux\"\nsnapshot_times = [0.05, 0.15]\n"
           "published = [\"late\"]\n" +
           run("mps-a") + run("sph-a") + run("vof-20");
  }

  static std::string late_series() {
    std::string csv =
        "# label: Late series\n# citation: Nobody 1900 <made up>\n# column: none\n"
        "# column_height: 2\n# tank_width: 4\n# bed_depth: 0\n# gate: none\n# axes: T, Z/L\n"
        "# kind: experiment\n# time_uncertainty: 0.1\n# position_uncertainty: 0.15\n"
        "T,Z_over_L\n";
    const Scales scales = dam_break().scales();
    for (double t : {0.02, 0.06, 0.1, 0.14}) {
      csv += std::to_string(scales.dimensionless(Seconds(t)).value() + 0.2) + "," +
             std::to_string((length + 2.0 * t + 0.0001) / length) + "\n";
    }
    return csv;
  }

  TemporaryFolder folder_;
};

inline std::string read_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  EXPECT_TRUE(in) << file;
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace surge::compare::testing
