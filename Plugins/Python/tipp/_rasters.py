# SPDX-License-Identifier: BSD-3-Clause
"""What tipp.dem needs of any engine: pixels, and files that laspy decompresses."""
from __future__ import annotations

import contextlib
import importlib.util
import math
import os
import tempfile
from typing import Iterator

import numpy as np


def grid_over(bounds: list[float], size: float, aligned: bool) -> tuple[float, float, int, int]:
    """West, south, columns and rows: those of `tipp dem`."""

    def cover(low: float, high: float) -> tuple[float, int]:
        if low > high:
            raise ValueError(f"bounds go from {low} to {high}; give the lower one first.")
        origin = math.floor(low / size + 1e-9) * size if aligned else low
        return origin, max(1, math.ceil((high - origin) / size - 1e-9))

    (west, columns), (south, rows) = cover(*bounds[:2]), cover(*bounds[2:])
    return west, south, columns, rows


def bounds_of(xy: np.ndarray) -> list[float]:
    """xmin, xmax, ymin, ymax of the finite points."""
    if len(xy) == 0:
        raise RuntimeError("There are no points.")
    xy = xy[np.isfinite(xy).all(axis=1)]
    if len(xy) == 0:
        raise RuntimeError("There is no point with finite coordinates.")
    low, high = xy.min(axis=0), xy.max(axis=0)
    return [float(low[0]), float(high[0]), float(low[1]), float(high[1])]


def sampling_of(grid: tuple[float, float, int, int], size: float) -> list[float]:
    """Bounds that have the centres of a grid's pixels as samples."""
    west, south, columns, rows = grid
    low = west + 0.5 * size, south + 0.5 * size
    # Half a step more on the far side, so that roundings do not cost the last column or row.
    return [low[0], low[0] + (columns - 0.5) * size, low[1], low[1] + (rows - 0.5) * size, 0.0, 0.0]


@contextlib.contextmanager
def uncompressed(paths: list[str]) -> Iterator[list[str]]:
    """The files, with .laz files as temporary .las files, which laspy writes, where it is installed."""
    compressed = [path for path in paths if path.lower().endswith(".laz")]
    if not compressed or importlib.util.find_spec("laspy") is None:
        yield paths
        return
    import laspy

    with tempfile.TemporaryDirectory() as folder:
        files = []
        for number, path in enumerate(paths):
            if path not in compressed:
                files.append(path)
                continue
            files.append(os.path.join(folder, f"{number}.las"))
            try:
                with laspy.open(path) as source, laspy.open(files[-1], "w", header=source.header, do_compress=False) as to:
                    for block in source.chunk_iterator(1_000_000):
                        to.write_points(block)
            except Exception as error:
                raise RuntimeError(f"{path}: cannot be decompressed by laspy ({error}).") from None
        yield files
