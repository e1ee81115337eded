#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Builds the core, which needs no VTK, and its tests for 64-bit ARM on a Debian machine of another kind, and runs them:
#   sh Utilities/aarch64.sh test [NAMES]       all tests, or those whose names match the regular expression NAMES
#   sh Utilities/aarch64.sh checksums          meshes, rasters and files are the same, byte for byte, as on this machine
#   sh Utilities/aarch64.sh wheel FOLDER [PYTHON]   the wheel for manylinux_2_28_aarch64; PYTHON is 3.12 or newer
# As root it installs Debian's cross compiler, QEMU's user mode, and the arm64 packages of the tests' libraries.
set -eu

top=$(cd "$(dirname "$0")/.." && pwd)
cd "$top"
toolchain=$top/CMake/Toolchains/aarch64-linux-gnu.cmake
what=${1:-}

install() { # PACKAGE...
  dpkg-query --show "$@" > /dev/null 2>&1 && return
  dpkg --add-architecture arm64
  apt-get update -q
  DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "$@"
}

# configure FOLDER OPTION...: the tests of the core
configure() {
  folder=$1
  shift
  if command -v ccache > /dev/null; then
    set -- "$@" -DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache
  fi
  cmake -S . -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON -DTIPP_BUILD_WHEEL=ON \
    -DTIPP_BUILD_EXTENSION=OFF -DTIPP_BUILD_CORE_TESTING=ON -DTIPP_WARNINGS_AS_ERRORS=ON "$@"
}

case $what in
  test | checksums)
    install g++-aarch64-linux-gnu qemu-user-static libgmp-dev:arm64 libmpfr-dev:arm64 libgtest-dev:arm64 \
      libfmt-dev:arm64 libdeflate-dev:arm64
    configure build-aarch64 "--toolchain=$toolchain"
    ;;
  wheel)
    [ $# -ge 2 ] || { echo "Name a folder for the wheel: sh Utilities/aarch64.sh wheel FOLDER [PYTHON]" >&2; exit 2; }
    install g++-aarch64-linux-gnu libc6-dev-arm64-cross libfmt-dev:arm64 libdeflate-dev:arm64
    export CXX=aarch64-linux-gnu-g++ TIPP_WHEEL_MACHINE=aarch64 _PYTHON_HOST_PLATFORM=linux-aarch64
    export CMAKE_ARGS="-DCMAKE_TOOLCHAIN_FILE=$toolchain"
    exec sh Utilities/wheel.sh "$2" "${3:-python3}"
    ;;
  *)
    sed -n '3,7s/^# \{0,1\}//p' "$0" >&2
    exit 2
    ;;
esac

if [ "$what" = test ]; then
  cmake --build build-aarch64
  ctest --test-dir build-aarch64 --output-on-failure --timeout 3000 -R "${2:-.}"
else
  configure build-core
  cmake --build build-aarch64 --target printChecksums
  cmake --build build-core --target printChecksums
  (cd build-aarch64 && qemu-aarch64-static bin/printChecksums > checksums.txt)
  (cd build-core && bin/printChecksums > checksums.txt)
  diff build-aarch64/checksums.txt build-core/checksums.txt
  echo "All $(wc -l < build-core/checksums.txt) checksums agree."
fi
