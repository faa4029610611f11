#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "compare/read/readers.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

vtkDataArray& require_array(vtkPointSet& points, const std::string& name, int components,
                            const fs::path& file) {
  vtkDataArray* array = points.GetPointData()->GetArray(name.c_str());
  if (!array) throw Error(file.string() + ": point array " + name + ": none found, one expected");
  if (array->GetNumberOfComponents() != components ||
      array->GetNumberOfTuples() != points.GetNumberOfPoints()) {
    throw Error(file.string() + ": point array " + name + ": " +
                std::to_string(array->GetNumberOfComponents()) + " components and " +
                std::to_string(array->GetNumberOfTuples()) + " values found, " +
                std::to_string(components) + " and " + std::to_string(points.GetNumberOfPoints()) +
                " expected");
  }
  return *array;
}

class ParticleReader : public FrameReader {
 public:
  ParticleReader(std::vector<SeriesEntry> entries, const SourceOptions& options)
      : entries_(std::move(entries)), options_(options) {
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      times_.push_back(time_of_entry(i));
      if (!times_[i].is_finite() || (i > 0 && times_[i] <= times_[i - 1])) {
        throw Error(entries_[i].files[0].string() + ": time " + std::to_string(times_[i].value()) +
                    " s found, a later one than of the file before expected");
      }
    }
    find_gaps();
  }

  [[nodiscard]] const std::vector<Seconds>& times() const override { return times_; }

  [[nodiscard]] Frame read(std::size_t index, Fields fields) override {
    ParticleFrame frame;
    frame.time = times_.at(index);
    for (const fs::path& file : entries_[index].files) append(frame, file, index, fields);
    count_nonfinite(frame, index);
    if (frame.position.empty()) {
      throw Error(entries_[index].files[0].string() + ": no fluid particle found (array " +
                  options_.type_array + ", value " + std::to_string(options_.fluid_type) +
                  "), at least one expected");
    }
    return frame;
  }

  [[nodiscard]] std::vector<std::string> notices() const override {
    std::vector<std::string> lines = gaps_;
    if (!nonfinite_.empty()) {
      std::size_t most = 0;
      for (const auto& [index, count] : nonfinite_) most = std::max(most, count);
      lines.push_back("particles that are not finite are left out: up to " + std::to_string(most) +
                      " in " + std::to_string(nonfinite_.size()) + " frames, first at " +
                      std::to_string(times_[nonfinite_.begin()->first].value()) + " s");
    }
    return lines;
  }

 private:
  /// A few lost particles are counted; a frame of which a tenth is not finite is no result.
  void count_nonfinite(const ParticleFrame& frame, std::size_t index) {
    if (frame.nonfinite == 0) return;
    nonfinite_[index] = frame.nonfinite;
    const std::size_t all = frame.nonfinite + frame.position.size();
    if (10 * frame.nonfinite <= all) return;
    throw Error(entries_[index].files[0].string() + ": " + std::to_string(frame.nonfinite) +
                " of " + std::to_string(all) +
                " fluid particles are not finite, at most a tenth expected");
  }

  /// Files are often numbered by steps: what most neighbours differ by is the rule, not one.
  void find_gaps() {
    long long stride = std::numeric_limits<long long>::max();
    for (std::size_t i = 1; i < entries_.size(); ++i)
      if (entries_[i].number && entries_[i - 1].number)
        stride = std::min(stride, *entries_[i].number - *entries_[i - 1].number);
    for (std::size_t i = 1; i < entries_.size(); ++i) {
      const auto before = entries_[i - 1].number, here = entries_[i].number;
      if (!before || !here || *here - *before == stride) continue;
      gaps_.push_back("no file between " + entries_[i - 1].files[0].filename().string() + " and " +
                      entries_[i].files[0].filename().string() + ": a gap in the series");
    }
  }

  [[nodiscard]] Seconds time_of_entry(std::size_t i) const {
    if (options_.time_step && entries_[i].time) {
      throw Error(entries_[i].files[0].string() +
                  ": its collection states times, so --time-step is not for it");
    }
    if (options_.time_step) {
      const auto count = entries_[i].number.value_or(static_cast<long long>(i));
      return static_cast<double>(count) * *options_.time_step;
    }
    if (entries_[i].time) return *entries_[i].time;
    const auto time = stated_time(entries_[i].files[0]);
    if (!time) {
      throw Error(
          entries_[i].files[0].string() +
          ": no time found (field data TimeValue, TIME, Time or time): one in each file, or "
          "--time-step, the seconds from one number in the names to the next, expected");
    }
    return *time;
  }

  /// Our frames state their times: files that were swapped show here.
  void check_time(vtkPointSet& points, const fs::path& file, std::size_t index) const {
    if (!options_.time_stated) return;
    vtkDataArray* stated = points.GetFieldData()->GetArray("TimeValue");
    if (!stated || stated->GetNumberOfTuples() < 1) return;
    const double found = stated->GetComponent(0, 0), expected = times_[index].value();
    if (std::abs(found - expected) <= 1e-6 * std::abs(expected) + 1e-12) return;
    throw Error(file.string() + ": a frame of " + number_text(found) + " s found, one of " +
                number_text(expected) + " s expected (its place in particles.pvd)");
  }

  void append(ParticleFrame& frame, const fs::path& file, std::size_t index, Fields fields) const {
    Names names{options_.type_array};
    if (fields.pressure) names.push_back(options_.pressure_array);
    if (fields.velocity) names.push_back(options_.velocity_array);
    const vtkSmartPointer<vtkPointSet> points = read_points(file, names);
    check_time(*points, file, index);
    vtkDataArray* type = nullptr;
    if (options_.type_required || points->GetPointData()->HasArray(options_.type_array.c_str())) {
      type = &require_array(*points, options_.type_array, 1, file);
    }
    vtkDataArray* pressure =
        fields.pressure ? &require_array(*points, options_.pressure_array, 1, file) : nullptr;
    vtkDataArray* velocity =
        fields.velocity ? &require_array(*points, options_.velocity_array, 3, file) : nullptr;
    for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i) {
      if (type && static_cast<int>(std::lround(type->GetComponent(i, 0))) != options_.fluid_type)
        continue;
      Vec3 x;
      points->GetPoint(i, x.data());
      if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2])) {
        ++frame.nonfinite;
        continue;
      }
      frame.position.push_back(x);
      if (pressure) frame.pressure.push_back(pressure->GetComponent(i, 0));
      if (velocity) {
        frame.velocity.push_back({velocity->GetComponent(i, 0), velocity->GetComponent(i, 1),
                                  velocity->GetComponent(i, 2)});
      }
    }
  }

  std::vector<SeriesEntry> entries_;
  SourceOptions options_;
  std::vector<Seconds> times_;
  std::map<std::size_t, std::size_t> nonfinite_;  ///< per frame that has any
  std::vector<std::string> gaps_;
};

}  // namespace

std::unique_ptr<FrameReader> open_particle_series(std::vector<SeriesEntry> entries,
                                                  const SourceOptions& options) {
  return std::make_unique<ParticleReader>(std::move(entries), options);
}

}  // namespace surge::compare
