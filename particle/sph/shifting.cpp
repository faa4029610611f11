#include "particle/sph/shifting.hpp"

#include <Eigen/Eigenvalues>

#include "particle/kernel/quintic_spline.hpp"
#include "particle/kernel/wendland_c2.hpp"

namespace surge::sph {
namespace {

constexpr double tiny = 1e-30;  ///< m^2, keeps 1/r finite for a particle and itself

/// Smallest eigenvalue of a symmetric matrix given row by row from the diagonal on.
template <int D, std::size_t N>
double smallest_eigenvalue(const std::array<double, N>& entries) {
  Eigen::Matrix<double, D, D> matrix;
  std::size_t k = 0;
  for (int a = 0; a < D; ++a)
    for (int b = a; b < D; ++b) matrix(a, b) = matrix(b, a) = entries[k++];
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, D, D>> solver;
  solver.computeDirect(matrix, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()(0);
}

}  // namespace

template <int D>
template <class K>
void Surroundings<D>::survey(const K& kernel, const CellGrid<D>& grid, const Particles<D>& p,
                             const Field& fluid_volume,
                             const std::vector<std::uint32_t>& fluid_before, double speed_limit) {
  const std::size_t size = p.size();
  for (Field* field : {&volume_, &second_moment_, &weight_, &lambda_, &surface_share_})
    field->resize(size);
  for (Field& field : shift_) field.resize(size);
  for (Field& field : moment_) field.resize(size);
  for (Field& field : inward_) field.resize(size);
  for (Field& field : wall_normal_) field.resize(size);
  for (Field& field : velocity_gradient_) field.resize(size);
  sum_neighbours(kernel, grid, p, fluid_volume, fluid_before);
  find_surface(kernel, grid, p, fluid_volume, fluid_before);

  const auto n = static_cast<std::ptrdiff_t>(size);
#pragma omp parallel for schedule(static, stretch)
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    Vec<D> shift{};
    if (p.type[i] == ParticleType::fluid && !is_detached(i) && weight_[i] > 0.0) {
      Vec<D> gradient;
      for (int a = 0; a < D; ++a) gradient[a] = shift_[a][i];
      const double limit = std::min(speed_limit, deformation_speed_of(i));
      shift = shifting_velocity(gradient, h_, speed_, limit);
      Vec<D> normal;
      if (near_surface(i)) {
        for (int a = 0; a < D; ++a) normal[a] = -inward_[a][i];
        shift = along_surface(shift, normal);
      } else {
        for (int a = 0; a < D; ++a) normal[a] = wall_normal_[a][i];
        shift = without_part_along(shift, normal);
      }
    }
    for (int a = 0; a < D; ++a) shift_[a][i] = shift[a];
  }
}

template <int D>
double Surroundings<D>::deformation_speed_of(std::size_t i) const {
  std::array<Vec<D>, D> gradient;
  for (int a = 0; a < D; ++a)
    for (int b = 0; b < D; ++b) gradient[a][b] = velocity_gradient_[a * D + b][i];
  return deformation_speed(gradient, second_moment_[i] / weight_[i]);
}

/// G, M, how the fluid deforms and where walls are, in one pass over the pairs.
template <int D>
template <class K>
void Surroundings<D>::sum_neighbours(const K& kernel, const CellGrid<D>& grid,
                                     const Particles<D>& p, const Field& fluid_volume,
                                     const std::vector<std::uint32_t>& fluid_before) {
  const auto n = static_cast<std::ptrdiff_t>(p.size());
  const double wall_volume = std::pow(spacing_, D);
#pragma omp parallel for schedule(static, stretch)
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    volume_[i] = p.type[i] == ParticleType::fluid ? fluid_volume[i] : wall_volume;
  }
  std::array<const double*, 2 * D + 2> fields;
  std::array<double*, sums> out;
  for (int a = 0; a < D; ++a) {
    fields[a] = p.x[a].data();
    fields[D + a] = p.v[a].data();
    out[a] = shift_[a].data();
  }
  fields[2 * D] = volume_.data();
  fields[2 * D + 1] = fluid_volume.data();
  for (int m = 0; m < moments; ++m) out[D + m] = moment_[m].data();
  out[D + moments] = second_moment_.data();
  out[D + moments + 1] = weight_.data();
  for (int a = 0; a < D; ++a) out[D + moments + 2 + a] = wall_normal_[a].data();
  for (int c = 0; c < D * D; ++c) out[2 * D + moments + 2 + c] = velocity_gradient_[c].data();

