# Settings of `cpack`, which makes Debian packages of the installed components, or of the ParaView plugin if this
# tree builds that. Utilities/package.sh configures the build for them (the prefix is /usr).
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME tipp)
set(CPACK_PACKAGE_VERSION "${PROJECT_VERSION}")
set(CPACK_PACKAGE_CONTACT "The TIPP developers <tipp@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Unstructured meshes that outgrow a desktop filter")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_PACKAGING_INSTALL_PREFIX "${CMAKE_INSTALL_PREFIX}")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)

if (TIPP_BUILD_PARAVIEW_PLUGIN)
  # One package: the plugin, its libraries and its Python modules.
  set(CPACK_COMPONENTS_ALL runtime python plugin)
  set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
  set(CPACK_PACKAGE_NAME paraview-tipp)
  set(CPACK_DEBIAN_PACKAGE_NAME paraview-tipp)
  # The plugin works with the minor version of ParaView that it was built against.
  math(EXPR next_minor "${ParaView_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PACKAGE_DEPENDS "paraview (>= ${ParaView_VERSION_MAJOR}.${ParaView_VERSION_MINOR}), \
paraview (<< ${ParaView_VERSION_MAJOR}.${next_minor})")
  set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
    "ParaView plugin for exact Delaunay triangulation, partitioned meshes and resampling")
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_BINARY_DIR}/${tipp_library_destination}")
else ()
  set(CPACK_COMPONENTS_ALL runtime development python tool)
  set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
  set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_BINARY_DIR}/lib")
  set(tipp_this_version "(= ${PROJECT_VERSION})")

  set(tipp_runtime_package "libtipp${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}")
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME "${tipp_runtime_package}")
  set(CPACK_COMPONENT_RUNTIME_DESCRIPTION
    "VTK modules for exact Delaunay triangulation, partitioned meshes and resampling")
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
  # GDAL's library, which is opened when a GeoTIFF is written. It is recommended by way of gdal-bin, because the name of
  # its own package contains its version.
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS gdal-bin)

  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libtipp-dev)
  set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Headers and CMake package of TIPP's VTK modules")
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "${tipp_runtime_package} ${tipp_this_version}, libvtk9-dev, libopenmpi-dev")
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)

  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-tipp)
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Python package of TIPP's VTK modules, for NumPy arrays")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "${tipp_runtime_package} ${tipp_this_version}, python3, python3-numpy, python3-vtk9")

  set(CPACK_DEBIAN_TOOL_PACKAGE_NAME tipp)
  set(CPACK_COMPONENT_TOOL_DESCRIPTION
    "Command line for exact Delaunay triangulation, partitioned meshes and resampling")
  set(CPACK_DEBIAN_TOOL_PACKAGE_DEPENDS "${tipp_runtime_package} ${tipp_this_version}")
endif ()
include(CPack)
