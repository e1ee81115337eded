#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Gmsh 4.15.2 writes OFF files with six significant digits: the corners of a square of 1 m at a northing of 5,700,000 m
# all get the y-coordinate 5.7e+06, so that its triangles have no area. There is no warning. The STL, PLY2, SU2 and MSH
# files that it writes of the same mesh, text as well, hold the coordinates.
# Expected: the coordinates in all of them, as OFF does not limit the digits.
# Consequence: northings are rounded to 10 m. Write another format, or move the mesh to the origin.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install gmsh==4.15.2 numpy==2.4.6
cd "$folder"
"$folder/venv/bin/python" -W error - <<'PYTHON' | tee "$folder/seen"
import re

import gmsh
import numpy

corners = numpy.array([[0, 0, 1], [1, 0, 2], [1, 1, 3], [0, 1, 4]]) + [500000.25, 5700000.75, 0]
gmsh.initialize(interruptible=False)
gmsh.option.setNumber("General.Verbosity", 1)
gmsh.model.addDiscreteEntity(2, 1)
gmsh.model.mesh.addNodes(2, 1, [1, 2, 3, 4], corners.ravel())
gmsh.model.mesh.addElementsByType(1, 2, [1, 2], [1, 2, 3, 1, 3, 4])
print("Gmsh", gmsh.__version__)
for ending in ("stl", "ply2", "su2", "msh", "off"):
    gmsh.write(f"mesh.{ending}")
    with open(f"mesh.{ending}") as file:
        numbers = {float(text) for text in re.findall(r"[-+.\deE]*\d[-+.\deE]*", file.read())}
    northings = sorted(number for number in numbers if number > 5e6)
    print(f"{ending}: northings {northings}")
gmsh.finalize()
PYTHON
cat > "$folder/expected" <<'TEXT'
Gmsh 4.15.2
stl: northings [5700000.75, 5700001.75]
ply2: northings [5700000.75, 5700001.75]
su2: northings [5700000.75, 5700001.75]
msh: northings [5700000.75, 5700001.75]
off: northings [5700000.0]
TEXT
diff "$folder/expected" "$folder/seen" && echo "As described."
