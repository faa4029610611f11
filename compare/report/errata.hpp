#pragma once

#include <span>

namespace surge::compare {

/// A mistake in the printed equations of Alves & Dreux.
struct Erratum {
  const char* place;
  const char* printed;
  const char* correct;
  const char* derivation;  ///< in one line
  const char* test_file;   ///< in the repository
  const char* test;        ///< that holds the corrected form
};
[[nodiscard]] std::span<const Erratum> errata();

}  // namespace surge::compare
