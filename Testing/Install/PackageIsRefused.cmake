cmake_minimum_required(VERSION 3.22)
# A project that requests REQUEST must fail to configure, with a message that contains MESSAGE.
file(REMOVE_RECURSE "${WORK}")
file(WRITE "${WORK}/CMakeLists.txt"
  "cmake_minimum_required(VERSION 3.22)\nproject(Consumer LANGUAGES C CXX)\n"
  "find_package(${REQUEST} REQUIRED)\n")
execute_process(
  COMMAND "${CMAKE_COMMAND}" -S "${WORK}" -B "${WORK}/build" "-DCMAKE_PREFIX_PATH=${PREFIX}"
    "-DCMAKE_CXX_COMPILER=${CXX}" "-DVTK_DIR=${VTK}"
  RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
# CMake breaks the lines of its messages.
string(REGEX REPLACE "[ \n]+" " " output "${output}")
string(FIND "${output}" "${MESSAGE}" place)
if (status EQUAL 0 OR place EQUAL -1)
  message(FATAL_ERROR "find_package(${REQUEST}) was to fail saying '${MESSAGE}', but: ${output}")
endif ()
