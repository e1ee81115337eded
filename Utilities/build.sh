#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Configures and builds a preset of CMakePresets.json:
#   sh Utilities/build.sh [PRESET [OPTION...]]      (PRESET: default if not given; OPTIONs: those of cmake --build)
set -eu

preset=${1:-default}
[ $# -eq 0 ] || shift
top=$(cd "$(dirname "$0")/.." && pwd)
sh "$top/Utilities/install-packages.sh"
cd "$top"

# If a compiler cache is installed, it makes the second build fast.
if command -v ccache > /dev/null; then
  export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache
  export CCACHE_SLOPPINESS=pch_defines,time_macros # without this it ignores precompiled headers
fi

if [ "$preset" = paraview ]; then
  sh Utilities/paraview.sh build-paraview/debian
fi
cmake --preset "$preset" --log-level=WARNING
cmake --build --preset "$preset" "$@"
