# The Python package tipp: the wrapped modules, and functions over them from Plugins/Python. It is in
# lib/python3/dist-packages/tipp, in the build tree and below the prefix. It finds the libraries relative to that
# folder, so users only set PYTHONPATH.
if (NOT TARGET VTK::WrappingPythonCore)
  message(FATAL_ERROR
    "TIPP_WRAP_PYTHON is ON, but this VTK (${VTK_DIR}) has no Python wrapping: "
    "install its Python development files or configure with -DTIPP_WRAP_PYTHON=OFF.")
endif ()

if (NOT TIPP_BUILD_PARAVIEW_PLUGIN) # the plugin has its own folder
  set(tipp_python_destination "lib/python3/dist-packages")
endif ()

# The relative path from a wrapped module to the libraries.
file(RELATIVE_PATH tipp_python_to_libraries
  "/${tipp_python_destination}/tipp" "/${tipp_library_destination}")
set(CMAKE_INSTALL_RPATH "$ORIGIN/${tipp_python_to_libraries}")
if (TIPP_BUILD_PARAVIEW_PLUGIN)
  # The plugin's module has a class with the module's name, and the wrapped code of both defines the same static names.
  set(CMAKE_UNITY_BUILD OFF)
endif ()
vtk_module_wrap_python(
  MODULES ${tipp_modules}
  TARGET TIPP::Python
  PYTHON_PACKAGE tipp
  MODULE_DESTINATION "${tipp_python_destination}"
  CMAKE_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/TIPP"
  INSTALL_HEADERS OFF
  WRAPPED_MODULES tipp_wrapped_modules)
unset(CMAKE_INSTALL_RPATH)
unset(CMAKE_UNITY_BUILD) # use the cached value again

# Builds all that the package imports.
add_custom_target(tipp_python)
set(tipp_python_imports "from ._run import require as _require_vtk\n\n_require_vtk(\"${VTK_VERSION}\")\n")
set(tipp_python_more_imports "")
set(tipp_python_more_names "")
set(tipp_python_other_names "")
set(tipp_python_listed_names "")
set(tipp_python_summary
  "and the VTK classes that these use: vtkTIPPDelaunay2D, vtkTIPPDelaunay3D, vtkTIPPOutOfCoreDelaunay2D,\nvtkTIPPRefine2D, vtkTIPPRemap, vtkTIPPCutFill, vtkTIPPPointsToImage, vtkTIPPResampleSeries,\nvtkRangeResampleFilter, vtkPartitionedMeshQuery, vtkTIPPPointReader, vtkPartitionedUnstructuredReader and\nvtkPartitionedUnstructuredWriter.")
foreach (module IN LISTS tipp_wrapped_modules)
  string(REPLACE "TIPP::" "vtk" library "${module}")
  add_dependencies(tipp_python "${library}Python")
  string(APPEND tipp_python_imports "from .${library} import *\n")
endforeach ()
set(tipp_python_source "${PROJECT_SOURCE_DIR}/Plugins/Python/tipp")
set(tipp_python_package "${CMAKE_BINARY_DIR}/${tipp_python_destination}/tipp")
configure_file("${tipp_python_source}/__init__.py.in" "${tipp_python_package}/__init__.py" @ONLY)
file(GLOB tipp_python_files CONFIGURE_DEPENDS
  "${tipp_python_source}/*.py" "${tipp_python_source}/py.typed")
foreach (file IN LISTS tipp_python_files)
  configure_file("${file}" "${tipp_python_package}" COPYONLY)
endforeach ()
install(FILES "${tipp_python_package}/__init__.py" ${tipp_python_files}
  DESTINATION "${tipp_python_destination}/tipp"
  COMPONENT python)

# VTK's Python modules need the interpreter that is installed beside VTK, which need not be the first on the PATH.
find_program(TIPP_PYTHON_EXECUTABLE
  NAMES python3
  HINTS "${VTK_PREFIX_PATH}/bin"
  NO_DEFAULT_PATH
  DOC "The Python interpreter that has vtkmodules")
