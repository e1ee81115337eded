#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Configures and builds a preset of CMakePresets.json:
#   sh Utilities/build.sh [PRESET [OPTION...]]      (PRESET: default, if none is named; OPTIONs: cmake --build's)
set -eu

preset=${1:-default}
[ $# -eq 0 ] || shift
top=$(cd "$(dirname "$0")/.." && pwd)
sh "$top/Utilities/install-packages.sh"
cd "$top"

# A compiler cache, where there is one, makes the second build quick.
if command -v ccache > /dev/null; then
  export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache
  export CCACHE_SLOPPINESS=pch_defines,time_macros # or it passes over precompiled headers
fi

cmake --preset "$preset" --log-level=WARNING
cmake --build --preset "$preset" "$@"
