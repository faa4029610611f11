#include "particle/io/presets.hpp"
#include "particle/support/text.hpp"

#include <algorithm>

namespace surge {

namespace {

TomlTable open_preset(const PresetFile& file) {
  return TomlTable::parse(file.text, "presets/" + std::string(file.name) + ".toml");
}

/// `depth` ends a circle of presets that extend each other.
void apply(const Method& method, std::string_view name, std::any& options, std::size_t depth) {
  const std::string full = std::string(method.name) + "-" + std::string(name);
  const auto files = preset_files();
  const auto file =
      std::find_if(files.begin(), files.end(), [&](auto& f) { return f.name == full; });
  if (file == files.end())
    throw Error("preset: found \"" + std::string(name) + "\", expected one of " +
                comma_list(preset_names(method.name)));
  const TomlTable preset = open_preset(*file);
  static_cast<void>(preset.text("description"));
  if (preset.has("extends")) {
    if (depth == files.size())
      throw preset.error("extends", "a circle", "a chain of presets that ends");
    apply(method, preset.text("extends"), options, depth + 1);
  }
  if (const auto table = preset.optional_table(method.name)) method.read(*table, options);
  preset.finish();
}

}  // namespace

void apply_preset(const Method& method, std::string_view name, std::any& options) {
  apply(method, name, options, 0);
}

std::vector<std::string> preset_names(std::string_view method) {
  const std::string prefix = std::string(method) + "-";
  std::vector<std::string> names;
  for (const PresetFile& file : preset_files()) {
    if (file.name.starts_with(prefix)) names.emplace_back(file.name.substr(prefix.size()));
  }
  return names;
}

std::string preset_description(const PresetFile& file) {
  return open_preset(file).text("description");
}

}  // namespace surge
