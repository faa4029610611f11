#include "particle/linear/direct.hpp"

#include <cblas.h>
#include <cholmod.h>
#include <omp.h>

#include <algorithm>
#include <string>

#include "particle/support/error.hpp"

namespace surge::linear {

struct SparseCholesky::State {
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  cholmod_dense* y = nullptr;  // workspaces that cholmod_solve2 keeps
  cholmod_dense* e = nullptr;
  cholmod_dense* result = nullptr;
  AlignedVector<int> start;  // lower triangle by columns, diagonal first
  AlignedVector<int> row;
  Field value;
  AlignedVector<int> analysed_start;  // the graph that `factor` belongs to
  AlignedVector<int> analysed_row;
  int analyses = 0;

  State() {
    cholmod_start(&common);
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.print = 0;
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    cholmod_free_dense(&y, &common);
    cholmod_free_dense(&e, &common);
    cholmod_free_dense(&result, &common);
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }

  void fill(const PoissonSystem& system);
  cholmod_sparse view();
  void check(const char* what) const;
};

// A is symmetric, so a row of it is a column; CHOLMOD reads one triangle only.
void SparseCholesky::State::fill(const PoissonSystem& system) {
  const std::size_t n = system.size();
  start.resize(n + 1);
  row.resize(system.column.size() / 2 + n);
  value.resize(row.size());
  std::size_t at = 0;
  for (std::size_t i = 0; i < n; ++i) {
    start[i] = static_cast<int>(at);
    row[at] = static_cast<int>(i);
    value[at++] = system.diagonal[i];
    for (auto k = static_cast<std::size_t>(system.row_start[i]);
         k < static_cast<std::size_t>(system.row_start[i + 1]); ++k) {
      if (system.column[k] <= static_cast<int>(i)) continue;
      if (at == row.size()) throw Error("pressure: the matrix is not symmetric");
      row[at] = system.column[k];
      value[at++] = static_cast<double>(system.value[k]);
    }
  }
  start[n] = static_cast<int>(at);
  row.resize(at);
  value.resize(at);
}

cholmod_sparse SparseCholesky::State::view() {
  cholmod_sparse matrix{};
  matrix.nrow = start.size() - 1;
  matrix.ncol = matrix.nrow;
  matrix.nzmax = row.size();
  matrix.p = start.data();
  matrix.i = row.data();
  matrix.x = value.data();
  matrix.stype = -1;
  matrix.itype = CHOLMOD_INT;
  matrix.xtype = CHOLMOD_REAL;
  matrix.dtype = CHOLMOD_DOUBLE;
  matrix.sorted = 0;
  matrix.packed = 1;
  return matrix;
}

void SparseCholesky::State::check(const char* what) const {
  if (common.status == CHOLMOD_NOT_POSDEF) {
    throw Error(std::string("pressure: ") + what +
                ": the equations are not positive definite, as far as rounding can tell");
  }
  if (common.status < CHOLMOD_OK) {
    throw Error(std::string("pressure: ") + what + ": CHOLMOD failed with status " +
                std::to_string(common.status) +
                (common.status == CHOLMOD_OUT_OF_MEMORY || common.status == CHOLMOD_TOO_LARGE
                     ? " (too large for memory: choose another ppe_solver)"
                     : ""));
  }
}

SparseCholesky::SparseCholesky() : state_(std::make_unique<State>()) {}
SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

int SparseCholesky::analyses() const {
  return state_->analyses;
}

void SparseCholesky::factorise(const PoissonSystem& system) {
  State& s = *state_;
  openblas_set_num_threads(omp_get_max_threads());
  s.fill(system);
  cholmod_sparse matrix = s.view();
  if (s.factor == nullptr || s.start != s.analysed_start || s.row != s.analysed_row) {
    cholmod_free_factor(&s.factor, &s.common);
    s.factor = cholmod_analyze(&matrix, &s.common);
    s.check("analysis");
    s.analysed_start = s.start;
    s.analysed_row = s.row;
    ++s.analyses;
  }
  cholmod_factorize(&matrix, s.factor, &s.common);
  s.check("factorisation");
}

void SparseCholesky::solve(const Field& b, Field& x) {
  State& s = *state_;
  cholmod_dense rhs{};
  rhs.nrow = b.size();
  rhs.ncol = 1;
  rhs.nzmax = b.size();
  rhs.d = b.size();
  rhs.x = const_cast<double*>(b.data());  // CHOLMOD only reads it
  rhs.xtype = CHOLMOD_REAL;
  rhs.dtype = CHOLMOD_DOUBLE;
  cholmod_solve2(CHOLMOD_A, s.factor, &rhs, nullptr, &s.result, nullptr, &s.y, &s.e, &s.common);
  s.check("solution");
  const double* result = static_cast<const double*>(s.result->x);
  x.assign(result, result + b.size());
}

}  // namespace surge::linear
