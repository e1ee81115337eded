# The three VTK modules and their install rules; for ParaView also the plugin's own module.
set(tipp_module_files
  "${CMAKE_CURRENT_SOURCE_DIR}/Accelerators/vtk.module"
  "${CMAKE_CURRENT_SOURCE_DIR}/IO/vtk.module"
  "${CMAKE_CURRENT_SOURCE_DIR}/Filters/vtk.module")
set(tipp_install_headers ON)
if (TIPP_BUILD_PARAVIEW_PLUGIN)
  list(APPEND tipp_module_files "${CMAKE_CURRENT_SOURCE_DIR}/Plugins/RangeReader/vtk.module")
  set(tipp_install_headers OFF)
else ()
  set(tipp_library_destination "${CMAKE_INSTALL_LIBDIR}")
  set(tipp_library_suffix "")
endif ()

vtk_module_scan(
  MODULE_FILES ${tipp_module_files}
  PROVIDES_MODULES tipp_modules
  WANT_BY_DEFAULT ON
  HIDE_MODULES_FROM_CACHE ON)

# The libraries find each other even if the installed tree is moved, and VTK where it was at build time.
set(CMAKE_INSTALL_RPATH "$ORIGIN")
set(CMAKE_INSTALL_RPATH_USE_LINK_PATH ON)
vtk_module_build(
  MODULES ${tipp_modules}
  PACKAGE TIPP
  INSTALL_EXPORT TIPP
  INSTALL_HEADERS ${tipp_install_headers}
  LIBRARY_DESTINATION "${tipp_library_destination}"
  HEADERS_DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/tipp"
  CMAKE_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/TIPP"
  LIBRARY_NAME_SUFFIX "${tipp_library_suffix}"
  VERSION "${PROJECT_VERSION}"
  SOVERSION "${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}")
unset(CMAKE_INSTALL_RPATH_USE_LINK_PATH)
unset(CMAKE_INSTALL_RPATH)
