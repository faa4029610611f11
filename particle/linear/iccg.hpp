#pragma once

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include "particle/linear/conjugate_gradients.hpp"

namespace surge::linear {

/// Conjugate gradients preconditioned by incomplete Cholesky, as the paper has it, with Eigen's
/// factorisation.
/// J. A. Meijerink & H. A. van der Vorst, Math. Comput. 31 (1977) 148-162;
/// C.-J. Lin & J. J. More, SIAM J. Sci. Comput. 21 (1999) 24-45 (Eigen's form, no fill).
class Iccg {
 public:
  /// Throws Error where the factorisation fails.
  SolveReport solve(const PoissonSystem& system, Field& p, double tolerance, int max_iterations);

 private:
  // In single precision, which is all that a preconditioner needs: it bounds neither the residual
  // nor, as measured, the iterations. Natural order: the unknowns come in cell order, which fills
  // no worse than AMD here.
  using Preconditioner =
      Eigen::IncompleteCholesky<float, Eigen::Lower, Eigen::NaturalOrdering<int>>;

  void factorise(const PoissonSystem& system);
  double apply(const Field& r, Field& z);

  Eigen::SparseMatrix<float, Eigen::ColMajor, int> lower_;
  Preconditioner factor_;
  Eigen::VectorXf single_r_;
  Eigen::VectorXf single_z_;
  ConjugateGradients cg_;
  BlockSum block_sum_;
};

}  // namespace surge::linear
