#pragma once

#include <concepts>

#include "particle/core/clock.hpp"
#include "particle/core/particles.hpp"
#include "particle/core/step_report.hpp"

namespace surge {

/// What the run loop needs of a method: Solver<D>(const Case&, const Params&, Search).
template <class S>
concept ParticleSolver = requires(S& solver, const S& view, double dt_limit, Clock& clock) {
  /// Advances by one step, no longer than dt_limit (s).
  { solver.step(dt_limit) } -> std::same_as<StepReport>;
  /// The step that the method would take now (s), before dt_limit.
  { view.stable_step() } -> std::convertible_to<double>;
  { view.time() } -> std::convertible_to<double>;
  view.particles();
  { solver.clock() } -> std::same_as<Clock&>;
};

}  // namespace surge
