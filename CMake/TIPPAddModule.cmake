# tipp_add_module(<name> [CLASSES <class>...] [HEADERS <header>...] [NEEDS <module>...] CORE <source>... VTK <source>...
#   [NO_VTK <source>...])
# Adds a VTK module of the CORE and VTK sources, which installs HEADERS and those of the CLASSES. In the build for the
# Python wheel, which has no VTK, a static library of the CORE and NO_VTK sources, linked with the modules that it NEEDS
# (for VTK, these are in vtk.module).
function (tipp_add_module name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "CLASSES;HEADERS;NEEDS;CORE;VTK;NO_VTK")
  foreach (source IN LISTS arg_CORE arg_NO_VTK) # a test reads this list
    set_property(GLOBAL APPEND PROPERTY TIPP_WHEEL_SOURCES "${CMAKE_CURRENT_SOURCE_DIR}/${source}")
  endforeach ()
  if (NOT TIPP_BUILD_WHEEL)
    foreach (list IN ITEMS CLASSES HEADERS)
      if (arg_${list})
        list(PREPEND arg_${list} ${list})
      endif ()
    endforeach ()
    vtk_module_add_module(${name} ${arg_CLASSES} ${arg_HEADERS} SOURCES ${arg_CORE} ${arg_VTK})
    return ()
  endif ()
  string(REPLACE "TIPP::" "" target "${name}")
  string(TOUPPER "VTK${target}" macro)
  file(CONFIGURE OUTPUT "${CMAKE_CURRENT_BINARY_DIR}/vtk${target}Module.h"
    CONTENT "#define ${macro}_EXPORT\n#define ${macro}_NO_EXPORT\n")
  add_library(${target} STATIC ${arg_CORE} ${arg_NO_VTK})
  add_library(${name} ALIAS ${target})
  target_include_directories(${target} PUBLIC "${CMAKE_CURRENT_SOURCE_DIR}" "${CMAKE_CURRENT_BINARY_DIR}")
  target_link_libraries(${target} PUBLIC ${arg_NEEDS})
endfunction ()

# tipp_link_module(<name> <library>...)
function (tipp_link_module name)
  if (TIPP_BUILD_WHEEL)
    tipp_real_target(target "${name}")
    target_link_libraries(${target} PUBLIC ${ARGN})
  else ()
    vtk_module_link(${name} PRIVATE ${ARGN})
  endif ()
endfunction ()
