# For the tests of the wheel's libraries, which have no VTK: each program gets those of its sources that need none. The
# lists of sources and libraries are the same as with VTK.
find_package(Python3 REQUIRED COMPONENTS Interpreter)
file(GLOB_RECURSE vtk_users CONFIGURE_DEPENDS "${CMAKE_CURRENT_LIST_DIR}/*.cxx")
execute_process(COMMAND "${Python3_EXECUTABLE}" "${CMAKE_CURRENT_LIST_DIR}/vtk_users.py" "${PROJECT_SOURCE_DIR}" ${vtk_users}
  OUTPUT_VARIABLE vtk_users COMMAND_ERROR_IS_FATAL ANY)
set_property(GLOBAL PROPERTY TIPP_VTK_USERS "${vtk_users}")

foreach (module IN ITEMS CommonCore CommonDataModel CommonExecutionModel CommonMath CommonTransforms FiltersCore
    IOGeometry IOLegacy IOPLY IOXML ParallelCore)
  add_library(VTK::${module} INTERFACE IMPORTED)
endforeach ()

# tipp_without_vtk(<result> <source>...)
function (tipp_without_vtk result)
  get_property(vtk_users GLOBAL PROPERTY TIPP_VTK_USERS)
  set(sources "")
  foreach (source IN LISTS ARGN)
    get_filename_component(path "${source}" ABSOLUTE)
    if (NOT path IN_LIST vtk_users)
      list(APPEND sources "${source}")
    endif ()
  endforeach ()
  set(${result} "${sources}" PARENT_SCOPE)
endfunction ()

# Leaves out a program of tests that need VTK. Its folder sets properties of the target, so there is one that is never built.
function (tipp_leave_out_program name)
  file(WRITE "${CMAKE_BINARY_DIR}/Empty.cxx" "")
  add_library(${name} OBJECT EXCLUDE_FROM_ALL "${CMAKE_BINARY_DIR}/Empty.cxx")
endfunction ()
