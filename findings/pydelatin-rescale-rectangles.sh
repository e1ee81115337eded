#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# pydelatin.util.rescale_positions of pydelatin 0.4.0 compresses the shorter side of rasters that are not square: for a
# raster of 400 x 100 pixels and the bounds (0, 0, 4000, 1000), the vertices get x from 0 to 4000, but y from 0 to 248.
# With flip_y they lie at 752 to 1000. Both sides are divided by the longer one. A square raster is right, and Delatin
# takes rectangles. Its documentation says "Linearly rescale position values to this extent".
# Expected: y from 0 to 1000.
# Consequence: the mesh of a rectangular elevation model has a quarter of its north-south extent, without a warning.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install pydelatin==0.4.0 numpy==2.2.6
"$folder/venv/bin/python" -W error - <<'PYTHON' | tee "$folder/seen"
import importlib.metadata

import numpy
from pydelatin import Delatin
from pydelatin.util import rescale_positions

print("pydelatin", importlib.metadata.version("pydelatin"))
for height, width in ((100, 100), (100, 400), (400, 100)):
    row, column = numpy.mgrid[0:height, 0:width]
    terrain = Delatin((numpy.sin(row / 9) + numpy.cos(column / 7)).astype("float32"), max_error=0.1)
    bounds = (0, 0, 10 * width, 10 * height)
    for flip_y in (False, True):
        x, y, _ = rescale_positions(terrain.vertices, bounds, flip_y=flip_y).T
        print(
            f"{width} x {height} pixels, bounds {bounds}, flip_y {flip_y}:"
            f" x {x.min():.0f} to {x.max():.0f}, y {y.min():.0f} to {y.max():.0f}"
        )
PYTHON
cat > "$folder/expected" <<'TEXT'
pydelatin 0.4.0
100 x 100 pixels, bounds (0, 0, 1000, 1000), flip_y False: x 0 to 1000, y 0 to 1000
100 x 100 pixels, bounds (0, 0, 1000, 1000), flip_y True: x 0 to 1000, y 0 to 1000
400 x 100 pixels, bounds (0, 0, 4000, 1000), flip_y False: x 0 to 4000, y 0 to 248
400 x 100 pixels, bounds (0, 0, 4000, 1000), flip_y True: x 0 to 4000, y 752 to 1000
100 x 400 pixels, bounds (0, 0, 1000, 4000), flip_y False: x 0 to 248, y 0 to 4000
100 x 400 pixels, bounds (0, 0, 1000, 4000), flip_y True: x 0 to 248, y 0 to 4000
TEXT
diff "$folder/expected" "$folder/seen" && echo "As described."
