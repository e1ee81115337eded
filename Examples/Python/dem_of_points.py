# SPDX-License-Identifier: BSD-3-Clause
"""Makes a raster of random points, with rows from north to south, as in rasterio."""
import numpy as np

import tipp

xyz = np.random.default_rng(1).random((10_000, 3)) * [100, 100, 5]
grid, transform, crs = tipp.dem(xyz, 0.5, max_edge=10)
print(grid.shape, transform, crs, round(float(np.nanmax(grid)), 2))
