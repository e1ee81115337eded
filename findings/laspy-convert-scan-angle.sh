#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# laspy.convert of laspy 2.7.0 sets all scan angles to 0 when points change between formats 0 to 5, which store whole
# degrees, and 6 to 10, which store multiples of 0.006 degrees. Fields of the same name, such as user data, are kept.
# There is no warning, and convert's documentation does not mention it. laspy.point.format.lost_dimensions(3, 6), which
# convert does not call, lists scan_angle_rank together with the colours that format 6 does not have.
# Expected: -20 degrees stay -20 degrees, as -3333 steps; only the name and the unit of the field differ.
# Consequence: after an upgrade to LAS 1.4, a filter by scan angle keeps every point as seen at nadir.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install laspy==2.7.0 numpy==2.2.6
"$folder/venv/bin/python" -W error - <<'PYTHON' | tee "$folder/seen"
import importlib.metadata
import io

import laspy
import numpy

DEGREES = numpy.array([-20, -1, 7, 15])


def degrees(las):
    if las.point_format.id < 6:
        return las.scan_angle_rank.tolist()
    return numpy.round(numpy.asarray(las.scan_angle) * 0.006, 1).tolist()


def converted(las, point_format):
    file = io.BytesIO()
    laspy.convert(las, point_format_id=point_format).write(file)
    file.seek(0)
    return laspy.read(file)


def report(las):
    print(f"  format {las.point_format.id}: scan angles {degrees(las)}, user data {las.user_data.tolist()}")


print("laspy", importlib.metadata.version("laspy"))
for version, point_format, other in (("1.2", 3, 6), ("1.4", 6, 3), ("1.4", 6, 7)):
    las = laspy.LasData(laspy.LasHeader(version=version, point_format=point_format))
    las.x = las.y = las.z = numpy.arange(4.0)
    las.user_data = numpy.arange(4)
    if point_format < 6:
        las.scan_angle_rank = DEGREES
    else:
        las.scan_angle = numpy.round(DEGREES / 0.006)
    print(f"{point_format} to {other}:")
    report(las)
    report(converted(las, other))
PYTHON
cat > "$folder/expected" <<'TEXT'
laspy 2.7.0
3 to 6:
  format 3: scan angles [-20, -1, 7, 15], user data [0, 1, 2, 3]
  format 6: scan angles [0.0, 0.0, 0.0, 0.0], user data [0, 1, 2, 3]
6 to 3:
  format 6: scan angles [-20.0, -1.0, 7.0, 15.0], user data [0, 1, 2, 3]
  format 3: scan angles [0, 0, 0, 0], user data [0, 1, 2, 3]
6 to 7:
  format 6: scan angles [-20.0, -1.0, 7.0, 15.0], user data [0, 1, 2, 3]
  format 7: scan angles [-20.0, -1.0, 7.0, 15.0], user data [0, 1, 2, 3]
TEXT
diff "$folder/expected" "$folder/seen" && echo "As described."
