"""Reads a range of a partitioned or flat mesh: read_partitioned.py MESH [X0 X1 Y0 Y1]"""
import sys

from tipp import vtkPartitionedUnstructuredReader

reader = vtkPartitionedUnstructuredReader()
reader.SetFileName(sys.argv[1])
if len(sys.argv) == 6:
    reader.SetBounds(*map(float, sys.argv[2:]), 0, 0)
reader.Update()

mesh = reader.GetOutputDataObject(0)
print(mesh.GetNumberOfCells(), "cells and", mesh.GetNumberOfPoints(), "points of",
      reader.GetNumberOfPiecesRead(), "pieces")
