#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <span>

#include "particle/io/computation.hpp"
#include "particle/io/manifest.hpp"
#include "particle/io/restart_error.hpp"
#include "particle/io/state_fields.hpp"

namespace surge {

/// Writes the checkpoint of a run: between two steps, all that the rest of its trajectory depends
/// on, and what the run has recorded so far. The older one is there until the new one is on the
/// disk. Throws Error.
///
/// The file:
///   surge-particle checkpoint, format 1
///   <bytes of the header>
///   <header: JSON {"build", "compiler", "flags", "case", "run", "fields"}>
///   the fields' values as they lie in memory, one after the other
///   crc32 <of all before it, hexadecimal>
void write_checkpoint(const std::filesystem::path& folder, const Computation& computation,
                      const RunRecord& record, std::span<const StateField> state);

/// Throws RestartError where a folder has no checkpoint.
void require_checkpoint(const std::filesystem::path& folder);

/// Of a run that is finished.
void remove_checkpoint(const std::filesystem::path& folder);

/// A checkpoint that was read and found whole, of this build and of this case.
class Checkpoint {
 public:
  /// Throws RestartError with the reason where it is not.
  Checkpoint(const std::filesystem::path& folder, const Computation& computation);

  [[nodiscard]] const RunRecord& record() const { return record_; }
  [[nodiscard]] StateReader& state() { return *state_; }

 private:
  [[noreturn]] void refuse(const std::string& reason) const;
  void open(double most_bytes);
  void check_sum();
  [[nodiscard]] nlohmann::json read_header();
  void check_build(const nlohmann::json& header) const;
  void check_case(const nlohmann::json& header, const Computation& computation) const;
  void read_fields(const nlohmann::json& header);

  std::filesystem::path file_;
  std::ifstream stream_;
  std::size_t size_ = 0;  ///< bytes, without the checksum
  RunRecord record_;
  std::optional<StateReader> state_;
};

}  // namespace surge
