# Language level, optimisation, warnings and sanitizers, for every target of the project.
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

if (NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif ()

set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_BINDIR}")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/lib")
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/lib")

# A program is not linked again when only the inside of a shared library has changed.
set(CMAKE_LINK_DEPENDS_NO_SHARED ON)

option(TIPP_WARNINGS_AS_ERRORS "Treat the compiler's warnings as errors" OFF)
set(TIPP_SANITIZE "" CACHE STRING "Sanitizers to build with, as for -fsanitize=")

# Expansion arithmetic is exact only if no multiply and add are contracted.
add_compile_options(-ffp-contract=off)
# Wheels are for processors since 2009, as those of current NumPy. Code for AVX2 is chosen at run time.
if (TIPP_BUILD_WHEEL AND CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$")
  add_compile_options(-march=x86-64-v2)
endif ()
# GCC notes that version 4.6 changed how vectors are passed. This does not matter: none is passed between libraries.
if (CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
  add_compile_options(-Wno-psabi)
endif ()
if (TIPP_SANITIZE)
  add_compile_options(-fsanitize=${TIPP_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${TIPP_SANITIZE})
endif ()

# What parallel loops need. A wheel would have to bring an OpenMP library, beside those of other packages in the same
# process, so it has a pool of threads instead.
if (TIPP_BUILD_WHEEL)
  find_package(Threads REQUIRED)
  set(TIPP_THREADS Threads::Threads)
else ()
  find_package(OpenMP REQUIRED COMPONENTS CXX)
  set(TIPP_THREADS OpenMP::OpenMP_CXX)
endif ()

# LLVM's tool Archer tells ThreadSanitizer about OpenMP's barriers; without it, every parallel loop is reported. OpenMP's
# runtime loads Archer if it is in the program's run path.
if (TIPP_SANITIZE MATCHES "thread")
  get_filename_component(tipp_openmp_directory "${OpenMP_omp_LIBRARY}" DIRECTORY)
  find_library(TIPP_ARCHER_LIBRARY archer HINTS "${tipp_openmp_directory}" NO_DEFAULT_PATH)
  if (NOT TIPP_ARCHER_LIBRARY)
    message(FATAL_ERROR "ThreadSanitizer needs clang and its OpenMP library with libarcher.so: "
      "use the preset tsan and install libomp-dev.")
  endif ()
  get_filename_component(tipp_archer_directory "${TIPP_ARCHER_LIBRARY}" DIRECTORY)
  list(APPEND CMAKE_BUILD_RPATH "${tipp_archer_directory}")
endif ()

# Sets `result` to the target that an alias such as TIPP::TIPPIO refers to. VTK 9.7 names module targets after libraries.
function (tipp_real_target result target)
  get_target_property(aliased "${target}" ALIASED_TARGET)
  if (aliased)
    set(target "${aliased}")
  endif ()
  set(${result} "${target}" PARENT_SCOPE)
endfunction ()

# Our own targets only: VTK's generated wrappers do not compile without warnings.
function (tipp_warnings target)
  tipp_real_target(target "${target}")
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic)
  # GCC treats the sources that a unity build includes as headers, and warns of their anonymous namespaces.
  if (CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  endif ()
  if (TIPP_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif ()
endfunction ()

# Compiles a program whose long work is done by the libraries with less optimisation, in half the time.
function (tipp_compile_quickly target)
  if (TIPP_SANITIZE)
    target_compile_options(${target} PRIVATE -O0)
  else ()
    # The wheel is to be small.
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:$<IF:$<BOOL:${TIPP_BUILD_WHEEL}>,-Os,-O1>>)
  endif ()
endfunction ()

# tipp_optimize_wheel(<target> <option> <folder>...)
# In the wheel, which is to be small, compiles the sources in these folders of a target with an option such as -Os.
function (tipp_optimize_wheel target option)
  if (NOT TIPP_BUILD_WHEEL)
    return ()
  endif ()
  tipp_real_target(target "${target}")
  get_target_property(sources ${target} SOURCES)
  foreach (folder IN LISTS ARGN)
    set(chosen ${sources})
    list(FILTER chosen INCLUDE REGEX "^${folder}/")
    if (NOT chosen)
      message(FATAL_ERROR "${target} has no sources in ${folder}: name a folder that has some.")
    endif ()
    set_property(SOURCE ${chosen} APPEND PROPERTY COMPILE_OPTIONS $<$<CONFIG:Release>:${option}>)
  endforeach ()
endfunction ()
