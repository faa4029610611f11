#include "compare/report/viewer_encoding.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

namespace surge::compare {

using nlohmann::json;

namespace {

/// Number of a cell of a grid; far apart cells may share one, which costs time and nothing else.
std::size_t cell_number(const std::array<long, 3>& cell) {
  return static_cast<std::size_t>(cell[0] * 73856093L ^ cell[1] * 19349663L ^ cell[2] * 83492791L);
}

void widen(std::array<double, 2>& span, double low, double high) {
  span = {std::min(span[0], low), std::max(span[1], high)};
}

}  // namespace

std::vector<WaterPatch> coarse_cells(const std::vector<WaterPatch>& cells, double edge) {
  struct Sum {
    double water = 0.0, pressure = 0.0, speed = 0.0;
  };
  struct Range {
    double low, high;
    long first, last;
  };
  std::map<std::array<long, 3>, Sum> squares;
  // Edges of a cell that differ from a square's by rounding alone must not touch the next square.
  const double slack = 1e-6 * edge;
  const auto range = [&](double middle, double half) {
    return Range{middle - half, middle + half,
                 static_cast<long>(std::floor((middle - half + slack) / edge)),
                 static_cast<long>(std::floor((middle + half - slack) / edge))};
  };
  const auto shared = [&](const Range& r, long i) {
    return std::min(r.high, double(i + 1) * edge) - std::max(r.low, double(i) * edge);
  };
  bool flat = true;
  for (const auto& cell : cells) {
    const Range x = range(cell.x, cell.half_x), y = range(cell.y, cell.half_y);
    // A flat cell has no depth to share.
    const Range z = cell.half_z > 0.0 ? range(cell.z, cell.half_z) : Range{0.0, edge, 0, 0};
    flat = flat && !(cell.half_z > 0.0);
    for (long i = x.first; i <= x.last; ++i)
      for (long j = y.first; j <= y.last; ++j)
        for (long k = z.first; k <= z.last; ++k) {
          const double water = cell.fraction * shared(x, i) * shared(y, j) * shared(z, k);
          Sum& sum = squares[{i, j, k}];
          sum.water += water;
          sum.pressure += water * cell.pressure;
          sum.speed += water * cell.speed;
        }
  }
  std::vector<WaterPatch> result;
  for (const auto& [at, sum] : squares) {
    const double fraction = sum.water / (edge * edge * edge);
    if (fraction < 0.02) continue;
    WaterPatch square{(double(at[0]) + 0.5) * edge,
                      (double(at[1]) + 0.5) * edge,
                      0.5 * edge,
                      0.5 * edge,
                      sum.pressure / sum.water,
                      fraction,
                      sum.speed / sum.water};
    if (!flat) {
      square.z = (double(at[2]) + 0.5) * edge;
      square.half_z = 0.5 * edge;
    }
    result.push_back(square);
  }
  return result;
}

void KnownValues::look(const WaterPatch& patch, bool first) {
  (first ? start : pressure) = (first ? start : pressure) && !std::isnan(patch.pressure);
  speed = speed && !std::isnan(patch.speed);
}

json KnownValues::encoded() const {
  return {{"pressure", pressure}, {"speed", speed}, {"start", start}};
}

ParticleTrack::ParticleTrack(double spacing, int dimension)
    : half_(0.5 * spacing),
      step_(spacing / steps_per_spacing),
      axes_(static_cast<std::size_t>(dimension)) {}

std::vector<long> ParticleTrack::followed(const std::vector<Place>& places) const {
  const auto cell_of = [](const Place& place) {
    std::array<long, 3> cell{};
    for (std::size_t a = 0; a < 3; ++a)
      cell[a] = static_cast<long>(std::floor(place[a] / steps_per_spacing));
    return cell;
  };
  const auto expected = [](const Held& held) {
    Place place{};
    for (std::size_t a = 0; a < 3; ++a) place[a] = held.at[a] + held.moved[a];
    return place;
  };
  std::unordered_multimap<std::size_t, std::size_t> grid;
  grid.reserve(held_.size());
  for (std::size_t i = 0; i < held_.size(); ++i)
    grid.emplace(cell_number(cell_of(expected(held_[i]))), i);
  std::vector<long> found(held_.size(), -1);
  std::vector<std::size_t> left;
  const long depth = axes_ == 3 ? 1 : 0;
  for (std::size_t n = 0; n < places.size(); ++n) {
    const std::array<long, 3> cell = cell_of(places[n]);
    double nearest = std::pow(steps_per_spacing, 2);
    long best = -1;
    for (long i = -1; i <= 1; ++i)
      for (long j = -1; j <= 1; ++j)
        for (long k = -depth; k <= depth; ++k) {
          const auto [begin, end] =
              grid.equal_range(cell_number({cell[0] + i, cell[1] + j, cell[2] + k}));
          for (auto it = begin; it != end; ++it) {
            if (found[it->second] >= 0) continue;
            const Place there = expected(held_[it->second]);
            double square = 0.0;
            for (std::size_t a = 0; a < 3; ++a)
              square += std::pow(double(there[a]) - double(places[n][a]), 2);
            if (square < nearest) {
              best = static_cast<long>(it->second);
              nearest = square;
            }
          }
        }
    if (best >= 0)
      found[static_cast<std::size_t>(best)] = static_cast<long>(n);
    else
      left.push_back(n);
  }
  // Those that went farther than a spacing from where they were expected take what places are free.
  for (std::size_t i = 0, n = 0; i < found.size() && n < left.size(); ++i)
    if (found[i] < 0) found[i] = static_cast<long>(left[n++]);
  return found;
}

void ParticleTrack::put(Held& held, const Place& expected, const Place& place,
                        const WaterPatch& patch) {
  for (std::size_t a = 0; a < axes_; ++a) places_[a].signed_number(place[a] - expected[a]);
  const std::uint8_t pressure = quantise_unit(patch.pressure), speed = quantise_unit(patch.speed);
  pressure_.byte(static_cast<std::uint8_t>(pressure - held.pressure));
  speed_.byte(static_cast<std::uint8_t>(speed - held.speed));
  held.at = place;
  held.pressure = pressure;
  held.speed = speed;
}

void ParticleTrack::add(const std::vector<WaterPatch>& patches) {
  const bool first = counts_.empty();
  std::vector<Place> places;
  for (const auto& patch : patches) {
    known_.look(patch, first);
    widen(span_, patch.x, patch.x);
    places.push_back({steps_of(patch.x, step_), steps_of(patch.y, step_),
                      axes_ == 3 ? steps_of(patch.z, step_) : 0});
  }
  counts_.push_back(patches.size());
  const std::vector<long> became = followed(places);
  gone_.number(static_cast<std::uint32_t>(std::count(became.begin(), became.end(), -1L)));
  std::vector<Held> now;
  std::vector<bool> taken(patches.size(), false);
  std::size_t before = 0;
  for (std::size_t i = 0; i < held_.size(); ++i) {
    if (became[i] < 0) {
      gone_.number(static_cast<std::uint32_t>(i - before));
      before = i;
      continue;
    }
    const auto n = static_cast<std::size_t>(became[i]);
    taken[n] = true;
    Held held = held_[i];
    Place expected{}, moved{};
    for (std::size_t a = 0; a < 3; ++a) {
      expected[a] = held.at[a] + held.moved[a];
      moved[a] = places[n][a] - held.at[a];
    }
    put(held, expected, places[n], patches[n]);
    held.moved = moved;
    now.push_back(held);
  }
  for (std::size_t n = 0; n < patches.size(); ++n) {
    if (taken[n]) continue;
    Held held;
    put(held, now.empty() ? Place{} : now.back().at, places[n], patches[n]);
    now.push_back(held);
  }
  held_ = std::move(now);
}

json ParticleTrack::encoded() const {
  std::vector<const ByteStream*> streams{&gone_};
  for (std::size_t a = 0; a < axes_; ++a) streams.push_back(&places_[a]);
  streams.insert(streams.end(), {&pressure_, &speed_});
  json out = packed(streams);
  out["mesh"] = false;
  out["dimension"] = axes_;
  out["half"] = half_;
  out["step"] = step_;
  out["counts"] = counts_;
  out["known"] = known_.encoded();
  return out;
}

void MeshTrack::add(const std::vector<WaterPatch>& squares) {
  const bool first = times_.empty();
  std::vector<Square>& now = times_.emplace_back();
  const auto index = [&](double middle) { return std::lround(middle / edge_ - 0.5); };
  for (const auto& square : squares) {
    known_.look(square, first);
    widen(span_, square.x - square.half_x, square.x + square.half_x);
    // Where there is water at all it is not lost to the rounding.
    now.push_back({{index(square.x), index(square.y), dimension_ == 3 ? index(square.z) : 0L},
                   {std::max(std::uint8_t{1}, quantise_unit(square.fraction)),
                    quantise_unit(square.pressure), quantise_unit(square.speed)}});
  }
}

json MeshTrack::encoded() const {
  std::array<long, 3> low{}, high{};
  bool any = false;
  for (const auto& squares : times_)
    for (const Square& square : squares) {
      for (std::size_t a = 0; a < 3; ++a) {
        low[a] = any ? std::min(low[a], square.at[a]) : square.at[a];
        high[a] = any ? std::max(high[a], square.at[a]) : square.at[a];
      }
      any = true;
    }
  std::array<std::size_t, 3> size{};
  for (std::size_t a = 0; a < 3; ++a) size[a] = static_cast<std::size_t>(high[a] - low[a] + 1);
  std::array<ByteStream, 3> streams;
  std::array<std::vector<std::uint8_t>, 3> before, now;
  for (auto& plane : before) plane.assign(size[0] * size[1] * size[2], 0);
  for (const auto& squares : times_) {
    for (auto& plane : now) plane.assign(before[0].size(), 0);
    for (const Square& square : squares) {
      std::array<std::size_t, 3> k{};
      for (std::size_t a = 0; a < 3; ++a) k[a] = static_cast<std::size_t>(square.at[a] - low[a]);
      for (std::size_t v = 0; v < 3; ++v)
        now[v][(k[2] * size[1] + k[1]) * size[0] + k[0]] = square.values[v];
    }
    for (std::size_t v = 0; v < 3; ++v) {
      for (std::size_t i = 0; i < now[v].size(); ++i)
        streams[v].byte(static_cast<std::uint8_t>(now[v][i] - before[v][i]));
      std::swap(now[v], before[v]);
    }
  }
  json out = packed({&streams[0], &streams[1], &streams[2]});
  out["mesh"] = true;
  out["dimension"] = dimension_;
  out["half"] = 0.5 * edge_;
  out["first"] = low;
  out["size"] = size;
  out["times"] = times_.size();
  out["known"] = known_.encoded();
  return out;
}

void SurfaceTrack::add(const std::vector<Segment>& segments) {
  using Point = std::array<std::int32_t, 2>;
  ++times_;
  std::vector<std::array<Point, 2>> ends;
  std::multimap<Point, std::size_t> at;
  for (const Segment& s : segments) {
    const Point a{steps_of(s.x0, step_), steps_of(s.y0, step_)};
    const Point b{steps_of(s.x1, step_), steps_of(s.y1, step_)};
    if (a == b) continue;  // shorter than what can be seen
    at.emplace(a, ends.size());
    at.emplace(b, ends.size());
    ends.push_back({a, b});
  }
  std::vector<bool> used(ends.size(), false);
  const auto extend = [&](std::vector<Point>& line) {
    for (bool more = true; more;) {
      more = false;
      const auto [begin, end] = at.equal_range(line.back());
      for (auto it = begin; it != end && !more; ++it) {
        if (used[it->second]) continue;
        used[it->second] = more = true;
        const auto& [a, b] = ends[it->second];
        line.push_back(a == line.back() ? b : a);
      }
    }
  };
  std::vector<std::vector<Point>> lines;
  for (std::size_t k = 0; k < ends.size(); ++k) {
    if (used[k]) continue;
    used[k] = true;
    std::vector<Point> line{ends[k][0], ends[k][1]};
    extend(line);
    std::reverse(line.begin(), line.end());
    extend(line);
    lines.push_back(std::move(line));
  }
  counts_.number(static_cast<std::uint32_t>(lines.size()));
  for (const auto& line : lines) {
    counts_.number(static_cast<std::uint32_t>(line.size()));
    for (const Point& point : line) {
      x_.signed_number(point[0] - before_[0]);
      y_.signed_number(point[1] - before_[1]);
      before_ = point;
    }
  }
}

json SurfaceTrack::encoded() const {
  json out = packed({&counts_, &x_, &y_});
  out["step"] = step_;
  out["times"] = times_;
  return out;
}

}  // namespace surge::compare
