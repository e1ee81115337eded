cmake_minimum_required(VERSION 3.22)
# CITATION.cff, the conda recipe and the newest entry of CHANGELOG.md in SOURCE must state VERSION.
foreach (check IN ITEMS "CITATION.cff|version: ([0-9.]+)" "CHANGELOG.md|## ([0-9.]+)"
    "Utilities/conda/recipe.yaml|  version: .([0-9.]+)")
  string(REPLACE "|" ";" check "${check}")
  list(GET check 0 file)
  list(GET check 1 pattern)
  file(READ "${SOURCE}/${file}" text)
  string(REGEX MATCH "\n${pattern}" found "${text}")
  set(named "${CMAKE_MATCH_1}")
  if (NOT named STREQUAL VERSION)
    message(FATAL_ERROR "${file} is of version '${named}', CMakeLists.txt of '${VERSION}'.")
  endif ()
endforeach ()
