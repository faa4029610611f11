#include "particle/isph/model.hpp"

#include <array>
#include <cmath>

#include "particle/case/scales.hpp"
#include "particle/core/for_each_cell.hpp"

namespace surge::isph {
namespace {

template <int D>
AnyKernel<D> make_kernel(Kernel kernel, double h) {
  if (kernel == Kernel::quintic_spline) return QuinticSpline<D>(h);
  return WendlandC2<D>(h);
}

/// sum of V (-W'/r) |x|^power, x along an axis, over the lattice of spacing l0 around one of its
/// points.
template <int D>
double lattice_moment(const AnyKernel<D>& any, double radius, double l0, int power) {
  const int reach = static_cast<int>(std::ceil(radius / l0));
  std::array<int, D> begin;
  std::array<int, D> end;
  begin.fill(-reach);
  end.fill(reach + 1);
  return std::visit(
      [&](const auto& kernel) {
        double sum = 0.0;
        for_each_cell<D>(begin, end, [&](const std::array<int, D>& k) {
          double square = 0.0;
          for (const int a : k) square += a * a;
          const double r = std::sqrt(square) * l0;
          if (r > 0.0 && r < radius)
            sum -=
                kernel.derivative(r) / r * std::pow(std::abs(k[0]) * l0, power) * std::pow(l0, D);
        });
        return sum;
      },
      any);
}

/// s; a case without a speed has no such time.
double divergence_time_of(const Params& params, const Case& c) {
  const double speed = reference_speed(c);
  return speed > 0.0 ? params.divergence_time * c.spacing / speed : 0.0;
}

}  // namespace

template <int D>
Model<D>::Model(const Case& c, const Params& params)
    : spacing(c.spacing),
      rho(c.density),
      nu(c.kinematic_viscosity),
      no_slip(nu > 0.0 && c.has_tank && c.tank.wall == WallCondition::no_slip),
      h(params.h_over_l0 * c.spacing),
      radius(support_of(params.kernel) * h),
      reach2(std::pow(0.999 * radius, 2)),
      volume(std::pow(c.spacing, D)),
      divergence_time(divergence_time_of(params, c)),
      kernel(make_kernel<D>(params.kernel, h)),
      self_volume(volume * std::visit([](const auto& k) { return k.value(0.0); }, kernel)),
      laplacian_factor(1.0 / lattice_moment<D>(kernel, radius, c.spacing, 2)),
      mean_square(1.0 / laplacian_factor / lattice_moment<D>(kernel, radius, c.spacing, 0)) {}

template struct Model<2>;
template struct Model<3>;

}  // namespace surge::isph
