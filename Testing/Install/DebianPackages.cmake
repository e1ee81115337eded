cmake_minimum_required(VERSION 3.22)
# Makes the Debian packages of BUILD, unpacks them into one folder and uses them there, as if they
# were installed. They must have VERSION.
find_program(DPKG_DEB dpkg-deb)
find_program(DPKG_SHLIBDEPS dpkg-shlibdeps)
if (NOT DPKG_DEB OR NOT DPKG_SHLIBDEPS)
  message(STATUS "Skipped: Debian packages need dpkg-deb and dpkg-shlibdeps (package dpkg-dev).")
  return ()
endif ()
file(REMOVE_RECURSE "${WORK}")
execute_process(
  COMMAND "${CPACK}" --config "${BUILD}/CPackConfig.cmake" -B "${WORK}"
  COMMAND_ERROR_IS_FATAL ANY)
file(GLOB packages "${WORK}/*.deb")
foreach (name IN ITEMS libtipp${MINOR} libtipp-dev python3-tipp tipp)
  file(GLOB package "${WORK}/${name}_${VERSION}_*.deb")
  if (NOT package)
    message(FATAL_ERROR "There is no package ${name} of version ${VERSION}, but: ${packages}")
  endif ()
  execute_process(
    COMMAND "${DPKG_DEB}" --field "${package}" Depends
    OUTPUT_VARIABLE depends COMMAND_ERROR_IS_FATAL ANY)
  if (NOT name MATCHES "^lib" AND NOT depends MATCHES "libtipp${MINOR} \\(= ${VERSION}\\)")
    message(FATAL_ERROR "${name} does not depend on the libraries of its version, but on: ${depends}")
  endif ()
  if (name STREQUAL "libtipp${MINOR}" AND NOT depends MATCHES "libvtk9")
    message(FATAL_ERROR "${name} does not depend on VTK, but on: ${depends}")
  endif ()
  execute_process(
    COMMAND "${DPKG_DEB}" --extract "${package}" "${WORK}/unpacked" COMMAND_ERROR_IS_FATAL ANY)
endforeach ()

set(prefix "${WORK}/unpacked/${INSTALL_PREFIX}")
execute_process(
  COMMAND "${CMAKE_COMMAND}" -E env --unset=LD_LIBRARY_PATH
    "${prefix}/bin/tipp" points --distribution uniform --count 1000 --seed 1 -o "${WORK}/points.npy"
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(
  COMMAND "${CMAKE_COMMAND}" -E env --unset=LD_LIBRARY_PATH
    "PYTHONPATH=${prefix}/lib/python3/dist-packages" "${PYTHON}" -c
    "import tipp, numpy; assert tipp.__version__ == '${VERSION}'; print(len(tipp.delaunay(numpy.load('${WORK}/points.npy'))))"
  OUTPUT_VARIABLE triangles COMMAND_ERROR_IS_FATAL ANY)
if (NOT triangles MATCHES "^19[0-9][0-9]")
  message(FATAL_ERROR "1000 points give nearly 2000 triangles, not: ${triangles}")
endif ()
execute_process(
  COMMAND "${CMAKE_COMMAND}" -S "${SOURCE}" -B "${WORK}/consumer" "-DCMAKE_PREFIX_PATH=${prefix}"
    "-DCMAKE_CXX_COMPILER=${CXX}"
  COMMAND_ERROR_IS_FATAL ANY)
