# Run by the build: writes a source that holds the files of the page as text. Variables: FILES (names
# with | between them), OUTPUT.
string(REPLACE "|" ";" files "${FILES}")
set(entries "")
set(count 0)
foreach(file IN LISTS files)
  get_filename_component(name "${file}" NAME)
  file(READ "${file}" content)
  if(name MATCHES "[.]js$")
    string(FIND "${content}" "]]>" end)
    if(NOT end EQUAL -1)
      message(FATAL_ERROR "${name}: ]]> found, which would end the page's CDATA section")
    endif()
  endif()
  # A literal ends at 64 KiB at the latest in the standard; ours are far shorter.
  string(APPEND entries "    {\"${name}\", R\"surge_page(${content})surge_page\"},\n")
  math(EXPR count "${count} + 1")
endforeach()
file(WRITE "${OUTPUT}" "#include \"compare/report/page.hpp\"

namespace surge::compare {

std::span<const std::pair<std::string_view, std::string_view>> page_files() {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, ${count}> files{{
${entries}  }};
  return files;
}

}  // namespace surge::compare
")
