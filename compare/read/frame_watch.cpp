#include "compare/read/frame_watch.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "compare/read/first_frame.hpp"
#include "compare/read/four_digits.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

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

/// The box of the particles, widened to each side by `sizes` of its longest one.
Extent around(const std::vector<Vec3>& position, double sizes) {
  Extent box{position.front(), position.front()};
  for (const Vec3& x : position)
    for (std::size_t a = 0; a < 3; ++a) {
      box.lower[a] = std::min(box.lower[a], x[a]);
      box.upper[a] = std::max(box.upper[a], x[a]);
    }
  double longest = 0.0;
  for (std::size_t a = 0; a < 3; ++a) longest = std::max(longest, box.upper[a] - box.lower[a]);
  for (std::size_t a = 0; a < 3; ++a) {
    box.lower[a] -= sizes * longest;
    box.upper[a] += sizes * longest;
  }
  return box;
}

constexpr double far_sizes = 100.0;

}  // namespace

std::string seconds_text(Seconds time) {
  return number_text(std::round(time.value() * 1e9) / 1e9) + " s";
}

std::string Sightings::text(const std::vector<Seconds>& times) const {
  if (counts.empty()) return {};
  std::size_t most = 0;
  for (const auto& [frame, count] : counts) most = std::max(most, count);
  return "up to " + std::to_string(most) + " in " + std::to_string(counts.size()) +
         " frames, first at " + seconds_text(times[counts.begin()->first]);
}

/// A few lost particles are counted; a frame of which a tenth is not finite is no result.
void FrameWatch::look(const ParticleFrame& frame, std::size_t index, const std::string& file,
                      const std::string& fluid) {
  nonfinite_.add(index, frame.nonfinite);
  const std::size_t all = frame.nonfinite + frame.position.size();
  if (10 * frame.nonfinite > all)
    throw Error(file + ": " + std::to_string(frame.nonfinite) + " of " + std::to_string(all) +
                " fluid particles are not finite, at most a tenth expected");
  if (frame.position.empty())
    throw Error(file + ": no fluid particle found" + fluid + ", at least one expected");
  if (!spacing_) return;
  particles_[index] = frame.position.size();
  fingerprints_[index] = fingerprint(frame.position);
  if (frame.position.size() > 1) {
    const double nearest = nearest_distance(frame.position);
    const double ratio = nearest / spacing_->value();
    if (!(ratio > 0.2 && ratio < 2.0))
      throw Error(file + ": particles are " + four_digits(nearest) +
                  " m from their nearest neighbour, spacing " + number_text(spacing_->value()) +
                  " m; about one spacing expected in every frame (is one in other units?)");
  }
  // Where walls are not known, a particle that was thrown to nowhere is not seen as outside of
  // them.
  if (index == 0) reach_ = around(frame.position, far_sizes);
  if (reach_) {
    const auto thrown = std::count_if(frame.position.begin(), frame.position.end(),
                                      [&](const Vec3& x) { return beyond(x, *reach_) > 0.0; });
    thrown_.add(index, static_cast<std::size_t>(thrown));
  }
  if (!tank_) return;
  const auto outside =
      std::count_if(frame.position.begin(), frame.position.end(),
                    [&](const Vec3& x) { return beyond(x, *tank_) > spacing_->value(); });
  outside_.add(index, static_cast<std::size_t>(outside));
}

void FrameWatch::expect(Metres spacing, const std::optional<Extent>& tank) {
  spacing_ = spacing;
  tank_ = tank;
}

std::optional<ParticleCounts> FrameWatch::counts() const {
  if (particles_.empty() || particles_.begin()->first != 0) return std::nullopt;
  ParticleCounts counts{particles_.begin()->second, 0};
  for (const auto& [frame, count] : nonfinite_.counts)
    counts.nonfinite = std::max(counts.nonfinite, count);
  return counts;
}

std::vector<std::string> FrameWatch::notices(const std::vector<Seconds>& times) const {
  std::vector<std::string> lines;
  if (!nonfinite_.counts.empty())
    lines.push_back("particles that are not finite are left out: " + nonfinite_.text(times));
  if (!outside_.counts.empty())
    lines.push_back((std::isfinite(tank_->upper[0]) || std::isfinite(tank_->upper[1]) ||
                             std::isfinite(tank_->upper[2])
                         ? "particles outside of the tank: "
                         : "particles behind the column's wall or below its floor: ") +
                    outside_.text(times));
  if (!thrown_.counts.empty())
    lines.push_back("particles farther away than " + number_text(far_sizes) +
                    " times the size of all water of the first frame: " + thrown_.text(times));
  Sightings changed;
  for (const auto& [index, count] : particles_) {
    const std::size_t first = particles_.begin()->second;
    changed.add(index, count > first ? count - first : first - count);
  }
  if (!changed.counts.empty()) {
    const auto [index, difference] = *changed.counts.begin();
    lines.push_back(
        "the number of fluid particles changes: " + std::to_string(particles_.begin()->second) +
        " at " + seconds_text(times[particles_.begin()->first]) + ", " +
        std::to_string(particles_.at(index)) + " at " + seconds_text(times[index]) + "; by " +
        changed.text(times));
  }
  for (auto here = fingerprints_.begin(); here != fingerprints_.end(); ++here) {
    const auto next = std::next(here);
    if (next != fingerprints_.end() && next->second == here->second)
      lines.push_back("the frames at " + seconds_text(times[here->first]) + " and " +
                      seconds_text(times[next->first]) + " hold the same particles");
  }
  return lines;
}

}  // namespace surge::compare