  const double value_at_spacing = kernel.value(spacing_);
  const auto pair = [&](const auto& i, const auto& j) {
    std::array<Simd, D> dx;
    Simd r2 = tiny;
    for (int a = 0; a < D; ++a) {
      dx[a] = j[a] - i[a];
      r2 += dx[a] * dx[a];
    }
    const Simd r = root(r2);
    const Simd slope = kernel.derivative(r) / r;
    Simd value = kernel.value(r);
    const Simd push = -concentration_slope(value, slope, value_at_spacing);
    stdx::where(r2 < Simd(2.0 * tiny), value) = 0.0;  // itself
    PairTerms<sums> terms;
    for (int a = 0; a < D; ++a) {
      terms.to_i[a] = push * j[2 * D] * dx[a];
      terms.to_j[a] = -push * i[2 * D] * dx[a];
    }
    int m = D;
    for (int a = 0; a < D; ++a)
      for (int b = a; b < D; ++b, ++m) {
        const Simd moment = -slope * dx[a] * dx[b];
        terms.to_i[m] = moment * j[2 * D];
        terms.to_j[m] = moment * i[2 * D];
      }
    terms.to_i[m + 1] = value * j[2 * D + 1];
    terms.to_j[m + 1] = value * i[2 * D + 1];
    terms.to_i[m] = terms.to_i[m + 1] * r2;
    terms.to_j[m] = terms.to_j[m + 1] * r2;
    for (int a = 0; a < D; ++a) {
      terms.to_i[m + 2 + a] = -slope * (j[2 * D] - j[2 * D + 1]) * dx[a];
      terms.to_j[m + 2 + a] = slope * (i[2 * D] - i[2 * D + 1]) * dx[a];
    }
    m += 2 + D;
    for (int a = 0; a < D; ++a) {
      const Simd dv = -slope * (j[D + a] - i[D + a]);
      for (int b = 0; b < D; ++b, ++m) {
        terms.to_i[m] = dv * dx[b] * j[2 * D + 1];
        terms.to_j[m] = dv * dx[b] * i[2 * D + 1];
      }
    }
    return terms;
  };
  neighbour_loop_(
      grid, fields, out, [&](std::size_t i) { return p.type[i] == ParticleType::fluid; },
      [&](std::size_t begin, std::size_t end) { return fluid_before[end] > fluid_before[begin]; },
      pair);
#pragma omp parallel for schedule(static, stretch)
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    std::array<double, moments> entries;
    for (int m = 0; m < moments; ++m) entries[m] = moment_[m][i];
    lambda_[i] = p.type[i] == ParticleType::fluid ? smallest_eigenvalue<D>(entries) : 1.0;
  }
}

/// Gradient of lambda over the fluid, and whether there is a surface within the kernel.
template <int D>
template <class K>
void Surroundings<D>::find_surface(const K& kernel, const CellGrid<D>& grid, const Particles<D>& p,
                                   const Field& fluid_volume,
                                   const std::vector<std::uint32_t>& fluid_before) {
  std::array<const double*, D + 2> fields;
  std::array<double*, D + 1> out;
  for (int a = 0; a < D; ++a) {
    fields[a] = p.x[a].data();
    out[a] = inward_[a].data();
  }
  fields[D] = lambda_.data();
  fields[D + 1] = fluid_volume.data();
  out[D] = surface_share_.data();
  const auto pair = [&](const auto& i, const auto& j) {
    std::array<Simd, D> dx;
    Simd r2 = tiny;
    for (int a = 0; a < D; ++a) {
      dx[a] = j[a] - i[a];
      r2 += dx[a] * dx[a];
    }
    const Simd r = root(r2);
    const Simd rise = -kernel.derivative(r) / r * (j[D] - i[D]);
    const Simd value = kernel.value(r);
    PairTerms<D + 1> terms;
    for (int a = 0; a < D; ++a) {
      terms.to_i[a] = rise * j[D + 1] * dx[a];
      terms.to_j[a] = rise * i[D + 1] * dx[a];
    }
    terms.to_i[D] = value * j[D + 1];
    terms.to_j[D] = value * i[D + 1];
    stdx::where(j[D] >= Simd(surface_lambda), terms.to_i[D]) = 0.0;
    stdx::where(i[D] >= Simd(surface_lambda), terms.to_j[D]) = 0.0;
    return terms;
  };
  surface_loop_(
      grid, fields, out, [&](std::size_t i) { return p.type[i] == ParticleType::fluid; },
      [&](std::size_t begin, std::size_t end) { return fluid_before[end] > fluid_before[begin]; },
      pair);
}

