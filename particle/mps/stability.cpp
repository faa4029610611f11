#include "particle/mps/stability.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "particle/core/for_each_cell.hpp"
#include "particle/core/time_step.hpp"
#include "particle/mps/laplacian.hpp"

namespace surge::mps {
namespace {

/// Waves along each axis; by symmetry k_x >= k_y >= k_z >= 0 are all there are.
constexpr int waves_along_axis = 13;

template <int D>
double largest_eigenvalue(double re) {
  using Matrix = Eigen::Matrix<double, D, D>;
  using Vector = Eigen::Matrix<double, D, 1>;
  const int reach = static_cast<int>(std::ceil(re));
  std::array<int, D> lower;
  std::array<int, D> upper;
  std::array<int, D> waves;
  lower.fill(-reach);
  upper.fill(reach + 1);
  waves.fill(waves_along_axis);
  double largest = 0.0;
  for_each_cell<D>({}, waves, [&](const std::array<int, D>& k) {
    if (!std::is_sorted(k.rbegin(), k.rend())) return;
    Matrix sum = Matrix::Zero();
    for_each_cell<D>(lower, upper, [&](const std::array<int, D>& at) {
      Vector d;
      double phase = 0.0;
      for (int a = 0; a < D; ++a) {
        d[a] = at[a];
        phase += std::numbers::pi * k[a] / (waves_along_axis - 1) * at[a];
      }
      const double r = d.norm();
      if (r == 0.0 || r >= re) return;
      // f = w/r^2; the derivative of f(r) r is f 1 + f' r r^T/|r|.
      const double f = mps_weight(r, re) / (r * r);
      const double slope = -3.0 * re / (r * r * r * r) + 2.0 / (r * r * r);
      const Matrix j = -(f * Matrix::Identity() + slope / r * d * d.transpose());
      sum += (1.0 - std::cos(phase)) * j;
    });
    Eigen::SelfAdjointEigenSolver<Matrix> solver;
    solver.computeDirect(sum, Eigen::EigenvaluesOnly);
    largest = std::max(largest, solver.eigenvalues()[D - 1]);
  });
  return D / reference_number_density<D>(re) * largest;
}

double lattice_lambda(const Case& c, const Params& p) {
  return c.dimension == 2 ? laplacian_lambda<2>(Lambda::lattice, p.re_laplacian, c.spacing)
                          : laplacian_lambda<3>(Lambda::lattice, p.re_laplacian, c.spacing);
}

}  // namespace

StepLimits::StepLimits(const Case& c, const Params& params)
    : spacing_(c.spacing),
      maximum_(c.time.maximum_step),
      courant_(c.time.courant),
      nu_(c.kinematic_viscosity),
      numerical_viscosity_(params.numerical_viscosity * c.spacing),
      viscous_factor_(0.25 / (c.dimension + 2)),
      viscous_length_(std::sqrt(lattice_lambda(c, params))) {
  if (params.courant_factor == 0.0) return;
  courant_ *= params.courant_factor;
  if (params.collision_distance > 0.0)
    courant_ = std::min(courant_, 0.5 * params.collision_distance);
  if (params.shifting > 0.0)
    courant_ = std::min(
        courant_, shifting_limit(c.dimension, params.re_gradient) / (disorder * params.shifting));
  fall_ = 2.0 / std::numbers::pi * c.spacing;
  for (const double way : {1.0 - params.collision_distance, 0.5 - params.wall_distance})
    if (way > 0.0) fall_ = std::min(fall_, way * c.spacing);
}

double StepLimits::viscosity(double v_max) const {
  return std::max(nu_, numerical_viscosity_ * v_max);
}

double StepLimits::operator()(double v_max, double gravity) const {
  double dt = maximum_;
  if (v_max > 0.0) dt = std::min(dt, courant_ * spacing_ / v_max);
  dt = std::min(dt, viscous_step(viscous_factor_, viscous_length_, viscosity(v_max)));
  if (fall_ > 0.0 && gravity > 0.0) dt = std::min(dt, std::sqrt(fall_ / gravity));
  return dt;
}

double StepLimits::shifting_limit(int dimension, double re) {
  return 2.0 / (dimension == 2 ? largest_eigenvalue<2>(re) : largest_eigenvalue<3>(re));
}

}  // namespace surge::mps
