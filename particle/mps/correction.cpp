#include "particle/mps/correction.hpp"

#include "particle/mps/gradient.hpp"

namespace surge::mps {

template <int D>
double PressureCorrection<D>::minimum(const View<D>& view, std::size_t i) {
  return neighbourhood_minimum<D>(
      i, view.neighbours(i), view.displacement, view.model.re,
      [&](std::size_t j) { return view.p.pressure[j]; },
      [&](std::size_t j) { return view.has_pressure(j); });
}

template <int D>
void PressureCorrection<D>::find(const View<D>& view, double dt, std::array<Field, D>& correction) {
  const Model<D>& m = view.model;
  const auto pressure = [&](std::size_t j) { return view.p.pressure[j]; };
  const auto least = [&](std::size_t j) { return least_[j]; };
  const auto counts = [&](std::size_t j) { return view.has_pressure(j); };
  const auto set_by = [&](const auto& gradient_at) {
    view.for_each_fluid([&](std::size_t i) {
      const Vec<D> grad = gradient_at(i);
      for (int a = 0; a < D; ++a) correction[a][i] = -dt / m.rho * grad[a];
    });
  };
  const auto plain = [&](std::size_t i) {
    return gradient<D>(i, view.neighbours(i), view.displacement, m.re, m.n0, minimum(view, i),
                       pressure, counts);
  };
  switch (model_) {
    case GradientModel::minimum:
      return set_by(plain);
    case GradientModel::conserving:
      least_.resize(view.p.size());
      view.for_each([&](std::size_t i) {
        if (view.has_pressure(i)) least_[i] = minimum(view, i);
      });
      return set_by([&](std::size_t i) {
        return conserving_gradient<D>(i, view.neighbours(i), view.displacement, m.re, m.n0,
                                      pressure, least, counts);
      });
    case GradientModel::corrected:
      return set_by([&](std::size_t i) {
        const auto exact = corrected_gradient<D>(i, view.neighbours(i), view.displacement, m.re,
                                                 m.n0, trusted_pivot, pressure, counts);
        return exact ? *exact : plain(i);
      });
  }
}

template class PressureCorrection<2>;
template class PressureCorrection<3>;

}  // namespace surge::mps
