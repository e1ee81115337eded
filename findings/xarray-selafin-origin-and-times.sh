#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# xarray-selafin 0.2.5, which reads and writes TELEMAC's results, changes a file that is read and written again, without
# an error or a warning:
# - The origin of the coordinates, which the parameters 3 and 4 of the file hold, is added twice: nodes at x = 500,000 m
#   and y = 5,700,000 m move to 1,000,000 m and 11,400,000 m, and further with each copy. The reader adds the origin to
#   the stored coordinates; the writer stores the sums and keeps the parameters.
# - Times lose their fractions of a second: steps at 0, 0.5, 1 and 1.5 s become 0, 0, 1 and 1 s.
# Expected: the same nodes and times, or a writer that refuses. Without an origin and with whole
# seconds the copy is right.
# Consequence: a mesh that went through a script lies elsewhere, and series with short steps have two values at one
# time. Zeros for parameters 3 and 4 in attrs["params"], set before writing, keep the coordinates.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install xarray-selafin==0.2.5 python-serafin==0.2.2 xarray==2026.9.0 numpy==2.4.6
cd "$folder"
"$folder/venv/bin/python" -W error - <<'PYTHON' | tee "$folder/seen"
import importlib.metadata
import struct

import numpy
import xarray


def record(data, dtype=">i4"):
    data = data if isinstance(data, bytes) else numpy.array(data, dtype).tobytes()
    size = struct.pack(">i", len(data))
    return size + data + size


def made(name, origin, times):
    records = [record(b"A triangle".ljust(72) + b"SERAFIN "), record([1, 0])]
    records.append(record(b"WATER DEPTH".ljust(16) + b"M".ljust(16)))
    records.append(record([1, 0, *origin, 0, 0, 0, 0, 0, 1]))
    records.append(record([2026, 1, 2, 3, 0, 0]))
    records += [record(integers) for integers in ([1, 3, 3, 1], [1, 2, 3], [1, 2, 3])]
    records += [record(axis, ">f4") for axis in ([0.25, 1.25, 1.25], [0.5, 0.5, 1.5])]
    records += [record(count * [time], ">f4") for time in times for count in (1, 3)]
    with open(name, "wb") as file:
        file.writelines(records)


def report(name):
    with xarray.open_dataset(name, engine="selafin") as mesh:
        seconds = (mesh.time - numpy.datetime64("2026-01-02T03:00")) / numpy.timedelta64(1, "s")
        print(f"  x {mesh.x.values.tolist()}, y {mesh.y.values.tolist()}, times {seconds.values.tolist()}")


def copy(source, target):
    with xarray.open_dataset(source, engine="selafin") as mesh:
        mesh.selafin.write(target)


print("xarray-selafin", importlib.metadata.version("xarray-selafin"))
for origin, times in (((0, 0), (0, 1, 2, 3)), ((500000, 5700000), (0, 0.5, 1, 1.5))):
    print(f"origin {origin}: the file, its copy, the copy's copy")
    made("first.slf", origin, times)
    copy("first.slf", "second.slf")
    copy("second.slf", "third.slf")
    for name in ("first.slf", "second.slf", "third.slf"):
        report(name)
PYTHON
cat > "$folder/expected" <<'TEXT'
xarray-selafin 0.2.5
origin (0, 0): the file, its copy, the copy's copy
  x [0.25, 1.25, 1.25], y [0.5, 0.5, 1.5], times [0.0, 1.0, 2.0, 3.0]
  x [0.25, 1.25, 1.25], y [0.5, 0.5, 1.5], times [0.0, 1.0, 2.0, 3.0]
  x [0.25, 1.25, 1.25], y [0.5, 0.5, 1.5], times [0.0, 1.0, 2.0, 3.0]
origin (500000, 5700000): the file, its copy, the copy's copy
  x [500000.25, 500001.25, 500001.25], y [5700000.5, 5700000.5, 5700001.5], times [0.0, 0.5, 1.0, 1.5]
  x [1000000.25, 1000001.25, 1000001.25], y [11400000.5, 11400000.5, 11400001.5], times [0.0, 0.0, 1.0, 1.0]
  x [1500000.25, 1500001.25, 1500001.25], y [17100000.0, 17100000.0, 17100002.0], times [0.0, 0.0, 1.0, 1.0]
TEXT
diff "$folder/expected" "$folder/seen" && echo "As described."
