#pragma once

#include <array>
#include <vector>

namespace surge::compare {

// Flows with a known answer, as functions of what their case files say. SI units.

/// Semi-axes of a drop, over its radius at time zero.
struct DropAxes {
  double x = 1.0;
  double y = 1.0;
};

/// Stretching elliptical drop (Monaghan 1994, J. Comput. Phys. 110): a circle with the
/// velocity (-A x, A y) at time zero, A in 1/s, without gravity. It stays an ellipse with the
/// velocity (-sigma x, sigma y); p = 0 on its edge asks for
///   da/dt = -sigma a,  db/dt = sigma b,  dsigma/dt = sigma^2 (a^2 - b^2)/(a^2 + b^2),
/// which we integrate by the classical Runge-Kutta scheme. a b stays 1, and so does the kinetic
/// energy, sigma^2 (a^2 + b^2). t >= 0, s.
[[nodiscard]] DropAxes drop_axes(double rate, double t);

/// The same in three dimensions: a sphere of radius one with the velocity (A1 x, A2 y, A3 z) at
/// time zero, A1 + A2 + A3 = 0, in 1/s. It stays an ellipsoid of semi-axes a_i with the velocity
/// A_i x_i; p = P (1 - sum x_i^2/a_i^2) and the volume, which stays, ask for
///   da_i/dt = A_i a_i,  dA_i/dt + A_i^2 = 2 P/(rho a_i^2),  2 P/rho = sum A_i^2 / sum 1/a_i^2.
/// The kinetic energy, sum A_i^2 a_i^2, stays too. Returns a_1, a_2, a_3 at t >= 0, s.
[[nodiscard]] std::array<double, 3> ellipsoid_axes(const std::array<double, 3>& rates, double t);

/// Angular frequency (1/s) of a gravity wave of small amplitude with wave number k (1/m) on water
/// of depth h: omega^2 = g k tanh kh (Lamb 1932, Hydrodynamics, Art. 228).
[[nodiscard]] double wave_frequency(double g, double k, double depth);

/// Rate (1/s) at which viscosity damps its amplitude, 2 nu k^2 (Lamb 1932, Art. 348), without
/// friction at the walls. Holds at any depth then: the flow is potential flow, whose dissipation
/// 2 mu D:D is 8 nu k^2 times its kinetic energy.
[[nodiscard]] double wave_decay(double nu, double k);

/// Speed (m/s) in a channel of width H at the height y above one wall, at time t after the force f
/// (m/s2) was switched on (Morris, Fox & Zhu 1997, J. Comput. Phys. 136):
///   u = f/(2 nu) y (H - y) - sum_{m odd} 4 f H^2/(nu pi^3 m^3) sin(pi m y/H) exp(-m^2 pi^2 nu
///   t/H^2).
[[nodiscard]] double channel_speed(double force, double nu, double width, double y, double t);

/// A square of fluid of side L that rotates as a rigid body with omega, without walls (Colagrossi
/// 2005): how its polar moment of inertia I grows at first, c in I/I0 = 1 + c (omega t)^2 + ....
/// From d2/dt2 int r^2 = 2 int v^2 + 4/rho int p with the pressure of lap p = 2 rho omega^2, p = 0
/// on the edge, whose double sine series gives
///   int p = -2 rho omega^2 L^4 sum_{m,n odd} 64/(pi^6 m^2 n^2 (m^2 + n^2)).
/// c = 0.1565; particles that do not feel each other have c = 1.
[[nodiscard]] double patch_spreading();

/// y = amplitude exp(-decay t) sin(omega t + phase).
struct DampedWave {
  double omega = 0.0;  ///< 1/s
  double decay = 0.0;  ///< 1/s
  double amplitude = 0.0;
  double phase = 0.0;
};

/// Least squares fit to samples (t, y), starting the search at `omega` (1/s). Throws Error for
/// fewer than eight samples.
[[nodiscard]] DampedWave fit_damped_wave(const std::vector<double>& t, const std::vector<double>& y,
                                         double omega);

}  // namespace surge::compare
