#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# write_scan_raw of pye57 0.4.19 stores coordinates in single precision, whatever the type of the arrays is: points
# 0.1 m apart at a northing of 5,700,000 m become 0.5 m apart. There is no warning and no parameter, and the arrays
# that are read back are of double precision. E57 has both precisions (the attribute "precision" of its Float elements).
# Expected: arrays of double precision are stored as such.
# Consequence: 30 points of a scan in projected coordinates come back at 7 places, and a surface of them has steps.
# Write coordinates relative to a corner, and the corner as the pose's translation, which is of double precision.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install pye57==0.4.19 numpy==2.4.6
cd "$folder"
"$folder/venv/bin/python" -W error - <<'PYTHON' | tee "$folder/seen"
import importlib.metadata

import numpy
import pye57

NAMES = ("cartesianX", "cartesianY", "cartesianZ")
points = numpy.array([[0.0, 0.1 * i, 0.0] for i in range(30)])
corner = numpy.array([500000.0, 5700000.0, 0.0])


def report(name, written, **options):
    with pye57.E57("scan.e57", mode="w") as file:
        file.write_scan_raw(dict(zip(NAMES, written.T.copy())), **options)
    with pye57.E57("scan.e57") as file:
        data = file.read_scan(0, ignore_missing_fields=True)
    found = numpy.stack([data[key] for key in NAMES], -1)
    error = abs(found - (corner + points)).max()
    print(f"{name}: {found.dtype}, {len(numpy.unique(found, axis=0))} of 30 places, the largest error is {error:.2f}")


print("pye57", importlib.metadata.version("pye57"))
report("projected", corner + points)
report("relative to a corner", points, translation=corner)
PYTHON
cat > "$folder/expected" <<'TEXT'
pye57 0.4.19
projected: float64, 7 of 30 places, the largest error is 0.20
relative to a corner: float64, 30 of 30 places, the largest error is 0.00
TEXT
diff "$folder/expected" "$folder/seen" && echo "As described."
