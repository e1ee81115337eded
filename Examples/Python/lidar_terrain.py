# SPDX-License-Identifier: BSD-3-Clause
"""Makes a gridded elevation model from lidar points.

Usage: lidar_terrain.py POINTS.xyz PICTURE.png [SPACING]      (SPACING: in the points' units; default 1)
"""
import sys

import numpy as np

import tipp
from pictures import TERRAIN, coloured, lit, save_png


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    points = np.loadtxt(sys.argv[1])
    spacing = float(sys.argv[3]) if len(sys.argv) == 4 else 1.0

    mesh = tipp.delaunay_2d(points, point_data={"elevation": points[:, 2]})
    image = tipp.resample(mesh, spacing=(spacing, spacing, 0), null_value=np.nan)
    grid = tipp.as_array(image, "elevation")

    low, high = np.nanpercentile(grid, [1, 99])
    save_png(sys.argv[2], lit(coloured(grid, TERRAIN, low, high), grid, 0.5 / spacing))
    print(f"{len(points)} points, {len(mesh.cells)} triangles, {grid.shape[1]} x {grid.shape[0]} samples, "
          f"elevations from {np.nanmin(grid):.1f} to {np.nanmax(grid):.1f}")


if __name__ == "__main__":
    main()
