# Writes OUTPUT: a function that returns the fingerprint of the sources in SOURCE_DIR.
file(GLOB_RECURSE files RELATIVE ${SOURCE_DIR} ${SOURCE_DIR}/*.cpp ${SOURCE_DIR}/*.hpp)
list(SORT files)
set(all)
foreach(file ${files})
  file(SHA256 ${SOURCE_DIR}/${file} hash)
  string(APPEND all "${file} ${hash}\n")
endforeach()
string(SHA256 hash "${all}")
file(WRITE ${OUTPUT} "#include \"particle/io/source_hash.hpp\"

std::string_view surge::source_hash() {
  return \"${hash}\";
}
")
