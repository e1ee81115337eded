#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Tests a wheel in clean environments with the current packages of PyPI:
#   sh Utilities/wheel-test.sh WHEEL [PYTHON]
# without VTK, with scipy, with VTK and PyVista, with an earlier VTK, with PyVista's back end cvista, and with the oldest
# NumPy for this Python.
set -eu

wheel=$(realpath "$1")
python=${2:-python3}
cd "$(dirname "$0")/.."
work=build-wheel/tests-$("$python" -c 'import sys; print("%d.%d" % sys.version_info[:2])')
mkdir -p "$work"
export PYTHONDONTWRITEBYTECODE=1

# environment NAME PACKAGE...: makes a virtual environment with the wheel and the packages
environment() {
  name=$1
  shift
  echo "== $name: $*"
  [ -x "$work/$name/bin/python" ] || "$python" -m venv "$work/$name"
  "$work/$name/bin/python" -m pip -q install "$@"
  "$work/$name/bin/python" -m pip -q install --force-reinstall --no-deps "$wheel"
}

# runs NAME TEST...
runs() {
  name=$1
  shift
  for test in "$@"; do
    "$work/$name/bin/python" "$test"
  done
}

# runs_tool NAME TEST...: runs tests of the command with the environment's `tipp`. If the C++ tool is built, they compare.
runs_tool() {
  name=$1
  shift
  for test in "$@"; do
    "$work/$name/bin/python" "$test" "$work/$name/bin/tipp"
  done
}
[ ! -x build/bin/tipp ] || export TIPP_CXX="$PWD/build/bin/tipp"

environment alone numpy
runs_tool alone Testing/Wheel/TestTool.py Testing/Wheel/TestNetcdf.py
runs alone Testing/Wheel/TestWithoutVtk.py Testing/Wheel/TestConstraintsWithoutVtk.py Testing/Wheel/TestTetrahedra.py \
  Testing/Wheel/TestVtkFiles.py Testing/Wheel/TestInterpreter.py Testing/Wheel/TestLinkage.py Testing/Wheel/TestPage.py \
  Testing/Wheel/run_readme.py Testing/Python/TestBounds.py Testing/Python/TestCheck.py Testing/Python/TestInputs.py \
  Testing/Python/TestMesh.py Testing/Python/TestResults.py Testing/Python/TestSwitches.py
environment oldest 'numpy<2'
runs oldest Testing/Wheel/TestWithoutVtk.py Testing/Wheel/TestConstraintsWithoutVtk.py
environment scipy numpy scipy scikit-learn
runs scipy Testing/Wheel/TestScipyHabits.py Testing/Wheel/TestBesideOpenMP.py
environment tool numpy rasterio pyproj scipy laspy lazrs netCDF4 h5netcdf h5py
runs_tool tool Testing/Wheel/TestTool.py Testing/Wheel/TestNetcdf.py Testing/Python/TestDemFiles.py Testing/Python/TestLasWriting.py
environment pyvista 'vtk>=9.7,<9.8' pyvista shapely geopandas laspy meshio polars rioxarray mypy pyright
runs pyvista Testing/Wheel/TestPyVista.py Testing/Wheel/TestFilters.py Testing/Python/TestArguments.py Testing/Python/TestArrays.py \
  Testing/Python/TestBounds.py Testing/Python/TestCheck.py Testing/Python/TestConstraints.py Testing/Python/TestDelaunay3D.py \
  Testing/Python/TestInputs.py Testing/Python/TestInterrupt.py Testing/Python/TestMesh.py Testing/Python/TestPackage.py \
  Testing/Python/TestOverlap.py Testing/Python/TestPointsToImage.py Testing/Python/TestResults.py Testing/Python/TestSeries.py Testing/Python/TestSwitches.py \
  Testing/Wheel/TestVtkFiles.py Testing/Wheel/uses_everything.py
"$work/pyvista/bin/mypy" --strict --cache-dir "$work/mypy" Testing/Wheel/uses_everything.py
"$work/pyvista/bin/pyright" --pythonpath "$work/pyvista/bin/python" Testing/Wheel/uses_everything.py
runs_tool pyvista Testing/Python/TestDem.py
# Before VTK 9.7, references between Python and VTK keep objects forever.
environment before 'vtk>=9.6,<9.7' numpy
runs before Testing/Wheel/TestFilters.py Testing/Python/TestConstraints.py
# cvista has no wheels for Python 3.11.
if "$python" -c 'import sys; sys.exit(sys.version_info < (3, 12))'; then
  environment cvista 'pyvista[cvista]>=0.49'
  runs cvista Testing/Wheel/TestPyVista.py
fi
