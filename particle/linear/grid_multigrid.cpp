#include "particle/linear/grid_multigrid.hpp"

#include <algorithm>
#include <cmath>

#include "particle/core/parallel_for.hpp"
#include "particle/support/error.hpp"

namespace surge::linear {

namespace {

// Nodes of a loop: starting threads for less costs more than it gains.
constexpr std::int32_t parallel_from = 250;
// A dense factorisation of this size costs less than a sweep over the particles.
constexpr std::int32_t coarsest_size = 100;
// Nodes that too few particles touch leave the operator singular. The coarsest grid spans the whole
// domain, so that all of its smooth modes are far above this shift.
constexpr double coarsest_shift = 1e-3;

template <int D>
std::array<int, D> offset_of(int s) {
  std::array<int, D> o{};
  for (std::size_t a = 0; a < D; ++a, s /= 3) o[a] = s % 3 - 1;
  return o;
}

template <int D>
void sweep(GridLevel<D>& level, const std::vector<std::int32_t>& nodes) {
  constexpr int stencil = GridLevel<D>::stencil;
  const auto count = static_cast<std::int32_t>(nodes.size());
  const std::int32_t* node = nodes.data();
  const std::int32_t* neighbour = level.neighbour.data();
  const float* value = level.value.data();
  const float* rhs = level.rhs.data();
  const float* inverse = level.inverse_diagonal.data();
  float* solution = level.solution.data();
  parallel_for(count, parallel_from, [&](std::int32_t k) {
    const std::int32_t i = node[k];
    float sum = rhs[i];
    for (int s = 0; s < stencil; ++s) {
      sum -= value[i * stencil + s] * solution[neighbour[i * stencil + s]];
    }
    solution[i] = sum * inverse[i];
  });
}

template <int D>
void restrict_residual(GridLevel<D>& fine, GridLevel<D>& coarse) {
  constexpr int stencil = GridLevel<D>::stencil;
  const std::int32_t n = fine.size();
  const float* solution = fine.solution.data();
  parallel_for(n, parallel_from, [&](std::int32_t i) {
    const auto at = static_cast<std::size_t>(i);
    float sum = fine.rhs[at] - fine.diagonal[at] * solution[i];
    for (std::size_t s = at * stencil; s < (at + 1) * stencil; ++s) {
      sum -= fine.value[s] * solution[fine.neighbour[s]];
    }
    fine.residual[at] = sum;
  });
  std::array<float, stencil> weight;
  for (int s = 0; s < stencil; ++s) {
    weight[static_cast<std::size_t>(s)] = 1.0F;
    for (const int o : offset_of<D>(s)) {
      if (o != 0) weight[static_cast<std::size_t>(s)] *= 0.5F;
    }
  }
  const std::int32_t m = coarse.size();
  parallel_for(m, parallel_from, [&](std::int32_t i) {
    float sum = 0.0F;
    for (std::size_t s = 0; s < stencil; ++s) {
      const std::int32_t c = coarse.child[static_cast<std::size_t>(i) * stencil + s];
      if (c >= 0) sum += weight[s] * fine.residual[static_cast<std::size_t>(c)];
    }
    coarse.rhs[static_cast<std::size_t>(i)] = sum;
  });
}

template <int D>
void correct(const GridLevel<D>& coarse, GridLevel<D>& fine) {
  constexpr int corners = GridLevel<D>::corners;
  const std::int32_t n = fine.size();
  parallel_for(n, parallel_from, [&](std::int32_t i) {
    const auto at = static_cast<std::size_t>(i);
    float sum = 0.0F;
    for (std::size_t q = at * corners; q < (at + 1) * corners; ++q) {
      sum += fine.parent_weight[q] * coarse.solution[static_cast<std::size_t>(fine.parent[q])];
    }
    fine.solution[at] += sum;
  });
}

}  // namespace

// Every second node of each axis that is halved; fine nodes between two take the mean of both. An
// axis keeps both its ends, or it is left as it is: what the grid does has no side.
template <int D>
bool GridMultigrid<D>::coarsen(GridLevel<D>& fine, GridLevel<D>& coarse) {
  typename GridIndex<D>::Coordinate extent = fine.index.extent();
  bool any = false;
  for (std::size_t a = 0; a < D; ++a) {
    // Colours need an even number of nodes around a wrapped axis.
    fine.halved[a] = fine.index.wrapped()[a] ? extent[a] % 4 == 0 && extent[a] >= 8
                                             : extent[a] % 2 == 1 && extent[a] > 2;
    if (fine.halved[a]) extent[a] = fine.index.wrapped()[a] ? extent[a] / 2 : extent[a] / 2 + 1;
    any = any || fine.halved[a];
  }
  if (!any) return false;

  coarse.index.reset(extent, fine.index.wrapped());
  constexpr int corners = GridLevel<D>::corners;
  constexpr int stencil = GridLevel<D>::stencil;
  fine.parent.resize(fine.diagonal.size() * corners);
  fine.parent_weight.resize(fine.parent.size());
  for (std::size_t i = 0; i < fine.diagonal.size(); ++i) {
    for (std::size_t q = 0; q < corners; ++q) {
      typename GridIndex<D>::Coordinate c = fine.index.points()[i];
      float weight = 1.0F;
      for (std::size_t a = 0; a < D; ++a) {
        const bool upper = ((q >> a) & 1U) != 0;
        const bool between = fine.halved[a] && (c[a] & 1) != 0;
        if (fine.halved[a]) c[a] /= 2;
        if (between && upper) ++c[a];
        weight *= between ? 0.5F : (upper ? 0.0F : 1.0F);
      }
      // A corner without weight repeats the first, so that it names a node.
      fine.parent[i * corners + q] = weight > 0.0F ? coarse.index.add(c) : fine.parent[i * corners];
      fine.parent_weight[i * corners + q] = weight;
    }
  }

  coarse.allocate();
  coarse.child.assign(coarse.diagonal.size() * stencil, -1);
  for (std::size_t i = 0; i < coarse.diagonal.size(); ++i) {
    for (int s = 0; s < stencil; ++s) {
      typename GridIndex<D>::Coordinate c = coarse.index.points()[i];
      const std::array<int, D> o = offset_of<D>(s);
      bool exists = true;
      for (std::size_t a = 0; a < D; ++a) {
        if (fine.halved[a]) {
          c[a] = 2 * c[a] + o[a];
        } else {
          exists = exists && o[a] == 0;
        }
      }
      if (exists) {
        coarse.child[i * stencil + static_cast<std::size_t>(s)] = fine.index.find(c);
      }
    }
  }
  return true;
}

// P^T A P, node by node: child i at offset o of I couples with j at offset t = o + s of I (in fine
// spacings), which hangs on the coarse neighbours t / 2, or on both beside it where t is odd.
template <int D>
void GridMultigrid<D>::galerkin(const GridLevel<D>& fine, GridLevel<D>& coarse) {
  constexpr int stencil = GridLevel<D>::stencil;
  constexpr int centre = stencil / 2;
  const std::int32_t n = coarse.size();
  parallel_for(n, parallel_from / 4, [&](std::int32_t node) {
    const auto at = static_cast<std::size_t>(node);
    std::array<float, stencil> row{};
    for (int o = 0; o < stencil; ++o) {
      const std::int32_t i = coarse.child[at * stencil + static_cast<std::size_t>(o)];
      if (i < 0) continue;
      const std::array<int, D> to_child = offset_of<D>(o);
      for (int s = 0; s < stencil; ++s) {
        const std::size_t entry =
            static_cast<std::size_t>(i) * stencil + static_cast<std::size_t>(s);
        float a_ij = s == centre ? fine.diagonal[static_cast<std::size_t>(i)] : fine.value[entry];
        if (a_ij == 0.0F) continue;
        for (const int step : to_child) a_ij *= step != 0 ? 0.5F : 1.0F;
        const std::array<int, D> to_neighbour = offset_of<D>(s);
        std::array<int, D> lower{};
        std::array<int, D> upper{};
        for (std::size_t a = 0; a < D; ++a) {
          const int t = to_child[a] + to_neighbour[a];
          const bool odd = fine.halved[a] && (t & 1) != 0;
          lower[a] = fine.halved[a] ? (t - (odd ? 1 : 0)) / 2 : t;
          upper[a] = lower[a] + (odd ? 1 : 0);
          if (odd) a_ij *= 0.5F;
        }
        for (int q = 0; q < GridLevel<D>::corners; ++q) {
          int target = 0;
          bool repeats = false;
          for (int a = D - 1; a >= 0; --a) {
            const bool use_upper = ((q >> a) & 1) != 0;
            const auto axis = static_cast<std::size_t>(a);
            repeats = repeats || (use_upper && upper[axis] == lower[axis]);
            target = target * 3 + (use_upper ? upper[axis] : lower[axis]) + 1;
          }
          if (!repeats) row[static_cast<std::size_t>(target)] += a_ij;
        }
      }
    }
    for (int s = 0; s < stencil; ++s) {
      const auto entry = at * stencil + static_cast<std::size_t>(s);
      const float a_ij = row[static_cast<std::size_t>(s)];
      if (s == centre) {
        coarse.diagonal[at] = a_ij;
      } else if (a_ij != 0.0F) {
        typename GridIndex<D>::Coordinate c = coarse.index.points()[at];
        const std::array<int, D> o = offset_of<D>(s);
        for (std::size_t a = 0; a < D; ++a) c[a] += o[a];
        coarse.neighbour[entry] = coarse.index.find(c);
        coarse.value[entry] = a_ij;
      }
    }
  });
  coarse.finish();
}

template <int D>
void GridMultigrid<D>::build() {
  finest().finish();
  count_ = 1;
  while (levels_[static_cast<std::size_t>(count_ - 1)].size() > coarsest_size) {
    if (static_cast<std::size_t>(count_) == levels_.size()) levels_.emplace_back();
    GridLevel<D>& fine = levels_[static_cast<std::size_t>(count_ - 1)];
    GridLevel<D>& coarse = levels_[static_cast<std::size_t>(count_)];
    if (!coarsen(fine, coarse)) break;
    galerkin(fine, coarse);
    ++count_;
  }
  factorise_coarsest();
}

void factorise_shifted(Eigen::MatrixXd matrix, Eigen::LLT<Eigen::MatrixXd>& factor) {
  constexpr double enough = 1e6;  // times the rows' sums: Cholesky cannot fail any more
  for (double shift = 1e-6; shift < enough && matrix.allFinite(); shift *= 10.0) {
    factor.compute(matrix);
    if (factor.info() == Eigen::Success) return;
    matrix.diagonal() *= 1.0 + shift;
  }
  throw Error("pressure: the coarsest grid of the multigrid is not positive definite");
}

template <int D>
void GridMultigrid<D>::factorise_coarsest() {
  constexpr int stencil = GridLevel<D>::stencil;
  const GridLevel<D>& level = levels_[static_cast<std::size_t>(count_ - 1)];
  const std::size_t n = level.diagonal.size();
  const float largest =
      n == 0 ? 0.0F : *std::max_element(level.diagonal.begin(), level.diagonal.end());
  const auto size = static_cast<Eigen::Index>(n);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t i = 0; i < n; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const double d = static_cast<double>(level.diagonal[i]);
    matrix(row, row) = d > 0.0 ? (1.0 + coarsest_shift) * d : static_cast<double>(largest);
    for (std::size_t s = i * stencil; s < (i + 1) * stencil; ++s)
      matrix(row, static_cast<Eigen::Index>(level.neighbour[s])) +=
          static_cast<double>(level.value[s]);
  }
  factorise_shifted(matrix, factor_);
}

