#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "compare/read/foam_case.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

using nlohmann::json;

constexpr double dry = 0.01;  ///< of the greatest depth
constexpr std::size_t most_bins = 100'000;
constexpr int samples = 4;               ///< per axis of a cell
constexpr double most_misplaced = 0.02;  ///< of the water

std::array<double, 6> bounds_of(const MeshFrame& frame, std::size_t cell) {
  std::array<double, 6> b{};
  frame.grid->GetCellBounds(static_cast<vtkIdType>(cell), b.data());
  return b;
}

std::string metres(double x) {
  return six_digits(std::round(x * 1e9) / 1e9) + " m";
}

/// A body of water as a manifest has it.
struct Block {
  Extent box;
  bool ball = false;
};

std::optional<Vec3> vector_of(const json& block, const char* key) {
  if (!block.is_object() || !block.contains(key)) return std::nullopt;
  const json& value = block.at(key);
  if (!value.is_array() || value.size() != 3) return std::nullopt;
  Vec3 result{};
  for (std::size_t a = 0; a < 3; ++a) {
    if (!value[a].is_number()) return std::nullopt;
    result[a] = value[a].get<double>();
  }
  return result;
}

/// The blocks of the manifest; none where there are bodies that are neither box nor ball.
std::vector<Block> blocks_of(const json& manifest) {
  std::vector<Block> blocks;
  const json::json_pointer place("/case/blocks");
  if (!manifest.contains(place) || !manifest.at(place).is_array()) return blocks;
  for (const json& entry : manifest.at(place)) {
    const auto lower = vector_of(entry, "lower"), upper = vector_of(entry, "upper");
    const bool has_shape = entry.is_object() && entry.contains("shape");
    const bool ball = has_shape && entry.at("shape") == "ball";
    if (!lower || !upper || (has_shape && !ball && entry.at("shape") != "box")) return {};
    blocks.push_back({{*lower, *upper}, ball});
  }
  return blocks;
}

/// An axis along which a block has no extent is the one that a 2D case does not have.
bool holds(const Block& block, const Vec3& x) {
  double distance = 0.0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double half = 0.5 * (block.box.upper[a] - block.box.lower[a]);
    if (half <= 0.0) continue;
    const double off = std::abs(x[a] - 0.5 * (block.box.upper[a] + block.box.lower[a])) / half;
    distance = block.ball ? distance + off * off : std::max(distance, off);
  }
  return distance <= 1.0;
}

/// Part of a cell's box that lies in the blocks.
double filled(const std::vector<Block>& blocks, const std::array<double, 6>& b) {
  int inside = 0;
  for (int i = 0; i < samples * samples * samples; ++i) {
    const std::array<int, 3> k{i % samples, i / samples % samples, i / samples / samples};
    Vec3 x{};
    for (std::size_t a = 0; a < 3; ++a)
      x[a] = b[2 * a] + (k[a] + 0.5) / samples * (b[2 * a + 1] - b[2 * a]);
    inside += std::any_of(blocks.begin(), blocks.end(),
                          [&](const Block& block) { return holds(block, x); });
  }
  return static_cast<double>(inside) / (samples * samples * samples);
}

void check_blocks(const Run& run, const MeshFrame& frame, const std::vector<double>& volumes) {
  const std::vector<Block> blocks = blocks_of(run.manifest);
  if (blocks.empty()) return;
  double there = 0.0, stated = 0.0, misplaced = 0.0, cut = 0.0;
  for (std::size_t c = 0; c < frame.alpha.size(); ++c) {
    const double part = filled(blocks, bounds_of(frame, c));
    there += frame.alpha[c] * volumes[c];
    stated += part * volumes[c];
    misplaced += std::abs(frame.alpha[c] - part) * volumes[c];
    // Cells that a block's surface cuts may be filled by their centres.
    if (part > 0.0 && part < 1.0) cut += volumes[c];
  }
  if (misplaced <= most_misplaced * stated + cut) return;
  throw Error(run.path.string() + ": water at time 0: " + six_digits(there) + " m3 in the mesh, " +
              six_digits(stated) + " m3 in the " + std::to_string(blocks.size()) +
              " blocks of manifest.json, " +
              six_digits(std::round(1000.0 * misplaced / std::max(stated, 1e-300)) / 10.0) +
              " % of it elsewhere; the same water expected (made by another setFieldsDict?)");
}

std::optional<double> stated_number(const json& manifest, const char* place) {
  const json::json_pointer pointer(place);
  if (!manifest.contains(pointer) || !manifest.at(pointer).is_number()) return std::nullopt;
  return manifest.at(pointer).get<double>();
}

