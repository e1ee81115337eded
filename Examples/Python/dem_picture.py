# SPDX-License-Identifier: BSD-3-Clause
"""Draws a shaded picture of a raster made from points.

Usage: dem_picture.py POINTS PICTURE.png RESOLUTION [ATTRIBUTE [MAX_EDGE]]      (POINTS: any file of points;
       ATTRIBUTE: one of its columns, default elevation; MAX_EDGE: triangles with longer edges are left out)
"""
import sys

import numpy as np

import tipp
from pictures import TERRAIN, coloured, lit, save_png


def main():
    if len(sys.argv) not in (4, 5, 6):
        sys.exit(__doc__)
    resolution = float(sys.argv[3])
    attribute = sys.argv[4] if len(sys.argv) > 4 else "elevation"
    max_edge = float(sys.argv[5]) if len(sys.argv) > 5 else 0

    dem = tipp.dem(sys.argv[1], resolution, attributes=attribute, max_edge=max_edge)

    grid = dem.array[::-1]  # pictures have the lowest row first
    low, high = np.nanpercentile(grid, [1, 99])
    slope = 0.5 / np.nanmedian(np.abs(np.diff(grid))[np.diff(grid) != 0]) / 4
    save_png(sys.argv[2], lit(coloured(grid, TERRAIN, low, high), grid, slope))
    print(f"{grid.shape[1]} x {grid.shape[0]} pixels from {dem.transform[2]:g}, {dem.transform[5]:g}, "
          f"{attribute} from {np.nanmin(grid):.1f} to {np.nanmax(grid):.1f}")


if __name__ == "__main__":
    main()
