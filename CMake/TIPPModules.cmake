# The three VTK modules, their Python package and their install rules.
set(tipp_module_files
  "${CMAKE_CURRENT_SOURCE_DIR}/Accelerators/vtk.module"
  "${CMAKE_CURRENT_SOURCE_DIR}/IO/vtk.module"
  "${CMAKE_CURRENT_SOURCE_DIR}/Filters/vtk.module")

vtk_module_scan(
  MODULE_FILES ${tipp_module_files}
  PROVIDES_MODULES tipp_modules
  WANT_BY_DEFAULT ON
  HIDE_MODULES_FROM_CACHE ON)

# The libraries find each other wherever the installed tree is moved to.
set(CMAKE_INSTALL_RPATH "$ORIGIN")
vtk_module_build(
  MODULES ${tipp_modules}
  PACKAGE TIPP
  INSTALL_EXPORT TIPP
  INSTALL_HEADERS ON
  HEADERS_DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/tipp"
  CMAKE_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/TIPP"
  LIBRARY_NAME_SUFFIX ""
  VERSION "${PROJECT_VERSION}"
  SOVERSION "${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}")
unset(CMAKE_INSTALL_RPATH)
