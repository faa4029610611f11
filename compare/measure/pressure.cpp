#include <algorithm>
#include <cmath>

#include "compare/measure/kinds.hpp"
#include "compare/measure/measure_tool.hpp"
#include "compare/measure/open_space.hpp"
#include "compare/measure/recorded.hpp"
#include "compare/measure/recorded_observable.hpp"
#include "compare/measure/stated.hpp"
#include "compare/measure/wall_pressure.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

/// Pressure at a probe, Pa. In this order, the first that there is:
/// 1. what surge-particle recorded at every step, a column of steps.csv: of the probe of that name,
/// or
///    of one within a tenth of a spacing of the place;
/// 2. what OpenFOAM recorded, postProcessing/NAME/*/p, of the function object of that name (or of
///    that name written wallPressure for wall_pressure) or with a probe at the place;
/// 3. what DualSPHysics' MeasureTool has written of the place beside the run's files;
/// 4. the pressure in the frames, over a box around the place,
///      p = int_B f p dV / max(int_B f dV, 3/4 int_B dV),  B = place +- s along each axis,
///    f the water as in height.hpp, over what of B is neither wall nor obstacle; s is a spacing or
///    a cell, or half the diameter of the probe where that is more. Where water covers less than
///    three quarters of B the rest is dry and counts with no pressure, as on the face of a sensor.
/// `average` filters in time: the mean over that interval around each value, linear between values;
/// times whose interval is not covered have none.
namespace surge::compare {
namespace {

constexpr double covered = 0.75;  ///< part of the box from which on it counts as wet

struct Filter {
  double interval = 0.0;  ///< s; 0: none

  [[nodiscard]] TimeSeries apply(TimeSeries series) const {
    if (interval <= 0.0 || series.values.size() < 2 || series.absent() > 0) return series;
    std::vector<double> time, value;
    for (std::size_t i = 0; i < series.values.size(); ++i) {
      time.push_back(series.times[i].value());
      value.push_back(*series.values[i]);
    }
    const PressureSignal signal(time, value);
    for (std::size_t i = 0; i < time.size(); ++i) {
      const bool known = signal.covers(time[i] - 0.5 * interval, time[i] + 0.5 * interval);
      series.values[i] = known ? std::optional(signal.mean(time[i], interval)) : std::nullopt;
    }
    return series;
  }
};

class FramePressure : public FrameObservable {
 public:
  FramePressure(const Vec3& place, double diameter, const Filter& filter, const std::string& name)
      : FrameObservable({{name, "Pa"}}), place_(place), radius_(0.5 * diameter), filter_(filter) {
    tell(name + ": nothing was recorded there; taken from the pressure in the frames");
  }
  [[nodiscard]] Fields fields() const override { return {.pressure = true}; }

  [[nodiscard]] Findings findings() override {
    Findings found = FrameObservable::findings();
    found.series.front() = filter_.apply(std::move(found.series.front()));
    return found;
  }

 protected:
  [[nodiscard]] Values measure(FrameView& frame) override {
    if (!frame.has_pressure()) return {std::nullopt};
    if (!is_inside(frame, place_))
      throw Error(so_far().series.front().name +
                  ": found a place outside of the tank, expected one "
                  "inside");
    const Vec3 half = resolution_at(frame, place_);
    Extent box;
    for (const std::size_t a : frame.axes()) {
      box.lower[a] = place_[a] - std::max(half[a], radius_);
      box.upper[a] = place_[a] + std::max(half[a], radius_);
    }
    double water = 0.0, load = 0.0, open = 0.0;
    for (std::size_t i = 0; i < frame.size(); ++i) {
      const double part = shared_volume(frame.box(i), box, frame.axes()) * frame.fraction(i);
      if (part <= 0.0) continue;
      water += part;
      load += part * frame.pressure(i);
    }
    for_each_open(frame, box.upper[frame.up()], [&](const Extent& space, double part) {
      open += part * shared_volume(space, box, frame.axes());
    });
    const double area = std::max(water, covered * open);
    return {area > 0.0 ? std::optional(load / area) : std::nullopt};
  }

 private:
  Vec3 place_;
  double radius_;
  Filter filter_;
};

std::unique_ptr<Observable> recorded(const Recorded& table, std::size_t column,
                                     const std::string& from, const Filter& filter,
                                     const std::string& name) {
  TimeSeries series{name, "Pa", {}, {}};
  for (const double time : table.time) series.times.emplace_back(time);
  for (const double value : table.values[column]) series.values.emplace_back(value);
  Findings found;
  found.series.push_back(filter.apply(std::move(series)));
  found.notices.push_back(name + ": as recorded by " + from);
  return std::make_unique<RecordedObservable>(std::move(found));
}

bool is_at(const Vec3& a, const Vec3& b, const std::vector<std::size_t>& axes, double spacing) {
  double square = 0.0;
  for (const std::size_t k : axes) square += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(square) <= 0.1 * spacing;
}

/// "wallPressure" of "wall_pressure": how OpenFOAM's names are usually written.
std::string camel_case(const std::string& name) {
  std::string out;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] == '_' && i + 1 < name.size()) {
      out += static_cast<char>(std::toupper(static_cast<unsigned char>(name[++i])));
    } else {
      out += name[i];
    }
  }
  return out;
}

