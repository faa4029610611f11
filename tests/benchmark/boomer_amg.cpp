#include "tests/benchmark/boomer_amg.hpp"

#include <HYPRE.h>
#include <HYPRE_IJ_mv.h>
#include <HYPRE_krylov.h>
#include <HYPRE_parcsr_ls.h>
#include <mpi.h>

#include <numeric>
#include <vector>

namespace surge::benchmarks {
namespace {

/// The library lives from the first use to the end of the program.
struct Library {
  Library() {
    MPI_Init(nullptr, nullptr);
    HYPRE_Init();
  }
  ~Library() {
    HYPRE_Finalize();
    MPI_Finalize();
  }
};

}  // namespace

struct BoomerAmg::State {
  explicit State(const linear::PoissonSystem& s) : system(s) {}

  const linear::PoissonSystem& system;
  std::vector<HYPRE_BigInt> rows;
  HYPRE_IJMatrix matrix = nullptr;
  HYPRE_IJVector rhs = nullptr;
  HYPRE_IJVector solution = nullptr;
};

BoomerAmg::BoomerAmg(const linear::PoissonSystem& system)
    : state_(std::make_unique<State>(system)) {
  static const Library library;
  State& s = *state_;
  const auto n = static_cast<HYPRE_BigInt>(system.size());
  s.rows.resize(system.size());
  std::iota(s.rows.begin(), s.rows.end(), HYPRE_BigInt{0});
  HYPRE_IJMatrixCreate(MPI_COMM_SELF, 0, n - 1, 0, n - 1, &s.matrix);
  HYPRE_IJMatrixSetObjectType(s.matrix, HYPRE_PARCSR);
  HYPRE_IJMatrixInitialize(s.matrix);
  std::vector<HYPRE_BigInt> columns;
  std::vector<double> values;
  for (HYPRE_BigInt i = 0; i < n; ++i) {
    const auto row = static_cast<std::size_t>(i);
    columns.assign(1, i);
    values.assign(1, system.diagonal[row]);
    const auto end = static_cast<std::size_t>(system.row_start[row + 1]);
    for (auto k = static_cast<std::size_t>(system.row_start[row]); k < end; ++k) {
      columns.push_back(system.column[k]);
      values.push_back(static_cast<double>(system.value[k]));
    }
    auto entries = static_cast<HYPRE_Int>(columns.size());
    HYPRE_IJMatrixSetValues(s.matrix, 1, &entries, &i, columns.data(), values.data());
  }
  HYPRE_IJMatrixAssemble(s.matrix);
  for (HYPRE_IJVector* vector : {&s.rhs, &s.solution}) {
    HYPRE_IJVectorCreate(MPI_COMM_SELF, 0, n - 1, vector);
    HYPRE_IJVectorSetObjectType(*vector, HYPRE_PARCSR);
    HYPRE_IJVectorInitialize(*vector);
  }
  HYPRE_IJVectorSetValues(s.rhs, static_cast<HYPRE_Int>(n), s.rows.data(), system.rhs.data());
  HYPRE_IJVectorAssemble(s.rhs);
  HYPRE_IJVectorAssemble(s.solution);
}

BoomerAmg::~BoomerAmg() {
  HYPRE_IJMatrixDestroy(state_->matrix);
  HYPRE_IJVectorDestroy(state_->rhs);
  HYPRE_IJVectorDestroy(state_->solution);
}

BoomerAmg::Report BoomerAmg::solve(double tolerance) {
  State& s = *state_;
  void* matrix = nullptr;
  void* rhs = nullptr;
  void* solution = nullptr;
  HYPRE_IJMatrixGetObject(s.matrix, &matrix);
  HYPRE_IJVectorGetObject(s.rhs, &rhs);
  HYPRE_IJVectorGetObject(s.solution, &solution);
  auto* const a = static_cast<HYPRE_ParCSRMatrix>(matrix);
  auto* const b = static_cast<HYPRE_ParVector>(rhs);
  auto* const x = static_cast<HYPRE_ParVector>(solution);
  HYPRE_ParVectorSetConstantValues(x, 0.0);

  HYPRE_Solver amg = nullptr;
  HYPRE_BoomerAMGCreate(&amg);
  HYPRE_BoomerAMGSetCoarsenType(amg, 10);  // HMIS
  HYPRE_BoomerAMGSetInterpType(amg, 6);    // extended+i
  HYPRE_BoomerAMGSetPMaxElmts(amg, 4);
  HYPRE_BoomerAMGSetStrongThreshold(amg, s.system.dimension == 3 ? 0.5 : 0.25);
  HYPRE_BoomerAMGSetRelaxType(amg, 6);  // symmetric Gauss-Seidel
  HYPRE_BoomerAMGSetNumSweeps(amg, 1);
  HYPRE_BoomerAMGSetTol(amg, 0.0);
  HYPRE_BoomerAMGSetMaxIter(amg, 1);
  HYPRE_Solver pcg = nullptr;
  HYPRE_ParCSRPCGCreate(MPI_COMM_SELF, &pcg);
  HYPRE_PCGSetTol(pcg, tolerance);
  HYPRE_PCGSetTwoNorm(pcg, 1);
  HYPRE_PCGSetMaxIter(pcg, 1000);
  HYPRE_PCGSetPrecond(pcg, reinterpret_cast<HYPRE_PtrToSolverFcn>(HYPRE_BoomerAMGSolve),
                      reinterpret_cast<HYPRE_PtrToSolverFcn>(HYPRE_BoomerAMGSetup), amg);
  HYPRE_ParCSRPCGSetup(pcg, a, b, x);
  HYPRE_ParCSRPCGSolve(pcg, a, b, x);

  Report report;
  HYPRE_Int iterations = 0;
  HYPRE_PCGGetNumIterations(pcg, &iterations);
  report.iterations = static_cast<int>(iterations);
  HYPRE_ParCSRPCGDestroy(pcg);
  HYPRE_BoomerAMGDestroy(amg);

  Field p(s.system.size());
  HYPRE_IJVectorGetValues(s.solution, static_cast<HYPRE_Int>(p.size()), s.rows.data(), p.data());
  linear::BlockSum block_sum;
  report.residual = relative_residual(s.system, p, block_sum);
  return report;
}

}  // namespace surge::benchmarks
