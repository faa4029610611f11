#include "compare/measure/height.hpp"
#include "compare/measure/kinds.hpp"
#include "compare/measure/stated.hpp"

/// Height of the water at a place, and of the column at its wall: water_height() over time.
namespace surge::compare {
namespace {

class Gauge : public FrameObservable {
 public:
  Gauge(const Place& place, const std::string& name)
      : FrameObservable({{name, "m"}}), place_(place) {}

 protected:
  [[nodiscard]] Values measure(FrameView& frame) override { return {water_height(frame, place_)}; }

 private:
  Place place_;
};

std::unique_ptr<Observable> make_gauge(Parameters& parameters, const std::string& name,
                                       const ObservableContext& context) {
  const Physics& physics = context.run.physics;
  const std::size_t across = physics.vertical_axis() == 1 ? 2 : 1;
  if (const auto gauge = parameters.text("name")) {
    const Vec3 at = stated_place(context.run, "gauges", *gauge, name);
    Place place{at[0], {}};
    if (physics.dimension == 3) place.across = at[across];
    return std::make_unique<Gauge>(place, name);
  }
  Place place{parameters.required("x"), {}};
  if (physics.dimension == 3) place.across = parameters.number(std::string(1, "xyz"[across]));
  return std::make_unique<Gauge>(place, name);
}

/// At the wall that the column stands at, in 3D over the whole width: at the start the height H of
/// the column.
std::unique_ptr<Observable> make_column_height(Parameters& parameters, const std::string& name,
                                               const ObservableContext& context) {
  (void)parameters;
  return std::make_unique<Gauge>(Place{context.run.physics.column_wall(), {}}, name);
}

}  // namespace

ObservableKind gauge_kind() {
  return {"gauge", "height of the water at a place, above the tank's floor, m",
          "x (m); in 3D the level axis across, z or y (m): without it over the whole width; or "
          "name, of "
          "a gauge of the case",
          make_gauge};
}

ObservableKind column_height_kind() {
  return {"column-height", "height of the water at the wall that the column stands at, m", "",
          make_column_height};
}

}  // namespace surge::compare
