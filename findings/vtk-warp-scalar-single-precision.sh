#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# vtkWarpScalar of VTK 9.7.2, the usual way to raise a surface by its heights (PyVista's warp_by_scalar, ParaView's Warp
# By Scalar), rounds coordinates of double precision to single precision: four rows of a terrain, 0.25 m apart at a
# northing of 5,700,000 m, become three, 0.5 m apart. There is no warning. OutputPointsPrecision is DEFAULT_PRECISION,
# for which vtkAlgorithm documents that the output's precision matches the input's. vtkWarpVector and vtkContourFilter
# do so. SetOutputPointsPrecision(DOUBLE_PRECISION) helps; PyVista has no parameter for it.
# Expected: four rows, in double precision.
# Consequence: triangles of dense surveys in projected coordinates collapse or overlap in the warped surface.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install vtk==9.7.2 numpy==2.2.6
"$folder/venv/bin/python" - <<'PYTHON' | tee "$folder/seen"
import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

PRECISIONS = ("SINGLE_PRECISION", "DOUBLE_PRECISION", "DEFAULT_PRECISION")


def terrain():
    row, column = numpy.mgrid[0:4, 0:4]
    xyz = numpy.stack([500000 + 0.25 * column, 5700000 + 0.25 * row, 0 * row], -1).reshape(-1, 3)
    points = vtk.vtkPoints()
    points.SetData(numpy_to_vtk(xyz, deep=1))
    grid = vtk.vtkStructuredGrid()
    grid.SetDimensions(4, 4, 1)
    grid.SetPoints(points)
    height = numpy_to_vtk(column.reshape(-1).astype(float), deep=1)
    height.SetName("height")
    grid.GetPointData().SetScalars(height)
    grid.GetPointData().SetVectors(numpy_to_vtk(numpy.zeros((16, 3)), deep=1))
    return grid


print("VTK", vtk.vtkVersion.GetVTKVersion())
contour = vtk.vtkContourFilter()
contour.SetValue(0, 1)
precise = vtk.vtkWarpScalar()
precise.SetOutputPointsPrecision(vtk.vtkAlgorithm.DOUBLE_PRECISION)
for algorithm in (vtk.vtkWarpScalar(), precise, vtk.vtkWarpVector(), contour):
    algorithm.SetInputData(terrain())
    algorithm.Update()
    y = vtk_to_numpy(algorithm.GetOutputDataObject(0).GetPoints().GetData())[:, 1]
    precision = PRECISIONS[algorithm.GetOutputPointsPrecision()]
    rows = (numpy.unique(y) - 5700000).tolist()
    print(f"{algorithm.GetClassName()}, {precision}: {y.dtype}, rows at {rows}")
PYTHON
cat > "$folder/expected" <<'TEXT'
VTK 9.7.2
vtkWarpScalar, DEFAULT_PRECISION: float32, rows at [0.0, 0.5, 1.0]
vtkWarpScalar, DOUBLE_PRECISION: float64, rows at [0.0, 0.25, 0.5, 0.75]
vtkWarpVector, DEFAULT_PRECISION: float64, rows at [0.0, 0.25, 0.5, 0.75]
vtkContourFilter, DEFAULT_PRECISION: float64, rows at [0.0, 0.25, 0.5, 0.75]
TEXT
diff "$folder/expected" "$folder/seen" && echo "As described."
