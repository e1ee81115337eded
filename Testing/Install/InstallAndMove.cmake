cmake_minimum_required(VERSION 3.22)
# Installs into PREFIX-first, then renames it to PREFIX: nothing installed may name its first place.
file(REMOVE_RECURSE "${PREFIX}" "${PREFIX}-first")
execute_process(
  COMMAND "${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${PREFIX}-first"
  COMMAND_ERROR_IS_FATAL ANY)
file(RENAME "${PREFIX}-first" "${PREFIX}")
