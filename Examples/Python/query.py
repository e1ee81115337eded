# SPDX-License-Identifier: BSD-3-Clause
"""Queries a mesh on disk: heights at scattered points, neighbours, borders, zones and descents."""
import numpy as np

import tipp

rng = np.random.default_rng(1)
xy = rng.random((20000, 2))
surface = tipp.delaunay_2d(xy, point_data={"height": np.sin(9 * xy[:, 0]) * np.cos(7 * xy[:, 1])})
tipp.write(surface, "surface.tipp", tiling="grid:4x4")

asked = rng.random((1000, 2))
with tipp.open("surface.tipp", memory="256M") as mesh:
    cells, weights = mesh.locate(asked)
    heights = mesh.interpolate(asked, "height")
    neighbors = mesh.neighbors(cells[cells >= 0])
    around = mesh.ring(points=[0], k=2)[0]
    outline = mesh.boundary()[0]
    nearest = mesh.closest([(2.0, 0.5)])
    square, hole = [(0.2, 0.2), (0.7, 0.2), (0.7, 0.7), (0.2, 0.7)], [(0.4, 0.4), (0.5, 0.4), (0.5, 0.5)]
    zones = mesh.zones([square, [square, hole]], "height", level=0.5)
    inside = mesh.cells_in(polygon=square, whole=True)
    ways = mesh.descend(asked[:10], "height")
print(f"{(cells >= 0).sum()} of {len(asked)} points inside, {len(around)} points around the first one, "
      f"{len(outline)} points on the border, {len(inside)} cells in the square, "
      f"{zones.volume_above[1]:.4f} above 0.5, {nearest.distances[0]:.2f} away, {len(ways[0].points)} points down")
