#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# griddata of SciPy 1.17.1 leaves out most points of an ordinary lidar tile whose coordinates are UTM metres: of 20,000
# points in 50 x 50 m (8 per square metre, rounded to millimetres), 77 % are in no triangle, and at 62 % the value
# is not the point's own height but another one, up to 8 m off. There is no warning. The same points relative to the
# tile's corner lose none, and every height comes back. rescale=True, documented for axes of different units, helps too.
# The cause: Qhull computes x * x + y * y, and at a northing of 5,700,000 a double resolves that to 4e-3 square metres.
# scipy.spatial.Delaunay lists such points as "coplanar"; griddata and LinearNDInterpolator do not report them.
# Expected: interpolation returns the heights at its own points, wherever the origin of the coordinates is.
# Consequence: terrain models of dense points in projected coordinates lose most of their detail in silence.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install scipy==1.17.1 numpy==2.4.6
"$folder/venv/bin/python" -W error - <<'PYTHON' | tee "$folder/seen"
import numpy
import scipy
from scipy.interpolate import griddata
from scipy.spatial import Delaunay

rng = numpy.random.default_rng(1)
local = numpy.unique(numpy.round(rng.random((20000, 2)) * 50, 3), axis=0)
height = 100 + 5 * numpy.sin(local[:, 0] / 9) + numpy.where(rng.random(len(local)) < 0.1, 8.0, 0.0)
origin = numpy.array([500000.0, 5700000.0])

print("SciPy", scipy.__version__)
for name, points, options in (
    ("local", local, {}),
    ("UTM", local + origin, {}),
    ("UTM, rescale", local + origin, {"rescale": True}),
):
    values = griddata(points, height, points, method="linear", **options)
    error = numpy.abs(values - height)
    lost = (error > 1e-3).mean()
    print(f"{name}: {lost:.0%} of the heights are not returned, the largest error is {numpy.nanmax(error):.1f}")
for name, points in (("local", local), ("UTM", local + origin)):
    used = len(numpy.unique(Delaunay(points).simplices)) / len(points)
    print(f"Delaunay, {name}: {used:.0%} of the points are in triangles")
PYTHON
cat > "$folder/expected" <<'TEXT'
SciPy 1.17.1
local: 0% of the heights are not returned, the largest error is 0.0
UTM: 62% of the heights are not returned, the largest error is 8.0
UTM, rescale: 0% of the heights are not returned, the largest error is 0.0
Delaunay, local: 100% of the points are in triangles
Delaunay, UTM: 23% of the points are in triangles
TEXT
diff "$folder/expected" "$folder/seen" && echo "As described."
