#pragma once

#include <string>
#include <vector>

#include "compare/read/particle_table.hpp"
#include "compare/read/run.hpp"

namespace surge::compare {

/// One array of a particle file, as a user needs it to name it.
struct ArrayFound {
  std::string name;
  std::string type;  ///< as the file stores it
  int components = 1;
  double lower = 0.0;  ///< of all components
  double upper = 0.0;
  std::vector<double> values;        ///< the distinct ones, where they are few and whole
  std::vector<std::size_t> counts;   ///< particles with each of them
  std::vector<std::string> words{};  ///< of text; the values are their places

  /// Few whole values, two at least: what tells fluid from walls looks like this.
  [[nodiscard]] bool looks_like_a_type() const { return components == 1 && values.size() > 1; }
  /// "Type (short, 1 component, 0 to 3: 0 x 142, 3 x 200)"
  [[nodiscard]] std::string text() const;
};

/// The arrays of a particle file.
[[nodiscard]] std::vector<ArrayFound> arrays_of(const ParticleTable& table);

/// Median over particles of the distance to the nearest other one, m.
[[nodiscard]] double nearest_distance(const std::vector<Vec3>& position);

/// Checks what a source's options and files make of its first frame, before any number is taken
/// from it: that nearest neighbours are about a spacing apart, that the water extends along
/// gravity, hangs together, and fills the box that it spans, as a column does and a tank with its
/// walls does not. Throws surge::Error, which names the option that answers it.
void check_first_frame(const Run& run, const ParticleFrame& frame, const SourceOptions& options);

}  // namespace surge::compare
