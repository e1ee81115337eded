# SPDX-License-Identifier: BSD-3-Clause
"""Triangulates the points of a file, which may be larger than memory, and reads a part of the mesh.

Usage: triangulate_file.py POINTS MESH.tipp [MEMORY], for example points.npy mesh.tipp 512M
"""
import sys

from tipp import vtkPartitionedUnstructuredReader, vtkTIPPOutOfCoreDelaunay2D

points, mesh, memory = (sys.argv[1:] + ["512M"])[:3]
unit = {"K": 10, "M": 20, "G": 30}[memory[-1]]

triangulation = vtkTIPPOutOfCoreDelaunay2D()
triangulation.AddInputFileName(points)
triangulation.SetFileName(mesh)
triangulation.SetMemoryLimit(int(memory[:-1]) << unit)
triangulation.Update()

totals = triangulation.GetStatistics().GetFieldData()
print(totals.GetArray("Triangles").GetValue(0), "triangles in", totals.GetArray("Pieces").GetValue(0), "pieces")

reader = vtkPartitionedUnstructuredReader()
reader.SetFileName(triangulation.GetFileName())
reader.SetBounds(0.4, 0.6, 0.4, 0.6, 0, 0)
reader.Update()
print(reader.GetOutputDataObject(0).GetNumberOfCells(), "of them in the middle")
