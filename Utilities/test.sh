#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Runs the checks: sh Utilities/test.sh [STEP...]
# Without STEPs: format build tests. Others take long and must be named: asan, tsan, paraview, wheel, tidy and analysis.
# Each step ends with one line; the first failure stops the run.
set -eu

top=$(cd "$(dirname "$0")/.." && pwd)
cd "$top"
sh Utilities/install-packages.sh

sources() { git ls-files '*.cxx' '*.h'; }

# Versions of clang-format differ; this project uses that of Debian 12.
check_format() {
  if clang-format --version | grep -q 'version 14\.'; then
    sources | xargs clang-format --dry-run -Werror
  else
    echo "The format is not checked: it needs clang-format 14, this is $(clang-format --version)."
  fi
}

check_build() { sh Utilities/build.sh full; }

# Analyses the libraries and the tool, but not the tests.
run_tidy() { # OPTION...
  sh Utilities/build.sh tidy
  run-clang-tidy -quiet -p build-tidy -j "$(nproc)" "$@" \
    "^$top/(Accelerators|IO|Filters|Tools)/.*\.cxx$" \
    > build-tidy/clang-tidy.log 2>&1 || { grep -E 'error:|warning:' build-tidy/clang-tidy.log; return 1; }
}
check_tidy() { run_tidy '-checks=-clang-analyzer-*'; }
check_analysis() { run_tidy; }

check_sanitizer() { sh Utilities/build.sh "$1" && ctest --preset "$1"; }
check_asan() { check_sanitizer asan; }
check_tsan() { check_sanitizer tsan; }

# Tests that render need a display.
check_tests() { xvfb-run -a ctest --preset default; }

# Builds the plugin, and the libraries again, against ParaView's VTK. Its tests also run the tool.
check_paraview() {
  sh Utilities/build.sh default --target tipp --target tipp_python && sh Utilities/build.sh paraview &&
    ctest --preset default --label-regex '^paraview$'
}

# Builds a wheel with the Python that PYTHON names, and tests it in clean environments; needs PyPI.
check_wheel() {
  rm -rf wheels && sh Utilities/wheel.sh wheels "${PYTHON:-python3}" &&
    sh Utilities/wheel-test.sh wheels/tipp-*.whl "${PYTHON:-python3}"
}

for step in ${*:-format build tests}; do
  case $step in
    format | build | tests | asan | tsan | paraview | wheel | tidy | analysis) ;;
    *)
      echo "Unknown step '$step'; the steps are: format build tests asan tsan paraview wheel tidy analysis." >&2
      exit 2
      ;;
  esac
  begin=$(date +%s)
  status=0
  "check_$step" || status=$?
  seconds=$(($(date +%s) - begin))
  if [ "$status" -ne 0 ]; then
    echo "test.sh: $step FAILED after $seconds s"
    exit 1
  fi
  echo "test.sh: $step passed in $seconds s"
done
