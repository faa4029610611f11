#pragma once

#include <span>
#include <string>
#include <string_view>

#include "particle/io/methods.hpp"

namespace surge {

/// A preset file, particle/cases/presets/<method>-<name>.toml, as built into the program.
struct PresetFile {
  std::string_view name;  ///< file name without .toml, such as "sph-paper"
  std::string_view text;
};

/// All presets in the order of their file names. Defined in a source that the build generates.
[[nodiscard]] std::span<const PresetFile> preset_files();

/// Sets the options of a preset and of those that it extends. Throws Error for an unknown name,
/// with the names that there are, and for bad entries in the preset file.
void apply_preset(const Method& method, std::string_view name, std::any& options);

/// Names of the presets of a method, without the method's prefix.
[[nodiscard]] std::vector<std::string> preset_names(std::string_view method);

/// The preset's own line about itself.
[[nodiscard]] std::string preset_description(const PresetFile& file);

}  // namespace surge
