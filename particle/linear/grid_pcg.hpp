#pragma once

#include "particle/linear/conjugate_gradients.hpp"
#include "particle/linear/grid_preconditioner.hpp"

namespace surge::linear {

/// Conjugate gradients with the GridPreconditioner: the number of iterations hardly depends on the
/// number of particles, and an iteration costs little more than the product with A.
class GridPcg {
 public:
  /// `excess`: compute_excess(system). `re`: radius of the neighbourhood, m.
  SolveReport solve(const PoissonSystem& system, const Field& excess, Field& p, double re,
                    double tolerance, int max_iterations);

 private:
  GridPreconditioner<2> plane_;
  GridPreconditioner<3> space_;
  ConjugateGradients cg_;
};

}  // namespace surge::linear
