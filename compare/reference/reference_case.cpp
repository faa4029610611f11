#include <algorithm>
#include <cmath>

#include "compare/reference/reference_series.hpp"
#include "particle/support/error.hpp"
#include "particle/support/table.hpp"

namespace surge::compare {
namespace {

constexpr double case_tolerance = 0.02;  ///< of L

/// A case as seen from the wall that its column stands at, in units of L: x along the surge, then
/// up from the floor, then across from the tank's lower side.
class Seen {
 public:
  explicit Seen(const Physics& physics)
      : physics_(physics),
        up_(static_cast<std::size_t>(physics.vertical_axis())),
        length_(physics.column_width().value()) {}

  [[nodiscard]] Vec3 point(const Vec3& x) const {
    const std::size_t across = 3 - up_;
    const double side = physics_.tank && std::isfinite(physics_.tank->lower[across])
                            ? physics_.tank->lower[across]
                            : physics_.column.lower[across];
    return {physics_.surge_direction() * (x[0] - physics_.column_wall()) / length_,
            (x[up_] - physics_.floor()) / length_, (x[across] - side) / length_};
  }
  [[nodiscard]] Extent box(const Extent& all) const {
    const Vec3 a = point(all.lower), b = point(all.upper);
    Extent out;
    for (std::size_t k = 0; k < 3; ++k) {
      out.lower[k] = std::min(a[k], b[k]);
      out.upper[k] = std::max(a[k], b[k]);
    }
    return out;
  }
  [[nodiscard]] Vec3 velocity(const Vec3& v) const {
    const double speed = std::sqrt(physics_.gravity_magnitude() * length_);
    return {physics_.surge_direction() * v[0] / speed, v[up_] / speed, v[3 - up_] / speed};
  }
  /// Whether a box reaches from side to side of the tank, so that a plane through it is all of it.
  [[nodiscard]] bool spans_width(const Extent& box) const {
    if (physics_.dimension == 2 || !physics_.tank) return true;
    const std::size_t across = 3 - up_;
    const double slack = case_tolerance * length_;
    return box.lower[across] <= physics_.tank->lower[across] + slack &&
           box.upper[across] >= physics_.tank->upper[across] - slack;
  }
  [[nodiscard]] bool is_plane() const {
    const auto spans = [&](const Extent& box) { return spans_width(box); };
    const auto& solids = physics_.obstacles;
    return (!solids || std::all_of(solids->begin(), solids->end(), spans)) &&
           (!physics_.blocks ||
            std::all_of(physics_.blocks->begin(), physics_.blocks->end(),
                        [&](const WaterBody& body) { return spans_width(body.box); }));
  }

