#include "particle/isph/pressure_equation.hpp"

#include "particle/isph/gradient.hpp"

namespace surge::isph {
namespace {

/// What balances gravity between a particle and its neighbour, at the middle between them; for a
/// wall g - a_w, by which it knows how steep the pressure is that keeps water away from it. Water
/// is not itself accelerated by the wall: only by that pressure.
template <int D>
Vec<D> head_of_pair(const View<D>& view, std::size_t i, const Vec<D>& d,
                    const BodyAcceleration<D>& still,
                    const std::array<Field, D>& wall_acceleration) {
  Vec<D> g = still.uniform;
  if (still.turns) {
    Vec<D> middle = view.p.position(i);
    for (int a = 0; a < D; ++a) middle[a] += 0.5 * d[a];
    g = still.at(middle);
  }
  if (wall_acceleration[0].empty()) return g;
  if (!view.is_fluid(i))
    for (int a = 0; a < D; ++a) g[a] -= wall_acceleration[a][i];
  return g;
}

}  // namespace

template <int D>
PressureEquation<D>::PressureEquation(const Model<D>& model, std::vector<Vec<D>> wall_normal)
    : wall_normal_(std::move(wall_normal)) {
  system_.dimension = D;
  system_.spacing = model.spacing;
  system_.mean_square = model.mean_square;
}

template <int D>
void PressureEquation<D>::number_entries(const View<D>& view, std::size_t unknowns) {
  system_.row_start.resize(unknowns + 1);
  system_.diagonal.resize(unknowns);
  system_.rhs.resize(unknowns);
  for (int a = 0; a < D; ++a) system_.x[a].resize(unknowns);
  system_.row_start[0] = 0;
  view.for_each([&](std::size_t i) {
    if (view.unknown[i] < 0) return;
    std::int32_t entries = 0;
    view.for_each_neighbour(i, [&](std::size_t j, const Vec<D>&, double) {
      entries += view.unknown[j] >= 0 && couples(view, i, j) ? 1 : 0;
    });
    system_.row_start[static_cast<std::size_t>(view.unknown[i]) + 1] = entries;
  });
  for (std::size_t k = 0; k < unknowns; ++k) system_.row_start[k + 1] += system_.row_start[k];
  const auto entries = static_cast<std::size_t>(system_.row_start[unknowns]);
  system_.column.resize(entries);
  system_.value.resize(entries);
}

template <int D>
const linear::PoissonSystem& PressureEquation<D>::assemble(
    const View<D>& view, std::size_t unknowns, const BodyAcceleration<D>& still,
    const std::array<Field, D>& wall_acceleration, double dt) {
  number_entries(view, unknowns);
  with_kernel(view.model, [&](const auto& kernel) {
    view.for_each([&](std::size_t i) {
      if (view.unknown[i] >= 0) fill_row(view, kernel, i, still, wall_acceleration, dt);
    });
  });
  return system_;
}

template <int D>
template <class K>
void PressureEquation<D>::fill_row(const View<D>& view, const K& kernel, std::size_t i,
                                   const BodyAcceleration<D>& still,
                                   const std::array<Field, D>& wall_acceleration, double dt) {
  const auto row = static_cast<std::size_t>(view.unknown[i]);
  auto entry = static_cast<std::size_t>(system_.row_start[row]);
  double diagonal = 0.0;
  double source = 0.0;
  view.for_each_neighbour(i, [&](std::size_t j, const Vec<D>& d, double r) {
    if (!couples(view, i, j)) return;
    // Each entry as it is stored: rows and right side must agree to the last bit.
    const auto stored = static_cast<float>(2.0 * view.model.laplacian_factor *
                                           gradient_weight(view.model, kernel, r));
    const auto weight = static_cast<double>(stored);
    const Vec<D> g = head_of_pair<D>(view, i, d, still, wall_acceleration);
    double head = 0.0;
    for (int a = 0; a < D; ++a) head += g[a] * d[a];
    // A wall without water near takes no part; it has none to couple with, either.
    diagonal += weight;
    source -= view.model.rho * head * weight;
    if (view.unknown[j] < 0) {
      source += weight * view.p.pressure[j];
      return;
    }
    system_.column[entry] = view.unknown[j];
    system_.value[entry] = -stored;
    ++entry;
  });
  if (view.is_fluid(i))
    source -=
        view.model.rho / dt * divergence_to_remove(view, kernel, i, still, wall_acceleration, dt);
  system_.diagonal[row] = diagonal;
  system_.rhs[row] = source;
  for (int a = 0; a < D; ++a) system_.x[a][row] = view.p.x[a][i];
}

/// Divergence of the velocity that this step's pressure takes back, 1/s, without what the body
/// force has just added to the fluid and the walls' own acceleration, which stand in the pairs.
/// What this step's motion has made, -dt tr(grad v grad v), goes at once, the rest within
/// divergence_time (Baumgarte 1972, Comput. Methods Appl. Mech. Eng. 1).
template <int D>
template <class K>
double PressureEquation<D>::divergence_to_remove(const View<D>& view, const K& kernel,
                                                 std::size_t i, const BodyAcceleration<D>& still,
                                                 const std::array<Field, D>& wall_acceleration,
                                                 double dt) const {
  const Particles<D>& p = view.p;
  const auto velocity = [&](std::size_t k) {
    Vec<D> v = p.velocity(k);
    if (view.is_fluid(k)) {
      const Vec<D> g = still.at(p.position(k));
      for (int a = 0; a < D; ++a) v[a] -= dt * g[a];
    } else if (!wall_acceleration[0].empty()) {
      for (int a = 0; a < D; ++a) v[a] -= dt * wall_acceleration[a][k];
    }
    return v;
  };
  const Vec<D> own = velocity(i);
  const auto relative = [&](std::size_t j) {
    Vec<D> v = velocity(j);
    for (int a = 0; a < D; ++a) v[a] -= own[a];
    if (view.is_fluid(j) || wall_normal_.empty()) return v;
    const Vec<D>& n = wall_normal_[static_cast<std::size_t>(p.id[j])];
    double along = 0.0;
    for (int a = 0; a < D; ++a) along += v[a] * n[a];
    for (int a = 0; a < D; ++a) v[a] = along * n[a];
    return v;
  };
  const auto gradient =
      vector_gradient(view, kernel, i, relative, [](std::size_t) { return true; });
  if (!gradient) return 0.0;
  double divergence = 0.0;
  for (int a = 0; a < D; ++a) divergence += (*gradient)[a][a];
  if (dt >= view.model.divergence_time) return divergence;
  double made = 0.0;
  for (int a = 0; a < D; ++a)
    for (int b = 0; b < D; ++b) made -= dt * (*gradient)[a][b] * (*gradient)[b][a];
  return made + dt / view.model.divergence_time * (divergence - made);
}

template class PressureEquation<2>;
template class PressureEquation<3>;

}  // namespace surge::isph
