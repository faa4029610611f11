#pragma once

#include <array>
#include <concepts>
#include <type_traits>

#include "particle/sph/params.hpp"
#include "particle/support/enum_names.hpp"

namespace surge {

template <>
inline constexpr std::array enum_names<sph::ViscousTerm>{
    Named{"laplacian", sph::ViscousTerm::laplacian},
    Named{"deformation", sph::ViscousTerm::deformation}};
template <>
inline constexpr std::array enum_names<sph::Kernel>{
    Named{"quintic_spline", sph::Kernel::quintic_spline},
    Named{"wendland_c2", sph::Kernel::wendland_c2}};
template <>
inline constexpr std::array enum_names<sph::NegativePressure>{
    Named{"keep", sph::NegativePressure::keep}, Named{"clip", sph::NegativePressure::clip},
    Named{"difference", sph::NegativePressure::difference}};
template <>
inline constexpr std::array enum_names<sph::Shifting>{
    Named{"none", sph::Shifting::none}, Named{"concentration", sph::Shifting::concentration}};
template <>
inline constexpr std::array enum_names<sph::DiffusionOf>{
    Named{"density", sph::DiffusionOf::density},
    Named{"dynamic_density", sph::DiffusionOf::dynamic_density}};
template <>
inline constexpr std::array enum_names<sph::WallDensity>{
    Named{"reference", sph::WallDensity::reference},
    Named{"continuity", sph::WallDensity::continuity},
    Named{"extrapolated", sph::WallDensity::extrapolated}};

namespace sph {

// A new option is one line here; a new enumeration needs its names as well.
/// Calls `option(name, member, bounds, description)` for each option of the SPH method.
template <class P, class Visitor>
requires std::same_as<std::remove_const_t<P>, Params>
void visit_options(P& p, Visitor&& option) {
  constexpr Bounds any;
  option("kernel", p.kernel, any,
         "kernel; the quintic spline, Eq. (18), reaches to 3h, Wendland's C2 to 2h");
  option("h_over_l0", p.h_over_l0, Bounds::closed(0.5, 5.0), "smoothing length h, in l0");
  option("sound_speed_ratio", p.sound_speed_ratio, Bounds::above(0.0),
         "speed of sound over the reference speed of the flow");
  option("gamma", p.gamma, Bounds::at_least(1.0), "exponent of the equation of state, Eq. (21)");
  option("xsph_epsilon", p.xsph_epsilon, Bounds::closed(0.0, 1.0), "XSPH factor, Eq. (24)");
  option("acoustic_courant", p.acoustic_courant, Bounds::at_least(0.0),
         "dt <= this h / (c0 + v_max); 0: only Eq. (25) limits the step");
  option("negative_pressure", p.negative_pressure, any,
         "what becomes of negative pressures; difference is Sun et al. (2018)");
  option("shifting", p.shifting, any,
         "moves particles to where there are fewer; concentration is Sun et al. (2017)");
  option(
      "survey_interval", p.survey_interval, Bounds::closed(0.0, 0.25),
      "surface and shift are found again after this h over the speed of the flow; 0: every step");
  option("viscous_term", p.viscous_term, any,
         "laplacian is Morris, Fox & Zhu (1997), deformation Monaghan & Gingold (1983)");
  option("artificial_viscosity", p.artificial_viscosity, Bounds::at_least(0.0),
         "alpha of Monaghan (1992); adds only what the fluid's own viscosity lacks of it");
  option("density_diffusion", p.density_diffusion, Bounds::at_least(0.0),
         "delta of the density diffusion, Molteni & Colagrossi (2009)");
  option("diffusion_of", p.diffusion_of, any,
         "what the diffusion acts on; dynamic_density is Fourtakas et al. (2019)");
  option("acoustic_damping", p.acoustic_damping, Bounds::at_least(0.0),
         "bulk viscosity over c0 h, which damps sound; Sun et al. (2023)");
  option("wall_density", p.wall_density, any, "how wall particles get density and pressure");
  option("wall_distance", p.wall_distance, Bounds::closed(0.0, 0.5),
         "no particle comes nearer to a wall, in l0");
  option("wall_restitution", p.wall_restitution, Bounds::closed(0.0, 1.0),
         "normal speed after a wall collision over that before");
}

}  // namespace sph
}  // namespace surge
