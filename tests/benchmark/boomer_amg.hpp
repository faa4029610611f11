#pragma once

#include <memory>

#include "particle/linear/poisson_system.hpp"

namespace surge::benchmarks {

/// Conjugate gradients with the algebraic multigrid of a library, hypre's BoomerAMG (Henson & Yang
/// 2002, Appl. Numer. Math. 41), as a yardstick for our own. Classical coarsening by HMIS, extended
/// interpolation with four entries a row, one symmetric Gauss-Seidel sweep: what hypre's manual
/// advises for such equations. One thread.
class BoomerAmg {
 public:
  /// Copies the equations into the library's matrix.
  explicit BoomerAmg(const linear::PoissonSystem& system);
  ~BoomerAmg();
  BoomerAmg(const BoomerAmg&) = delete;
  BoomerAmg& operator=(const BoomerAmg&) = delete;

  struct Report {
    int iterations = 0;
    double residual = 0.0;  ///< ||b - A p|| / ||b||, by our own product
  };
  /// From a zero guess to the relative residual `tolerance`, setup included.
  Report solve(double tolerance);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace surge::benchmarks
