#include "compare/read/particle_reader.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "compare/read/first_frame.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

bool finite(const Vec3& x) {
  return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
}

std::string seconds(Seconds time) {
  return number_text(std::round(time.value() * 1e9) / 1e9) + " s";
}

std::size_t fingerprint(const std::vector<Vec3>& position) {
  std::size_t hash = position.size();
  for (const Vec3& x : position)
    for (const double c : x) hash = hash * 1099511628211ULL ^ std::hash<double>()(c);
  return hash;
}

/// How far a particle is outside of a box, m; ends that are not known do not count.
double beyond(const Vec3& x, const Extent& box) {
  double most = 0.0;
  for (std::size_t a = 0; a < 3; ++a) {
    if (std::isfinite(box.upper[a])) most = std::max(most, x[a] - box.upper[a]);
    if (std::isfinite(box.lower[a])) most = std::max(most, box.lower[a] - x[a]);
  }
  return most;
}

/// The axes of the files without a word about them.
FileAxes file_axes(const SourceOptions& options) {
  return options.axes.value_or(FileAxes{});
}

}  // namespace

std::string Sightings::text(const std::vector<Seconds>& times) const {
  if (counts.empty()) return {};
  std::size_t most = 0;
  for (const auto& [frame, count] : counts) most = std::max(most, count);
  return "up to " + std::to_string(most) + " in " + std::to_string(counts.size()) +
         " frames, first at " + seconds(times[counts.begin()->first]);
}

ParticleSeries::ParticleSeries(std::vector<SeriesEntry> entries, const SourceOptions& options)
    : entries_(with_parts(std::move(entries), options)),
      options_(options),
      position_(VectorField::of(options.position_array)),
      velocity_(VectorField::of(options.velocity_array)) {
  if (velocity_.names.size() == position_.names.size()) velocity_.axes = position_.axes;
  find_times();
  for (std::size_t i = 0; i < entries_.size(); ++i)
    if (!times_[i].is_finite() || (i > 0 && times_[i] <= times_[i - 1]))
      throw Error(entries_[i].files[0].string() + ": time " + std::to_string(times_[i].value()) +
                  " s found, a later one than of the file before expected");
  for (std::string& line : irregularities(entries_, times_)) series_notices_.push_back(line);
}

void ParticleSeries::find_times() {
  const double unit = options_.units.time;
  std::map<long long, double> table;
  if (!options_.time_file.empty()) table = read_time_file(options_.time_file);
  const auto first = entries_.front().number;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const SeriesEntry& entry = entries_[i];
    const auto stated = entry.time        ? std::optional(unit * entry.time->value())
                        : entry.part.time ? std::optional(unit * *entry.part.time)
                                          : std::nullopt;
    if (options_.time_step && entry.time)
      throw Error(entry.files[0].string() +
                  ": its collection states times, so --time-step is not for it");
    if (!options_.time_file.empty()) {
      const auto found = entry.number ? table.find(*entry.number) : table.end();
      if (found == table.end())
        throw Error(options_.time_file.string() + ": no time of " +
                    entry.files[0].filename().string() + " found, one for each file expected");
      times_.emplace_back(unit * found->second);
    } else if (options_.time_step) {
      long long count = entry.number.value_or(static_cast<long long>(i));
      if (options_.first_time) count -= first.value_or(0);
      const Seconds time = static_cast<double>(count) * *options_.time_step +
                           options_.first_time.value_or(Seconds(0.0));
      if (stated && std::abs(*stated - time.value()) > 0.01 * options_.time_step->value())
        series_notices_.push_back(entry.files[0].filename().string() + " states the time " +
                                  seconds(Seconds(*stated)) + ", --time-step makes it " +
                                  seconds(time));
      times_.push_back(time);
    } else if (stated) {
      times_.emplace_back(*stated);
    } else {
      throw Error(
          entry.files[0].string() +
          ": no time found (field data TimeValue, TIME, Time or time): one in each file, or "
          "--time-step, the seconds from one number in the names to the next, expected");
    }
  }
}

std::vector<std::string> ParticleSeries::wanted(Fields fields) const {
  std::vector<std::string> names = position_.names;
  if (!options_.all_fluid) names.push_back(options_.type_array);
  if (fields.pressure) names.push_back(options_.pressure_array);
  if (fields.velocity) names.insert(names.end(), velocity_.names.begin(), velocity_.names.end());
  return names;
}

