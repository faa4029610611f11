#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "particle/kernel/mps_weight.hpp"
#include "particle/kernel/quintic_spline.hpp"
#include "particle/kernel/wendland_c2.hpp"

namespace surge {
namespace {

constexpr double pi = std::numbers::pi;

/// Surface of the unit sphere in D dimensions.
template <int D>
constexpr double unit_sphere() {
  return D == 1 ? 2.0 : D == 2 ? 2.0 * pi : 4.0 * pi;
}

/// int_0^upper f(r) S_D r^(D-1) dr by Gauss-Legendre with three points on small pieces; the pieces'
/// ends include the kernels' joints.
template <int D, class F>
double radial_integral(double upper, F&& f) {
  constexpr int pieces = 3000;
  constexpr std::array<double, 3> node{-0.7745966692414834, 0.0, 0.7745966692414834};
  constexpr std::array<double, 3> weight{5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
  const double width = upper / pieces;
  double sum = 0.0;
  for (int k = 0; k < pieces; ++k)
    for (std::size_t q = 0; q < 3; ++q) {
      const double r = width * (k + 0.5 + 0.5 * node[q]);
      sum += 0.5 * width * weight[q] * f(r) * unit_sphere<D>() * std::pow(r, D - 1);
    }
  return sum;
}

template <class K>
class KernelTest : public testing::Test {};

template <template <int> class K, int D>
struct Dimensioned {
  using Kernel = K<D>;
  static constexpr int dimension = D;
};
using Kernels = testing::Types<Dimensioned<QuinticSpline, 1>, Dimensioned<QuinticSpline, 2>,
                               Dimensioned<QuinticSpline, 3>, Dimensioned<WendlandC2, 1>,
                               Dimensioned<WendlandC2, 2>, Dimensioned<WendlandC2, 3>>;
TYPED_TEST_SUITE(KernelTest, Kernels);

TYPED_TEST(KernelTest, IntegratesToOne) {
  constexpr int D = TypeParam::dimension;
  for (const double h : {0.006, 1.0, 2.5}) {
    const typename TypeParam::Kernel kernel(h);
    const double integral = radial_integral<D>(TypeParam::Kernel::support * h,
                                               [&](double r) { return kernel.value(r); });
    EXPECT_NEAR(integral, 1.0, 1e-11) << "h = " << h;
  }
}

TYPED_TEST(KernelTest, DerivativeMatchesFiniteDifference) {
  const double h = 0.7;
  const typename TypeParam::Kernel kernel(h);
  const double scale = kernel.value(0.0) / h;
  for (double q = 0.05; q < TypeParam::Kernel::support; q += 0.0831) {
    const double r = q * h;
    const double step = 1e-5 * h;
    const double difference = (kernel.value(r + step) - kernel.value(r - step)) / (2.0 * step);
    EXPECT_NEAR(kernel.derivative(r), difference, 2e-9 * scale) << "R = " << q;
  }
  EXPECT_NEAR(kernel.derivative(0.0), 0.0, 1e-14 * scale);
}

// The gradient's first moment: int -dW/dr r dV = D, which makes the gradient of linear fields
// exact.
TYPED_TEST(KernelTest, GradientReproducesLinearFields) {
  constexpr int D = TypeParam::dimension;
  const double h = 0.3;
  const typename TypeParam::Kernel kernel(h);
  const double moment = radial_integral<D>(TypeParam::Kernel::support * h,
                                           [&](double r) { return -kernel.derivative(r) * r; });
  EXPECT_NEAR(moment, D, 1e-10);
}

TYPED_TEST(KernelTest, VanishesBeyondItsSupport) {
  const double h = 0.2;
  const typename TypeParam::Kernel kernel(h);
  for (const double q : {1.0, 1.0001, 7.0, 1e15}) {
    EXPECT_EQ(kernel.value(q * TypeParam::Kernel::support * h * (1.0 + 1e-12)), 0.0);
    EXPECT_EQ(kernel.derivative(q * TypeParam::Kernel::support * h * (1.0 + 1e-12)), 0.0);
  }
}

TYPED_TEST(KernelTest, VectorsGiveTheSameAsScalars) {
  const typename TypeParam::Kernel kernel(0.4);
  alignas(64) std::array<double, simd_width> r;
  for (std::size_t k = 0; k < simd_width; ++k) r[k] = 0.01 + 0.17 * static_cast<double>(k);
  const Simd value = kernel.value(load(r.data()));
  const Simd derivative = kernel.derivative(load(r.data()));
  for (std::size_t k = 0; k < simd_width; ++k) {
    EXPECT_NEAR(value[k], kernel.value(r[k]), 1e-14 * kernel.value(0.0));
    EXPECT_NEAR(derivative[k], kernel.derivative(r[k]), 1e-13 * kernel.value(0.0));
  }
}

// Errata of the paper: with the factors that it prints after Eq. (18), the kernel does not
// integrate to one in 1D and 3D.
TEST(PaperErrata, NormalisationOfTheQuinticSpline) {
  const double h = 1.0;
  const auto integral_with = [&]<int D>(double printed) {
    const QuinticSpline<D> kernel(h);
    return printed / quintic_spline_normalisation<D>() *
           radial_integral<D>(3.0 * h, [&](double r) { return kernel.value(r); });
  };
  EXPECT_NEAR((integral_with.template operator()<1>(120.0)), 14400.0, 1e-6);
  EXPECT_NEAR((integral_with.template operator()<2>(7.0 / (478.0 * pi))), 1.0, 1e-11);
  EXPECT_NEAR((integral_with.template operator()<3>(3.0 / (359.0 * pi))), 1.00279, 1e-5);
}

// The paper: the weight function grows without bound as r -> 0, which keeps particles apart.
TEST(MpsWeight, ValuesAndLimits) {
  EXPECT_DOUBLE_EQ(mps_weight(1.0, 2.1), 1.1);
  EXPECT_DOUBLE_EQ(mps_weight(2.1, 2.1), 0.0);
  EXPECT_EQ(mps_weight(2.2, 2.1), 0.0);
  EXPECT_NEAR(mps_weight(2.1 * (1.0 - 1e-12), 2.1), 0.0, 1e-11);
  EXPECT_GT(mps_weight(1e-12, 2.1), 1e12);
}

// Eq. (8): the moments of w give re^2/6 in 2D, where the paper prints re^2/12.
TEST(PaperErrata, LambdaByIntegration) {
  const double re = 4.0;
  const double second = radial_integral<2>(re, [&](double r) { return mps_weight(r, re) * r * r; });
  const double zeroth = radial_integral<2>(re, [&](double r) { return mps_weight(r, re); });
  EXPECT_NEAR(second / zeroth, re * re / 6.0, 1e-9);
  const double second_3d =
      radial_integral<3>(re, [&](double r) { return mps_weight(r, re) * r * r; });
  const double zeroth_3d = radial_integral<3>(re, [&](double r) { return mps_weight(r, re); });
  EXPECT_NEAR(second_3d / zeroth_3d, 0.3 * re * re, 1e-9);
}

}  // namespace
}  // namespace surge
