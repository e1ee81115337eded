#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Makes Debian packages in FOLDER: sh Utilities/package.sh FOLDER [paraview]
# libtipp, libtipp-dev, python3-tipp and tipp; with the word paraview, paraview-tipp instead.
set -eu

[ $# -ge 1 ] || {
  sed -n '3,4s/^# \{0,1\}//p' "$0" >&2
  exit 2
}
top=$(cd "$(dirname "$0")/.." && pwd)
mkdir -p "$1"
folder=$(cd "$1" && pwd)
sh "$top/Utilities/install-packages.sh"
cd "$top"
if command -v ccache > /dev/null; then
  export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache
fi

case ${2:-} in
  paraview)
    sh Utilities/paraview.sh build-paraview/debian
    preset=paraview build=build-package-paraview
    ;;
  *) preset=default build=build-package ;;
esac
# The prefix is Debian's, so that the dynamic linker finds the libraries.
cmake --preset "$preset" -B "$build" --log-level=WARNING \
  -DCMAKE_INSTALL_PREFIX=/usr -DTIPP_BUILD_TESTING=OFF -DTIPP_BUILD_BENCHMARKS=OFF
cmake --build "$build"
cpack --config "$build/CPackConfig.cmake" -B "$folder"
rm -rf "$folder/_CPack_Packages"
