cmake_minimum_required(VERSION 3.22)
# The installed tool must find its libraries in the prefix, without environment variables.
set(tool "${PREFIX}/bin/tipp")
execute_process(COMMAND "${CMAKE_COMMAND}" -E env --unset=LD_LIBRARY_PATH
  "${tool}" points --distribution uniform --count 1000 --seed 1 -o "${PREFIX}/points.npy"
  COMMAND_ERROR_IS_FATAL ANY)
if (NOT EXISTS "${PREFIX}/points.npy")
  message(FATAL_ERROR "The tool wrote no points.")
endif ()
