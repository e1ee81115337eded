# SPDX-License-Identifier: BSD-3-Clause
"""Makes a mesh from an array of points, and an image from the mesh."""
import numpy as np

import tipp

points = np.random.default_rng(1).random((100_000, 2))
height = np.sin(9 * points[:, 0]) * np.cos(7 * points[:, 1])

mesh = tipp.delaunay_2d(points, point_data={"height": height})
image = tipp.resample(mesh, dimensions=(300, 200, 1))
grid = tipp.as_array(image, "height")

print(len(mesh.cells), "triangles; a grid of", grid.shape, "samples up to", round(grid.max(), 3))
