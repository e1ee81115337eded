# SPDX-License-Identifier: BSD-3-Clause
"""Measures xugrid's OverlapRegridder on triangulations of random points, for comparison with benchmarkRemap.

Usage: remap_peers.py TRIANGLES

Prints the wall-clock and processor seconds of making the weights and of applying them once, after a small run that
compiles its functions.
"""
import sys
import time

import numpy as np


def grid(triangles, seed):
    import xugrid
    from scipy.spatial import Delaunay

    points = np.random.default_rng(seed).random((triangles // 2, 2))
    points = np.concatenate([points, [[0, 0], [1, 0], [0, 1], [1, 1]]])
    cells = Delaunay(points).simplices.astype(np.int64)
    return xugrid.Ugrid2d(points[:, 0], points[:, 1], -1, cells)


def measured(triangles):
    import xarray
    import xugrid

    source, target = grid(triangles, 1), grid(triangles, 2)
    values = xarray.DataArray(np.sin(9 * source.centroids[:, 0]), dims=[source.face_dimension])
    data = xugrid.UgridDataArray(values, source)
    wall, processor = time.perf_counter(), time.process_time()
    xugrid.OverlapRegridder(data, xugrid.UgridDataset(grids=[target]), method="mean").regrid(data)
    return time.perf_counter() - wall, time.process_time() - processor


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    try:
        import xugrid  # noqa: F401
    except ImportError:
        print("xugrid is not installed: no comparison")
        return
    measured(1000)
    wall, processor = measured(int(sys.argv[1]))
    print(f"| xugrid, {sys.argv[1]} triangles | {wall:.3f} s | {processor:.3f} s | |")


main()
