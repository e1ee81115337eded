# SPDX-License-Identifier: BSD-3-Clause
"""Compares the times of vtkTIPPDelaunay2D and vtkDelaunay2D on a sample of a point set.

Usage: compare_with_vtk.py POINTS.npy [COUNT]      (COUNT: sample size; default 20000)
"""
import sys
import time

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkDelaunay2D

from tipp import vtkTIPPDelaunay2D


def sample(path, count):
    """Returns `count` points of the set with distinct coordinates, chosen at random, as VTK points."""
    xy = np.unique(np.load(path)[:, :2], axis=0)
    chosen = np.random.default_rng(1).permutation(len(xy))[:count]
    xyz = np.zeros((len(chosen), 3))
    xyz[:, :2] = xy[chosen]
    points = vtkPoints()
    points.SetData(numpy_to_vtk(xyz, deep=True))
    cloud = vtkPolyData()
    cloud.SetPoints(points)
    return cloud


def doubled_areas(mesh):
    """Returns twice the area of each triangle, negative for clockwise ones."""
    xyz = vtk_to_numpy(mesh.GetPoints().GetData())
    a, b, c = (xyz[ids] for ids in vtk_to_numpy(
        mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3).T)
    u, v = b - a, c - a
    return u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]


def report(algorithm, cloud):
    algorithm.SetInputData(cloud)
    start = time.perf_counter()
    algorithm.Update()
    seconds = time.perf_counter() - start
    areas = doubled_areas(algorithm.GetOutput())
    print(f"{algorithm.GetClassName():18} {seconds:9.3f} s {len(areas):10} triangles, "
          f"{np.count_nonzero(areas < 0)} clockwise, covering {np.abs(areas).sum() / 2:.9g}")


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    cloud = sample(sys.argv[1], int(sys.argv[2]) if len(sys.argv) == 3 else 20_000)
    print(f"{cloud.GetNumberOfPoints()} points")
    for algorithm in (vtkTIPPDelaunay2D(), vtkDelaunay2D()):
        report(algorithm, cloud)


if __name__ == "__main__":
    main()
