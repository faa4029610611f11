#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "foam_cases/case_files.hpp"

namespace surge::foam {

/// What a case will take. Steps, memory and disk are guesses.
struct CaseSize {
  double cells = 0.0;
  double cell = 0.0;  ///< edge of a cell in the water, m
  double frames = 0.0;
  double steps = 0.0;   ///< with a splash
  double memory = 0.0;  ///< bytes, of all processes
  double disk = 0.0;    ///< bytes
};
[[nodiscard]] CaseSize case_size(const FoamCase& c);

[[nodiscard]] nlohmann::json to_json(const CaseSize& size);

/// Bytes of memory of this machine, or of the control group that the process runs in.
[[nodiscard]] double available_memory();

/// Throws Error for a case of more memory than `memory` (bytes).
void check_size(const CaseSize& size, double memory);
/// Throws Error for a case of more bytes than are free where `folder` lies.
void check_disk(const CaseSize& size, const std::filesystem::path& folder);

/// "1.5 GB"
[[nodiscard]] std::string bytes_text(double bytes);

}  // namespace surge::foam
