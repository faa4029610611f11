#pragma once

#include "particle/io/computation.hpp"
#include "particle/isph/solver.hpp"
#include "particle/mps/solver.hpp"
#include "particle/sph/solver.hpp"

namespace surge::test {

namespace detail {
template <class S>
struct ParamsOf;
template <int D>
struct ParamsOf<isph::Solver<D>> {
  using type = isph::Params;
};
template <int D>
struct ParamsOf<mps::Solver<D>> {
  using type = mps::Params;
};
template <int D>
struct ParamsOf<sph::Solver<D>> {
  using type = sph::Params;
};
}  // namespace detail

/// The solver S itself, such as mps::Solver<2>, of a computation by its method.
template <class S>
S make_solver(const Computation& c) {
  return S(c.flow, c.params<typename detail::ParamsOf<S>::type>(), c.search);
}

}  // namespace surge::test
