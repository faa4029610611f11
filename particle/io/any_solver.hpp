#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "particle/core/radial_function.hpp"
#include "particle/core/solver.hpp"
#include "particle/io/state_fields.hpp"

namespace surge {

/// A method's solver behind what a run needs of it, so that the run loop knows no method. One
/// virtual call per step.
template <int D>
class AnySolver {
 public:
  AnySolver() = default;
  AnySolver(const AnySolver&) = delete;
  AnySolver& operator=(const AnySolver&) = delete;
  virtual ~AnySolver() = default;

  virtual StepReport step(double dt_limit) = 0;
  [[nodiscard]] virtual double stable_step() const = 0;
  [[nodiscard]] virtual double time() const = 0;
  [[nodiscard]] virtual const Particles<D>& particles() const = 0;
  [[nodiscard]] virtual Clock& clock() = 0;
  /// All that the rest of the trajectory depends on, where it lies now.
  [[nodiscard]] virtual std::vector<StateField> state() const = 0;
  /// What it weighs neighbours with, for the method sheet.
  [[nodiscard]] virtual std::vector<RadialFunction> functions() const = 0;
  /// h, m, of methods that have one.
  [[nodiscard]] virtual std::optional<double> smoothing_length() const = 0;
};

/// The solver of a Method such as mps::Method.
template <class M, int D>
class WrappedSolver final : public AnySolver<D> {
 public:
  using Solver = typename M::template Solver<D>;
  static_assert(ParticleSolver<Solver>);

  template <class... Arguments>
  explicit WrappedSolver(Arguments&&... arguments)
      : solver_(std::forward<Arguments>(arguments)...) {}

  StepReport step(double dt_limit) override { return solver_.step(dt_limit); }
  [[nodiscard]] double stable_step() const override { return solver_.stable_step(); }
  [[nodiscard]] double time() const override { return solver_.time(); }
  [[nodiscard]] const Particles<D>& particles() const override { return solver_.particles(); }
  [[nodiscard]] Clock& clock() override { return solver_.clock(); }
  [[nodiscard]] std::vector<StateField> state() const override {
    return fields_of(solver_.state());
  }
  [[nodiscard]] std::vector<RadialFunction> functions() const override {
    return M::template functions<D>(solver_);
  }
  [[nodiscard]] std::optional<double> smoothing_length() const override {
    if constexpr (requires { solver_.smoothing_length(); }) return solver_.smoothing_length();
    return std::nullopt;
  }

 private:
  Solver solver_;
};

}  // namespace surge
