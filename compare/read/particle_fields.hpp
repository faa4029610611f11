#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "compare/read/particle_table.hpp"
#include "compare/read/physics.hpp"

namespace surge::compare {

/// A vector of the particles: one array with components, or one array for each component.
struct VectorField {
  std::vector<std::string> names;
  std::vector<std::size_t> axes;  ///< of each of several names: 0, 1, 2 for x, y, z

  /// Axes by the names' last letters (x, y, z; u, v, w; 0, 1, 2) where they tell; else in order.
  static VectorField of(const std::vector<std::string>& names);
};

/// Names of the position under which tables usually hold it; empty where none is found.
[[nodiscard]] std::vector<std::string> usual_position(const ParticleTable& table);

/// An array of a table with a number of components; throws surge::Error that names the arrays that
/// there are.
[[nodiscard]] const ParticleArray& require_array(const ParticleTable& table,
                                                 const std::string& name, int components,
                                                 const std::filesystem::path& file);

/// The same of numbers, not of words.
[[nodiscard]] const ParticleArray& require_numbers(const ParticleTable& table,
                                                   const std::string& name, int components,
                                                   const std::filesystem::path& file);

/// What of a type array means fluid: numbers, or the words that `fluid_type` was stated with.
struct FluidTypes {
  explicit FluidTypes(const SourceOptions& options);

  TypeValues values;
  std::vector<std::string> words;  ///< empty where numbers mean fluid

  [[nodiscard]] std::string text() const;
  /// Which particles are fluid. Throws surge::Error where words are expected and the array holds
  /// numbers, or the other way round.
  [[nodiscard]] std::vector<bool> fluid(const ParticleArray& type,
                                        const std::filesystem::path& file) const;
};

/// The vectors of all particles in the file's axes and units; missing components are zero. Throws
/// surge::Error where an array is missing or not as long as the others.
[[nodiscard]] std::vector<Vec3> vectors(const ParticleTable& table, const VectorField& field,
                                        const std::filesystem::path& file);

/// Positions of all particles in the file's axes and units.
[[nodiscard]] std::vector<Vec3> positions(const ParticleTable& table, const VectorField& field,
                                          const std::filesystem::path& file);

}  // namespace surge::compare
