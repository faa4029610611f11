#include "compare/library/surgefront.hpp"

#include <algorithm>
#include <cmath>

#include "compare/measure/measure_all.hpp"
#include "compare/measure/registry.hpp"
#include "compare/read/memory_series.hpp"
#include "compare/study/baseline_check.hpp"
#include "compare/study/metrics.hpp"
#include "compare/study/quantities.hpp"
#include "particle/support/error.hpp"

namespace surgefront {

namespace sc = surge::compare;

namespace {

/// What surge::Error says, as the public kind of error.
auto translated(const auto& action) {
  try {
    return action();
  } catch (const surge::Error& error) {
    throw Error(error.what());
  }
}

double positive(const Flow& flow, const char* what, double value) {
  if (!std::isfinite(value) || value <= 0.0)
    throw Error(flow.name + ": " + what + ": found " + std::to_string(value) +
                ", expected a positive number");
  return value;
}

sc::SourceOptions options_of(const Flow& flow) {
  sc::SourceOptions options;
  const auto length = [&](const char* what, const std::optional<double>& value) {
    return value ? std::optional(sc::Metres(positive(flow, what, *value))) : std::nullopt;
  };
  options.spacing = length("spacing", flow.spacing);
  options.gravity = positive(flow, "gravity", flow.gravity);
  options.column_width = length("column_width", flow.column_width);
  options.column_height = length("column_height", flow.column_height);
  options.tank_width = length("tank_width", flow.tank_width);
  options.tank_height = length("tank_height", flow.tank_height);
  options.bed_depth = length("bed_depth", flow.bed_depth);
  if (flow.density) options.density = positive(flow, "density", *flow.density);
  if (flow.dimension != 0 && flow.dimension != 2 && flow.dimension != 3)
    throw Error(flow.name + ": dimension: found " + std::to_string(flow.dimension) +
                ", expected 2, 3 or 0");
  if (flow.dimension != 0) options.dimension = flow.dimension;
  options.axes = sc::FileAxes::parse(flow.axes, flow.name + ": axes");
  return options;
}

std::vector<sc::Vec3> vectors(std::span<const double> values) {
  std::vector<sc::Vec3> list;
  for (std::size_t i = 0; i + 2 < values.size(); i += 3)
    list.push_back({values[i], values[i + 1], values[i + 2]});
  return list;
}

}  // namespace

struct Frames::State {
  Flow flow;
  sc::SourceOptions options;
  std::vector<sc::ParticleFrame> frames;
  std::vector<std::string> notices;

  [[nodiscard]] sc::Run open() const { return sc::open_memory(flow.name, frames, options); }
  [[nodiscard]] sc::FrontOptions front() const {
    return {.strip_height = sc::Metres(flow.strip_height)};
  }
  void keep(const std::vector<std::string>& lines) {
    for (const std::string& line : lines)
      if (std::find(notices.begin(), notices.end(), line) == notices.end()) notices.push_back(line);
  }
  void keep(const sc::ObservedRun& source) {
    keep(source.run.notices);
    for (const sc::Findings& found : source.found) keep(found.notices);
  }
};

Frames::Frames(const Flow& flow)
    : state_(std::make_unique<State>(
          State{flow, translated([&] { return options_of(flow); }), {}, {}})) {
  positive(flow, "strip_height", flow.strip_height);
}
Frames::~Frames() = default;
Frames::Frames(Frames&&) noexcept = default;
Frames& Frames::operator=(Frames&&) noexcept = default;

void Frames::add(double time, std::span<const double> position, std::span<const double> velocity,
                 std::span<const double> pressure) {
  const std::string place = state_->flow.name + ": frame of " + std::to_string(time) + " s: ";
  if (!std::isfinite(time) ||
      (!state_->frames.empty() && time <= state_->frames.back().time.value()))
    throw Error(place + "expected a finite time after that of the last frame");
  if (position.empty() || position.size() % 3 != 0)
    throw Error(place + "found " + std::to_string(position.size()) +
                " numbers of positions, expected three for each particle");
  if (!velocity.empty() && velocity.size() != position.size())
    throw Error(place + "found " + std::to_string(velocity.size()) +
                " numbers of velocities, expected " + std::to_string(position.size()) + " or none");
  if (!pressure.empty() && 3 * pressure.size() != position.size())
    throw Error(place + "found " + std::to_string(pressure.size()) + " pressures, expected " +
                std::to_string(position.size() / 3) + " or none");
  sc::ParticleFrame frame;
  frame.time = sc::Seconds(time);
  frame.position = vectors(position);
  frame.velocity = vectors(velocity);
  frame.pressure.assign(pressure.begin(), pressure.end());
  state_->frames.push_back(std::move(frame));
}

std::size_t Frames::size() const {
  return state_->frames.size();
}

std::vector<Series> Frames::measure(const std::vector<std::string>& observables) {
  return translated([&] {
    const sc::ObservedRun source = sc::observe(state_->open(), state_->front(), observables);
    state_->keep(source);
    std::vector<Series> all;
    for (const sc::Findings& found : source.found) {
      if (found.failure) throw surge::Error(*found.failure);
      for (const sc::TimeSeries& series : found.series) {
        Series& plain = all.emplace_back(Series{series.name, series.unit, {}, series.values});
        for (const sc::Seconds t : series.times) plain.time.push_back(t.value());
      }
    }
    return all;
  });
}

Difference Frames::difference(const std::string& reference) {
  return translated([&] {
    const sc::MeasuredRun run = sc::measure(state_->open(), state_->front());
    const sc::MeasuredRun other = sc::measure(sc::open_run(reference), state_->front());
    state_->keep(run.run.notices);
    state_->keep(other.run.notices);
    sc::require_same_physics(
        sc::compare_physics(run.run.physics, run.run.name, other.run.physics, other.run.name), {});
    const sc::FrontDifference d = sc::difference(
        run.front, other.front, sc::wall_rule(other.run, sc::DimensionlessLength(0.1)));
    return Difference{d.rms, d.maximum, d.bias, d.window.begin.value(), d.window.end.value()};
  });
}

std::vector<Finding> Frames::check(const std::string& baseline_file) {
  return translated([&] {
    const sc::Baseline baseline = sc::read_baseline(baseline_file);
    const sc::ObservedRun source =
        sc::observe(state_->open(), baseline.front, baseline.observables());
    state_->keep(source);
    std::vector<Finding> findings;
    for (const sc::Finding& f : sc::check(source, baseline).findings)
      findings.push_back({f.quantity, f.status == sc::Status::passed, f.worst, f.found, f.expected,
                          f.unit, f.why});
    return findings;
  });
}

void Frames::bless(const std::string& baseline_file, const std::string& reason,
                   const std::vector<std::string>& observables) {
  translated([&] {
    const sc::Provenance now = sc::provenance_now(reason);
    sc::BlessOptions options;
    options.front = state_->front();
    sc::ObservedRun source = sc::observe(state_->open(), options.front, observables);
    const sc::Baseline baseline = sc::bless(source, options, now);
    state_->keep(source);
    sc::write_baseline(baseline_file, baseline);
    return 0;
  });
}

const std::vector<std::string>& Frames::notices() const {
  return state_->notices;
}

}  // namespace surgefront
