# SPDX-License-Identifier: BSD-3-Clause
"""Samples the surface of scattered points on a regular grid."""
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData

from tipp import vtkRangeResampleFilter, vtkTIPPDelaunay2D

xyz = np.random.default_rng(1).random((10000, 3))
height = numpy_to_vtk(np.sin(9 * xyz[:, 0]) * np.cos(7 * xyz[:, 1]))
height.SetName("height")
points = vtkPoints()
points.SetData(numpy_to_vtk(xyz))
data = vtkPolyData()
data.SetPoints(points)
data.GetPointData().AddArray(height)

delaunay = vtkTIPPDelaunay2D()
delaunay.SetInputData(data)
resample = vtkRangeResampleFilter()
resample.SetInputConnection(delaunay.GetOutputPort())
resample.SetSamplingDimensions(300, 200, 1)
resample.SetNullValue(np.nan)
resample.Update()

grid = vtk_to_numpy(resample.GetOutput().GetPointData().GetArray("height")).reshape(200, 300)
print(grid.shape, np.nanmin(grid), np.nanmax(grid))