struct Request {
  std::string name;  ///< of the result
  std::optional<std::string> probe;
  std::optional<Vec3> place;
  Filter filter;
};

std::unique_ptr<Observable> of_particle_run(const Run& run, const Request& request,
                                            const std::vector<std::size_t>& axes) {
  for (const StatedPlace& probe : stated_places(run, "probes")) {
    const bool wanted = request.probe
                            ? probe.name == *request.probe
                            : is_at(probe.place, *request.place, axes, run.spacing.value());
    if (!wanted) continue;
    return recorded(read_recorded_csv(run.path / "steps.csv", {probe.name}), 0,
                    "probe " + probe.name, request.filter, request.name);
  }
  return nullptr;
}

std::unique_ptr<Observable> of_foam_case(const Run& run, const Request& request,
                                         const std::vector<std::size_t>& axes) {
  const std::string stated = request.probe ? recording_object(run, "probes", *request.probe) : "";
  for (const std::string& object : foam_function_objects(run, "p")) {
    if (request.probe && object != *request.probe && object != camel_case(*request.probe) &&
        object != stated)
      continue;
    const FoamProbes probes = read_foam_probes(run, object);
    if (request.probe && !request.place && probes.places.size() > 1)
      throw Error(request.name + ": found " + std::to_string(probes.places.size()) +
                  " places in postProcessing/" + object + ", expected x, y (and z) of one of them");
    for (std::size_t k = 0; k < probes.places.size(); ++k) {
      if (request.place && !is_at(probes.places[k], *request.place, axes, run.spacing.value()))
        continue;
      return recorded(probes.pressure, k, "postProcessing/" + object, request.filter, request.name);
    }
  }
  return nullptr;
}

std::unique_ptr<Observable> of_tables(const Run& run, const Request& request,
                                      const std::vector<std::size_t>& axes) {
  const auto column = measure_tool_column(run, "Press", *request.place, axes);
  if (!column) return nullptr;
  if (column->unit != "Pa")
    throw Error(column->file.string() + ": found the unit \"" + column->unit +
                "\" of Press, expected Pa");
  return recorded({column->time, {column->values}}, 0, column->file.filename().string(),
                  request.filter, request.name);
}

std::unique_ptr<Observable> make_pressure(Parameters& parameters, const std::string& name,
                                          const ObservableContext& context) {
  const Run& run = context.run;
  const FrameView view(run.physics, run.spacing);
  Request request{name,
                  parameters.text("name"),
                  {},
                  {parameters.number("average", Bounds::above(0.0)).value_or(0.0)}};
  const double diameter = parameters.number("diameter", Bounds::above(0.0)).value_or(0.0);
  Vec3 place{};
  std::size_t given = 0;
  for (const std::size_t a : view.axes()) {
    const auto coordinate = parameters.number(std::string(1, "xyz"[a]));
    if (coordinate) ++given;
    place[a] = coordinate.value_or(0.0);
  }
  if (given == view.axes().size()) request.place = place;
  if (given > 0 && !request.place)
    parameters.fail(
        "x, y, z", std::to_string(given) + " of them",
        std::to_string(view.axes().size()) + " in " + std::to_string(run.physics.dimension) + "D");
  if (!request.place && !request.probe)
    parameters.fail("name", "nothing", "the name of a probe, or its place");
  if (context.planned) {
    if (!request.place) require_stated(run, "probes", *request.probe, name);
    return nullptr;
  }
  auto found = run.is_mesh() ? of_foam_case(run, request, view.axes())
                             : of_particle_run(run, request, view.axes());
  if (!found && request.place) found = of_tables(run, request, view.axes());
  if (found) return found;
  if (!request.place)
    parameters.fail("name", "no probe \"" + *request.probe + "\" recorded by " + run.path.string(),
                    "one that it has, or a place");
  return std::make_unique<FramePressure>(place, diameter, request.filter, name);
}

}  // namespace

ObservableKind pressure_kind() {
  return {"pressure", "pressure at a probe, Pa: as recorded, else from the frames",
          "name of the probe, or x, y (z) (m); diameter (m, from frames), average (s, filter)",
          make_pressure};
}

}  // namespace surge::compare
