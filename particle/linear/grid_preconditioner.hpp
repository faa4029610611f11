#pragma once

#include "particle/linear/block_sum.hpp"
#include "particle/linear/grid_multigrid.hpp"
#include "particle/linear/poisson_system.hpp"

namespace surge::linear {

/// Two-level additive preconditioner for the wide stencils of particle methods:
///
///   M^-1 = diag(A)^-1 + omega P C P^T,
///
/// P the (bi-, tri-)linear interpolation from a square grid that is fixed in space and about as
/// wide as the neighbourhood, C a V-cycle for the finite-element operator on that grid. The
/// particles' own stencil already couples everything within re, so that the diagonal smooths all
/// that the grid does not resolve; no product with A is needed.
///
/// The grid's operator is not P^T A P. A pair of particles contributes w_ij (p_i - p_j)^2 to the
/// energy of A; with p_i - p_j = (x_i - x_j) . grad p and neighbours on all sides this becomes
/// 1/2 kappa sum_j w_ij |grad p|^2 at x_i, kappa = PoissonSystem::mean_square. So the grid couples
/// nearest nodes only, and needs no pairs: the sum of w_ij is diagonal - excess. Neighbours with p
/// = 0 add excess_i p_i^2. Additive Schwarz with a coarse space: B. F. Smith, P. E. Bjorstad & W.
/// D. Gropp, Domain Decomposition, Cambridge, 1996. The combination is our own.
template <int D>
class GridPreconditioner {
 public:
  /// `excess`: compute_excess(system). `width`: of the grid cells, m.
  void setup(const PoissonSystem& system, const Field& excess, double width);
  /// z = M^-1 r; returns r . z. Results do not depend on the number of threads.
  double apply(const Field& r, Field& z);

 private:
  static constexpr int corners = GridLevel<D>::corners;
  using Element = std::array<float, std::size_t{corners} * corners>;

  void lay_grid(const PoissonSystem& system, double width);
  void sort_into_cells(const PoissonSystem& system);
  void connect_nodes();
  void compute_elements(const PoissonSystem& system, const Field& excess);
  void assemble();
  void restrict_to_grid(const Field& r);
  [[nodiscard]] std::array<float, corners> shape(std::int32_t particle) const;
  [[nodiscard]] std::array<std::array<float, D>, corners> shape_gradient(  // 1/m
      std::int32_t particle) const;

  std::array<double, D> width_{};   // m
  std::array<double, D> middle_{};  // of the grid, m
  GridIndex<D> cells_;
  AlignedVector<std::int32_t> cell_of_;                        // [particle]
  AlignedVector<std::array<float, D>> place_;                  // [particle] in its cell, 0 to 1
  std::vector<typename GridIndex<D>::Coordinate> coordinate_;  ///< of each particle\'s cell
  AlignedVector<std::int32_t> cell_start_;                     // cell -> range in cell_particle_
  AlignedVector<std::int32_t> cell_particle_;
  AlignedVector<std::int32_t> cell_node_;  // [cell][corner]
  AlignedVector<std::int32_t> node_cell_;  // [node][corner]: the cell that has it there, or -1
  AlignedVector<Element> element_;         // [cell]
  AlignedVector<float> cell_rhs_;          // [cell][corner]
  Field inverse_diagonal_;
  GridMultigrid<D> grid_;
  BlockSum block_sum_;
};

}  // namespace surge::linear
