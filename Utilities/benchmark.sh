#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Builds and runs a benchmark: sh Utilities/benchmark.sh NAME [OPTION...]
# NAME is a script in Utilities/benchmarks; its first lines describe its options.
set -eu

top=$(cd "$(dirname "$0")/.." && pwd)
build=$top/build-benchmark
inputs=$build/inputs
data=${TIPP_SHARED_DATA:-$top/../shared/data}

usage() {
  sed -n 's/^# \{0,1\}//; 3,4p' "$0" >&2
  for script in "$top"/Utilities/benchmarks/*.sh; do
    sed -n '2,/^[^#]/s/^# \{0,1\}//p' "$script" >&2
  done
  exit 2
}

name=${1:-}
[ -n "$name" ] && [ -f "$top/Utilities/benchmarks/$name.sh" ] || usage
shift

# Builds the named programs.
build_targets() {
  sh "$top/Utilities/install-packages.sh"
  cmake --preset default -B "$build" --log-level=WARNING \
    -DTIPP_BUILD_BENCHMARKS=ON -DTIPP_BUILD_TESTING=OFF -DTIPP_WRAP_PYTHON=OFF
  cmake --build "$build" --target "$@"
}

cd "$top"
mkdir -p "$inputs"
. "$top/Utilities/benchmarks/$name.sh"
