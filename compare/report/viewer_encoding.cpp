#include "compare/report/viewer_encoding.hpp"

#include <vtkBase64Utilities.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace surge::compare {

using nlohmann::json;

namespace {

/// Value in 0..1 times `steps`, rounded.
double steps_of(double part, double steps) {
  return std::isfinite(part) ? std::round(steps * std::clamp(part, 0.0, 1.0)) : 0.0;
}

/// Smallest interval around the numbers; never empty, so that it can be divided by.
class Bounds {
 public:
  void add(double value) {
    lower_ = any_ ? std::min(lower_, value) : value;
    upper_ = any_ ? std::max(upper_, value) : value;
    any_ = true;
  }
  [[nodiscard]] Interval interval() const {
    return {lower_, upper_ > lower_ ? upper_ : lower_ + 1.0};
  }

 private:
  bool any_ = false;
  double lower_ = 0.0, upper_ = 0.0;
};

void append(std::vector<std::uint8_t>& bytes, double value, Interval interval) {
  const std::uint16_t q = quantise(value, interval);
  bytes.push_back(static_cast<std::uint8_t>(q & 0xffU));
  bytes.push_back(static_cast<std::uint8_t>(q >> 8U));
}

json entry_of(Interval x, Interval y, const std::vector<std::size_t>& counts,
              const std::vector<std::uint8_t>& bytes) {
  return {{"x", {x.lower, x.upper}},
          {"y", {y.lower, y.upper}},
          {"counts", counts},
          {"data", base64(bytes)}};
}

}  // namespace

std::uint16_t quantise(double value, Interval interval) {
  const double part = (value - interval.lower) / (interval.upper - interval.lower);
  return static_cast<std::uint16_t>(steps_of(part, 65535.0));
}

double restored(std::uint16_t value, Interval interval) {
  return interval.lower + value / 65535.0 * (interval.upper - interval.lower);
}

std::uint8_t quantise_unit(double value) {
  return static_cast<std::uint8_t>(steps_of(value, 255.0));
}

std::string base64(std::span<const std::uint8_t> bytes) {
  std::string text((bytes.size() + 2) / 3 * 4, '=');
  // VTK writes into unsigned characters.
  const auto length = vtkBase64Utilities::Encode(bytes.data(), bytes.size(),
                                                 reinterpret_cast<unsigned char*>(text.data()));
  text.resize(length);
  return text;
}

std::vector<WaterPatch> coarse_cells(const std::vector<WaterPatch>& cells, double edge) {
  struct Sum {
    double water = 0.0, pressure = 0.0, speed = 0.0;
  };
  std::map<std::pair<long, long>, Sum> squares;
  // Edges of a cell that differ from a square's by rounding alone must not touch the next square.
  const double slack = 1e-6 * edge;
  const auto index = [&](double x) { return static_cast<long>(std::floor(x / edge)); };
  for (const auto& cell : cells) {
    const double x0 = cell.x - cell.half_x, x1 = cell.x + cell.half_x;
    const double y0 = cell.y - cell.half_y, y1 = cell.y + cell.half_y;
    for (long i = index(x0 + slack); i <= index(x1 - slack); ++i) {
      const double width = std::min(x1, double(i + 1) * edge) - std::max(x0, double(i) * edge);
      for (long j = index(y0 + slack); j <= index(y1 - slack); ++j) {
        const double height = std::min(y1, double(j + 1) * edge) - std::max(y0, double(j) * edge);
        const double water = cell.fraction * width * height;
        Sum& sum = squares[{i, j}];
        sum.water += water;
        sum.pressure += water * cell.pressure;
        sum.speed += water * cell.speed;
      }
    }
  }
  std::vector<WaterPatch> result;
  for (const auto& [at, sum] : squares) {
    const double fraction = sum.water / (edge * edge);
    if (fraction < 0.02) continue;
    result.push_back({(double(at.first) + 0.5) * edge, (double(at.second) + 0.5) * edge, 0.5 * edge,
                      0.5 * edge, sum.pressure / sum.water, fraction, sum.speed / sum.water});
  }
  return result;
}

void WaterTrack::add(const std::vector<WaterPatch>& patches) {
  counts_.push_back(patches.size());
  for (const auto& patch : patches) {
    half_ = patch.half_x;
    x_.push_back(static_cast<float>(patch.x));
    y_.push_back(static_cast<float>(patch.y));
    pressure_.push_back(quantise_unit(patch.pressure));
    speed_.push_back(quantise_unit(patch.speed));
    if (mesh_) fraction_.push_back(quantise_unit(patch.fraction));
  }
}

json WaterTrack::encoded() const {
  Bounds x, y;
  for (float value : x_) x.add(value);
  for (float value : y_) y.add(value);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(7 * x_.size());
  for (float value : x_) append(bytes, value, x.interval());
  for (float value : y_) append(bytes, value, y.interval());
  for (const auto* plane : {&pressure_, &speed_, &fraction_}) {
    bytes.insert(bytes.end(), plane->begin(), plane->end());
  }
  json entry = entry_of(x.interval(), y.interval(), counts_, bytes);
  entry["mesh"] = mesh_;
  entry["half"] = half_;
  return entry;
}

void SurfaceTrack::add(const std::vector<Segment>& segments) {
  counts_.push_back(segments.size());
  segments_.insert(segments_.end(), segments.begin(), segments.end());
}

json SurfaceTrack::encoded() const {
  Bounds x, y;
  for (const auto& s : segments_) {
    x.add(s.x0);
    x.add(s.x1);
    y.add(s.y0);
    y.add(s.y1);
  }
  std::vector<std::uint8_t> bytes;
  bytes.reserve(8 * segments_.size());
  for (const auto& s : segments_) append(bytes, s.x0, x.interval());
  for (const auto& s : segments_) append(bytes, s.y0, y.interval());
  for (const auto& s : segments_) append(bytes, s.x1, x.interval());
  for (const auto& s : segments_) append(bytes, s.y1, y.interval());
  return entry_of(x.interval(), y.interval(), counts_, bytes);
}

}  // namespace surge::compare
