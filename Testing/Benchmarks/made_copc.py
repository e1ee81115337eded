# SPDX-License-Identifier: BSD-3-Clause
"""Writes a COPC file of random points on hills, for measuring. Needs numpy and lazrs.

Usage: made_copc.py OUTPUT LEVELS POINTS

The octree has LEVELS levels, all cubes along x and y and one along z, with POINTS points each: 7 levels of 18312 points are
100 million points.
"""
import struct
import sys

import lazrs
import numpy as np

SIDE = 10000.0  # of the root's cube
SCALE = 0.001
PAGED_LEVEL = 4  # the nodes from this level on are in pages of their own
RECORD = np.dtype([("x", "<i4"), ("y", "<i4"), ("z", "<i4"), ("intensity", "<u2"), ("returns", "u1"), ("flags", "u1"),
                   ("class", "u1"), ("user", "u1"), ("angle", "<i2"), ("source", "<u2"), ("time", "<f8")])
FORMAT = 6
RANDOM = np.random.default_rng(1)


def points_of(level, x, y, count):
    """The records of a node, in lines as scanners write them."""
    side = SIDE / 2**level
    px, py = (x + RANDOM.random(count)) * side, (y + RANDOM.random(count)) * side
    order = np.lexsort((px, np.floor(py / side * np.sqrt(count) / 3)))
    px, py = px[order], py[order]
    records = np.zeros(count, RECORD)
    records["x"] = np.minimum(px / SCALE, (x + 1) * side / SCALE - 1)
    records["y"] = np.minimum(py / SCALE, (y + 1) * side / SCALE - 1)
    records["z"] = (40 + 20 * np.sin(px / 300) + 15 * np.cos(py / 200) + RANDOM.normal(0, 0.3, count)) / SCALE
    records["intensity"], records["returns"], records["class"] = 100, 0x11, 2
    records["time"] = 1000 + np.arange(count) * 1e-5
    return records


def record(user, number, content):
    return b"\0\0" + user.ljust(16, b"\0") + struct.pack("<HH", number, len(content)) + b"\0" * 32 + content


def header_of(offset, points, extended):
    header = bytearray(375)
    struct.pack_into("<4s", header, 0, b"LASF")
    struct.pack_into("<BB", header, 24, 1, 4)
    struct.pack_into("<HIIBH", header, 94, 375, offset, 2, 128 + FORMAT, RECORD.itemsize)
    struct.pack_into("<6d", header, 131, SCALE, SCALE, SCALE, 0, 0, 0)
    struct.pack_into("<6d", header, 179, SIDE, 0, SIDE, 0, 100, 0)
    struct.pack_into("<QIQ", header, 235, extended, 1, points)
    return header


def write_hierarchy(file, entries):
    """Writes the pages, the root's last. Returns its offset and size."""
    pages = {}
    for entry in entries:
        level, x, y = entry[:3]
        up = level - PAGED_LEVEL
        pages.setdefault((PAGED_LEVEL, x >> up, y >> up) if up >= 0 else (), []).append(struct.pack("<4iQii", *entry))
    size = 32 * (len(entries) + len(pages) - 1)
    file.write(b"\0\0" + b"copc".ljust(16, b"\0") + struct.pack("<HQ", 1000, size) + b"\0" * 32)
    root = pages.pop(())
    for (level, x, y), page in pages.items():
        root.append(struct.pack("<4iQii", level, x, y, 0, file.tell(), 32 * len(page), -1))
        file.write(b"".join(page))
    offset = file.tell()
    file.write(b"".join(root))
    return offset, 32 * len(root)


def main():
    output, levels, count = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    nodes = [(level, x, y) for level in range(levels) for x in range(2**level) for y in range(2**level)]
    compression = lazrs.LazVlr.new_for_compression(FORMAT, 0, True)
    laszip = record(b"laszip encoded", 22204, bytes(compression.record_data()))
    begin = 375 + 54 + 160 + len(laszip)
    with open(output, "wb") as file:
        file.write(bytes(begin))
        compressor = lazrs.LasZipCompressor(file, compression)
        compressor.reserve_offset_to_chunk_table()
        entries, at = [], begin + 8
        for level, x, y in nodes:
            compressor.compress_many(points_of(level, x, y, count).tobytes())
            compressor.finish_current_chunk()
            file.flush()
            entries.append((level, x, y, 0, at, file.tell() - at, count))
            at = file.tell()
        compressor.done()
        file.seek(0, 2)
        extended = file.tell()
        root = write_hierarchy(file, entries)
        file.seek(0)
        half = SIDE / 2
        info = struct.pack("<5dQQdd88x", half, half, half, half, SIDE / np.sqrt(count), *root, 1000, 2000)
        file.write(header_of(begin, count * len(nodes), extended) + record(b"copc", 1, info) + laszip)


if __name__ == "__main__":
    main()
