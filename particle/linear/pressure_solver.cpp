#include "particle/linear/pressure_solver.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include "particle/core/parallel_for.hpp"
#include "particle/linear/closed_regions.hpp"
#include "particle/linear/direct.hpp"
#include "particle/linear/grid_pcg.hpp"
#include "particle/linear/iccg.hpp"
#include "particle/linear/timer.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::linear {

namespace {

using Method = std::variant<Iccg, SparseCholesky, GridPcg>;

Method make_method(Solver solver) {
  switch (solver) {
    case Solver::iccg:
      return Method(std::in_place_type<Iccg>);
    case Solver::cholmod:
      return Method(std::in_place_type<SparseCholesky>);
    case Solver::multigrid:
      return Method(std::in_place_type<GridPcg>);
  }
  throw Error("ppe_solver: unknown solver");
}

SolveReport run(Iccg& method, const PoissonSystem& system, const Field&, Field& p,
                const Params& params) {
  return method.solve(system, p, params.tolerance, params.max_iterations);
}

SolveReport run(SparseCholesky& method, const PoissonSystem& system, const Field&, Field& p,
                const Params&) {
  SolveReport report;
  Timer setup(report.setup_s);
  method.factorise(system);
  setup.stop();
  Timer solve(report.solve_s);
  method.solve(system.rhs, p);
  return report;
}

SolveReport run(GridPcg& method, const PoissonSystem& system, const Field& excess, Field& p,
                const Params& params) {
  return method.solve(system, excess, p, params.radius * system.spacing, params.tolerance,
                      params.max_iterations);
}

void check(const PoissonSystem& system) {
  const auto n = static_cast<std::ptrdiff_t>(system.size());
  const std::ptrdiff_t first = parallel_reduce(
      n, worth_sharing, n,
      [&](std::ptrdiff_t i, std::ptrdiff_t& least) {
        if (!std::isfinite(system.rhs[i]) || !std::isfinite(system.diagonal[i]))
          least = std::min(least, i);
      },
      [](std::ptrdiff_t& all, std::ptrdiff_t own) { all = std::min(all, own); });
  if (first == n) return;
  throw Error("pressure: equation " + std::to_string(first) +
              " is not finite: particles coincide or flew off; a smaller step may help");
}

bool is_zero(const Field& field) {
  for (const double value : field) {
    if (value != 0.0) return false;
  }
  return true;
}

}  // namespace

struct PressureSolver::State {
  explicit State(const Params& p) : params(p), method(make_method(p.solver)) {}

  Params params;
  Method method;
  Field excess;
  ClosedRegions closed;
  BlockSum block_sum;
  PoissonSystem anchored;  // a copy, made only where there are closed regions
};

PressureSolver::PressureSolver(const Params& params) {
  if (!(params.tolerance > 0.0 && params.tolerance < 1.0)) {
    throw Error("ppe_tolerance: found " + number_text(params.tolerance) +
                ", expected a number between 0 and 1");
  }
  if (params.max_iterations < 1) {
    throw Error("ppe_max_iterations: found " + std::to_string(params.max_iterations) +
                ", expected a positive number");
  }
  state_ = std::make_unique<State>(params);
}
PressureSolver::~PressureSolver() = default;
PressureSolver::PressureSolver(PressureSolver&&) noexcept = default;
PressureSolver& PressureSolver::operator=(PressureSolver&&) noexcept = default;

SolveReport PressureSolver::solve(const PoissonSystem& system, Field& p) {
  check(system);
  if (p.size() != system.size()) p.assign(system.size(), 0.0);

  SolveReport report;
  double preparation_s = 0.0;
  Timer preparation(preparation_s);
  compute_excess(system, state_->excess);
  const std::vector<Region>& closed = state_->closed.find(system, state_->excess);
  const PoissonSystem* solvable = &system;
  if (!closed.empty()) {
    state_->anchored = system;
    anchor(closed, state_->anchored, state_->excess, p);
    solvable = &state_->anchored;
  }
  preparation.stop();

  if (is_zero(solvable->rhs)) {  // relative residuals have no meaning, and p = 0 is exact
    p.assign(system.size(), 0.0);
  } else {
    report = std::visit(
        [&](auto& method) { return run(method, *solvable, state_->excess, p, state_->params); },
        state_->method);
    report.residual = relative_residual(*solvable, p, state_->block_sum);
    if (!std::isfinite(report.residual)) throw Error("pressure: the solution is not finite");
    // The recursive residual of conjugate gradients and the true one part in the last digits.
    report.converged = report.residual <= 1.01 * state_->params.tolerance;
  }
  lift(closed, p);
  report.setup_s += preparation_s;
  report.closed_regions = static_cast<int>(closed.size());
  return report;
}

}  // namespace surge::linear
