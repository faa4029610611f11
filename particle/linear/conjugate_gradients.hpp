#pragma once

#include <cmath>

#include "particle/core/parallel_for.hpp"
#include "particle/linear/block_sum.hpp"
#include "particle/linear/pressure_solver.hpp"
#include "particle/linear/timer.hpp"
#include "particle/support/error.hpp"

namespace surge::linear {

/// Preconditioned conjugate gradients (Hestenes & Stiefel 1952, J. Res. Natl. Bur. Stand. 49) until
/// ||b - A p|| <= tolerance ||b||. Every sum has one order of its terms, whatever the number of
/// threads; the workspaces are kept from call to call.
class ConjugateGradients {
 public:
  /// `p` is the first guess and becomes the solution. prepare() sets the preconditioner up; it is
  /// left out where the guess is good enough. precondition(r, z) makes z from r and returns r . z.
  /// Throws Error where the system is not positive definite.
  template <class Prepare, class Precondition>
  SolveReport operator()(const PoissonSystem& system, Field& p, double tolerance,
                         int max_iterations, Prepare&& prepare, Precondition&& precondition);

 private:
  /// product_ = A x; returns x . A x.
  double multiply(const PoissonSystem& system, const Field& x);

  Field residual_;
  Field z_;
  Field direction_;
  Field product_;  ///< A times the guess, then A times the direction
  BlockSum block_sum_;
};

inline double ConjugateGradients::multiply(const PoissonSystem& system, const Field& x) {
  return block_sum_(x.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      product_[i] = row_product(system, x, i);
      sum += x[i] * product_[i];
    }
    return sum;
  });
}

// Each loop does all that can be done while its data are at hand.
template <class Prepare, class Precondition>
SolveReport ConjugateGradients::operator()(const PoissonSystem& system, Field& p, double tolerance,
                                           int max_iterations, Prepare&& prepare,
                                           Precondition&& precondition) {
  SolveReport report;
  const std::size_t n = system.size();
  for (Field* field : {&residual_, &z_, &direction_, &product_}) field->resize(n);

  Timer solve(report.solve_s);
  const double pb = dot(p, system.rhs, block_sum_);
  const double bb = dot(system.rhs, system.rhs, block_sum_);
  const double pap = multiply(system, p);
  // The multiple of the guess that is nearest to the solution in the energy norm: a pressure of the
  // step before may be far too large where the time step has changed.
  const double scale = pap > 0.0 ? pb / pap : 0.0;
  double rr = block_sum_(n, [&](std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      p[i] *= scale;
      residual_[i] = system.rhs[i] - scale * product_[i];
      sum += residual_[i] * residual_[i];
    }
    return sum;
  });
  const double limit = tolerance * tolerance * bb;
  solve.stop();
  if (rr <= limit) return report;

  Timer setup(report.setup_s);
  prepare();
  setup.stop();

  Timer iterate(report.solve_s);
  double rz = precondition(residual_, direction_);
  while (report.iterations < max_iterations) {
    const double curvature = multiply(system, direction_);
    if (!(curvature > 0.0)) {
      throw Error("pressure: the equations are not positive definite, as far as rounding can tell");
    }
    const double alpha = rz / curvature;
    rr = block_sum_(n, [&](std::size_t begin, std::size_t end) {
      double sum = 0.0;
      for (std::size_t i = begin; i < end; ++i) {
        p[i] += alpha * direction_[i];
        residual_[i] -= alpha * product_[i];
        sum += residual_[i] * residual_[i];
      }
      return sum;
    });
    ++report.iterations;
    if (rr <= limit) break;
    const double rz_before = rz;
    rz = precondition(residual_, z_);
    const double beta = rz / rz_before;
    const auto count = static_cast<std::int32_t>(n);
    parallel_for(count, worth_sharing, [&](std::int32_t i) {
      const auto at = static_cast<std::size_t>(i);
      direction_[at] = z_[at] + beta * direction_[at];
    });
  }
  return report;
}

}  // namespace surge::linear
