# The Python package tipp: the wrapped modules and an __init__.py that offers their classes. It lies
# at lib/python3/dist-packages/tipp in the build tree and below the prefix. The libraries are found
# from there, so that PYTHONPATH is all that users set.
if (NOT TARGET VTK::WrappingPythonCore)
  message(FATAL_ERROR
    "TIPP_WRAP_PYTHON is ON, but this VTK (${VTK_DIR}) has no Python wrapping: "
    "install its Python development files or configure with -DTIPP_WRAP_PYTHON=OFF.")
endif ()

set(tipp_python_destination "lib/python3/dist-packages")

# From a wrapped module, three folders deep below lib, to the libraries.
file(RELATIVE_PATH tipp_python_to_libraries
  "/${tipp_python_destination}/tipp" "/${CMAKE_INSTALL_LIBDIR}")
set(CMAKE_INSTALL_RPATH "$ORIGIN/${tipp_python_to_libraries}")
vtk_module_wrap_python(
  MODULES ${tipp_modules}
  TARGET TIPP::Python
  PYTHON_PACKAGE tipp
  MODULE_DESTINATION "${tipp_python_destination}"
  CMAKE_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/TIPP"
  INSTALL_HEADERS OFF
  WRAPPED_MODULES tipp_wrapped_modules)
unset(CMAKE_INSTALL_RPATH)

set(tipp_python_imports "")
foreach (module IN LISTS tipp_wrapped_modules)
  string(REPLACE "TIPP::" "vtk" library "${module}")
  string(APPEND tipp_python_imports "from .${library} import *\n")
endforeach ()
set(tipp_python_init "${CMAKE_BINARY_DIR}/${tipp_python_destination}/tipp/__init__.py")
file(CONFIGURE OUTPUT "${tipp_python_init}" CONTENT
"\"\"\"Unstructured meshes that outgrow a desktop filter.\"\"\"
@tipp_python_imports@" @ONLY)
install(FILES "${tipp_python_init}" DESTINATION "${tipp_python_destination}/tipp")

# The interpreter that VTK's own Python modules were built for is the one installed beside VTK,
# which need not be the first on the PATH.
find_program(TIPP_PYTHON_EXECUTABLE
  NAMES python3
  HINTS "${VTK_PREFIX_PATH}/bin"
  NO_DEFAULT_PATH
  DOC "The Python interpreter that has vtkmodules")