template <int D>
void GridMultigrid<D>::solve_coarsest() {
  GridLevel<D>& level = levels_[static_cast<std::size_t>(count_ - 1)];
  const auto n = static_cast<Eigen::Index>(level.diagonal.size());
  coarsest_solution_ =
      Eigen::Map<const Eigen::VectorXf>(level.rhs.data(), n).template cast<double>();
  factor_.solveInPlace(coarsest_solution_);
  Eigen::Map<Eigen::VectorXf>(level.solution.data(), n) = coarsest_solution_.template cast<float>();
}

template <int D>
void GridMultigrid<D>::cycle() {
  const auto coarsest = static_cast<std::size_t>(count_ - 1);
  for (std::size_t l = 0; l < coarsest; ++l) {
    std::fill(levels_[l].solution.begin(), levels_[l].solution.end(), 0.0F);
    for (const auto& nodes : levels_[l].colour) sweep(levels_[l], nodes);
    restrict_residual(levels_[l], levels_[l + 1]);
  }
  solve_coarsest();
  for (std::size_t l = coarsest; l-- > 0;) {
    correct(levels_[l + 1], levels_[l]);
    for (auto nodes = levels_[l].colour.rbegin(); nodes != levels_[l].colour.rend(); ++nodes) {
      sweep(levels_[l], *nodes);
    }
  }
}

template class GridMultigrid<2>;
template class GridMultigrid<3>;

}  // namespace surge::linear
