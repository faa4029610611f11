#pragma once

#include "particle/case/case.hpp"
#include "particle/mps/params.hpp"

namespace surge::mps {

/// What bounds the step of MPS. With courant_factor = 0, the paper's: Eq. (25) with the Courant
/// number of the case, and the limit of the explicit viscous term, 0.25/(d + 2) lambda/nu.
///
/// Otherwise the Courant number of the case times that factor, and no more than
/// - collisions: the fastest two particles that meet come nearer by 2 Cr l0 in a step. Of those
/// that
///   do not collide yet none may be past the other after it: 2 Cr <= collision_distance;
/// - shifting: a displacement u of the lattice becomes (1 - A Cr L) u in a step, A being `shifting`
///   and L the largest eigenvalue of l0^2 d/n0 sum J (1 - cos k.r), J = -d/dr (r w/r^2), over waves
///   k. It grows, changing its sign, for A Cr L > 2;
/// - surface waves: with s = (omega dt)^2 the step
///     y* = y + dt w,  w' = w - dt omega^2 y*,  y' = y + dt (w + w')/2
///   has the trace 2 - 3s/2 and the determinant 1 - s/2 and is stable for s <= 2, where the
///   shortest wave has omega^2 = pi g/l0: g dt^2 <= 2/pi l0;
/// - free fall: in a step water at rest falls by g dt^2 before its pressure takes that back. The
///   layer on the floor, l0 above the wall's particles and l0/2 above the wall, must not meet
///   either by that: g dt^2 <= min(1 - collision_distance, 1/2 - wall_distance) l0, where positive.
class StepLimits {
 public:
  StepLimits(const Case& c, const Params& params);

  /// s; v_max: the fastest particle, m/s; gravity: magnitude of the body force, m/s2
  [[nodiscard]] double operator()(double v_max, double gravity) const;
  /// The largest Courant number v_max dt/l0.
  [[nodiscard]] double courant() const { return courant_; }
  /// m2/s, numerical or not
  [[nodiscard]] double viscosity(double v_max) const;

  /// The largest stable A Cr of particle shifting on the lattice, re in l0.
  [[nodiscard]] static double shifting_limit(int dimension, double re);

 private:
  double spacing_;
  double maximum_;
  double courant_;
  double fall_ = 0.0;  ///< g dt^2 is no more than this, m; 0: no limit
  double nu_;
  double numerical_viscosity_;  ///< over v_max, m
  double viscous_factor_;
  double viscous_length_;  ///< m
};

/// Eigenvalues of sums over disordered neighbours are larger than those of the lattice by up to a
/// fifth: steps are chosen as if they were this much longer.
inline constexpr double disorder = 1.2;

}  // namespace surge::mps
