#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# gmsh.algorithm.triangulate of Gmsh 4.15.2, "Triangulate the points given", leaves out triangles along the border, and
# turns half of its triangles clockwise. Of 2,000 uniform points in a square it makes 3,947 of the 3,982 Delaunay
# triangles, which cover 98.96 % of the convex hull; of 2,000 normally distributed points, 97.63 %. There is no warning,
# and every point is in some triangle. SciPy's Delaunay of the same points covers the hull. A lattice is covered.
# Expected: a triangulation of points without constraints is that of their convex hull, in one orientation.
# Consequence: interpolation has gaps along the border, and signed areas cancel each other.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install gmsh==4.15.2 scipy==1.15.3 numpy==2.2.6
"$folder/venv/bin/python" - <<'PYTHON' | tee "$folder/seen"
import gmsh
import numpy
from scipy.spatial import Delaunay


def signed_areas(points, triangles):
    u, v = (points[triangles[:, k]] - points[triangles[:, 0]] for k in (1, 2))
    return (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2


gmsh.initialize(interruptible=False)
gmsh.option.setNumber("General.Verbosity", 1)
print("Gmsh", gmsh.__version__)
rng = numpy.random.default_rng(1)
lattice = numpy.stack(numpy.meshgrid(numpy.arange(20.0), numpy.arange(20.0)), -1).reshape(-1, 2)
for name, points in (("uniform", rng.random((2000, 2))), ("normal", rng.normal(size=(2000, 2))), ("lattice", lattice)):
    whole = abs(signed_areas(points, Delaunay(points).simplices))
    triangles = numpy.array(gmsh.algorithm.triangulate(points.ravel()), int).reshape(-1, 3) - 1
    areas = signed_areas(points, triangles)
    print(
        f"{name}: {len(areas)} triangles, Delaunay has {len(whole)}, {len(numpy.unique(triangles))} points used,"
        f" {abs(areas).sum() / whole.sum():.2%} of the hull, {(areas < 0).mean():.0%} clockwise"
    )
gmsh.finalize()
PYTHON
cat > "$folder/expected" <<'TEXT'
Gmsh 4.15.2
uniform: 3947 triangles, Delaunay has 3982, 2000 points used, 98.96% of the hull, 50% clockwise
normal: 3979 triangles, Delaunay has 3987, 2000 points used, 97.63% of the hull, 50% clockwise
lattice: 722 triangles, Delaunay has 722, 400 points used, 100.00% of the hull, 57% clockwise
TEXT
diff "$folder/expected" "$folder/seen" && echo "As described."
