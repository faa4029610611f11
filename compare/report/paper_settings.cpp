#include "compare/report/paper_settings.hpp"

#include <algorithm>
#include <array>

#include "compare/read/method_sheet.hpp"

namespace surge::compare {

std::span<const PaperSetting> paper_settings() {
  static constexpr std::array<PaperSetting, 41> settings{{
      {"mps", "re_gradient", "2.1", "text after Eq. (4)"},
      {"mps", "re_laplacian", "4.0", "text after Eq. (7)"},
      {"mps", "lambda", R"("paper")", "Eq. (8) as printed, re²/12; its integrals give re²/6"},
      {"mps", "beta", "0.97", "text after Eq. (14)"},
      {"mps", "surface_offset", "0.0", "Eq. (14) alone finds the free surface"},
      {"mps", "source", R"("number_density")", "Eq. (12)"},
      {"mps", "density_share", "", "Eq. (12) has no such share", "source=divergence_and_density"},
      {"mps", "divergence_time", "", "Eq. (12) has no such time", "source=divergence_and_density"},
      {"mps", "laplacian_of", R"("pressure")", "Eq. (12)"},
      {"mps", "surface_at", R"("centre")", "text after Eq. (14)"},
      {"mps", "wall_coupling", R"("all")", "Eq. (12) as it stands"},
      {"mps", "shifting", "0.0", "the algorithm, Fig. 3, has no such step"},
      {"mps", "numerical_viscosity", "0.0", "Eq. (2) has no such term"},
      {"mps", "gradient", R"("minimum")", "Eqs. (5) and (6)"},
      {"mps", "viscous_term", "", "the paper leaves viscosity out",
       "kinematic_viscosity or numerical_viscosity"},
      {"mps", "position_update", R"("new_velocity")", "the algorithm, Fig. 3"},
      {"mps", "source_relaxation", "1.0", "Eq. (12) as it stands"},
      {"mps", "negative_pressure", "", "not stated"},
      {"mps", "ppe_solver", R"("iccg")", "text after Eq. (12)"},
      {"mps", "ppe_tolerance", "", "tolerance of the ICCG not stated",
       "ppe_solver=iccg or ppe_solver=multigrid"},
      {"mps", "ppe_max_iterations", "", "not stated", "ppe_solver=iccg or ppe_solver=multigrid"},
      {"mps", "collision_distance", "", "collision named in Sec. 3.2, its distance not stated"},
      {"mps", "collision_speed", "", "not stated", "collision_distance"},
      {"mps", "collision_restitution", "", "not stated", "collision_distance or wall_distance"},
      {"mps", "wall_distance", "", "not stated"},
      {"sph", "kernel", R"("quintic_spline")", "Eq. (18)"},
      {"sph", "h_over_l0", "", "smoothing length not stated"},
      {"sph", "sound_speed_ratio", "", "speed of sound not stated"},
      {"sph", "gamma", "7.0", "Eq. (21)"},
      {"sph", "xsph_epsilon", "", "Eq. (24): \"varies from 0 to 1\""},
      {"sph", "acoustic_courant", "0.0", "Eq. (25) limits the step by the flow speed alone"},
      {"sph", "negative_pressure", R"("keep")", "Eq. (21) as it stands"},
      {"sph", "shifting", R"("none")", "the algorithm, Fig. 5, has no such step"},
      {"sph", "viscous_term", "", "the paper leaves viscosity out",
       "kinematic_viscosity or artificial_viscosity"},
      {"sph", "artificial_viscosity", "0.0", "Eq. (23) has no such term"},
      {"sph", "density_diffusion", "0.0", "Eq. (20) has no such term"},
      {"sph", "diffusion_of", "", "Eq. (20) has no such term", "density_diffusion"},
      {"sph", "acoustic_damping", "0.0", "Eq. (23) has no such term"},
      {"sph", "wall_density", "", "density of wall particles not stated"},
      {"sph", "wall_distance", "", "wall collision named in Sec. 4, its distance not stated"},
      {"sph", "wall_restitution", "", "not stated", "wall_distance"},
  }};
  return settings;
}

const PaperSetting* find_paper_setting(const std::string& method, const std::string& parameter) {
  const auto settings = paper_settings();
  const auto found = std::find_if(settings.begin(), settings.end(), [&](const PaperSetting& s) {
    return method == s.method && parameter == s.parameter;
  });
  return found == settings.end() ? nullptr : &*found;
}

Agreement compare_with_paper(const PaperSetting* setting, const nlohmann::json& value,
                             const nlohmann::json& stated) {
  if (setting == nullptr) return Agreement::unknown;
  if (!is_any_on(setting->acts_with, stated)) return Agreement::inert;
  if (std::string(setting->value).empty()) return Agreement::open;
  return nlohmann::json::parse(setting->value) == value ? Agreement::as_stated : Agreement::departs;
}

std::string agreement_text(Agreement agreement) {
  switch (agreement) {
    case Agreement::as_stated:
      return "as stated";
    case Agreement::departs:
      return "departs";
    case Agreement::open:
      return "left open";
    case Agreement::inert:
      return "does not act";
    case Agreement::unknown:
      return "not in the paper";
  }
  return "unknown";
}

}  // namespace surge::compare
