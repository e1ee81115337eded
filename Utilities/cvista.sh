#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Builds TIPP against VTK 9.7 from PyPI and runs the tests that need no MPI and no rendering:
#   sh Utilities/cvista.sh [FOLDER [PYTHON [TARGET...]]]
# FOLDER (default: build-cvista) gets the package cvista-sdk and the build. PYTHON (default: python3) is 3.12 or newer.
# If TARGETs, test programs, are given, only these are built and run.
set -eu

cd "$(dirname "$0")/.."
folder=${1:-build-cvista}
python=${2:-python3}
[ $# -lt 2 ] && shift $# || shift 2

sdk=$folder/sdk
[ -x "$sdk/bin/python" ] || "$python" -m venv "$sdk"
"$sdk/bin/python" -m pip -q install 'cvista-sdk>=9.7,<9.8'
config=$("$sdk/bin/python" -c 'import cvista_sdk, pathlib; print(pathlib.Path(cvista_sdk.__file__).parent / "cmake")')
cmake -S . -B "$folder/tipp" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON -DTIPP_WARNINGS_AS_ERRORS=ON \
  -DTIPP_WRAP_PYTHON=OFF -DVTK_DIR="$config"
cmake --build "$folder/tipp" ${1:+--target} "$@"
if [ $# -gt 0 ]; then
  for test in "$@"; do
    "$folder/tipp/bin/$test"
  done
else
  ctest --test-dir "$folder/tipp" --output-on-failure -j 2
fi
