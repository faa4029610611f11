#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compare/read/frame_watch.hpp"
#include "compare/read/particle_fields.hpp"
#include "compare/read/readers.hpp"
#include "compare/read/tables_ahead.hpp"

namespace surge::compare {

/// A series of particle files of any format.
class ParticleSeries : public FrameReader {
 public:
  /// Throws surge::Error where times are missing, not finite or do not increase.
  ParticleSeries(std::vector<SeriesEntry> entries, const SourceOptions& options);

  [[nodiscard]] const std::vector<Seconds>& times() const override { return times_; }
  [[nodiscard]] Frame read(std::size_t index, Fields fields) override;
  [[nodiscard]] std::vector<std::string> notices() const override;
  /// Of foreign files; empty for our own runs, whose manifest states it.
  [[nodiscard]] std::optional<ParticleCounts> counts() const { return watch_.counts(); }

  /// What every frame of a foreign series is held against from now on: neighbours are about a
  /// spacing apart (an error), particles stay inside the tank and as many as they were (notices).
  void expect(Metres spacing, const std::optional<Extent>& tank);

 private:
  void find_times();
  void append(ParticleFrame& frame, const SeriesEntry& entry, const std::filesystem::path& file,
              Fields fields);
  [[nodiscard]] std::vector<std::string> wanted(Fields fields) const;
  /// Where the options have no name the files have no such array.
  [[nodiscard]] bool wants_pressure(Fields fields) const {
    return fields.pressure && !options_.pressure_array.empty();
  }
  [[nodiscard]] bool wants_velocity(Fields fields) const {
    return fields.velocity && !velocity_.names.empty();
  }

  std::vector<SeriesEntry> entries_;
  SourceOptions options_;
  VectorField position_;
  VectorField velocity_;
  std::vector<Seconds> times_;
  FrameWatch watch_;
  std::map<std::string, std::map<std::size_t, std::string>> notes_;  ///< file by frame, by note
  std::vector<std::string> series_notices_;
  Fields asked_;  ///< so far
  TablesAhead ahead_;
};

/// What the numbers in the names and the times of a series tell: gaps, and intervals that differ
/// from all others; a line each.
[[nodiscard]] std::vector<std::string> irregularities(const std::vector<SeriesEntry>& entries,
                                                      const std::vector<Seconds>& times);

/// Times by number from a CSV file with a column for each. Throws surge::Error.
[[nodiscard]] std::map<long long, double> read_time_file(const std::filesystem::path& file);

}  // namespace surge::compare
