# Run by the build: writes a source that holds the preset files as text, so that the program needs
# no data folder. Variables: FILES (separated by |), OUTPUT.
string(REPLACE "|" ";" FILES "${FILES}")
list(SORT FILES)
set(source "#include \"particle/io/presets.hpp\"\n\nnamespace surge {\n\nnamespace {\n\n")
string(APPEND source "constexpr PresetFile files[] = {\n")
foreach(file IN LISTS FILES)
  get_filename_component(name "${file}" NAME_WE)
  file(READ "${file}" text)
  string(APPEND source "    {\"${name}\", R\"toml(${text})toml\"},\n")
endforeach()
string(APPEND source "};\n\n}  // namespace\n\n")
string(APPEND source "std::span<const PresetFile> preset_files() { return files; }\n\n}  // namespace surge\n")
file(WRITE "${OUTPUT}" "${source}")
