#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compare/read/particle_fields.hpp"
#include "compare/read/readers.hpp"

namespace surge::compare {

/// What was seen of a kind in the frames that were read.
struct Sightings {
  std::map<std::size_t, std::size_t> counts;  ///< by frame

  void add(std::size_t frame, std::size_t count) {
    if (count > 0) counts[frame] = count;
  }
  /// "up to 3 in 2 frames, first at 0.1 s"; empty where there is none.
  [[nodiscard]] std::string text(const std::vector<Seconds>& times) const;
};

/// A series of particle files of any format.
class ParticleSeries : public FrameReader {
 public:
  /// Throws surge::Error where times are missing, not finite or do not increase.
  ParticleSeries(std::vector<SeriesEntry> entries, const SourceOptions& options);

  [[nodiscard]] const std::vector<Seconds>& times() const override { return times_; }
  [[nodiscard]] Frame read(std::size_t index, Fields fields) override;
  [[nodiscard]] std::vector<std::string> notices() const override;

  /// What every frame of a foreign series is held against from now on: neighbours are about a
  /// spacing apart (an error), particles stay inside the tank and as many as they were (notices).
  void expect(Metres spacing, const std::optional<Extent>& tank);

 private:
  void find_times();
  void append(ParticleFrame& frame, const SeriesEntry& entry, const std::filesystem::path& file,
              Fields fields);
  void check(const ParticleFrame& frame, std::size_t index);
  [[nodiscard]] std::vector<std::string> wanted(Fields fields) const;

  std::vector<SeriesEntry> entries_;
  SourceOptions options_;
  VectorField position_;
  VectorField velocity_;
  std::vector<Seconds> times_;
  std::optional<Metres> spacing_;
  std::optional<Extent> tank_;
  Sightings nonfinite_;
  Sightings outside_;
  std::map<std::size_t, std::size_t> particles_;                     ///< by frame
  std::map<std::size_t, std::size_t> fingerprints_;                  ///< of the positions, by frame
  std::map<std::string, std::map<std::size_t, std::string>> notes_;  ///< file by frame, by note
  std::vector<std::string> series_notices_;
};

/// What the numbers in the names and the times of a series tell: gaps, and intervals that differ
/// from all others; a line each.
[[nodiscard]] std::vector<std::string> irregularities(const std::vector<SeriesEntry>& entries,
                                                      const std::vector<Seconds>& times);

/// Times by number from a CSV file with a column for each. Throws surge::Error.
[[nodiscard]] std::map<long long, double> read_time_file(const std::filesystem::path& file);

}  // namespace surge::compare
