#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# TetGen does not keep its maximum volume. Of a unit cube with the switches "pqa0.001", 27 of 1,742 tetrahedra exceed
# 0.001, the largest by 28 %; with "pqa0.0001", 108 of 18,093 by up to 63 %. The packages tetgen 0.8.4 and meshpy
# 2026.1.1 behave alike. The switch O0, no optimization of the mesh, changes nothing. There is no warning.
# Triangle keeps its bound of areas in the plane, 0.001 of a unit square.
# Expected: TetGen's manual promises that no tetrahedron is larger than the number after the switch a.
# Consequence: who derives a time step or an error bound from that number must measure the mesh first.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install tetgen==0.8.4 meshpy==2026.1.1 triangle==20250106 numpy==2.2.6
"$folder/venv/bin/python" -W ignore - <<'PYTHON' | grep -e " of " -e "^tetgen 0" | tee "$folder/seen"
import importlib.metadata

import meshpy.tet
import numpy
import tetgen
import triangle

CORNERS = numpy.array([[i, j, k] for i in (0, 1) for j in (0, 1) for k in (0, 1)], float)
SIDES = numpy.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
TRIANGLES = numpy.vstack([SIDES[:, [0, 1, 2]], SIDES[:, [0, 2, 3]]])


def report(name, points, cells, bound):
    edges = points[cells[:, 1:]] - points[cells[:, :1]]
    sizes = abs(numpy.linalg.det(edges)) / (6 if points.shape[1] == 3 else 2)
    above = int((sizes > bound * (1 + 1e-9)).sum())
    print(f"{name}: {above} of {len(cells)} above the bound, the largest is {sizes.max() / bound:.2f} of it", flush=True)


print(*(f"{name} {importlib.metadata.version(name)}" for name in ("tetgen", "meshpy", "triangle")))
for switches, bound in (("pqa0.001", 0.001), ("pqa0.001O0", 0.001), ("pqa0.0001", 0.0001)):
    points, cells = tetgen.TetGen(CORNERS, TRIANGLES).tetrahedralize(switches=switches + "Q")[:2]
    report(f"tetgen {switches}", numpy.asarray(points), numpy.asarray(cells), bound)
info = meshpy.tet.MeshInfo()
info.set_points(CORNERS.tolist())
info.set_facets(SIDES.tolist())
mesh = meshpy.tet.build(info, meshpy.tet.Options("pqQ"), max_volume=0.001)
report("meshpy pq, max_volume 0.001", numpy.array(mesh.points), numpy.array(mesh.elements), 0.001)
square = {"vertices": [[0, 0], [1, 0], [1, 1], [0, 1]], "segments": [[0, 1], [1, 2], [2, 3], [3, 0]]}
plane = triangle.triangulate(square, "pqa0.001")
report("triangle pqa0.001", plane["vertices"], plane["triangles"], 0.001)
PYTHON
cat > "$folder/expected" <<'TEXT'
tetgen 0.8.4 meshpy 2026.1.1 triangle 20250106
tetgen pqa0.001: 27 of 1742 above the bound, the largest is 1.28 of it
tetgen pqa0.001O0: 27 of 1742 above the bound, the largest is 1.28 of it
tetgen pqa0.0001: 108 of 18093 above the bound, the largest is 1.63 of it
meshpy pq, max_volume 0.001: 20 of 1692 above the bound, the largest is 1.37 of it
triangle pqa0.001: 0 of 1539 above the bound, the largest is 1.00 of it
TEXT
diff "$folder/expected" "$folder/seen" && echo "As described."
