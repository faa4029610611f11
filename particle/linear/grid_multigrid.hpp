#pragma once

#include <vector>

#include "particle/linear/grid_level.hpp"

namespace surge::linear {

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
  Field factor_;  // dense Cholesky factor of the coarsest level, row by row
  Field coarsest_solution_;
};

}  // namespace surge::linear
