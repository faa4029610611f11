#include "compare/read/first_frame.hpp"

#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStaticPointLocator.h>

#include <algorithm>
#include <boost/math/statistics/univariate_statistics.hpp>
#include <cmath>
#include <map>

#include "compare/read/four_digits.hpp"
#include "compare/read/pieces.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {

namespace {

constexpr std::size_t most_values = 8;    ///< of an array that may be a type
constexpr vtkIdType most_samples = 2000;  ///< particles whose neighbours are looked for
constexpr double connected_length = 2.0;  ///< spacings, the front's usual linking length
constexpr double least_main_body = 0.9;   ///< of the particles
constexpr double least_fill = 0.85;       ///< of the box that a column spans
constexpr double most_fill = 1.15;

/// The distinct values of an array with the particles that have each; none where they are many or
/// not whole.
std::map<double, std::size_t> few_values(const std::vector<double>& values) {
  std::map<double, std::size_t> found;
  for (const double value : values) {
    if (value != std::round(value)) return {};
    ++found[value];
    if (found.size() > most_values) return {};
  }
  return found;
}

[[noreturn]] void refuse(const Run& run, const std::string& found, const std::string& expected) {
  throw Error(run.path.string() + ": first frame: " + found + "; expected " + expected);
}

void check_spacing(const Run& run, const ParticleFrame& frame) {
  if (frame.position.size() < 2) return;
  const double nearest = nearest_distance(frame.position);
  const double ratio = nearest / run.spacing.value();
  if (ratio > 0.5 && ratio < 1.5) return;
  refuse(
      run,
      "particles are " + four_digits(nearest) + " m from their nearest neighbour, spacing " +
          number_text(run.spacing.value()) + " m",
      "about one spacing (--spacing; are the files in millimetres, or walls among the particles?)");
}

void check_bodies(const Run& run, const ParticleFrame& frame) {
  const Pieces pieces = connected_pieces(frame.position, connected_length * run.spacing.value());
  const auto all = static_cast<double>(frame.position.size());
  if (static_cast<double>(pieces.sizes.front()) >= least_main_body * all) return;
  refuse(
      run,
      std::to_string(pieces.sizes.size()) + " separate bodies, the largest with " +
          std::to_string(pieces.sizes.front()) + " of " + std::to_string(frame.position.size()) +
          " particles",
      "one body of water (which particles are fluid: --type-array with --fluid-type; --spacing)");
}

/// A foreign file does not say what its column is: its first frame must be one.
void check_column(const Run& run, const ParticleFrame& frame) {
  const Extent& box = run.physics.column;
  double volume = 1.0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double extent = box.upper[a] - box.lower[a];
    // A plane of particles is one spacing thick.
    volume *= std::max(extent, run.spacing.value());
  }
  // Of water that lies in the tank beside the column nothing is in its box.
  const auto count =
      std::count_if(frame.position.begin(), frame.position.end(),
                    [&](const Vec3& x) { return x[0] >= box.lower[0] && x[0] <= box.upper[0]; });
  const double filled = static_cast<double>(count) * std::pow(run.spacing.value(), 3) / volume;
  if (filled >= least_fill && filled <= most_fill) return;
  refuse(
      run,
      "its " + std::to_string(count) + " particles fill " +
          number_text(std::round(100.0 * filled)) + " % of the box that they span",
      "a column of water (walls among them, or water lying in the tank? --type-array with "
      "--fluid-type says which are fluid, --bed-depth how deep the water lies, --column-width and "
      "--column-height what the column is)");
}

}  // namespace

std::string ArrayFound::text() const {
  std::string text = name + " (" + type + ", " + std::to_string(components) +
                     (components == 1 ? " component" : " components");
  if (type != "text") text += ", " + number_text(lower) + " to " + number_text(upper);
  for (std::size_t i = 0; i < values.size(); ++i)
    text += (i == 0 ? ": " : ", ") + (words.empty() ? number_text(values[i]) : words.at(i)) +
            " x " + std::to_string(counts[i]);
  return text + ")";
}

std::vector<ArrayFound> arrays_of(const ParticleTable& table) {
  std::vector<ArrayFound> found;
  for (const ParticleArray& array : table.arrays) {
    ArrayFound entry{array.name, array.type, array.components, 0.0, 0.0, {}, {}};
    bool started = false;
    for (const double value : array.values) {
      if (!std::isfinite(value)) continue;
      entry.lower = started ? std::min(entry.lower, value) : value;
      entry.upper = started ? std::max(entry.upper, value) : value;
      started = true;
    }
    if (array.words.size() <= most_values) entry.words = array.words;
    if (entry.components == 1)
      for (const auto& [value, count] : few_values(array.values)) {
        entry.values.push_back(value);
        entry.counts.push_back(count);
      }
    found.push_back(std::move(entry));
  }
  return found;
}

double nearest_distance(const std::vector<Vec3>& position) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& x : position) points->InsertNextPoint(x.data());
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(cloud);
  locator->BuildLocator();
  const auto count = static_cast<vtkIdType>(position.size());
  const vtkIdType stride = std::max<vtkIdType>(1, count / most_samples);
  std::vector<double> distances;
  vtkNew<vtkIdList> two;
  for (vtkIdType i = 0; i < count; i += stride) {
    const Vec3& x = position[static_cast<std::size_t>(i)];
    locator->FindClosestNPoints(2, x.data(), two);
    double nearest = 0.0;
    for (vtkIdType k = 0; k < two->GetNumberOfIds(); ++k) {
      const Vec3& y = position[static_cast<std::size_t>(two->GetId(k))];
      nearest = std::max(nearest, std::hypot(y[0] - x[0], y[1] - x[1], y[2] - x[2]));
    }
    distances.push_back(nearest);
  }
  return boost::math::statistics::median(distances);
}

void check_first_frame(const Run& run, const ParticleFrame& frame, const SourceOptions& options) {
  check_spacing(run, frame);
  if (run.kind != SourceKind::particle_series) return;
  const auto up = static_cast<std::size_t>(run.physics.vertical_axis());
  const Extent& box = run.physics.column;
  // The column's box has half a spacing around the outermost particles.
  if (box.upper[up] - box.lower[up] < 1.5 * run.spacing.value())
    refuse(run, "the water is one layer thick along gravity",
           "a column with a height (--vertical names the axis)");
  check_bodies(run, frame);
  if (!options.column_width) check_column(run, frame);
}

}  // namespace surge::compare
