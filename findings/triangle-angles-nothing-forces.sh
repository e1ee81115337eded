#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# triangle 20250106, the Python package of Triangle 1.6, leaves angles below the bound that nothing forces: of a polygon
# whose corners are all at least 65.4 degrees, "pq30" makes 19 triangles, one of which has an angle of 26.2 degrees; one
# with corners from 67.1 degrees keeps 28.6. Between two segments that meet, a thin triangle whose shortest edge
# joins points at equal distances is skipped, however wide the angle between the segments is.
# Expected: its page of the switch q promises no angle below the bound except where input angles are small.
# Consequence: a mesh that was asked to be good for finite elements is not, without a warning; Ruppert's algorithm with
# the skip limited to corners below 60 degrees ends on both polygons without such a triangle.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install triangle==20250106 numpy==2.2.6
"$folder/venv/bin/python" - <<'PYTHON' | tee "$folder/seen"
import importlib.metadata

import numpy
import triangle


def degrees_at(before, at, after):
    u, v = before - at, after - at
    return numpy.degrees(numpy.arctan2(numpy.abs(u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]), (u * v).sum(-1)))


print("triangle", importlib.metadata.version("triangle"))
for corners in (
    [[10, 5], [5, 12], [4, 11], [-8, 4], [-12, 1], [-11, -8], [-1, -2]],
    [[4, 2], [-11, 13], [-16, -8], [0, -8], [6, -16], [14, -6]],
):
    polygon = numpy.array(corners, float)
    count = len(polygon)
    sharpest = degrees_at(numpy.roll(polygon, 1, 0), polygon, numpy.roll(polygon, -1, 0)).min()
    segments = [[i, (i + 1) % count] for i in range(count)]
    mesh = triangle.triangulate({"vertices": polygon, "segments": segments}, "pq30")
    at = mesh["vertices"][mesh["triangles"]]
    angles = numpy.stack([degrees_at(at[:, i - 1], at[:, i], at[:, (i + 1) % 3]) for i in range(3)])
    print(f"corners from {sharpest:.1f} degrees: {angles.shape[1]} triangles, the smallest angle {angles.min():.1f}")
PYTHON
cat > "$folder/expected" <<'TEXT'
triangle 20250106
corners from 65.4 degrees: 19 triangles, the smallest angle 26.2
corners from 67.1 degrees: 6 triangles, the smallest angle 28.6
TEXT
diff "$folder/expected" "$folder/seen" && echo "As described."
