# Makes the files that find_package(TIPP) reads, in addition to the targets that vtk_module_build exports.
include(CMakePackageConfigHelpers)

set(tipp_package_destination "${CMAKE_INSTALL_LIBDIR}/cmake/TIPP")
string(REPLACE "TIPP::" "" tipp_components "${tipp_modules}")
string(REPLACE ";" ", " tipp_components "${tipp_components}")
string(REPLACE ";" " " tipp_vtk_components "${TIPP_VTK_COMPONENTS}")
if (TIPP_HAS_MPI)
  string(APPEND tipp_vtk_components " ParallelMPI")
endif ()

configure_package_config_file(
  "${CMAKE_CURRENT_LIST_DIR}/TIPPConfig.cmake.in" "${CMAKE_BINARY_DIR}/TIPPConfig.cmake"
  INSTALL_DESTINATION "${tipp_package_destination}"
  NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file("${CMAKE_BINARY_DIR}/TIPPConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(
  FILES "${CMAKE_BINARY_DIR}/TIPPConfig.cmake" "${CMAKE_BINARY_DIR}/TIPPConfigVersion.cmake"
  DESTINATION "${tipp_package_destination}"
  COMPONENT development)
install(FILES LICENSE CITATION.cff CHANGELOG.md
  DESTINATION "${CMAKE_INSTALL_DOCDIR}"
  COMPONENT runtime)

file(RELATIVE_PATH tipp_tool_to_libraries
  "/${CMAKE_INSTALL_BINDIR}" "/${CMAKE_INSTALL_LIBDIR}")
set_target_properties(tipp PROPERTIES
  INSTALL_RPATH "$ORIGIN/${tipp_tool_to_libraries}" INSTALL_RPATH_USE_LINK_PATH ON)
