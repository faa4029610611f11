#pragma once

#include <Eigen/Cholesky>
#include <vector>

#include "particle/linear/grid_level.hpp"

namespace surge::linear {

/// Dense Cholesky factor of a matrix with positive diagonal that is positive definite but for
/// rounding: its diagonal is enlarged by as little as makes it so, since a preconditioner need not
/// be exact. Throws surge::Error for entries that are not finite, or where nothing helps.
void factorise_shifted(Eigen::MatrixXd matrix, Eigen::LLT<Eigen::MatrixXd>& factor);

/// A V-cycle on a hierarchy of nested grids with linear interpolation, Galerkin operators and one
/// coloured Gauss-Seidel sweep before and, in reverse, after: a symmetric positive definite
/// operation. Results do not depend on the number of threads.
/// W. L. Briggs, V. E. Henson & S. F. McCormick, A Multigrid Tutorial, 2nd ed., SIAM, 2000.
template <int D>
class GridMultigrid {
 public:
  /// The finest level, to be filled before build().
  GridLevel<D>& finest() { return levels_.front(); }
  void build();
  /// finest().solution becomes an approximation of the inverse times finest().rhs.
  void cycle();
  [[nodiscard]] int levels() const { return count_; }

 private:
  static bool coarsen(GridLevel<D>& fine, GridLevel<D>& coarse);
  static void galerkin(const GridLevel<D>& fine, GridLevel<D>& coarse);
  void factorise_coarsest();
  void solve_coarsest();

  std::vector<GridLevel<D>> levels_ = std::vector<GridLevel<D>>(1);
  int count_ = 1;
  Eigen::LLT<Eigen::MatrixXd> factor_;  ///< of the coarsest level
  Eigen::VectorXd coarsest_solution_;
};

}  // namespace surge::linear
