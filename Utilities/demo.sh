#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Makes a coast-like set of a million points, triangulates it exactly, checks the result, compares the time with
# vtkDelaunay2D on a sample, and draws a picture. All files are written to demo/.
#   TIPP_DEMO_POINTS   number of points (1000000)
#   TIPP_BUILD_DIR     a build to use; without it, build/ is built first
set -eu

top=$(cd "$(dirname "$0")/.." && pwd)
cd "$top"
count=${TIPP_DEMO_POINTS:-1000000}
if [ -z "${TIPP_BUILD_DIR:-}" ]; then
  sh Utilities/build.sh default --target tipp --target tipp_python
  TIPP_BUILD_DIR=$top/build
fi
tipp=$TIPP_BUILD_DIR/bin/tipp
# VTK's Python modules need Debian's own Python, which need not be the first on PATH.
python=/usr/bin/python3
export PYTHONPATH="$TIPP_BUILD_DIR/lib/python3/dist-packages"

mkdir -p demo
echo "== $count points along fractal shorelines"
"$tipp" points --distribution coast --count "$count" --seed 1 -o demo/coast.npy
echo "== Triangulating"
"$tipp" delaunay demo/coast.npy -o demo/coast.vtp --stats demo/coast.json
echo "== Checking every triangle in exact arithmetic"
"$tipp" check demo/coast.npy demo/coast.vtp
echo "== Beside vtkDelaunay2D, on a sample"
"$python" Examples/Python/compare_with_vtk.py demo/coast.npy "$((count < 20000 ? count : 20000))"
echo "== Picture"
xvfb-run -a "$python" Utilities/picture.py demo/coast.vtp demo/coast.png
echo "$top/demo/coast.png"
