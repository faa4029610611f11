#include "compare/measure/height.hpp"
#include "compare/measure/kinds.hpp"
#include "compare/measure/measure_tool.hpp"
#include "compare/measure/recorded_observable.hpp"
#include "compare/measure/stated.hpp"

/// Height of the water at a place, and of the column at its wall: water_height() over time. With
/// `recorded = yes` what DualSPHysics' MeasureTool (-elevation) has written of the place beside the
/// run's files, by a rule of its own, less the height of the floor.
namespace surge::compare {
namespace {

class GaugeObservable : public FrameObservable {
 public:
  GaugeObservable(const Place& place, const std::string& name)
      : FrameObservable({{name, "m"}}), place_(place) {}

 protected:
  [[nodiscard]] Values measure(FrameView& frame) override { return {water_height(frame, place_)}; }

 private:
  Place place_;
};

std::unique_ptr<Observable> recorded_gauge(const ProbeColumn& column, double floor,
                                           const std::string& name) {
  Findings found;
  TimeSeries& series = found.series.emplace_back(TimeSeries{name, "m", {}, {}});
  for (const double time : column.time) series.times.emplace_back(time);
  for (const double value : column.values) series.values.emplace_back(value - floor);
  found.notices.push_back(name + ": as recorded by " + column.file.filename().string());
  return std::make_unique<RecordedObservable>(std::move(found));
}

std::unique_ptr<Observable> make_gauge(Parameters& parameters, const std::string& name,
                                       const ObservableContext& context) {
  const Physics& physics = context.run.physics;
  const std::size_t across = physics.vertical_axis() == 1 ? 2 : 1;
  if (const auto gauge = parameters.text("name")) {
    const Vec3 at = stated_place(context.run, "gauges", *gauge, name);
    Place place{at[0], {}};
    if (physics.dimension == 3) place.across = at[across];
    return std::make_unique<GaugeObservable>(place, name);
  }
  Place place{parameters.required("x"), {}};
  if (physics.dimension == 3) place.across = parameters.number(std::string(1, "xyz"[across]));
  if (const auto recorded = parameters.text("recorded")) {
    if (*recorded != "yes") parameters.fail("recorded", *recorded, "yes, or nothing");
    Vec3 at{place.x, 0.0, 0.0};
    if (place.across) at[across] = *place.across;
    const std::vector<std::size_t> axes =
        place.across ? std::vector<std::size_t>{0, across} : std::vector<std::size_t>{0};
    const auto column = measure_tool_column(context.run, "Elevation", at, axes);
    if (!column)
      parameters.fail("recorded", "no table of MeasureTool with Elevation at that place", "one");
    return recorded_gauge(*column, physics.floor(), name);
  }
  return std::make_unique<GaugeObservable>(place, name);
}

/// At the wall that the column stands at, in 3D over the whole width: at the start the height H of
/// the column.
std::unique_ptr<Observable> make_column_height(Parameters& parameters, const std::string& name,
                                               const ObservableContext& context) {
  (void)parameters;
  return std::make_unique<GaugeObservable>(Place{context.run.physics.column_wall(), {}}, name);
}

}  // namespace

ObservableKind gauge_kind() {
  return {"gauge", "height of the water at a place, above the tank's floor, m",
          "x (m); in 3D the level axis across, z or y (m): without it over the whole width; or "
          "name, of a gauge of the case; recorded = yes: by DualSPHysics' MeasureTool",
          make_gauge};
}

ObservableKind column_height_kind() {
  return {"column-height", "height of the water at the wall that the column stands at, m", "",
          make_column_height};
}

}  // namespace surge::compare
