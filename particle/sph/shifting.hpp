#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "particle/core/particles.hpp"
#include "particle/core/projection.hpp"
#include "particle/sph/cluster_lists.hpp"

namespace surge::sph {

/// Concentration of the particles about i, weighted so that near neighbours count more, by which
/// Sun, Colagrossi, Marrone & Zhang (2017), Comput. Methods Appl. Mech. Eng. 315, shift particles:
///   G_i = sum_j [1 + R (W_ij / W(l0))^4] V_j grad_i W_ij,  R = 0.2,
/// here the factor of (x_i - x_j) V_j for one neighbour; slope = (dW/dr) / r. The fourth power
/// keeps particles from pairing (Monaghan 2000, J. Comput. Phys. 159).
template <class T>
T concentration_slope(T value, T slope, double value_at_spacing) {
  const T ratio = value * T(1.0 / value_at_spacing);
  const T square = ratio * ratio;
  return (T(1.0) + T(0.2) * square * square) * slope;
}

/// Velocity (m/s) at which a particle is shifted relative to the fluid (the same authors):
///   du = -2 h U G,
/// U being the reference speed of the flow, but no faster than `limit` (m/s).
template <std::size_t D>
std::array<double, D> shifting_velocity(const std::array<double, D>& concentration_gradient,
                                        double h, double speed, double limit) {
  std::array<double, D> shift;
  double square = 0.0;
  for (std::size_t a = 0; a < D; ++a) {
    shift[a] = -2.0 * h * speed * concentration_gradient[a];
    square += shift[a] * shift[a];
  }
  const double length = std::sqrt(square);
  if (length > limit)
    for (double& s : shift) s *= limit / length;
  return shift;
}

/// The part of a shift that leads out of the fluid taken off; `outward` is a normal of any length.
/// A surface particle has neighbours on one side only and would be shifted off it. What leads
/// inward stays, so that layers under a surface that is being stretched can still move into each
/// other.
template <std::size_t D>
std::array<double, D> along_surface(const std::array<double, D>& shift,
                                    const std::array<double, D>& outward) {
  double dot = 0.0;
  for (std::size_t a = 0; a < D; ++a) dot += shift[a] * outward[a];
  return dot > 0.0 ? without_part_along(shift, outward) : shift;
}

/// Speed (m/s) at which a fluid that deforms at the rate D, the symmetric part of the velocity
/// gradient (1/s), moves past a point, with the mean square distance r2 (m2) of what is about it:
///   sqrt(2 D:D r2 / d) in d dimensions.
/// For uniform shear this is the root mean square of the relative velocities; a rotation doesn't
/// count.
template <std::size_t N>
double deformation_speed(const std::array<std::array<double, N>, N>& velocity_gradient, double r2) {
  double sum = 0.0;
  for (std::size_t a = 0; a < N; ++a)
    for (std::size_t b = 0; b < N; ++b) {
      const double rate = 0.5 * (velocity_gradient[a][b] + velocity_gradient[b][a]);
      sum += 2.0 * rate * rate;
    }
  return std::sqrt(sum * r2 / static_cast<double>(N));
}

/// What lies about each fluid particle: whether the free surface is near, and where the particle
/// should be shifted to.
template <int D>
struct Survey {
  static constexpr double surface_lambda = 0.75;  ///< below it a particle counts as surface
  static constexpr double detached_lambda = 0.4;  ///< below it as spray, which isn't shifted

  std::array<Field, D> shift;  ///< velocity relative to the fluid, m/s
  Field lambda;                ///< see Surroundings; 1 for walls
  Field surface_share;         ///< sum of V W over the surface particles around
  Field density_rate;          ///< by the shift, kg/m3/s; zero near the surface

  [[nodiscard]] bool on_surface(std::size_t i) const { return lambda[i] < surface_lambda; }
  [[nodiscard]] bool is_detached(std::size_t i) const { return lambda[i] < detached_lambda; }
  /// Whether a particle or one within its kernel lies on the surface.
  [[nodiscard]] bool near_surface(std::size_t i) const {
    return on_surface(i) || surface_share[i] > 0.0;
  }

  /// As it is where nothing has been looked for: no surface, no shift.
  explicit Survey(std::size_t n = 0) : lambda(n, 1.0), surface_share(n, 0.0), density_rate(n, 0.0) {
    for (Field& field : shift) field.assign(n, 0.0);
  }

  /// All that goes with a particle.
  [[nodiscard]] std::array<Field*, D + 3> fields() {
    std::array<Field*, D + 3> all{};
    for (int a = 0; a < D; ++a) all[a] = &shift[a];
    all[D] = &lambda;
    all[D + 1] = &surface_share;
    all[D + 2] = &density_rate;
    return all;
  }

