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

option(TIPP_WARNINGS_AS_ERRORS "Treat the compiler's warnings as errors" OFF)
set(TIPP_SANITIZE "" CACHE STRING "Sanitizers to build with, as for -fsanitize=")

# Expansion arithmetic is exact only if no multiply and add are contracted.
add_compile_options(-ffp-contract=off)
if (TIPP_SANITIZE)
  add_compile_options(-fsanitize=${TIPP_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${TIPP_SANITIZE})
endif ()

find_package(OpenMP REQUIRED COMPONENTS CXX)

# Our own targets only: VTK's generated wrappers do not compile without warnings.
function (tipp_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic)
  if (TIPP_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif ()
endfunction ()