/// A finished run has a frame at every multiple of its interval.
void check_times(Run& run, FoamReader& reader) {
  const auto end = stated_number(run.manifest, "/case/time/end");
  const auto interval = stated_number(run.manifest, "/case/output/interval");
  if (!end || !interval || !(*interval > 0.0) || !(*end / *interval < 1e5)) return;
  std::string missing;
  std::size_t count = 0;
  for (long long k = 0; k <= std::llround(*end / *interval); ++k) {
    const double time = static_cast<double>(k) * *interval;
    if (time > *end * (1.0 + 1e-9)) break;
    const auto& times = reader.times();
    const bool there = std::any_of(times.begin(), times.end(), [&](Seconds t) {
      return std::abs(t.value() - time) < 1e-3 * *interval;
    });
    if (there) continue;
    if (++count <= 5) missing.append(" ").append(six_digits(std::round(time * 1e9) / 1e9));
  }
  if (count == 0) return;
  std::string notice = std::to_string(count);
  notice.append(" of the times that manifest.json announces (every ")
      .append(six_digits(*interval))
      .append(" s to ")
      .append(six_digits(*end))
      .append(" s) are not there:")
      .append(missing)
      .append(count > 5 ? " ..." : "");
  reader.tell(notice);
}

}  // namespace

std::string six_digits(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

WaterDepths water_depths(const MeshFrame& frame, const std::vector<double>& volumes,
                         const Extent& tank, std::size_t vertical, double bin) {
  WaterDepths result;
  const double length = tank.upper[0] - tank.lower[0];
  const double count = std::round(length / bin);
  const auto bins = static_cast<std::size_t>(
      std::clamp(std::isfinite(count) ? count : 1.0, 1.0, static_cast<double>(most_bins)));
  result.begin = tank.lower[0];
  result.bin = length / static_cast<double>(bins);
  result.depth.assign(bins, 0.0);
  const std::size_t across = vertical == 1 ? 2 : 1;
  const double area = result.bin * (tank.upper[across] - tank.lower[across]);
  for (std::size_t c = 0; c < frame.alpha.size(); ++c) {
    const std::array<double, 6> b = bounds_of(frame, c);
    const double from = (b[0] - result.begin) / result.bin;
    const double to = (b[1] - result.begin) / result.bin;
    const auto first = static_cast<std::size_t>(std::max(from, 0.0));
    for (std::size_t k = first; k < bins && static_cast<double>(k) < to; ++k) {
      const double low = std::max(from, static_cast<double>(k));
      const double part = (std::min(to, static_cast<double>(k + 1)) - low) / (to - from);
      result.depth[k] += std::max(part, 0.0) * frame.alpha[c] * volumes[c] / area;
    }
  }
  return result;
}

double column_edge(const WaterDepths& depths, const std::string& source) {
  const std::vector<double>& depth = depths.depth;
  const double height = *std::max_element(depth.begin(), depth.end());
  if (!(height > 0.0))
    throw Error(source + ": no water at time 0, a column or --column-width expected");
  const auto is_wet = [&](std::size_t k) { return depth[k] > dry * height; };
  const auto place = [&](std::size_t k) {
    return metres(depths.begin + static_cast<double>(k) * depths.bin);
  };
  if (is_wet(depth.size() - 1)) {
    throw Error(source + ": the water reaches the far wall, x = " + place(depth.size()) +
                ", at time 0 (a layer of water in the tank, or a column there?); expected a column "
                "with a free side, or the depth of the layer (--bed-depth), or the column's width "
                "(--column-width)");
  }
  std::size_t wet = 0;
  double volume = 0.0;
  while (is_wet(wet)) volume += depth[wet++] * depths.bin;
  for (std::size_t k = wet; k < depth.size(); ++k) {
    if (!is_wet(k)) continue;
    throw Error(source + ": water from x = " + place(k) + " on at time 0, " +
                (wet == 0 ? "none at the wall" : "apart from that at the wall") + ", x = " +
                place(0) + "; expected one column at that wall, or its width (--column-width)");
  }
  const double width = volume / height;
  if (std::abs(width - static_cast<double>(wet) * depths.bin) > 1.5 * depths.bin)
    throw Error(source + ": the water at time 0 ends at x = " + place(wet) +
                ", but is as much as " + metres(width) + " of its greatest depth " +
                metres(height) +
                "; expected a column with upright sides, or its width (--column-width)");
  return depths.begin + width;
}

void check_foam_case(Run& run) {
  auto& reader = dynamic_cast<FoamReader&>(*run.frames);
  check_times(run, reader);
  if (std::abs(reader.times().front().value()) > 1e-12) {
    reader.tell("no time 0: the water is not compared with the blocks of manifest.json");
    return;
  }
  const auto frame = std::get<MeshFrame>(reader.read(0, Fields{}));
  check_blocks(run, frame, reader.volumes());
}

}  // namespace surge::compare
