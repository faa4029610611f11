#pragma once

#include <memory>

#include "particle/linear/poisson_system.hpp"

namespace surge::linear {

enum class Solver {
  iccg,      ///< conjugate gradients with incomplete Cholesky (Eigen), the paper's
  cholmod,   ///< supernodal sparse Cholesky (SuiteSparse)
  multigrid  ///< conjugate gradients with a multigrid on a background grid
};

struct Params {
  Solver solver = Solver::multigrid;
  double tolerance = 1e-6;  ///< on ||b - A p|| / ||b||
  int max_iterations = 2000;
  double radius = 4.0;  ///< within which unknowns are coupled, in l0; for the multigrid's cells
};

/// What one solve did.
struct SolveReport {
  int iterations = 0;      ///< of conjugate gradients; 0 for the direct solver
  double residual = 0.0;   ///< ||b - A p|| / ||b|| reached, from the equations as solved
  double setup_s = 0.0;    ///< preconditioner or factorisation
  double solve_s = 0.0;    ///< the rest
  bool converged = true;   ///< residual <= tolerance
  int closed_regions = 0;  ///< connected sets of unknowns that touch no free surface
};

/// Solves the pressure Poisson equation with the solver that Params name, to
/// ||b - A p|| <= tolerance ||b||. Keeps its workspaces, and what it can of its preconditioner,
/// from call to call.
///
/// A connected region without any p = 0 (a closed tank) fixes its pressure only up to a constant
/// and has a solution only for a right side of zero mean: the mean is subtracted there, and the
/// lowest pressure of the region is set to zero. A solver that runs out of iterations says so in
/// the report.
class PressureSolver {
 public:
  /// Throws Error where the tolerance or the number of iterations is not positive.
  explicit PressureSolver(const Params& params);
  ~PressureSolver();
  PressureSolver(PressureSolver&&) noexcept;
  PressureSolver& operator=(PressureSolver&&) noexcept;

  /// `p` is the first guess (zero where its size does not match) and becomes the solution.
  /// Throws Error where the system is not positive definite or not finite.
  SolveReport solve(const PoissonSystem& system, Field& p);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace surge::linear
