#include "particle/linear/direct.hpp"

#include <cblas.h>
#include <omp.h>

#include <Eigen/CholmodSupport>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "particle/support/error.hpp"

namespace surge::linear {

namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// Whether both have entries at the same places.
bool same_graph(const Matrix& a, const Matrix& b) {
  return a.rows() == b.rows() && a.nonZeros() == b.nonZeros() &&
         std::equal(a.outerIndexPtr(), a.outerIndexPtr() + a.outerSize() + 1, b.outerIndexPtr()) &&
         std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), b.innerIndexPtr());
}

}  // namespace

struct SparseCholesky::State {
  Eigen::CholmodSupernodalLLT<Matrix, Eigen::Lower> solver;
  std::vector<Eigen::Triplet<double, int>> entries;
  Matrix matrix;    ///< lower triangle
  Matrix analysed;  ///< whose graph the symbolic factorisation belongs to
  int analyses = 0;

  State() { solver.cholmod().print = 0; }

  void fill(const PoissonSystem& system);
  void check(const char* what);
};

void SparseCholesky::State::fill(const PoissonSystem& system) {
  const auto n = static_cast<int>(system.size());
  entries.clear();
  double below = 0.0, above = 0.0;  // sums of the two triangles
  for (int i = 0; i < n; ++i) {
    const auto row = static_cast<std::size_t>(i);
    entries.emplace_back(i, i, system.diagonal[row]);
    for (auto k = static_cast<std::size_t>(system.row_start[row]);
         k < static_cast<std::size_t>(system.row_start[row + 1]); ++k) {
      const auto value = static_cast<double>(system.value[k]);
      if (system.column[k] < i) entries.emplace_back(i, system.column[k], value);
      (system.column[k] < i ? below : above) += value;
    }
  }
  // A pair at the very end of its reach may stand in one triangle only, with no weight to speak of.
  if (std::abs(below - above) > 1e-4 * (std::abs(below) + std::abs(above)))
    throw Error("pressure: the matrix is not symmetric");
  matrix.resize(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
}

void SparseCholesky::State::check(const char* what) {
  const int status = solver.cholmod().status;
  if (status == CHOLMOD_NOT_POSDEF || (status == CHOLMOD_OK && solver.info() != Eigen::Success)) {
    throw Error(std::string("pressure: ") + what +
                ": the equations are not positive definite, as far as rounding can tell");
  }
  if (status < CHOLMOD_OK) {
    throw Error(std::string("pressure: ") + what + ": CHOLMOD failed with status " +
                std::to_string(status) +
                (status == CHOLMOD_OUT_OF_MEMORY || status == CHOLMOD_TOO_LARGE
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
  if (s.analyses == 0 || !same_graph(s.matrix, s.analysed)) {
    s.solver.analyzePattern(s.matrix);
    s.check("analysis");
    s.analysed = s.matrix;
    ++s.analyses;
  }
  s.solver.factorize(s.matrix);
  s.check("factorisation");
}

void SparseCholesky::solve(const Field& b, Field& x) {
  State& s = *state_;
  const auto n = static_cast<Eigen::Index>(b.size());
  x.resize(b.size());
  Eigen::Map<Eigen::VectorXd>(x.data(), n) =
      s.solver.solve(Eigen::Map<const Eigen::VectorXd>(b.data(), n));
  s.check("solution");
}

}  // namespace surge::linear
