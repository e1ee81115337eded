#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# vtkDelaunay2D of VTK 9.7.2, with its default settings, returns clockwise triangles for a plain 20 x 20 lattice: 37 of
# 722, so that the signed areas add up to 324 instead of 361. With RandomPointInsertion on, 358 of 722 are clockwise.
# Expected: triangles of one orientation, as for points in general position (no clockwise one among 1,959).
# Consequence: normals and signed areas computed from the output are wrong, without a warning.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install vtk==9.7.2 numpy==2.2.6
"$folder/venv/bin/python" - <<'PYTHON' | tee "$folder/seen"
import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy


def signed_areas(xy, random_insertion):
    points = vtk.vtkPoints()
    points.SetData(numpy_to_vtk(numpy.column_stack([xy, numpy.zeros(len(xy))]), deep=1))
    data = vtk.vtkPolyData()
    data.SetPoints(points)
    delaunay = vtk.vtkDelaunay2D()
    delaunay.SetInputData(data)
    delaunay.SetRandomPointInsertion(random_insertion)
    delaunay.Update()
    mesh = delaunay.GetOutput()
    corners = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    a, b, c = (vtk_to_numpy(mesh.GetPoints().GetData())[corners[:, k], :2] for k in range(3))
    (ux, uy), (vx, vy) = (b - a).T, (c - a).T
    return (ux * vy - uy * vx) / 2


lattice = numpy.stack(numpy.meshgrid(numpy.arange(20.0), numpy.arange(20.0)), -1).reshape(-1, 2)
scattered = numpy.random.default_rng(1).random((1000, 2))
print("VTK", vtk.vtkVersion.GetVTKVersion())
for name, xy, random_insertion in (("lattice", lattice, 0), ("lattice, random insertion", lattice, 1), ("scattered", scattered, 0)):
    areas = signed_areas(xy, random_insertion)
    clockwise = int((areas < 0).sum())
    print(f"{name}: {len(areas)} triangles, {clockwise} clockwise, signed area {areas.sum():.6g}")
PYTHON
cat > "$folder/expected" <<'TEXT'
VTK 9.7.2
lattice: 722 triangles, 37 clockwise, signed area 324
lattice, random insertion: 722 triangles, 358 clockwise, signed area 3
scattered: 1959 triangles, 0 clockwise, signed area 0.968667
TEXT
diff "$folder/expected" "$folder/seen" && echo "As described."
