# SPDX-License-Identifier: BSD-3-Clause
"""Times vtkDelaunay3D of the installed VTK on uniform points.

Usage: delaunay3d_vtk.py POINTS [REPEATS]      (the fastest run counts)
"""
import sys
import time

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    count, repeats = (int(word) for word in (sys.argv[1:] + ["3"])[:2])
    points = vtk.vtkPoints()
    points.SetData(numpy_to_vtk(np.random.default_rng(1).random((count, 3)), deep=True))
    data = vtk.vtkPolyData()
    data.SetPoints(points)
    best = np.inf
    for _ in range(repeats):
        delaunay = vtk.vtkDelaunay3D()
        delaunay.SetInputData(data)
        begin = time.perf_counter()
        delaunay.Update()
        best = min(best, time.perf_counter() - begin)
    version = vtk.vtkVersion.GetVTKVersion()
    cells = delaunay.GetOutput().GetNumberOfCells()
    print(f"vtkDelaunay3D of VTK {version}: {count} uniform points, {cells} tetrahedra, {best:.3f} s")


if __name__ == "__main__":
    main()