 private:
  const Physics& physics_;
  std::size_t up_;
  double length_;
};

std::string unlike(const std::string& what, const std::string& series, const std::string& run) {
  return "of another case: " + what + ": " + series + " in the series, " + run + " in the run";
}
std::string in_lengths(double value) {
  return std::isfinite(value) ? fixed_text(value, 2) + " L" : "not stated";
}

std::optional<std::string> unlike(const std::string& what, double series, double run) {
  if (std::abs(series - run) <= case_tolerance) return std::nullopt;
  return unlike(what, in_lengths(series), in_lengths(run));
}

bool near(const Vec3& a, const Vec3& b, std::size_t axes) {
  for (std::size_t k = 0; k < axes; ++k)
    if (!(std::abs(a[k] - b[k]) <= case_tolerance)) return false;
  return true;
}

/// Whether each of the one list has its like in the other.
template <class Body, class Same>
bool alike(std::vector<Body> a, std::vector<Body> b, const Same& same) {
  if (a.size() != b.size()) return false;
  for (const Body& body : a) {
    const auto found =
        std::find_if(b.begin(), b.end(), [&](const Body& x) { return same(body, x); });
    if (found == b.end()) return false;
    b.erase(found);
  }
  return true;
}

std::optional<std::string> other_bodies(const Physics& series, const Physics& run) {
  const Seen theirs(series), ours(run);
  const std::size_t axes = series.dimension == 3 && run.dimension == 3 ? 3 : 2;
  const auto same_box = [&](const Extent& a, const Extent& b) {
    const Extent x = theirs.box(a), y = ours.box(b);
    return near(x.lower, y.lower, axes) && near(x.upper, y.upper, axes);
  };
  const auto count = [](std::size_t n) { return std::to_string(n); };
  const auto same_solids = [&](const SolidBody& x, const SolidBody& y) {
    if (!x.surface || !y.surface) return !x.surface && !y.surface && same_box(x, y);
    return same_solid(x, y, axes, case_tolerance * x.surface->bounds().upper[0]);
  };
  const std::vector<SolidBody> a = series.obstacles.value_or(std::vector<SolidBody>{});
  if (!run.obstacles && !a.empty()) return unlike("obstacles", count(a.size()), "not stated");
  const std::vector<SolidBody> b = run.obstacles.value_or(std::vector<SolidBody>{});
  if (!alike(a, b, same_solids)) {
    const std::string same = a.size() == b.size() ? " elsewhere" : "";
    return unlike("obstacles", count(a.size()), count(b.size()) + same);
  }
  if (!run.blocks || !series.blocks) return std::nullopt;
  const auto same_body = [&](const WaterBody& x, const WaterBody& y) {
    return x.shape == y.shape && same_box(x.box, y.box) &&
           near(theirs.velocity(x.velocity), ours.velocity(y.velocity), axes);
  };
  if (!alike(*series.blocks, *run.blocks, same_body))
    return unlike("bodies of water", count(series.blocks->size()),
                  count(run.blocks->size()) + " with other places, sizes or velocities");
  return std::nullopt;
}

/// Walls that move along x, such as a piston: they make the flow. Those that are lifted only set it
/// free.
nlohmann::json pistons(const Physics& physics) {
  nlohmann::json found = nlohmann::json::array();
  if (!physics.moving_walls || !physics.moving_walls->is_array()) return found;
  for (const nlohmann::json& wall : *physics.moving_walls) {
    const nlohmann::json direction = wall.value("direction", nlohmann::json::array());
    if (direction.size() == 3 && std::abs(direction[0].get<double>()) > 1e-6) found.push_back(wall);
  }
  return found;
}

std::optional<std::string> other_motion(const Physics& series, const Physics& run) {
  const auto shown = [](const nlohmann::json& value) {
    return value.empty() ? std::string("none") : value.dump();
  };
  const nlohmann::json a = series.motion.value_or(nullptr), b = run.motion.value_or(nullptr);
  if (!same_statement(a, b))
    return unlike("motion of the tank", shown(a), run.motion ? shown(b) : "not stated");
  const nlohmann::json x = pistons(series), y = pistons(run);
  if (!same_statement(x, y)) return unlike("walls that move", shown(x), shown(y));
  return std::nullopt;
}

double height_of(const Physics& physics) {
  const auto up = static_cast<std::size_t>(physics.vertical_axis());
  return physics.column.upper[up] - physics.floor();
}

}  // namespace

std::optional<std::string> other_case(const ReferenceSeries& series, const Physics& run) {
  const Physics& of = series.of;
  const double theirs = of.column_width().value(), ours = run.column_width().value();
  const bool moves = series.of.motion && !series.of.motion->is_null();
  if ((series.of_one_size() || moves) && std::abs(ours / theirs - 1.0) > case_tolerance)
    return unlike("width of the column", fixed_text(theirs, 4) + " m", fixed_text(ours, 4) + " m");
  if (of.dimension != run.dimension && !(Seen(of).is_plane() && Seen(run).is_plane()))
    return unlike("dimension", std::to_string(of.dimension) + "D",
                  std::to_string(run.dimension) + "D");
  if (auto reason = unlike("height of the column", height_of(of) / theirs, height_of(run) / ours))
    return reason;
  const auto far = of.far_wall();
  const auto wall = run.far_wall();
  const bool open = of.open && of.open->contains(of.surge_direction() > 0.0 ? "x+" : "x-");
  if (far && !open) {
    if (auto reason =
            unlike("far wall", far->value() / theirs, wall ? wall->value() / ours : std::nan("")))
      return reason;
  }
  const auto bed = [](const Physics& p) { return p.bed_depth().value_or(Metres(0.0)).value(); };
  if (auto reason = unlike("water in the tank", bed(of) / theirs, bed(run) / ours)) return reason;
  if (auto reason = other_bodies(of, run)) return reason;
  return other_motion(of, run);
}

std::optional<std::string> other_place(const ReferenceSeries& series, const Physics& run,
                                       const std::optional<Vec3>& place, double slack) {
  if (!place || !series.at[0]) return std::nullopt;
  const Symbols symbols = case_symbols(series.of);
  Vec3 at{};
  for (std::size_t a = 0; a < 3; ++a)
    if (series.at[a]) at[a] = evaluate_in(*series.at[a], "m", symbols, series.place + ": place");
  const Vec3 theirs = Seen(series.of).point(at), ours = Seen(run).point(*place);
  const double allowed = std::max(case_tolerance, slack / run.column_width().value());
  constexpr std::array<std::size_t, 3> seen{0, 1, 2};
  const auto up = static_cast<std::size_t>(series.of.vertical_axis());
  const std::array<std::size_t, 3> axis{0, up, 3 - up};
  for (const std::size_t k : seen) {
    if (!series.at[axis[k]] || (k == 2 && run.dimension == 2)) continue;
    if (series.observable == "gauge" && k == 1) continue;
    if (std::abs(theirs[k] - ours[k]) <= allowed) continue;
    constexpr std::array names{"along the surge", "above the floor", "across"};
    return unlike(std::string("place ") + names[k], in_lengths(theirs[k]), in_lengths(ours[k]));
  }
  return std::nullopt;
}

ReferenceCurve curve_for(const ReferenceSeries& series, const Physics& run,
                         const std::string& unit) {
  const Symbols symbols = case_symbols(run);
  const std::string first_in = series.is_profile() ? "m" : "s";
  const auto in = [&](const std::string& text, const std::string& of, const char* key) {
    return evaluate_in(text, of, symbols, series.place + ": " + key);
  };
  const SiValue wanted = evaluate(unit, unit_symbols(), "unit");
  const SiValue value = evaluate(series.value_unit, symbols, series.place + ": value_unit");
  if (!value.same_dimension(wanted))
    throw Error(series.place + ": value_unit: found \"" + series.value_unit + "\" in " +
                dimension_text(value) + ", expected " + dimension_text(wanted) +
                ", the unit of the observable (" + unit + ")");
  const double first = evaluate(series.first_unit, symbols, series.place + ": unit").value;
  const double first_zero = in(series.first_zero, first_in, "zero");
  const double value_zero = in(series.value_zero, unit, "value_zero");
  ReferenceCurve curve;
  for (const ReferenceSeries::Point& point : series.points) {
    curve.first.push_back(first_zero + first * point.first);
    curve.value.push_back(value_zero + value.value * point.value);
    curve.limit.push_back(std::abs(value.value) * point.limit);
  }
  curve.first_limit = first * series.first_uncertainty;
  if (series.at_time) curve.at_time = in(*series.at_time, "s", "at_time");
  if (series.shift_within) curve.shift_within = in(*series.shift_within, "s", "time_shift");
  if (!series.is_profile()) return curve;
  // From the series' own frame to that of the run, which may be mirrored or of another size.
  const double mirror = series.of.surge_direction() * run.surge_direction();
  const double scale = run.column_width().value() / series.of.column_width().value();
  for (double& x : curve.first)
    x = run.column_wall() + mirror * (x - scale * series.of.column_wall());
  if (mirror < 0.0) {
    std::reverse(curve.first.begin(), curve.first.end());
    std::reverse(curve.value.begin(), curve.value.end());
    std::reverse(curve.limit.begin(), curve.limit.end());
  }
  return curve;
}

}  // namespace surge::compare
