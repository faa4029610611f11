#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "particle/core/particles.hpp"
#include "particle/linear/block_sum.hpp"

namespace surge::linear {

/// A p = b on the particles whose pressure is unknown. A is symmetric, has no positive entry off
/// the diagonal and is weakly diagonally dominant (an M-matrix): what Eq. (7) gives with the sign
/// turned, where the particles with p = 0 are eliminated but stay in the diagonal.
///
/// Compressed rows of both triangles without the diagonal: row i owns the entries row_start[i] to
/// row_start[i + 1]. Columns may come in any order; neighbours in space should be near in number.
struct PoissonSystem {
  AlignedVector<std::int32_t> row_start;  ///< size() + 1 entries
  AlignedVector<std::int32_t> column;
  /// Entries off the diagonal, <= 0. In single precision, because every iteration reads all of
  /// them: a pair's weight then has a relative error of 6e-8, and as the diagonal is
  /// the sum of the rounded weights, so has the energy of every field of pressures. All arithmetic
  /// with them is in double precision.
  AlignedVector<float> value;
  Field diagonal;  ///< >= the sum of |value| over the row
  Field rhs;

  int dimension = 2;
  double spacing = 1.0;  ///< l0, m
  /// Mean of one component of (x_j - x_i)^2 under the weights of a full neighbourhood, m^2; only
  /// the preconditioner goes by it.
  double mean_square = 1.0;
  std::array<Field, 3> x;          ///< m, where the unknowns are; the first `dimension` are used
  std::array<double, 3> period{};  ///< m, length of the periodic axes, zero for the others

  [[nodiscard]] std::size_t size() const { return diagonal.size(); }
};

/// Row i of A x. Two sums side by side: an addition need not wait for the one before it.
inline double row_product(const PoissonSystem& system, const Field& x, std::size_t i) {
  const auto term = [&](std::size_t k) {
    return static_cast<double>(system.value[k]) * x[static_cast<std::size_t>(system.column[k])];
  };
  auto k = static_cast<std::size_t>(system.row_start[i]);
  const auto end = static_cast<std::size_t>(system.row_start[i + 1]);
  double even = system.diagonal[i] * x[i];
  double odd = 0.0;
  for (; k + 1 < end; k += 2) {
    even += term(k);
    odd += term(k + 1);
  }
  if (k < end) even += term(k);
  return even + odd;
}

/// y = A x.
void multiply(const PoissonSystem& system, const Field& x, Field& y);

/// What the diagonal holds beyond the row's own couplings, diagonal - sum |value|: the coupling to
/// particles with p = 0. Zero to rounding (and never below) where there are none.
void compute_excess(const PoissonSystem& system, Field& excess);

/// ||b - A p|| / ||b|| in the Euclidean norm; ||A p|| where b = 0.
double relative_residual(const PoissonSystem& system, const Field& p, BlockSum& block_sum);

}  // namespace surge::linear
