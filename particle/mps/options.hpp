#pragma once

#include <array>
#include <concepts>
#include <type_traits>

#include "particle/mps/params.hpp"
#include "particle/support/enum_names.hpp"

namespace surge {

template <>
inline constexpr std::array enum_names<mps::Lambda>{Named{"paper", mps::Lambda::paper},
                                                    Named{"analytic", mps::Lambda::analytic},
                                                    Named{"lattice", mps::Lambda::lattice}};
template <>
inline constexpr std::array enum_names<mps::PpeSolver>{
    Named{"iccg", mps::PpeSolver::iccg}, Named{"cholmod", mps::PpeSolver::cholmod},
    Named{"multigrid", mps::PpeSolver::multigrid}};
template <>
inline constexpr std::array enum_names<mps::NegativePressure>{
    Named{"keep", mps::NegativePressure::keep}, Named{"clip", mps::NegativePressure::clip}};
template <>
inline constexpr std::array enum_names<mps::Source>{
    Named{"number_density", mps::Source::number_density},
    Named{"divergence_and_density", mps::Source::divergence_and_density}};
template <>
inline constexpr std::array enum_names<mps::GradientModel>{
    Named{"minimum", mps::GradientModel::minimum},
    Named{"conserving", mps::GradientModel::conserving},
    Named{"corrected", mps::GradientModel::corrected}};
template <>
inline constexpr std::array enum_names<mps::LaplacianOf>{
    Named{"pressure", mps::LaplacianOf::pressure},
    Named{"dynamic_pressure", mps::LaplacianOf::dynamic_pressure}};
template <>
inline constexpr std::array enum_names<mps::SurfaceAt>{
    Named{"centre", mps::SurfaceAt::centre}, Named{"half_spacing", mps::SurfaceAt::half_spacing}};
template <>
inline constexpr std::array enum_names<mps::WallCoupling>{Named{"all", mps::WallCoupling::all},
                                                          Named{"fluid", mps::WallCoupling::fluid}};
template <>
inline constexpr std::array enum_names<mps::ViscousTerm>{
    Named{"laplacian", mps::ViscousTerm::laplacian},
    Named{"deformation", mps::ViscousTerm::deformation}};
template <>
inline constexpr std::array enum_names<mps::PositionUpdate>{
    Named{"new_velocity", mps::PositionUpdate::new_velocity},
    Named{"mean_velocity", mps::PositionUpdate::mean_velocity}};

namespace mps {

// A new option is one line here; a new enumeration needs its names as well.
/// Calls `option(name, member, bounds, description)` for each option of the MPS method.
template <class P, class Visitor>
requires std::same_as<std::remove_const_t<P>, Params>
void visit_options(P& p, Visitor&& option) {
  constexpr Bounds any;
  option(
      "courant_factor", p.courant_factor, Bounds::closed(0.0, 10.0),
      "steps are longer than time.courant says by this factor, where collisions, shifting and free "
      "fall allow it; 0: Eq. (25) as it stands");
  option("re_gradient", p.re_gradient, Bounds::above_to(1.0, 20.0),
         "radius of number density, gradient and free surface, in l0");
  option("re_laplacian", p.re_laplacian, Bounds::above_to(1.0, 20.0),
         "radius of the Laplacian, in l0");
  option("lambda", p.lambda, any, "lambda of the Laplacian, Eqs. (7) and (8)");
  option("beta", p.beta, Bounds::open(0.0, 1.0), "free surface where n < beta n0, Eq. (14)");
  option("surface_offset", p.surface_offset, Bounds::at_least(0.0),
         "and neighbours lie to one side by more than this; 0: Eq. (14) alone");
  option("source", p.source, any,
         "source of the pressure equation; divergence_and_density is Tanaka & Masunaga (2010)");
  option("density_share", p.density_share, Bounds::closed(0.0, 1.0),
         "gamma, the share of the density error in divergence_and_density");
  option(
      "divergence_time", p.divergence_time, Bounds::at_least(0.0),
      "time to take back the divergence that earlier steps left, in l0 over the reference speed; "
      "0: a step");
  option("laplacian_of", p.laplacian_of, any,
         "dynamic_pressure leaves the hydrostatic part out of the pressure equation");
  option("surface_at", p.surface_at, any,
         "p = 0 in the centres of the surface particles, or half a spacing outside");
  option("wall_coupling", p.wall_coupling, any,
         "neighbours in the pressure equation of walls: all, or the fluid alone");
  option("shifting", p.shifting, Bounds::at_least(0.0),
         "particle shifting, in l0 per path l0 of the fastest particle; 0: off");
  option("numerical_viscosity", p.numerical_viscosity, Bounds::at_least(0.0),
         "kinematic viscosity is no less than this times l0 and the speed of the fastest particle");
  option("gradient", p.gradient, any,
         "pressure gradient: conserving is Khayyer & Gotoh (2008), corrected (2011)");
  option("viscous_term", p.viscous_term, any,
         "laplacian of the velocity, Eq. (7), or divergence of its rate of deformation");
  option("source_relaxation", p.source_relaxation, Bounds::above_to(0.0, 1.0),
         "factor on the source of the pressure equation, Eq. (12)");
  option("negative_pressure", p.negative_pressure, any, "what becomes of negative pressures");
  option("position_update", p.position_update, any,
         "particles move with the new velocity, or with the mean of old and new");
  option("ppe_solver", p.ppe_solver, any, "solver of the pressure equation");
  option("ppe_tolerance", p.ppe_tolerance, Bounds::closed(1e-14, 0.5),  // less is rounding
         "relative residual at which the pressure solver stops");
  option("ppe_max_iterations", p.ppe_max_iterations, Bounds::closed(1, 1e9),
         "iterations after which the pressure solver gives up");
  option("collision_distance", p.collision_distance, Bounds::closed(0.0, 1.0),
         "approaching particles nearer than this collide, in l0");
  option("collision_speed", p.collision_speed, Bounds::closed(0.0, 1.0),
         "if they approach by more than this, over the speed of the fastest particle");
  option("collision_restitution", p.collision_restitution, Bounds::closed(0.0, 1.0),
         "relative normal speed after a collision over that before");
  option("wall_distance", p.wall_distance, Bounds::closed(0.0, 0.5),
         "no particle comes nearer to a wall, in l0");
}

}  // namespace mps
}  // namespace surge
