# Run at every build: writes version.cpp, and touches it only where the commit changed.
execute_process(COMMAND git describe --always --dirty --abbrev=12 --exclude=*
                WORKING_DIRECTORY ${SOURCE_DIR} OUTPUT_VARIABLE SURGE_COMMIT
                OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT SURGE_COMMIT)
  set(SURGE_COMMIT unknown)
endif()
configure_file(${SOURCE_DIR}/particle/support/version.cpp.in ${OUTPUT} @ONLY)
