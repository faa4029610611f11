#include "compare/read/particle_reader.hpp"

#include <algorithm>
#include <cmath>

#include "compare/read/frame_watch.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

bool finite(const Vec3& x) {
  return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
}

/// The axes of the files without a word about them.
FileAxes file_axes(const SourceOptions& options) {
  return options.axes.value_or(FileAxes{});
}

}  // namespace

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
                                  seconds_text(Seconds(*stated)) + ", --time-step makes it " +
                                  seconds_text(time));
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
  if (wants_pressure(fields)) names.push_back(options_.pressure_array);
  if (wants_velocity(fields))
    names.insert(names.end(), velocity_.names.begin(), velocity_.names.end());
  return names;
}

void ParticleSeries::append(ParticleFrame& frame, const SeriesEntry& entry, const fs::path& file,
                            Fields fields) {
  const auto index = static_cast<std::size_t>(&entry - entries_.data());
  const ParticleTable table = entry.files.size() == 1
                                  ? ahead_.read(entries_, index, wanted(fields), options_)
                                  : read_table(file, entry.part, wanted(fields), options_);
  for (const std::string& note : table.notes) notes_[note][index] = file.filename().string();
  // Our frames state their times: files that were swapped show here.
  if (options_.time_stated && table.time) {
    const double expected = frame.time.value();
    if (std::abs(*table.time - expected) > 1e-6 * std::abs(expected) + 1e-12)
      throw Error(file.string() + ": a frame of " + number_text(*table.time) + " s found, one of " +
                  number_text(expected) + " s expected (its place in particles.pvd)");
  }
  std::vector<bool> is_fluid(table.count, true);
  if (!options_.all_fluid && (options_.type_required || table.find(options_.type_array)))
    is_fluid = FluidTypes(options_).fluid(require_array(table, options_.type_array, 1, file), file);
  const ParticleArray* pressure =
      wants_pressure(fields) ? &require_numbers(table, options_.pressure_array, 1, file) : nullptr;
  const std::vector<Vec3> position = positions(table, position_, file);
  std::vector<Vec3> velocity;
  if (wants_velocity(fields)) velocity = vectors(table, velocity_, file);
  const FileAxes axes = file_axes(options_);
  const FileUnits& units = options_.units;
  const auto scaled = [&](const Vec3& x, double unit) {
    return axes.apply({unit * x[0], unit * x[1], unit * x[2]});
  };
  for (std::size_t i = 0; i < table.count; ++i) {
    if (!is_fluid[i]) continue;
    if (!finite(position[i])) {
      ++frame.nonfinite;
      continue;
    }
    frame.position.push_back(scaled(position[i], units.length));
    if (pressure) frame.pressure.push_back(units.pressure * pressure->values[i]);
    if (wants_velocity(fields)) frame.velocity.push_back(scaled(velocity[i], units.speed()));
  }
}

Frame ParticleSeries::read(std::size_t index, Fields fields) {
  ParticleFrame frame;
  frame.time = times_.at(index);
  asked_.pressure = asked_.pressure || fields.pressure;
  asked_.velocity = asked_.velocity || fields.velocity;
  const SeriesEntry& entry = entries_[index];
  for (const fs::path& file : entry.files) append(frame, entry, file, fields);
  watch_.look(frame, index, entry.files[0].string(),
              " (array " + options_.type_array + ", value " + FluidTypes(options_).text() + ")");
  return frame;
}

void ParticleSeries::expect(Metres spacing, const std::optional<Extent>& tank) {
  watch_.expect(spacing, tank);
}

std::vector<std::string> ParticleSeries::notices() const {
  std::vector<std::string> lines = series_notices_;
  if (asked_.pressure && !wants_pressure(asked_))
    lines.emplace_back("the files hold no pressure by a usual name (--pressure-array)");
  if (asked_.velocity && !wants_velocity(asked_))
    lines.emplace_back("the files hold no velocity by a usual name (--velocity-array)");
  for (const auto& [note, files] : notes_)
    lines.push_back(files.begin()->second +
                    (files.size() > 1 ? " and " + std::to_string(files.size() - 1) + " more" : "") +
                    ": " + note);
  for (std::string& line : watch_.notices(times_)) lines.push_back(std::move(line));
  return lines;
}

std::unique_ptr<FrameReader> open_particle_series(std::vector<SeriesEntry> entries,
                                                  const SourceOptions& options) {
  return std::make_unique<ParticleSeries>(std::move(entries), options);
}

}  // namespace surge::compare
