#include "particle/core/smallest_eigenvalue.hpp"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace surge {

template <>
double smallest_eigenvalue<2>(const std::array<double, 3>& entries) {
  const double mean = 0.5 * (entries[0] + entries[2]);
  const double half = 0.5 * (entries[0] - entries[2]);
  return mean - std::sqrt(half * half + entries[1] * entries[1]);
}

template <>
double smallest_eigenvalue<3>(const std::array<double, 6>& entries) {
  Eigen::Matrix3d matrix;
  std::size_t k = 0;
  for (int a = 0; a < 3; ++a)
    for (int b = a; b < 3; ++b) matrix(a, b) = matrix(b, a) = entries[k++];
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(matrix, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()(0);
}

}  // namespace surge
