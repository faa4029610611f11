#pragma once

#include <array>
#include <concepts>
#include <type_traits>

#include "particle/isph/params.hpp"
#include "particle/support/enum_names.hpp"

namespace surge {

template <>
inline constexpr std::array enum_names<isph::Kernel>{
    Named{"wendland_c2", isph::Kernel::wendland_c2},
    Named{"quintic_spline", isph::Kernel::quintic_spline}};
template <>
inline constexpr std::array enum_names<isph::SurfaceAt>{
    Named{"centre", isph::SurfaceAt::centre}, Named{"half_spacing", isph::SurfaceAt::half_spacing}};

namespace isph {

/// Calls `option(name, member, bounds, description)` for each option of the ISPH method.
template <class P, class Visitor>
requires std::same_as<std::remove_const_t<P>, Params>
void visit_options(P& p, Visitor&& option) {
  constexpr Bounds any;
  option("kernel", p.kernel, any, "kernel");
  option("h_over_l0", p.h_over_l0, Bounds::closed(0.7, 4.0), "smoothing length, in l0");
  option("surface_lambda", p.surface_lambda, Bounds::open(0.0, 1.0),
         "free surface where the smallest eigenvalue of the moments of the particles around is "
         "below this");
  option("surface_at", p.surface_at, any,
         "p = 0 in the centres of the surface particles, or half a spacing outside");
  option("divergence_time", p.divergence_time, Bounds::at_least(0.0),
         "time to take back the divergence that earlier steps left, in l0 over the reference "
         "speed; 0: a step");
  option("shifting", p.shifting, Bounds::at_least(0.0),
         "particle shifting, in h per path h of the fastest particle; 0: off");
  option("numerical_viscosity", p.numerical_viscosity, Bounds::at_least(0.0),
         "kinematic viscosity is no less than this times l0 and the speed of the fastest particle");
  option("ppe_solver", p.ppe_solver, any, "solver of the pressure equation");
  option("ppe_tolerance", p.ppe_tolerance, Bounds::closed(1e-14, 0.5),  // less is rounding
         "relative residual at which the pressure solver stops");
  option("ppe_max_iterations", p.ppe_max_iterations, Bounds::closed(1, 1e9),
         "iterations after which the pressure solver gives up");
  option("wall_distance", p.wall_distance, Bounds::closed(0.0, 0.5),
         "no particle comes nearer to a wall, in l0");
  option("wall_restitution", p.wall_restitution, Bounds::closed(0.0, 1.0),
         "normal speed after meeting a wall over that before");
}

}  // namespace isph
}  // namespace surge
