#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# mesh2d_make_triangular_mesh_from_samples of meshkernel 8.3.0, "triangulating the sample points", gives a mesh that is
# not all triangles and leaves out part of the convex hull: of 1,000 uniform points in a square it makes 1,901
# triangles, nine quadrilaterals and a hexagon, which cover 97.1 % of the hull. There is no warning. The Delaunay
# triangulation has 1,982 triangles; 69 of its edges are missing.
# Expected: triangles that cover the hull, as the name of the function says.
# Consequence: interpolation has gaps along the border, and face_nodes, reshaped to three columns, fails or mixes the
# corners of different faces. Read nodes_per_face, and triangulate with another library if the hull matters.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install meshkernel==8.3.0 scipy==1.17.1 numpy==2.4.6
"$folder/venv/bin/python" -W error - <<'PYTHON' | tee "$folder/seen"
import importlib.metadata

import numpy
from meshkernel import GeometryList, MeshKernel
from scipy.spatial import ConvexHull, Delaunay


def edges_of(pairs):
    return {tuple(sorted(pair)) for pair in pairs.tolist()}


print("meshkernel", importlib.metadata.version("meshkernel"))
for count in (100, 400, 1000):
    points = 1000 * numpy.random.default_rng(1).random((count, 2))
    kernel = MeshKernel()
    kernel.mesh2d_make_triangular_mesh_from_samples(GeometryList(*points.T.copy()))
    mesh = kernel.mesh2d_get()
    assert numpy.array_equal(numpy.stack([mesh.node_x, mesh.node_y], -1), points)
    corners = numpy.split(mesh.face_nodes, numpy.cumsum(mesh.nodes_per_face)[:-1])
    area = 0.0
    for face in corners:
        (x, y), (next_x, next_y) = points[face].T, numpy.roll(points[face], -1, axis=0).T
        area += (x * next_y - y * next_x).sum() / 2
    whole = Delaunay(points).simplices
    edges = edges_of(whole[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2))
    sizes = dict(zip(*(values.tolist() for values in numpy.unique(mesh.nodes_per_face, return_counts=True))))
    missing = len(edges - edges_of(mesh.edge_nodes.reshape(-1, 2)))
    print(
        f"{count} points: faces by corners {sizes}, {area / ConvexHull(points).volume:.1%} of the hull;"
        f" Delaunay has {len(whole)}, {missing} of its {len(edges)} edges are missing"
    )
PYTHON
cat > "$folder/expected" <<'TEXT'
meshkernel 8.3.0
100 points: faces by corners {3: 169, 5: 1}, 96.2% of the hull; Delaunay has 183, 13 of its 282 edges are missing
400 points: faces by corners {3: 745, 4: 1}, 95.7% of the hull; Delaunay has 781, 35 of its 1180 edges are missing
1000 points: faces by corners {3: 1901, 4: 9, 6: 1}, 97.1% of the hull; Delaunay has 1982, 69 of its 2981 edges are missing
TEXT
diff "$folder/expected" "$folder/seen" && echo "As described."
