#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# vtkDelaunay3D of VTK 9.7.2, with its default settings, does not fill the convex hull of its points: 500 points in a unit
# cube, the cube's eight corners among them, give tetrahedra with a total volume of 0.934 instead of 1. There is no
# warning. SciPy's Delaunay of the same points fills the cube. A larger Offset closes the gap.
# Expected: a Delaunay tetrahedralization covers the convex hull.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install vtk==9.7.2 numpy==2.2.6 scipy==1.15.3
"$folder/venv/bin/python" - <<'PYTHON' | tee "$folder/seen"
import numpy
import scipy.spatial
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy


def volume(points, cells):
    edges = points[cells[:, 1:]] - points[cells[:, :1]]
    return abs(numpy.linalg.det(edges)).sum() / 6


def vtk_volume(points, offset):
    data = vtk.vtkPolyData()
    data.SetPoints(vtk.vtkPoints())
    data.GetPoints().SetData(numpy_to_vtk(points, deep=1))
    delaunay = vtk.vtkDelaunay3D()
    delaunay.SetInputData(data)
    if offset:
        delaunay.SetOffset(offset)
    delaunay.Update()
    cells = delaunay.GetOutput().GetCells()
    return volume(points, vtk_to_numpy(cells.GetConnectivityArray()).reshape(-1, 4))


points = numpy.random.default_rng(2).random((500, 3))
points[:8] = [[i, j, k] for i in (0, 1) for j in (0, 1) for k in (0, 1)]
print("VTK", vtk.vtkVersion.GetVTKVersion())
print(f"vtkDelaunay3D: {vtk_volume(points, 0):.4f}")
print(f"vtkDelaunay3D, Offset 1000: {vtk_volume(points, 1000):.4f}")
print(f"SciPy: {volume(points, scipy.spatial.Delaunay(points).simplices):.4f}")
PYTHON
cat > "$folder/expected" <<'TEXT'
VTK 9.7.2
vtkDelaunay3D: 0.9338
vtkDelaunay3D, Offset 1000: 1.0000
SciPy: 1.0000
TEXT
diff "$folder/expected" "$folder/seen" && echo "As described."
