# SPDX-License-Identifier: BSD-3-Clause
"""Triangulates points that are distributed among the ranks of an MPI run.

Usage: mpirun -np 2 python3 triangulate_on_ranks.py [POINTS_PER_RANK]
"""
import sys

from mpi4py import MPI  # before VTK's controller is initialised
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkParallelMPI import vtkMPIController

from tipp import vtkTIPPDelaunay2D

controller = vtkMPIController()
controller.Initialize()
controller.SetGlobalController(controller)
rank = controller.GetLocalProcessId()

count = int(sys.argv[1]) if len(sys.argv) > 1 else 50_000
xyz = np.zeros((count, 3))
xyz[:, :2] = np.random.default_rng(rank).random((count, 2))
points = vtkPoints()
points.SetData(numpy_to_vtk(xyz, deep=True))
cloud = vtkPolyData()
cloud.SetPoints(points)

delaunay = vtkTIPPDelaunay2D()
delaunay.SetInputData(cloud)
delaunay.Update()

piece = delaunay.GetOutput()
total = MPI.COMM_WORLD.allreduce(piece.GetNumberOfCells())
print(f"rank {rank}: {piece.GetNumberOfCells()} of {total} triangles", flush=True)

del delaunay  # it refers to the controller, which must not outlive MPI
controller.SetGlobalController(None)
controller.Finalize(1)
