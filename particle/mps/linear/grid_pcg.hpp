#pragma once

#include "particle/mps/linear/block_sum.hpp"
#include "particle/mps/linear/grid_preconditioner.hpp"
#include "particle/mps/pressure_solver.hpp"

namespace surge::mps {

/// Conjugate gradients with the GridPreconditioner: the number of iterations hardly depends on the
/// number of particles, and an iteration costs little more than the product with A.
class GridPcg {
 public:
  /// `excess`: compute_excess(system). `re`: radius of the neighbourhood, m.
  SolveReport solve(const PoissonSystem& system, const Field& excess, Field& p, double re,
                    double tolerance, int max_iterations);

 private:
  template <class Preconditioner>
  SolveReport run(Preconditioner& preconditioner, const PoissonSystem& system, const Field& excess,
                  Field& p, double re, double tolerance, int max_iterations);

  GridPreconditioner<2> plane_;
  GridPreconditioner<3> space_;
  Field residual_;
  Field z_;
  Field direction_;
  Field product_;
  BlockSum block_sum_;
};

}  // namespace surge::mps
