#pragma once

#include <memory>

#include "particle/linear/pressure_solver.hpp"

namespace surge::linear {

/// Supernodal sparse Cholesky of SuiteSparse's CHOLMOD.
/// Y. Chen, T. A. Davis, W. W. Hager & S. Rajamanickam, ACM TOMS 35 (2008) 22.
/// The symbolic factorisation is kept as long as the graph of the matrix does not change.
class SparseCholesky {
 public:
  SparseCholesky();
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;

  /// Throws Error where the matrix is not positive definite or memory runs out.
  void factorise(const PoissonSystem& system);
  /// x = A^-1 b of the matrix factorised last; b has its size.
  void solve(const Field& b, Field& x);
  /// How often the graph was analysed.
  [[nodiscard]] int analyses() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace surge::linear
