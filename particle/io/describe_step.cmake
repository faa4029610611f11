# Run by the build: finds what Solver::step() of each method calls, in the order of the source, and
# what the comment on each function's declaration says it does, and writes that as a table. So the
# flowcharts of the report cannot differ from the code. Variables: SOURCE_DIR, METHODS, OUTPUT.
#
# Taken are functions called by their plain name: neither std::min nor report.add. The comment's first
# line counts; "Eq. (4)" or "Eqs. (4), (5)" at its end is taken apart. A function without a comment
# gets an empty text. A call that is made only with some options names them behind it, as
#   if (...) shift_particles(dt);  // if shifting
# `// if a or b=c`: a is not zero, none or empty, or b is c; names of options or of parts of a case.
string(REPLACE "|" ";" METHODS "${METHODS}")

# The body of step(), with its comments.
function(step_body file result)
  file(READ "${file}" text)
  string(FIND "${text}" "StepReport Solver<D>::step(" start)
  if(start EQUAL -1)
    message(FATAL_ERROR "${file}: found no StepReport Solver<D>::step(, expected one")
  endif()
  string(SUBSTRING "${text}" ${start} -1 text)
  string(FIND "${text}" "{" start)
  string(FIND "${text}" "\n}" end)
  math(EXPR length "${end} - ${start}")
  string(SUBSTRING "${text}" ${start} ${length} text)
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

# First line of the comment on a function's declaration.
function(comment_of header name result)
  file(READ "${header}" text)
  set(comment "")
  if(text MATCHES "\n *///([^\n]*)(\n *///[^\n]*)*\n( *template <[^\n]*>\n)?[^\n/;]* ${name}\\(")
    string(STRIP "${CMAKE_MATCH_1}" comment)
  endif()
  set(${result} "${comment}" PARENT_SCOPE)
endfunction()

set(source "#include \"particle/io/method_sheet.hpp\"\n\nnamespace surge {\n\nnamespace {\n\n")
foreach(method IN LISTS METHODS)
  set(folder "${SOURCE_DIR}/${method}")
  step_body("${folder}/solver.cpp" commented)
  string(REGEX REPLACE "//[^\n]*" "" body "${commented}")
  # A ; would end an entry of the list; foo<D>( is a call of foo.
  string(REPLACE ";" " " body "${body}")
  string(REGEX REPLACE "<[^<>()]*>\\(" "(" body "${body}")
  string(REGEX MATCHALL "[A-Za-z0-9_:.>]+\\(" calls "${body}")
  string(APPEND source "constexpr Stage list_of_${method}[] = {\n")
  foreach(call IN LISTS calls)
    if(call MATCHES "[:.>]" OR call MATCHES "^(if|for|while|switch|return)\\(")
      continue()
    endif()
    string(REPLACE "(" "" name "${call}")
    comment_of("${folder}/solver.hpp" "${name}" comment)
    string(REGEX REPLACE "\\.$" "" comment "${comment}")
    set(equations "")
    if(comment MATCHES "^(.*), (Eqs?\\. .*)$")
      set(comment "${CMAKE_MATCH_1}")
      set(equations "${CMAKE_MATCH_2}")
    endif()
    set(options "")
    if(commented MATCHES "[^A-Za-z0-9_]${name}\\([^\n]*// if ([a-z0-9_= ]+)")
      string(STRIP "${CMAKE_MATCH_1}" options)
    endif()
    string(APPEND source
           "    {\"${name}\", R\"text(${comment})text\", \"${equations}\", \"${options}\"},\n")
  endforeach()
  string(APPEND source "};\n\n")
endforeach()
string(APPEND source "}  // namespace\n\n")
string(APPEND source "std::span<const Stage> stages_of(std::string_view method) {\n")
foreach(method IN LISTS METHODS)
  string(APPEND source "  if (method == \"${method}\") return list_of_${method};\n")
endforeach()
string(APPEND source "  return {};\n}\n\n")
file(WRITE "${OUTPUT}" "${source}}  // namespace surge\n")
