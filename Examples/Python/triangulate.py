# SPDX-License-Identifier: BSD-3-Clause
"""Triangulates a NumPy array of points, and gets the triangles as an array."""
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData

from tipp import vtkTIPPDelaunay2D

xyz = np.zeros((100_000, 3))
xyz[:, :2] = np.random.default_rng(1).random((100_000, 2))

points = vtkPoints()
points.SetData(numpy_to_vtk(xyz))
cloud = vtkPolyData()
cloud.SetPoints(points)

delaunay = vtkTIPPDelaunay2D()
delaunay.SetInputData(cloud)
delaunay.Update()

mesh = delaunay.GetOutput()
triangles = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)
print(len(triangles), "triangles; the first has the points", triangles[0])
