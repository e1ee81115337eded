# SPDX-License-Identifier: BSD-3-Clause
"""Sorts points along a Hilbert curve: hilbert-order.py POINTS.npy SORTED.npy"""
import sys

import numpy as np

LEVELS = 20


def hilbert_index(x, y):
    """The position along the curve of integer coordinates below 2^LEVELS (Skilling's transform in 2D)."""
    index = np.zeros(len(x), np.int64)
    for level in reversed(range(LEVELS)):
        side = np.int64(1) << level
        right = (x & side) > 0
        upper = (y & side) > 0
        index += side * side * ((3 * right) ^ upper)
        turned = ~upper
        mirrored = turned & right
        x = np.where(mirrored, (2 * side - 1) - (x & (2 * side - 1)), x & (2 * side - 1))
        y = np.where(mirrored, (2 * side - 1) - (y & (2 * side - 1)), y & (2 * side - 1))
        x, y = np.where(turned, y, x), np.where(turned, x, y)
    return index


points = np.load(sys.argv[1])
low, high = points.min(axis=0), points.max(axis=0)
cells = ((points - low) / (high - low) * (2**LEVELS - 1)).astype(np.int64)
with open(sys.argv[2], "wb") as file:
    np.save(file, points[np.argsort(hilbert_index(cells[:, 0], cells[:, 1]), kind="stable")])