template <int D>
template <class K>
void Surroundings<D>::density_rate(const K& kernel, const CellGrid<D>& grid, const Particles<D>& p,
                                   const Field& fluid_volume,
                                   const std::vector<std::uint32_t>& fluid_before, Field& rate) {
  std::array<const double*, 2 * D + 3> fields;
  for (int a = 0; a < D; ++a) {
    fields[a] = p.x[a].data();
    fields[D + a] = shift_[a].data();
  }
  fields[2 * D + 2] = fluid_volume.data();
  fields[2 * D] = volume_.data();
  fields[2 * D + 1] = p.density.data();
  const std::array<double*, 1> out{rate.data()};
  const auto pair = [&](const auto& i, const auto& j) {
    std::array<Simd, D> dx;
    Simd r2 = tiny;
    Simd along_i = 0.0;
    Simd along_j = 0.0;
    for (int a = 0; a < D; ++a) {
      dx[a] = j[a] - i[a];
      r2 += dx[a] * dx[a];
      along_i += i[D + a] * dx[a];
      along_j += j[D + a] * dx[a];
    }
    const Simd r = root(r2);
    const Simd slope = kernel.derivative(r) / r;
    const Simd rho_i = i[2 * D + 1];
    const Simd rho_j = j[2 * D + 1];
    Simd carried = rho_i * along_i + rho_j * along_j;
    // Nothing is carried through a wall.
    stdx::where(i[2 * D + 2] * j[2 * D + 2] == 0.0, carried) = 0.0;
    PairTerms<1> terms;
    terms.to_i[0] = -slope * j[2 * D] * (carried - rho_i * (along_j - along_i));
    terms.to_j[0] = slope * i[2 * D] * (carried + rho_j * (along_j - along_i));
    return terms;
  };
  density_loop_(
      grid, fields, out, [&](std::size_t i) { return p.type[i] == ParticleType::fluid; },
      [&](std::size_t begin, std::size_t end) { return fluid_before[end] > fluid_before[begin]; },
      pair);
}

template class Surroundings<2>;
template class Surroundings<3>;
template void Surroundings<2>::survey(const QuinticSpline<2>&, const CellGrid<2>&,
                                      const Particles<2>&, const Field&,
                                      const std::vector<std::uint32_t>&, double);
template void Surroundings<2>::survey(const WendlandC2<2>&, const CellGrid<2>&, const Particles<2>&,
                                      const Field&, const std::vector<std::uint32_t>&, double);
template void Surroundings<3>::survey(const QuinticSpline<3>&, const CellGrid<3>&,
                                      const Particles<3>&, const Field&,
                                      const std::vector<std::uint32_t>&, double);
template void Surroundings<3>::survey(const WendlandC2<3>&, const CellGrid<3>&, const Particles<3>&,
                                      const Field&, const std::vector<std::uint32_t>&, double);
template void Surroundings<2>::density_rate(const QuinticSpline<2>&, const CellGrid<2>&,
                                            const Particles<2>&, const Field&,
                                            const std::vector<std::uint32_t>&, Field&);
template void Surroundings<2>::density_rate(const WendlandC2<2>&, const CellGrid<2>&,
                                            const Particles<2>&, const Field&,
                                            const std::vector<std::uint32_t>&, Field&);
template void Surroundings<3>::density_rate(const QuinticSpline<3>&, const CellGrid<3>&,
                                            const Particles<3>&, const Field&,
                                            const std::vector<std::uint32_t>&, Field&);
template void Surroundings<3>::density_rate(const WendlandC2<3>&, const CellGrid<3>&,
                                            const Particles<3>&, const Field&,
                                            const std::vector<std::uint32_t>&, Field&);

}  // namespace surge::sph
