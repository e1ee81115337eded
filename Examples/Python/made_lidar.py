# SPDX-License-Identifier: BSD-3-Clause
"""Writes a LAS file as of a lidar scanner: a synthetic valley with ground, houses, trees, and a river without returns.

Usage: made_lidar.py FILE.las [COUNT]      (COUNT: number of pulses; default 200000)
"""
import struct
import sys

import numpy as np

SIDE, STEP = 400.0, 0.01  # metres
GROUND, TREE, HOUSE = 2, 5, 6  # classes of the LAS format
RECORD = np.dtype([("xyz", "<i4", 3), ("intensity", "<u2"), ("returns", "u1"), ("class", "u1"), ("rest", "u1", 4)])


def ground_at(x, y):
    """Returns the height of the ground, a valley with ripples and a terrace, and the distance from the river."""
    away = np.abs(y - 200 - 40 * np.sin(x / 70))
    hills = sum(8 / k * np.sin(k * x / 55 + k) * np.cos(k * y / 60 - k * k) for k in (1, 2, 3, 5, 8))
    return 100 + 0.0012 * away ** 2 + hills * np.minimum(away / 60, 1) + 2 * np.tanh((x - 260) / 3), away


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 200_000
    random = np.random.default_rng(3)
    x, y = random.random((2, count)) * SIDE
    z, away = ground_at(x, y)
    kind = np.full(count, GROUND)
    for east, north in random.random((25, 2)) * SIDE:
        inside = (np.abs(x - east) < 7) & (np.abs(y - north) < 5) & (away > 25)
        z[inside], kind[inside] = ground_at(np.array(east), np.array(north))[0] + 9 - np.abs(y[inside] - north) * 0.6, HOUSE
    for east, north in random.random((120, 2)) * SIDE:
        crown = 5 ** 2 - (x - east) ** 2 - (y - north) ** 2
        hit = (crown > 0) & (kind == GROUND) & (random.random(count) < 0.7)  # the other pulses reach the ground
        z[hit], kind[hit] = z[hit] + 4 + 1.5 * np.sqrt(crown[hit]), TREE
    returned = away > 9  # water returns nothing
    records = np.zeros(np.count_nonzero(returned), RECORD)
    records["xyz"] = np.column_stack([x, y, z + random.normal(0, 0.03, count)])[returned] / STEP
    records["intensity"] = (400 * kind + random.integers(0, 300, count))[returned]
    records["returns"], records["class"] = 9, kind[returned]  # bits: first return of one

    header = bytearray(227)
    header[:4] = b"LASF"
    header[24:26] = 1, 2
    struct.pack_into("<HII", header, 94, 227, 227, 0)
    struct.pack_into("<BHI", header, 104, 0, RECORD.itemsize, len(records))
    struct.pack_into("<6d", header, 131, *[STEP] * 3, *[0.0] * 3)
    high, low = records["xyz"].max(axis=0) * STEP, records["xyz"].min(axis=0) * STEP
    struct.pack_into("<6d", header, 179, *np.column_stack([high, low]).ravel())
    with open(sys.argv[1], "wb") as file:
        file.write(header)
        records.tofile(file)
    print(f"{len(records)} returns of {count} pulses over {SIDE:g} m x {SIDE:g} m")


if __name__ == "__main__":
    main()