  /// Calls f(name, member) for all members. A new member that is left out here does not compile.
  template <class Self, class F>
  static void visit(Self& survey, F&& f) {
    auto& [velocity, eigenvalue, share, rate] = survey;
    f("shift", velocity);
    f("lambda", eigenvalue);
    f("surface_share", share);
    f("density_rate", rate);
  }
};

/// Makes surveys.
///
/// The free surface is known by the smallest eigenvalue lambda of
///   M_i = sum_j V_j (x_j - x_i) (x) grad_i W_ij,
/// which is 1 inside the fluid, about 1/2 on a flat surface and 0 for a particle alone; the normal
/// by its gradient (Marrone et al. 2010, J. Comput. Phys. 229; Sun et al. 2017).
///
/// A survey may serve several steps. Shifting evens out the concentration like diffusion, du = -2 h
/// U G; explicitly this is stable on the square lattice (Wendland C2, h = 1.5 l0) while a survey
/// serves for no longer than 0.2546 h/U, 2 over the largest eigenvalue of 2 h U sum_j V d(push
/// x)/dx (1 - cos k.x).
template <int D>
class Surroundings {
 public:
  /// h: smoothing length, spacing: l0, both m; speed: reference speed U of the flow, m/s
  Surroundings(double h, double spacing, double speed) : h_(h), spacing_(spacing), speed_(speed) {}

  /// Shift and surface of the particles in the grid's order; the rate of density is left alone.
  /// fluid_volume: m3, 0 for walls; speed_limit: m/s, no shift is faster. A shift isn't faster
  /// either than deformation_speed() of the neighbours: what moves as a whole isn't rearranged, at
  /// rest nothing is. (Sun, Colagrossi, Marrone, Antuono & Zhang 2019, Comput. Methods Appl. Mech.
  /// Eng. 348, take half of the largest relative velocity instead, which in uniform shear is 1.3
  /// times that. But it takes the jitter of single particles for motion, and what the shift jolts
  /// is shifted the more: still water stirs itself.) Inside the fluid, particles near a wall are
  /// shifted along it only. A wall does not give way to what is shifted: find_density_rate() would
  /// take a shift towards it for thinner fluid, whose pressure draws in more, and in a corner that
  /// runs away. Under a free surface the density does not follow, and layers that are drawn out
  /// along a wall, as in the tongue of a dam break, are filled up from above.
  template <class K>
  void survey(const K& kernel, ClusterLists<D>& lists, const Particles<D>& p,
              const Field& fluid_volume, double speed_limit, Survey<D>& found);

  /// Rate of change of density (kg/m3/s) by the shift found last. Sun et al. (2019), without the
  /// velocity of the fluid, which the continuity equation has:
  ///   D rho_i/Dt += sum_j V_j [rho_i du_i + rho_j du_j - rho_i (du_j - du_i)] . grad_i W_ij,
  /// du = 0 for walls. Walls have no part in the first two terms: nothing is carried through them.
  /// The last part is what the shift does to the particle's volume; the first, which changes sign
  /// between i and j, carries the density to where the particle goes. Together they leave a smooth
  /// density alone, but not a shift that on the whole draws the particles together or apart: that
  /// would change the volume of the fluid without its pressure ever knowing. Near the surface,
  /// where the kernel is cut off and the sums are one-sided, it is zero.
  template <class K>
  void find_density_rate(const K& kernel, ClusterLists<D>& lists, const Particles<D>& p,
                         Survey<D>& found);

 private:
  /// Entries of a symmetric matrix, row by row from the diagonal on.
  static constexpr int entries = D * (D + 1) / 2;

  template <class K>
  void sum_neighbours(const K& kernel, ClusterLists<D>& lists, const Particles<D>& p,
                      const Field& fluid_volume, Survey<D>& found);
  template <class K>
  void find_surface(const K& kernel, ClusterLists<D>& lists, const Particles<D>& p,
                    const Field& fluid_volume, Survey<D>& found);
  [[nodiscard]] Vec<D> shift_of(std::size_t i, double speed_limit, const Survey<D>& found) const;
  [[nodiscard]] double deformation_speed_of(std::size_t i) const;

  double h_;
  double spacing_;
  double speed_;
  Field volume_;                                 ///< of walls too
  std::array<Field, D> concentration_gradient_;  ///< G
  std::array<Field, entries> moment_;            ///< M
  std::array<Field, D> wall_normal_;             ///< sum of V grad W over walls, 1/m
  std::array<Field, entries> deformation_;  ///< twice the rate, of sum V (v_j - v_i) grad W, 1/s
  Field second_moment_;                     ///< sum of V W r^2 over fluid, m2
  Field weight_;                            ///< sum of V W over fluid, without the particle itself
  std::array<Field, D> inward_;             ///< gradient of lambda
};

}  // namespace surge::sph
