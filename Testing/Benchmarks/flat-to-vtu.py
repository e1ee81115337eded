# SPDX-License-Identifier: BSD-3-Clause
"""Writes a flat mesh of triangles as one .vtu with raw appended data: flat-to-vtu.py FOLDER FILE.vtu"""
import os
import sys

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TRIANGLE, vtkCellArray, vtkUnstructuredGrid
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

folder, path = sys.argv[1:]
xy = np.load(f"{folder}/points.npy")
cells = np.load(f"{folder}/cells.npy").astype(np.int32)
points = vtkPoints()
points.SetData(numpy_to_vtk(np.column_stack([xy, np.zeros(len(xy))])))
array = vtkCellArray()
offsets = np.arange(0, 3 * len(cells) + 1, 3, dtype=np.int32)
array.SetData(numpy_to_vtk(offsets), numpy_to_vtk(cells.ravel()))
grid = vtkUnstructuredGrid()
grid.SetPoints(points)
grid.SetCells(VTK_TRIANGLE, array)
writer = vtkXMLUnstructuredGridWriter()
writer.SetInputData(grid)
writer.SetDataModeToAppended()
writer.EncodeAppendedDataOff()
writer.SetCompressorTypeToNone()
writer.SetHeaderTypeToUInt64()
writer.SetFileName(path + ".unfinished")
if not writer.Write():
    sys.exit(f"{path} could not be written.")
os.rename(path + ".unfinished", path)
