#pragma once

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include "particle/mps/pressure_solver.hpp"

namespace surge::mps {

/// Conjugate gradients preconditioned by incomplete Cholesky, as the paper has it; Eigen's.
/// J. A. Meijerink & H. A. van der Vorst, Math. Comput. 31 (1977) 148-162;
/// C.-J. Lin & J. J. More, SIAM J. Sci. Comput. 21 (1999) 24-45 (Eigen's form, no fill).
class Iccg {
 public:
  SolveReport solve(const PoissonSystem& system, Field& p, double tolerance, int max_iterations);

 private:
  using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;
  // Natural order: the unknowns come in cell order, which fills no worse than AMD here.
  using Preconditioner =
      Eigen::IncompleteCholesky<double, Eigen::Lower, Eigen::NaturalOrdering<int>>;

  void fill(const PoissonSystem& system);

  Matrix matrix_;
  Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper, Preconditioner> cg_;
};

}  // namespace surge::mps
