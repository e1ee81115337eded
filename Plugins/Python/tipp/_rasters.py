# SPDX-License-Identifier: BSD-3-Clause
"""What tipp.dem needs of any engine: pixels, files that laspy decompresses, thinning, duplicates and slopes."""
from __future__ import annotations

import contextlib
import importlib.util
import math
import os
import tempfile
from typing import Any, Iterator

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


DERIVED = ("slope", "aspect", "hillshade", "void", "density")


def needs_elevation(options: dict[str, Any]) -> bool:
    rules = {options["duplicates"], *(options["thin"] or ())[1:]}
    wanted = {"elevation", *DERIVED[:3]}
    return not wanted.isdisjoint(options["attributes"]) or not rules.isdisjoint({"min", "max"})


def selected(xyz: np.ndarray, data: dict[str, np.ndarray],
             options: dict[str, Any]) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """The points that thinning keeps, one at each position, and their data."""
    if options["thin"]:
        kept = thinned(xyz, *options["thin"])
        xyz, data = xyz[kept], {name: values[kept] for name, values in data.items()}
    if options["duplicates"] != "first":
        _, xyz, data = distinct(xyz, data, options["duplicates"])
    return xyz, data


def thinned(xyz: np.ndarray, cell: float, rule: str) -> np.ndarray:
    """The indices of the points to keep: one in each square, and all that are not finite."""
    finite = np.isfinite(xyz[:, :2]).all(axis=1)
    ids = np.flatnonzero(finite)
    square = np.floor(xyz[ids, :2] / cell)
    if rule == "nearest":
        away = xyz[ids, :2] / cell - square - 0.5
        rank = away[:, 0] * away[:, 0] + away[:, 1] * away[:, 1]
    else:
        rank = _ranks(xyz[ids, 2], rule)
    return np.sort(np.concatenate([ids[_best(square, rank)], np.flatnonzero(~finite)]))


def distinct(xyz: np.ndarray, columns: dict[str, np.ndarray], rule: str) -> tuple[np.ndarray, np.ndarray, dict[str, np.ndarray]]:
    """The indices of the points to keep, one at each position, and their coordinates and columns."""
    positions = xyz[:, :2] + 0.0  # -0 is 0
    if rule != "mean":
        chosen = np.sort(_best(positions, _ranks(xyz[:, 2], rule)))
        return chosen, xyz[chosen], {name: values[chosen] for name, values in columns.items()}
    _, first, position = np.unique(positions, axis=0, return_index=True, return_inverse=True)
    position = position.reshape(-1)
    z, *means = (_means(position, values, len(first)) for values in (xyz[:, 2], *columns.values()))
    return first, np.c_[xyz[first, :2], z], dict(zip(columns, means))


def derived(kind: str, corners: np.ndarray) -> np.ndarray:
    """One value for each triangle of corners of shape (n, 3, 3)."""
    if kind == "void":
        return np.zeros(len(corners))
    order = np.lexsort((corners[..., 2], corners[..., 1], corners[..., 0]), axis=-1)
    a, b, c = np.moveaxis(np.take_along_axis(corners, order[..., None], axis=1), 1, 0)
    (bx, by, bz), (cx, cy, cz) = (b - a).T, (c - a).T
    area = bx * cy - by * cx
    if kind == "density":
        return 1 / np.abs(area)
    x, y = (bz * cy - by * cz) / area, (bx * cz - bz * cx) / area
    if kind == "slope":
        return np.arctan(np.hypot(x, y)) * (180 / np.pi)
    if kind == "aspect":
        angle = np.arctan2(-x, -y) * (180 / np.pi)
        return np.where((x == 0) & (y == 0), np.nan, np.where(angle < 0, angle + 360, angle))
    light = (np.sqrt(0.5) + 0.5 * x - 0.5 * y) / np.sqrt(1 + x * x + y * y)
    return 1 + 254 * np.maximum(0, light)


def _ranks(z: np.ndarray, rule: str) -> np.ndarray:
    """The lowest rank is the best; NaN comes last."""
    rank = np.zeros(len(z)) if rule == "first" else z if rule == "min" else -z
    return np.where(np.isnan(rank), np.inf, rank)


def _best(groups: np.ndarray, rank: np.ndarray) -> np.ndarray:
    """Of each group, which two numbers name, the first index of lowest rank."""
    order = np.lexsort((rank, groups[:, 1], groups[:, 0]))  # stable
    ordered = groups[order]
    return order[np.r_[True, (ordered[1:] != ordered[:-1]).any(axis=1)][: len(order)]]


def _means(group: np.ndarray, values: np.ndarray, groups: int) -> np.ndarray:
    known = ~np.isnan(values)
    with np.errstate(invalid="ignore"):
        return (np.bincount(group[known], values[known], groups) / np.bincount(group[known], minlength=groups))
