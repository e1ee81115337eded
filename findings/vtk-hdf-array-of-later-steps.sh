#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# vtkHDFWriter of VTK 9.7.2 writes an array that begins at a later time step so that it is read at wrong times. Of five
# steps, "always" is 0, 10, 20, 30 and 40, and "late" is the same from the second step on. The writer reports no error.
# vtkHDFReader then gives "late" = 20, 30 and 40 at times 0, 1 and 2, also without an error, and cannot read it at times
# 3 and 4. All values are in the file: the array's offsets lack those of the steps without it, and its first one, 0.
# Expected: at each time the values of that time, no array where there was none, or a writer that refuses.
# Consequence: output that a model begins after a spin-up, such as a maximum, appears two steps too early.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install vtk==9.7.2 numpy==2.2.6
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON' 2> /dev/null | tee "$folder/seen"
import vtk
from vtk.util.numpy_support import vtk_to_numpy
from vtk.util.vtkAlgorithm import VTKPythonAlgorithmBase

STEPS = [0.0, 1.0, 2.0, 3.0, 4.0]
STREAMING = vtk.vtkStreamingDemandDrivenPipeline


def array(name, value, count):
    values = vtk.vtkDoubleArray()
    values.SetName(name)
    values.SetNumberOfTuples(count)
    values.Fill(value)
    return values


class Model(VTKPythonAlgorithmBase):
    """A triangle whose array "late" begins at the second step."""

    def __init__(self):
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkUnstructuredGrid")

    def RequestInformation(self, request, inputs, outputs):
        information = outputs.GetInformationObject(0)
        information.Set(STREAMING.TIME_STEPS(), STEPS, len(STEPS))
        information.Set(STREAMING.TIME_RANGE(), [STEPS[0], STEPS[-1]], 2)
        return 1

    def RequestData(self, request, inputs, outputs):
        information = outputs.GetInformationObject(0)
        time = information.Get(STREAMING.UPDATE_TIME_STEP()) if information.Has(STREAMING.UPDATE_TIME_STEP()) else 0.0
        mesh = vtk.vtkUnstructuredGrid.GetData(information)
        points = vtk.vtkPoints()
        for corner in ((0, 0, 0), (1, 0, 0), (0, 1, 0)):
            points.InsertNextPoint(corner)
        mesh.SetPoints(points)
        mesh.Allocate(1)
        mesh.InsertNextCell(vtk.VTK_TRIANGLE, 3, [0, 1, 2])
        mesh.GetPointData().AddArray(array("always", 10 * time, 3))
        if time > 0:
            mesh.GetPointData().AddArray(array("late", 10 * time, 3))
        return 1


model = Model()
writer = vtk.vtkHDFWriter()
writer.SetInputConnection(model.GetOutputPort())
writer.SetFileName("steps.vtkhdf")
writer.SetWriteAllTimeSteps(True)
print("VTK", vtk.vtkVersion.GetVTKVersion())
print("Write() returns", writer.Write(), "with error code", writer.GetErrorCode())
for time in STEPS:
    reader = vtk.vtkHDFReader()
    reader.SetFileName("steps.vtkhdf")
    reader.UpdateInformation()
    reader.UpdateTimeStep(time)
    data = reader.GetOutputDataObject(0).GetPointData()
    found = []
    for name in ("always", "late"):
        values = data.GetArray(name)
        found.append(f"{name} {vtk_to_numpy(values)[0]:g}" if values and values.GetNumberOfTuples() else f"no {name}")
    print(f"time {time:g}: {', '.join(found)}")
PYTHON
cat > "$folder/expected" <<'TEXT'
VTK 9.7.2
Write() returns 1 with error code 0
time 0: always 0, late 20
time 1: always 10, late 30
time 2: always 20, late 40
time 3: always 30, no late
time 4: always 40, no late
TEXT
diff "$folder/expected" "$folder/seen" && echo "As described."
