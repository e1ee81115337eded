#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# A number as sizing of OCSMesh 2.2.0's generate() is the length of edges for the engine gmsh, and the largest area of a
# triangle for the engine triangle: the same call makes edges of 0.5 with one and of 0.8 with the other, of 5 and of 2.7.
# The documentation of generate() says "The sizing function or field" for both.
# Expected: lengths for both, as the size functions of OCSMesh (hfun) have.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install ocsmesh==2.2.0 triangle==20250106 gmsh==4.15.2
"$folder/venv/bin/python" - <<'PYTHON' 2> /dev/null | tee "$folder/seen"
import importlib.metadata

import geopandas
import numpy as np
from ocsmesh.engines.factory import get_mesh_engine
from shapely.geometry import box

print("OCSMesh", importlib.metadata.version("ocsmesh"))
for sizing, side in ((0.5, 10), (5.0, 100)):
    shape = geopandas.GeoSeries([box(0, 0, side, side)])
    for name, options in (("gmsh", {}), ("triangle", {"opts": "pq30"})):
        mesh = get_mesh_engine(name, **options).generate(shape, sizing)
        corners = mesh.coords[mesh.tria]
        edges = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
        u, v = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        areas = (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2
        is_area = 0.9 < areas.max() / sizing <= 1
        print(f"sizing {sizing}, {name}: median edge {np.median(edges):.1f},",
              "the largest area is the sizing" if is_area else "the largest area is another number")
PYTHON
cat > "$folder/expected" <<'TEXT'
OCSMesh 2.2.0
sizing 0.5, gmsh: median edge 0.5, the largest area is another number
sizing 0.5, triangle: median edge 0.8, the largest area is the sizing
sizing 5.0, gmsh: median edge 5.0, the largest area is another number
sizing 5.0, triangle: median edge 2.7, the largest area is the sizing
TEXT
diff "$folder/expected" "$folder/seen" && echo "As described."
