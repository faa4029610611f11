# What `cmake --install` installs and CPack packs: component "programs" (programs, presets, cases,
# studies, published series, manual pages, completion, documentation) and component "development"
# (the comparator as a library for find_package).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(documentation ${CMAKE_INSTALL_DATADIR}/doc/surgefront)
set(data ${CMAKE_INSTALL_DATADIR}/surgefront)
set(programs surge-particle surge-compare surge-foam)

install(TARGETS ${programs} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT programs)
# The tree of the repository, so that its studies find what they name.
install(DIRECTORY particle/cases DESTINATION ${data}/particle COMPONENT programs
        FILES_MATCHING PATTERN "*.toml")
install(DIRECTORY compare/studies DESTINATION ${data}/compare COMPONENT programs
        FILES_MATCHING PATTERN "*.toml")
install(DIRECTORY compare/reference DESTINATION ${data}/compare COMPONENT programs
        FILES_MATCHING PATTERN "*.csv" PATTERN baselines EXCLUDE)
install(DIRECTORY foam_cases/damBreak2D DESTINATION ${data}/foam_cases COMPONENT programs
        USE_SOURCE_PERMISSIONS)
install(FILES README.md CHANGELOG.md CITATION.cff DESTINATION ${documentation} COMPONENT programs)
install(FILES LICENSE DESTINATION ${documentation} COMPONENT programs RENAME copyright)
install(DIRECTORY docs/ DESTINATION ${documentation} COMPONENT programs USE_SOURCE_PERMISSIONS
        PATTERN build EXCLUDE PATTERN answers EXCLUDE PATTERN conf.py EXCLUDE PATTERN index.md EXCLUDE)

# Manual pages and completion say what --help says: the programs write them.
foreach(program ${programs})
  set(page ${CMAKE_BINARY_DIR}/manual/${program}.1)
  set(completion ${CMAKE_BINARY_DIR}/manual/completion/${program})
  add_custom_command(
    OUTPUT ${page} ${completion}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_BINARY_DIR}/manual/completion
    COMMAND ${program} --print man > ${page}
    COMMAND ${program} --print completion > ${completion}
    DEPENDS ${program} VERBATIM)
  list(APPEND manual ${page} ${completion})
  install(FILES ${page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT programs)
  install(FILES ${completion} COMPONENT programs
          DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
endforeach()
add_custom_target(surge_manual ALL DEPENDS ${manual})

# SurgeFront::compare; the other two are what it is made of.
set_target_properties(surge_library PROPERTIES EXPORT_NAME compare OUTPUT_NAME surgefront)
set_target_properties(surge_compare PROPERTIES EXPORT_NAME compare_parts)
set_target_properties(surge_case PROPERTIES EXPORT_NAME case_parts)
set_target_properties(surge_support PROPERTIES EXPORT_NAME support_parts)
install(TARGETS surge_library surge_compare surge_case surge_support EXPORT SurgeFrontTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(FILES compare/library/surgefront.hpp
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/surgefront COMPONENT development)
set(config ${CMAKE_INSTALL_LIBDIR}/cmake/SurgeFront)
install(EXPORT SurgeFrontTargets NAMESPACE SurgeFront:: DESTINATION ${config} COMPONENT development)
configure_package_config_file(.ci/SurgeFrontConfig.cmake.in ${CMAKE_BINARY_DIR}/SurgeFrontConfig.cmake
                              INSTALL_DESTINATION ${config})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/SurgeFrontConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/SurgeFrontConfig.cmake ${CMAKE_BINARY_DIR}/SurgeFrontConfigVersion.cmake
        DESTINATION ${config} COMPONENT development)

# Debian packages: cmake --preset portable && cmake --build build/portable && cpack -G DEB --config ...
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME surgefront)
set(CPACK_PACKAGE_CONTACT "The SurgeFront authors <surgefront@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL programs development)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME surgefront)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_DEPENDS gnuplot-nox python3 python3-jinja2)
string(REPLACE ";" ", " CPACK_DEBIAN_PROGRAMS_PACKAGE_DEPENDS "${CPACK_DEBIAN_PROGRAMS_PACKAGE_DEPENDS}")
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SUGGESTS "openfoam")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME surgefront-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "surgefront (= ${PROJECT_VERSION}), libvtk9-dev, libhdf5-dev, zlib1g-dev, libtomlplusplus-dev")
if(SURGE_NATIVE)
  # A package is for other machines than this one.
  set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/.ci/refuse_native.cmake)
endif()
include(CPack)
