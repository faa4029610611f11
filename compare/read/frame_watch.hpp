#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "compare/read/run.hpp"

namespace surge::compare {

/// A time as a message tells it, "0.25 s": nothing beyond a nanosecond.
[[nodiscard]] std::string seconds_text(Seconds time);

/// What was counted in the frames that were read so far.
struct ParticleCounts {
  std::size_t first = 0;      ///< fluid particles of the first frame
  std::size_t nonfinite = 0;  ///< not finite, the most in one frame
};

/// What was seen of a kind in the frames that were read.
struct Sightings {
  std::map<std::size_t, std::size_t> counts;  ///< by frame

  void add(std::size_t frame, std::size_t count) {
    if (count > 0) counts[frame] = count;
  }
  /// "up to 3 in 2 frames, first at 0.1 s"; empty where there is none.
  [[nodiscard]] std::string text(const std::vector<Seconds>& times) const;
};

/// What every frame of particles that are not our own is held against, wherever it comes from.
class FrameWatch {
 public:
  /// From now on neighbours are about a spacing apart (an error), particles stay inside the tank
  /// and as many as they were (notices).
  void expect(Metres spacing, const std::optional<Extent>& tank);
  /// Throws surge::Error, beginning with `place`, where more than a tenth of the particles are not
  /// finite, where there is none (`fluid`: how they are told), or where they are not a spacing
  /// apart.
  void look(const ParticleFrame& frame, std::size_t index, const std::string& place,
            const std::string& fluid = "");
  /// A line for each kind of oddity that was seen.
  [[nodiscard]] std::vector<std::string> notices(const std::vector<Seconds>& times) const;
  /// Empty before the first frame was looked at, and where nothing is expected.
  [[nodiscard]] std::optional<ParticleCounts> counts() const;

 private:
  std::optional<Metres> spacing_;
  std::optional<Extent> tank_;
  Sightings nonfinite_;
  Sightings outside_;
  Sightings thrown_;
  std::optional<Extent> reach_;  ///< where no particle leaves it for a reason of the flow
  std::map<std::size_t, std::size_t> particles_;     ///< by frame
  std::map<std::size_t, std::size_t> fingerprints_;  ///< of the positions, by frame
};

}  // namespace surge::compare
