cmake_minimum_required(VERSION 3.22)
# Builds the example project against the package in PREFIX, and runs its programs.
file(REMOVE_RECURSE "${WORK}")
foreach (command IN ITEMS
    "-S;${SOURCE};-B;${WORK};-DCMAKE_PREFIX_PATH=${PREFIX};-DCMAKE_CXX_COMPILER=${CXX};-DVTK_DIR=${VTK}"
    "--build;${WORK}")
  execute_process(COMMAND "${CMAKE_COMMAND}" ${command} COMMAND_ERROR_IS_FATAL ANY)
endforeach ()
execute_process(COMMAND "${WORK}/triangulate" OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
if (NOT output MATCHES "^1[0-9][0-9][0-9][0-9][0-9] triangles")
  message(FATAL_ERROR "100000 points give nearly 200000 triangles, not: ${output}")
endif ()
execute_process(COMMAND "${WORK}/resample" OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
if (NOT output MATCHES "^height 1 in the middle of 10201 samples")
  message(FATAL_ERROR "The surface is 1 high in its middle, not: ${output}")
endif ()
