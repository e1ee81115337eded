#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# append_points of laspy 2.7.0 moves points whose offsets or scales are not those of the file that it appends to: a tile
# with x from 2,000 m and the offset 2,000 m lands at 1,000 m in a file with the offset 1,000 m, and with steps of 1 mm
# instead of 1 cm it becomes ten times as wide. There is no error or warning. write_points, given the same records,
# converts them, as its documentation says; that of append_points asks only for the same point format.
# Expected: the same coordinates by both ways, or an error.
# Consequence: merged tiles of a survey, which often have offsets of their own, lie on top of each other. Call
# change_scaling of the points with the scales and offsets of the file's header before appending.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install laspy==2.7.0 numpy==2.2.6
cd "$folder"
"$folder/venv/bin/python" -W error - <<'PYTHON' | tee "$folder/seen"
import importlib.metadata

import laspy
import numpy


def made(name, offset, scale):
    header = laspy.LasHeader(version="1.4", point_format=6)
    header.offsets, header.scales = [offset, 0, 0], [scale, 0.01, 0.01]
    tile = laspy.LasData(header)
    tile.x = offset + numpy.array([0.25, 100.5])
    tile.y = tile.z = numpy.zeros(2)
    tile.write(name)


print("laspy", importlib.metadata.version("laspy"))
for offset, scale in ((1000, 0.01), (2000, 0.01), (2000, 0.001)):
    made("second.las", offset, scale)
    second = laspy.read("second.las")
    print(f"offset {offset}, scale {scale}: x {numpy.array(second.x).tolist()}")
    for way in ("write_points", "append_points", "append_points after change_scaling"):
        made("first.las", 1000, 0.01)
        first = laspy.read("first.las")
        points = laspy.read("second.las").points
        if way == "write_points":
            with laspy.open("merged.las", mode="w", header=first.header) as file:
                file.write_points(first.points)
                file.write_points(points)
        else:
            first.write("merged.las")
            if "change" in way:
                points.change_scaling(first.header.scales, first.header.offsets)
            with laspy.open("merged.las", mode="a") as file:
                file.append_points(points)
        print(f"  {way}: x {numpy.round(laspy.read('merged.las').x[2:], 3).tolist()}")
PYTHON
cat > "$folder/expected" <<'TEXT'
laspy 2.7.0
offset 1000, scale 0.01: x [1000.25, 1100.5]
  write_points: x [1000.25, 1100.5]
  append_points: x [1000.25, 1100.5]
  append_points after change_scaling: x [1000.25, 1100.5]
offset 2000, scale 0.01: x [2000.25, 2100.5]
  write_points: x [2000.25, 2100.5]
  append_points: x [1000.25, 1100.5]
  append_points after change_scaling: x [2000.25, 2100.5]
offset 2000, scale 0.001: x [2000.25, 2100.5]
  write_points: x [2000.25, 2100.5]
  append_points: x [1002.5, 2005.0]
  append_points after change_scaling: x [2000.25, 2100.5]
TEXT
diff "$folder/expected" "$folder/seen" && echo "As described."
