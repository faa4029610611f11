# Run by the build: writes a source that holds the files of the folder `template` as text, so that
# the program needs no data folder. Variables: FOLDER, FILES (separated by |), OUTPUT.
string(REPLACE "|" ";" FILES "${FILES}")
list(SORT FILES)
set(source "#include \"foam_cases/text.hpp\"\n\nnamespace surge::foam {\n\n")
string(APPEND source "const std::map<std::string_view, std::string_view>& template_files() {\n")
string(APPEND source "  static const std::map<std::string_view, std::string_view> files{\n")
foreach(file IN LISTS FILES)
  file(RELATIVE_PATH name "${FOLDER}" "${file}")
  file(READ "${file}" text)
  string(APPEND source "      {\"${name}\", R\"template(${text})template\"},\n")
endforeach()
string(APPEND source "  };\n  return files;\n}\n\n}  // namespace surge::foam\n")
file(WRITE "${OUTPUT}" "${source}")
