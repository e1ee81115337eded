#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# vtkNetCDFUGRIDReader of VTK 9.7.2, which ParaView uses for UGRID files, ignores scale_factor and add_offset: water
# levels of 1.04, 1.05 and 1.06 m that are packed as short integers in centimetres above 1 m are read as 4, 5 and 6.
# There is no warning, and no property to change it. VTK's other NetCDF reader for CF files, vtkNetCDFCFReader, unpacks
# the same values, and so does netCDF4. A UGRID file is a CF file, so CF's packing applies.
# Expected: 1.04, 1.05 and 1.06.
# Consequence: pictures and statistics of packed model output show counts as if they were metres.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install vtk==9.7.2 numpy==2.2.6 netCDF4==1.7.2
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON' | tee "$folder/seen"
import netCDF4
import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy

LEVELS = [1.04, 1.05, 1.06]


def packed(file, name, dimensions, values):
    variable = file.createVariable(name, "i2", dimensions)
    variable.scale_factor, variable.add_offset, variable.units = 0.01, 1.0, "m"
    variable[:] = values
    return variable


with netCDF4.Dataset("mesh.nc", "w") as file:
    file.Conventions = "CF-1.8 UGRID-1.0"
    for name, size in (("node", 5), ("face", 3), ("corner", 3)):
        file.createDimension(name, size)
    mesh = file.createVariable("mesh", "i4")
    mesh.cf_role, mesh.topology_dimension = "mesh_topology", numpy.int32(2)
    mesh.node_coordinates, mesh.face_node_connectivity = "x y", "face_nodes"
    file.createVariable("x", "f8", ("node",))[:] = [0, 1, 2, 0.5, 1.5]
    file.createVariable("y", "f8", ("node",))[:] = [0, 0, 0, 1, 1]
    faces = file.createVariable("face_nodes", "i4", ("face", "corner"))
    faces.cf_role, faces.start_index = "face_node_connectivity", numpy.int32(0)
    faces[:] = [[0, 1, 3], [1, 4, 3], [1, 2, 4]]
    level = packed(file, "level", ("face",), LEVELS)
    level.mesh, level.location = "mesh", "face"

with netCDF4.Dataset("grid.nc", "w") as file:
    file.Conventions = "CF-1.8"
    for name, size in (("y", 1), ("x", 3)):
        file.createDimension(name, size)
        file.createVariable(name, "f8", (name,))[:] = numpy.arange(size)
    packed(file, "level", ("y", "x"), [LEVELS])

print("VTK", vtk.vtkVersion.GetVTKVersion())
with netCDF4.Dataset("mesh.nc") as file:
    print("netCDF4:", numpy.round(file["level"][:], 6).tolist())
for reader, name in ((vtk.vtkNetCDFCFReader(), "grid.nc"), (vtk.vtkNetCDFUGRIDReader(), "mesh.nc")):
    reader.SetFileName(name)
    reader.Update()
    data = reader.GetOutputDataObject(0)
    values = data.GetCellData().GetArray("level") or data.GetPointData().GetArray("level")
    print(f"{reader.GetClassName()}:", numpy.round(vtk_to_numpy(values), 6).tolist())
PYTHON
cat > "$folder/expected" <<'TEXT'
VTK 9.7.2
netCDF4: [1.04, 1.05, 1.06]
vtkNetCDFCFReader: [1.04, 1.05, 1.06]
vtkNetCDFUGRIDReader: [4, 5, 6]
TEXT
diff "$folder/expected" "$folder/seen" && echo "As described."
