# SPDX-License-Identifier: BSD-3-Clause
"""Constraints in the wheel: calls the core, which only uses ids, and completes the values at points."""
from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from . import _core
from ._constraints import constraints_of
from ._surface import completed


class Segments(NamedTuple):
    """Constraints as edges between points, and the points and their values including new corners."""

    points: np.ndarray
    point_data: dict[str, np.ndarray] | None
    """None: the input's points."""
    pairs: np.ndarray
    """(m, 2) ids"""
    cells: np.ndarray
    """The number of each edge's line or polygon."""
    polygon_begin: int
    """The index of the first edge of a polygon; all following edges are polygons', too."""
    warnings: list[str]


def segments_of(points: np.ndarray, data: dict[str, np.ndarray], options: dict[str, Any]) -> Segments | None:
    """Combines the constraints of all arguments of delaunay_2d(). Returns None if there are none."""
    source = options["edge_source"]
    constraints = constraints_of(len(points), source, options["edges"], options["polygons"])
    if constraints is None and source is None:
        return None
    if options["tolerance"] > 0:
        raise RuntimeError("tol does not go with constraints: set it to 0, which merges points at one position.")
    if constraints is not None:
        lines, polygons, corners = constraints
        first, own = 0, {}
    else:
        lines, polygons, corners, own = _read_source(source, len(points), options.get("merge_source_points", False))
        first = source.GetNumberOfVerts()
    pairs, cells, begin = edges_of(lines, polygons)
    if len(pairs) and not 0 <= pairs.min() <= pairs.max() < len(points) + len(corners):
        wrong = np.flatnonzero((pairs < 0).any(axis=1) | (pairs >= len(points)).any(axis=1))[0]
        raise RuntimeError(f"cell {first + cells[wrong]} of the source names point {pairs[wrong].max()}, but the input "
                           f"has {len(points)} points: the source's ids are the input's.")
    joined, warnings = None, []
    if len(corners):
        count = len(points)
        ids, new = _core.match_positions(points, corners)
        pairs = np.concatenate([np.arange(count), ids])[pairs]
        if len(new):
            corners = corners[new]
            if constraints is None:
                values = {name: array[new] for name, array in own.items()}
            else:
                corners, values = completed(points, data, corners, options["threads"])
            kind = np.promote_types(points.dtype, corners.dtype)
            joined = {name: np.concatenate([array, values[name]]) for name, array in data.items()
                      if name in values and values[name].dtype == array.dtype and values[name].shape[1:] == array.shape[1:]}
            points = np.concatenate([points.astype(kind), corners[:, : points.shape[1]]])
            lost = len(data) - len(joined)
            if lost:
                warnings.append(f"{lost} point arrays of the input are left out: the source has {len(new)} new points "
                                "and no values of these arrays.")
    return Segments(points, joined, np.ascontiguousarray(pairs, np.int64), (first + cells).astype(np.int64), begin,
                    warnings)


def _read_source(source: Any, count: int, has_own_points: bool) -> tuple[Any, ...]:
    """Returns lines, polygons, and the source's own points and values, whose ids follow the input's."""
    from ._vtk import cell_lists, point_arrays, xyz_of

    lines, polygons = cell_lists(source.GetLines()), cell_lists(source.GetPolys())
    if not has_own_points or source.GetNumberOfPoints() == 0:
        return lines, polygons, np.zeros((0, 3)), {}
    shifted = [[ids + count for ids in cells] for cells in (lines, polygons)]
    return (*shifted, np.ascontiguousarray(xyz_of(source)), point_arrays(source))


def edges_of(lines: Any, polygons: Any) -> tuple[np.ndarray, np.ndarray, int]:
    """Returns the edges of lines and closed polygons, each edge's cell, and the index of the first polygon's edge."""
    parts = [np.column_stack([ids[:-1], ids[1:]]) for ids in lines]
    begin = sum(len(part) for part in parts)
    parts += [np.column_stack([ids, np.roll(ids, -1)]) for ids in polygons]
    cells = np.repeat(np.arange(len(parts)), [len(part) for part in parts])
    return np.concatenate([np.zeros((0, 2), np.int64), *parts]).astype(np.int64), cells, begin


def with_crossings(points: np.ndarray, crossings: np.ndarray) -> np.ndarray:
    """Appends the crossings to the points, in double precision: x and y are exact, z is interpolated."""
    result = interpolated(points.astype(np.float64), crossings)
    result[len(points):, :2] = crossings[:, :2]
    return result


def interpolated(values: np.ndarray, crossings: np.ndarray) -> np.ndarray:
    """Appends the values at crossings, interpolated linearly between the two points on either side of each crossing."""
    return _core.interpolate(np.ascontiguousarray(values), crossings).reshape(-1, *values.shape[1:])
