#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# vtk_to_numpy of VTK 9.7.2 raises NameError: name 'vtkConstants' is not defined, for arrays of the implicit classes
# vtkAffineType*Array and vtkConstantType*Array, which filters of VTK 9.7 hand to Python. numpy.asarray returns an array
# of no dimension that holds the VTK object, instead of its values. Iterating with GetTuple1 works.
# Expected: the values, as for vtkDoubleArray, or a TypeError that names the class.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install vtk==9.7.2 numpy==2.2.6
"$folder/venv/bin/python" - <<'PYTHON' | tee "$folder/seen"
import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy

print("VTK", vtk.vtkVersion.GetVTKVersion())
for name in ("vtkAffineTypeFloat64Array", "vtkConstantTypeInt32Array"):
    array = getattr(vtk, name)()
    if "Affine" in name:
        array.ConstructBackend(2, 1)
    else:
        array.ConstructBackend(7)
    array.SetNumberOfTuples(3)
    print(name, [array.GetTuple1(i) for i in range(3)])
    try:
        print("vtk_to_numpy:", vtk_to_numpy(array))
    except NameError as error:
        print("vtk_to_numpy: NameError:", error)
    print("numpy.asarray: shape", numpy.asarray(array).shape, "dtype", numpy.asarray(array).dtype)
PYTHON
cat > "$folder/expected" <<'TEXT'
VTK 9.7.2
vtkAffineTypeFloat64Array [1.0, 3.0, 5.0]
vtk_to_numpy: NameError: name 'vtkConstants' is not defined
numpy.asarray: shape () dtype object
vtkConstantTypeInt32Array [7.0, 7.0, 7.0]
vtk_to_numpy: NameError: name 'vtkConstants' is not defined
numpy.asarray: shape () dtype object
TEXT
diff "$folder/expected" "$folder/seen" && echo "As described."
