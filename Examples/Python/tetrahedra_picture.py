# SPDX-License-Identifier: BSD-3-Clause
"""Draws sections through the tetrahedra that vtkDelaunay3D and TIPP make of the same random points.

Usage: tetrahedra_picture.py PICTURE.png
"""
import sys

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkDelaunay3D

import tipp
from pictures import save_png

POINTS, PIXELS, HEIGHT = 3000, 420, 0.5


def of_vtk(points):
    data, vtk_points = vtkPolyData(), vtkPoints()
    vtk_points.SetData(numpy_to_vtk(points))
    data.SetPoints(vtk_points)
    delaunay = vtkDelaunay3D()
    delaunay.SetInputData(data)
    delaunay.Update()
    return delaunay.GetOutput()


def corners_of(mesh):
    return vtk_to_numpy(mesh.GetCells().GetConnectivityArray()).reshape(-1, 4)


def cut(points, cells):
    """Returns the RGB of the cells at a plane's pixels, white where there is no cell, and the share of covered pixels."""
    axis = np.linspace(0, 1, PIXELS)
    x, y = np.meshgrid(axis, axis)
    rgb = np.ones((PIXELS, PIXELS, 3))
    covered = np.zeros((PIXELS, PIXELS), bool)
    colours = 0.35 + 0.6 * np.random.default_rng(2).random((len(cells), 3))
    for cell, colour in zip(points[cells], colours):
        if not cell[:, 2].min() <= HEIGHT <= cell[:, 2].max():
            continue
        low, high = (np.searchsorted(axis, cell[:, :2].min(axis=0)),
                     np.searchsorted(axis, cell[:, :2].max(axis=0), "right"))
        at = np.s_[low[1]:high[1], low[0]:high[0]]
        matrix = (cell[1:] - cell[0]).T
        if abs(np.linalg.det(matrix)) < 1e-15:
            continue
        offsets = np.stack([x[at], y[at], np.full_like(x[at], HEIGHT)], axis=-1) - cell[0]
        weights = offsets @ np.linalg.inv(matrix).T
        inside = (weights.min(axis=-1) >= 0) & (weights.sum(axis=-1) <= 1)
        rgb[at][inside] = colour
        covered[at] |= inside
    return rgb, covered.mean()


def main(path):
    points = np.random.default_rng(1).random((POINTS, 3))
    left, left_share = cut(points, corners_of(of_vtk(points)))
    right, right_share = cut(points, tipp.delaunay_3d(points).cells)
    gap = np.ones((PIXELS, 20, 3))
    save_png(path, np.concatenate([left, gap, right], axis=1))
    print(f"of the cut, vtkDelaunay3D fills {left_share:.0%}, TIPP {right_share:.0%}")


if __name__ == "__main__":
    main(sys.argv[1])
