cmake_minimum_required(VERSION 3.22)
# Installs into PREFIX-first and renames it to PREFIX: installed files must not contain the first
# path.
file(REMOVE_RECURSE "${PREFIX}" "${PREFIX}-first")
execute_process(
  COMMAND "${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${PREFIX}-first"
  COMMAND_ERROR_IS_FATAL ANY)
file(RENAME "${PREFIX}-first" "${PREFIX}")
