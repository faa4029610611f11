#pragma once

#include "particle/mps/view.hpp"

namespace surge::mps {

/// The viscous term nu lap v, or nu div 2D, by the models of particle/mps/laplacian.hpp. A no-slip
/// wall counts, a slip wall does not. The paper has no viscous term: its lambda does not enter.
template <int D>
class Viscosity {
 public:
  explicit Viscosity(ViscousTerm term) : term_(term) {}

  /// v += dt times the term, for the fluid; nu in m2/s. Neighbours of the step before will do, with
  /// whose speed nu was found, too: two neighbours' sums bound the eigenvalues, by which the
  /// solver's limit is half the stable step.
  void add(const View<D>& view, double nu, double dt, std::array<Field, D>& v);

 private:
  void extrapolate_to_walls(const View<D>& view);

  ViscousTerm term_;
  std::array<Field, D> shown_;  ///< m/s, what neighbours show to the term
};

}  // namespace surge::mps