void ParticleSeries::append(ParticleFrame& frame, const SeriesEntry& entry, const fs::path& file,
                            Fields fields) {
  const ParticleTable table = read_table(file, entry.part, wanted(fields), options_);
  for (const std::string& note : table.notes)
    notes_[note][static_cast<std::size_t>(&entry - entries_.data())] = file.filename().string();
  // Our frames state their times: files that were swapped show here.
  if (options_.time_stated && table.time) {
    const double expected = frame.time.value();
    if (std::abs(*table.time - expected) > 1e-6 * std::abs(expected) + 1e-12)
      throw Error(file.string() + ": a frame of " + number_text(*table.time) + " s found, one of " +
                  number_text(expected) + " s expected (its place in particles.pvd)");
  }
  const ParticleArray* type = nullptr;
  if (!options_.all_fluid && (options_.type_required || table.find(options_.type_array)))
    type = &require_array(table, options_.type_array, 1, file);
  const ParticleArray* pressure =
      fields.pressure ? &require_array(table, options_.pressure_array, 1, file) : nullptr;
  const std::vector<Vec3> position = positions(table, position_, file);
  std::vector<Vec3> velocity;
  if (fields.velocity) velocity = vectors(table, velocity_, file);
  const TypeValues fluid = options_.fluid_type.value_or(0);
  const FileAxes axes = file_axes(options_);
  const FileUnits& units = options_.units;
  const auto scaled = [&](const Vec3& x, double unit) {
    return axes.apply({unit * x[0], unit * x[1], unit * x[2]});
  };
  for (std::size_t i = 0; i < table.count; ++i) {
    if (type && !fluid.contain(type->values[i])) continue;
    if (!finite(position[i])) {
      ++frame.nonfinite;
      continue;
    }
    frame.position.push_back(scaled(position[i], units.length));
    if (pressure) frame.pressure.push_back(units.pressure * pressure->values[i]);
    if (fields.velocity) frame.velocity.push_back(scaled(velocity[i], units.speed()));
  }
}

Frame ParticleSeries::read(std::size_t index, Fields fields) {
  ParticleFrame frame;
  frame.time = times_.at(index);
  const SeriesEntry& entry = entries_[index];
  for (const fs::path& file : entry.files) append(frame, entry, file, fields);
  check(frame, index);
  return frame;
}

/// A few lost particles are counted; a frame of which a tenth is not finite is no result.
void ParticleSeries::check(const ParticleFrame& frame, std::size_t index) {
  const std::string file = entries_[index].files[0].string();
  nonfinite_.add(index, frame.nonfinite);
  const std::size_t all = frame.nonfinite + frame.position.size();
  if (10 * frame.nonfinite > all)
    throw Error(file + ": " + std::to_string(frame.nonfinite) + " of " + std::to_string(all) +
                " fluid particles are not finite, at most a tenth expected");
  if (frame.position.empty())
    throw Error(file + ": no fluid particle found (array " + options_.type_array + ", value " +
                options_.fluid_type.value_or(0).text() + "), at least one expected");
  if (!spacing_) return;
  particles_[index] = frame.position.size();
  fingerprints_[index] = fingerprint(frame.position);
  if (frame.position.size() > 1) {
    const double nearest = nearest_distance(frame.position);
    const double ratio = nearest / spacing_->value();
    if (!(ratio > 0.2 && ratio < 2.0))
      throw Error(file + ": particles are " + number_text(nearest) +
                  " m from their nearest neighbour, spacing " + number_text(spacing_->value()) +
                  " m; about one spacing expected in every frame (is one in other units?)");
  }
  if (!tank_) return;
  const auto outside =
      std::count_if(frame.position.begin(), frame.position.end(),
                    [&](const Vec3& x) { return beyond(x, *tank_) > spacing_->value(); });
  outside_.add(index, static_cast<std::size_t>(outside));
}

void ParticleSeries::expect(Metres spacing, const std::optional<Extent>& tank) {
  spacing_ = spacing;
  tank_ = tank;
}

std::vector<std::string> ParticleSeries::notices() const {
  std::vector<std::string> lines = series_notices_;
  for (const auto& [note, files] : notes_)
    lines.push_back(files.begin()->second +
                    (files.size() > 1 ? " and " + std::to_string(files.size() - 1) + " more" : "") +
                    ": " + note);
  if (!nonfinite_.counts.empty())
    lines.push_back("particles that are not finite are left out: " + nonfinite_.text(times_));
  if (!outside_.counts.empty())
    lines.push_back("particles outside of the tank: " + outside_.text(times_));
  Sightings changed;
  for (const auto& [index, count] : particles_) {
    const std::size_t first = particles_.begin()->second;
    changed.add(index, count > first ? count - first : first - count);
  }
  if (!changed.counts.empty()) {
    const auto [index, difference] = *changed.counts.begin();
    lines.push_back(
        "the number of fluid particles changes: " + std::to_string(particles_.begin()->second) +
        " at " + seconds(times_[particles_.begin()->first]) + ", " +
        std::to_string(particles_.at(index)) + " at " + seconds(times_[index]) + "; by " +
        changed.text(times_));
  }
  for (auto here = fingerprints_.begin(); here != fingerprints_.end(); ++here) {
    const auto next = std::next(here);
    if (next != fingerprints_.end() && next->second == here->second)
      lines.push_back("the frames at " + seconds(times_[here->first]) + " and " +
                      seconds(times_[next->first]) + " hold the same particles");
  }
  return lines;
}

std::unique_ptr<FrameReader> open_particle_series(std::vector<SeriesEntry> entries,
                                                  const SourceOptions& options) {
  return std::make_unique<ParticleSeries>(std::move(entries), options);
}

}  // namespace surge::compare
