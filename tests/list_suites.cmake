# One ctest entry for each suite of a program of GoogleTest, as starting it takes longer than most tests do; for
# suites that take minutes or may be skipped, SPLIT, one for each test.
# PROGRAM, PREFIX of the names, LABEL, OUTPUT: the file for ctest.
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listed RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} --gtest_list_tests: ended with ${status}")
endif()
# Behind a # stand values of parameters, with signs in them that mean something in a list of CMake.
string(REGEX REPLACE " *#[^\n]*" "" listed "${listed}")
string(REPLACE "\n" ";" lines "${listed}")

set(filters)
foreach(line IN LISTS lines)
  if(line MATCHES "^([^ ]+)\\.$")
    set(suite ${CMAKE_MATCH_1})
    if(NOT suite MATCHES "${SPLIT}")
      list(APPEND filters "${suite}.*")
    endif()
  elseif(suite MATCHES "${SPLIT}" AND line MATCHES "^  ([^ ]+)$")
    list(APPEND filters "${suite}.${CMAKE_MATCH_1}")
  endif()
endforeach()
if(NOT filters)
  message(FATAL_ERROR "${PROGRAM}: found no tests")
endif()

set(entries "")
foreach(filter IN LISTS filters)
  # Threads that wait must not spin: tests run side by side.
  set(properties "LABELS ${LABEL} ENVIRONMENT OMP_WAIT_POLICY=passive")
  set(verbosity --gtest_brief=1)
  set(name "${PREFIX}.${filter}")
  if(filter MATCHES "\\.\\*$")
    string(REGEX REPLACE "\\.\\*$" "" name "${name}")
  else()
    string(APPEND properties " SKIP_REGULAR_EXPRESSION [==[\\[  SKIPPED \\]]==]")
    set(verbosity --gtest_brief=0)
  endif()
  string(APPEND entries "add_test([==[${name}]==] [==[${PROGRAM}]==] ${verbosity} [==[--gtest_filter=${filter}]==])\n"
         "set_tests_properties([==[${name}]==] PROPERTIES ${properties})\n")
endforeach()
file(WRITE ${OUTPUT} "${entries}")
