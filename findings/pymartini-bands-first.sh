#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# decode_ele of pymartini 0.6.0 transposes the terrain if the bands come first: the same tile gives heights that rise to
# the east from an array (row, column, band), as imageio and Pillow read it, and to the south from (band, row, column),
# as rasterio reads it. There is no warning. Its documentation accepts both shapes, and rescale_positions takes the
# first index of the terrain as the row in both cases. pydelatin 0.4.0's decode_ele, whose documentation names only the
# first shape, does the same.
# Expected: the same terrain from both, as only the place of the bands differs.
# Consequence: the mesh of an elevation tile is mirrored at its diagonal, and no size or bound shows it, as tiles are
# square. numpy.moveaxis(bands, 0, -1) before the call helps.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install pymartini==0.6.0 pydelatin==0.4.0 rasterio==1.4.4 pillow==13.0.0 numpy==2.4.6
cd "$folder"
"$folder/venv/bin/python" -W ignore - <<'PYTHON' | tee "$folder/seen"
import importlib.metadata

import numpy
import pydelatin.util
import pymartini
import rasterio
from PIL import Image

SIZE = 32
heights = numpy.tile(10.0 * numpy.arange(SIZE), (SIZE, 1))
coded = numpy.round((heights + 10000) * 10).astype(int)
Image.fromarray(numpy.stack([coded >> 16, coded >> 8 & 255, coded & 255], -1).astype("uint8")).save("tile.png")
with rasterio.open("tile.png") as file:
    bands = file.read()

print(*(f"{name} {importlib.metadata.version(name)}" for name in ("pymartini", "pydelatin")))
for name, tile in (
    ("Pillow", numpy.asarray(Image.open("tile.png"))),
    ("rasterio", bands),
    ("rasterio, bands moved", numpy.moveaxis(bands, 0, -1)),
):
    terrain = pymartini.decode_ele(tile, "mapbox")
    vertices, _ = pymartini.Martini(SIZE + 1).create_tile(terrain).get_mesh(1)
    x, y, z = pymartini.rescale_positions(vertices, terrain).T
    slope = numpy.round(numpy.linalg.lstsq(numpy.stack([x, y, 1 + 0 * x], -1), z)[0][:2], 0) + 0.0
    same = numpy.array_equal(terrain[:-1, :-1], pydelatin.util.decode_ele(tile, "mapbox"))
    print(f"{name}, {tile.shape}: {slope[0]:g} m per column, {slope[1]:g} m per row; pydelatin alike: {same}")
PYTHON
cat > "$folder/expected" <<'TEXT'
pymartini 0.6.0 pydelatin 0.4.0
Pillow, (32, 32, 3): 10 m per column, 0 m per row; pydelatin alike: True
rasterio, (3, 32, 32): 0 m per column, 10 m per row; pydelatin alike: True
rasterio, bands moved, (32, 32, 3): 10 m per column, 0 m per row; pydelatin alike: True
TEXT
diff "$folder/expected" "$folder/seen" && echo "As described."
