#include "particle/sph/shifting.hpp"

#include "particle/core/parallel_for.hpp"
#include "particle/core/smallest_eigenvalue.hpp"
#include "particle/kernel/quintic_spline.hpp"
#include "particle/kernel/wendland_c2.hpp"

namespace surge::sph {

template <int D>
template <class K>
void Surroundings<D>::survey(const K& kernel, ClusterLists<D>& lists, const Particles<D>& p,
                             const Field& fluid_volume, double speed_limit, Survey<D>& found) {
  const std::size_t size = p.size();
  for (Field* field : {&volume_, &second_moment_, &weight_}) field->resize(size);
  for (Field& field : concentration_gradient_) field.resize(size);
  for (Field& field : moment_) field.resize(size);
  for (Field& field : inward_) field.resize(size);
  for (Field& field : wall_normal_) field.resize(size);
  for (Field& field : deformation_) field.resize(size);
  sum_neighbours(kernel, lists, p, fluid_volume, found);
  find_surface(kernel, lists, p, fluid_volume, found);

  const auto n = static_cast<std::ptrdiff_t>(size);
  parallel_for_in_stretches(n, stretch, [&](std::ptrdiff_t k) {
    const auto i = static_cast<std::size_t>(k);
    if (p.type[i] != ParticleType::fluid) return;
    const Vec<D> shift = shift_of(i, speed_limit, found);
    for (int a = 0; a < D; ++a) found.shift[a][i] = shift[a];
  });
}

template <int D>
Vec<D> Surroundings<D>::shift_of(std::size_t i, double speed_limit, const Survey<D>& found) const {
  if (found.is_detached(i) || !(weight_[i] > 0.0)) return {};
  Vec<D> gradient;
  for (int a = 0; a < D; ++a) gradient[a] = concentration_gradient_[a][i];
  const double limit = std::min(speed_limit, deformation_speed_of(i));
  const Vec<D> shift = shifting_velocity(gradient, h_, speed_, limit);
  Vec<D> normal;
  if (found.near_surface(i)) {
    for (int a = 0; a < D; ++a) normal[a] = -inward_[a][i];
    return along_surface(shift, normal);
  }
  for (int a = 0; a < D; ++a) normal[a] = wall_normal_[a][i];
  return without_part_along(shift, normal);
}

template <int D>
double Surroundings<D>::deformation_speed_of(std::size_t i) const {
  std::array<Vec<D>, D> rate;
  int m = 0;
  for (int a = 0; a < D; ++a)
    for (int b = a; b < D; ++b, ++m) rate[a][b] = rate[b][a] = 0.5 * deformation_[m][i];
  return deformation_speed(rate, second_moment_[i] / weight_[i]);
}

/// G, M, how the fluid deforms and where walls are, in one pass over the pairs.
template <int D>
template <class K>
void Surroundings<D>::sum_neighbours(const K& kernel, ClusterLists<D>& lists, const Particles<D>& p,
                                     const Field& fluid_volume, Survey<D>& found) {
  const auto n = static_cast<std::ptrdiff_t>(p.size());
  const double wall_volume = std::pow(spacing_, D);
  parallel_for_in_stretches(n, stretch, [&](std::ptrdiff_t k) {
    const auto i = static_cast<std::size_t>(k);
    volume_[i] = p.type[i] == ParticleType::fluid ? fluid_volume[i] : wall_volume;
  });
  constexpr int to_moment = D;
  constexpr int to_wall = to_moment + entries;
  constexpr int to_deformation = to_wall + D;
  constexpr int to_weight = to_deformation + entries;
  std::array<const double*, 2 * D + 1> fields;
  std::array<double*, to_weight + 2> out;
  for (int a = 0; a < D; ++a) {
    fields[a] = p.x[a].data();
    fields[D + a] = p.v[a].data();
    out[a] = concentration_gradient_[a].data();
    out[to_wall + a] = wall_normal_[a].data();
  }
  fields[2 * D] = volume_.data();
  for (int m = 0; m < entries; ++m) {
    out[to_moment + m] = moment_[m].data();
    out[to_deformation + m] = deformation_[m].data();
  }
  out[to_weight] = weight_.data();
  out[to_weight + 1] = second_moment_.data();

  const double value_at_spacing = kernel.value(spacing_);
  const auto pair = [&](const Offset<D>& offset, const auto& i, const auto& j, auto& total,
                        auto j_is_fluid) SURGE_INLINE {
    const auto& dx = offset.dx;
    const Simd slope = kernel.slope(offset.r);
    const Simd value = kernel.value(offset.r);
    const Simd push = -j[2 * D] * concentration_slope(value, slope, value_at_spacing);
    const Simd grad = -slope * j[2 * D];  // V grad W over dx
    int m = 0;
    for (int a = 0; a < D; ++a) {
      total[a] += push * dx[a];
      for (int b = a; b < D; ++b, ++m) total[to_moment + m] += grad * dx[a] * dx[b];
    }
    if constexpr (j_is_fluid()) {
      std::array<Simd, D> dv;
      for (int a = 0; a < D; ++a) dv[a] = grad * (j[D + a] - i[D + a]);
      m = 0;
      for (int a = 0; a < D; ++a)
        for (int b = a; b < D; ++b, ++m) total[to_deformation + m] += dv[a] * dx[b] + dv[b] * dx[a];
      Simd weight = j[2 * D] * value;
      stdx::where(offset.r2 < Simd(2.0 * tiny), weight) = 0.0;  // itself
      total[to_weight] += weight;
      total[to_weight + 1] += weight * offset.r2;
    } else {
      for (int a = 0; a < D; ++a) total[to_wall + a] += grad * dx[a];
    }
  };
  lists.template sum<2 * D + 1, 2 * D + 1, to_weight + 2>(ClusterLists<D>::Of::fluid, fields, out,
                                                          pair);
  parallel_for_in_stretches(n, stretch, [&](std::ptrdiff_t k) {
    const auto i = static_cast<std::size_t>(k);
    std::array<double, entries> of_i;
    for (int m = 0; m < entries; ++m) of_i[m] = moment_[m][i];
    found.lambda[i] = p.type[i] == ParticleType::fluid ? smallest_eigenvalue<D>(of_i) : 1.0;
  });
}

/// Gradient of lambda over the fluid, and whether there is a surface within the kernel.
template <int D>
template <class K>
void Surroundings<D>::find_surface(const K& kernel, ClusterLists<D>& lists, const Particles<D>& p,
                                   const Field& fluid_volume, Survey<D>& found) {
  using Lists = ClusterLists<D>;
  std::array<const double*, D + 2> fields;
  std::array<double*, D + 1> out;
  for (int a = 0; a < D; ++a) {
    fields[a] = p.x[a].data();
    out[a] = inward_[a].data();
  }
  fields[D] = found.lambda.data();
  fields[D + 1] = fluid_volume.data();
  out[D] = found.surface_share.data();
  const auto pair = [&](const Offset<D>& offset, const auto& i, const auto& j, auto& total,
                        auto j_is_fluid) SURGE_INLINE {
    if constexpr (j_is_fluid()) {
      const Simd rise = -kernel.slope(offset.r) * (j[D] - i[D]) * j[D + 1];
      for (int a = 0; a < D; ++a) total[a] += rise * offset.dx[a];
      Simd share = kernel.value(offset.r) * j[D + 1];
      stdx::where(j[D] >= Simd(Survey<D>::surface_lambda), share) = 0.0;
      total[D] += share;
    }
  };
  // The rest has neither a surface near nor use for a normal.
  const auto wanted = [&](const typename Lists::Row& row, const typename Lists::Cluster& cluster) {
    bool surface = false;
    row.for_each_fluid_neighbour(cluster,
                                 [&](std::size_t j) { surface = surface || found.on_surface(j); });
    return surface;
  };
  lists.template sum<D + 2, D + 2, D + 1>(Lists::Of::fluid, fields, out, pair, wanted);
}

template <int D>
template <class K>
void Surroundings<D>::find_density_rate(const K& kernel, ClusterLists<D>& lists,
                                        const Particles<D>& p, Survey<D>& found) {
  using Lists = ClusterLists<D>;
  std::array<const double*, 2 * D + 2> fields;
  for (int a = 0; a < D; ++a) {
    fields[a] = p.x[a].data();
    fields[D + a] = found.shift[a].data();
  }
  fields[2 * D] = volume_.data();
  fields[2 * D + 1] = p.density.data();
  const std::array<double*, 1> out{found.density_rate.data()};
  const auto pair = [&](const Offset<D>& offset, const auto& i, const auto& j, auto& total,
                        auto j_is_fluid) SURGE_INLINE {
    Simd along_i = 0.0;
    Simd along_j = 0.0;
    for (int a = 0; a < D; ++a) {
      along_i += i[D + a] * offset.dx[a];
      along_j += j[D + a] * offset.dx[a];
    }
    const Simd rho_i = i[2 * D + 1];
    Simd rate = rho_i * (along_i - along_j);
    // Nothing is carried through a wall.
    if constexpr (j_is_fluid()) rate += rho_i * along_i + j[2 * D + 1] * along_j;
    total[0] -= kernel.slope(offset.r) * j[2 * D] * rate;
  };
  const auto wanted = [&](const typename Lists::Row&, const typename Lists::Cluster& cluster) {
    bool inside = false;
    for (const std::uint32_t i : cluster.member) inside = inside || !found.near_surface(i);
    return inside;
  };
  lists.template sum<2 * D + 2, 2 * D + 2, 1>(Lists::Of::fluid, fields, out, pair, wanted);
  const auto n = static_cast<std::ptrdiff_t>(p.size());
  parallel_for_in_stretches(n, stretch, [&](std::ptrdiff_t k) {
    const auto i = static_cast<std::size_t>(k);
    if (p.type[i] != ParticleType::fluid || found.near_surface(i)) found.density_rate[i] = 0.0;
  });
}

template class Surroundings<2>;
template class Surroundings<3>;
template void Surroundings<2>::survey(const QuinticSpline<2>&, ClusterLists<2>&,
                                      const Particles<2>&, const Field&, double, Survey<2>&);
template void Surroundings<2>::find_density_rate(const QuinticSpline<2>&, ClusterLists<2>&,
                                                 const Particles<2>&, Survey<2>&);
template void Surroundings<2>::survey(const WendlandC2<2>&, ClusterLists<2>&, const Particles<2>&,
                                      const Field&, double, Survey<2>&);
template void Surroundings<2>::find_density_rate(const WendlandC2<2>&, ClusterLists<2>&,
                                                 const Particles<2>&, Survey<2>&);
template void Surroundings<3>::survey(const QuinticSpline<3>&, ClusterLists<3>&,
                                      const Particles<3>&, const Field&, double, Survey<3>&);
template void Surroundings<3>::find_density_rate(const QuinticSpline<3>&, ClusterLists<3>&,
                                                 const Particles<3>&, Survey<3>&);
template void Surroundings<3>::survey(const WendlandC2<3>&, ClusterLists<3>&, const Particles<3>&,
                                      const Field&, double, Survey<3>&);
template void Surroundings<3>::find_density_rate(const WendlandC2<3>&, ClusterLists<3>&,
                                                 const Particles<3>&, Survey<3>&);

}  // namespace surge::sph
