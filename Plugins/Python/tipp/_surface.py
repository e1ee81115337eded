# SPDX-License-Identifier: BSD-3-Clause
"""Values at new corners of constraints: those of the surface of the points, without the constraints."""
from __future__ import annotations

import warnings
from typing import Any, Callable, Mapping

import numpy as np

from ._arrays import in_space
from ._data import Mesh

# Ids are not interpolated, and marks of ghosts are not values.
_NOT_VALUES = ("GlobalPointIds", "vtkGhostType", "vtkOriginalPointIds", "RepresentativePointId")
_HEIGHT = "\0"  # the key of the points' z, which is no name of an array
_OPTIONS = {"tolerance": 0.0, "max_edge": 0.0, "partitions": (0, 0), "schedule": 1}


def completed(points: np.ndarray, data: Mapping[str, np.ndarray], corners: np.ndarray,
              threads: int) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Returns (k, 3) corners with a height for each NaN, and the values of arrays at the corners. `points` are (n, 3).

    Outside of the surface they are those of the nearest location on it.
    """
    from . import _engine

    values = _values_in(data)
    missing = np.isnan(corners[:, 2])
    first = points[0, 2] if len(points) else 0.0
    is_flat = not missing.any() or bool((points[:, 2] == first).all())
    result = corners.copy()
    if is_flat and not (len(corners) and len(points) and values):  # nothing to locate
        result[missing, 2] = first
        return result, {}
    finite = np.flatnonzero(np.isfinite(points[:, :2]).all(axis=1))
    used = points if len(finite) == len(points) else points[finite]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)  # of points on one line, which the caller's run gives, too
        triangles = _engine.delaunay(used, {**_OPTIONS, "threads": threads}, None)
    if len(triangles):
        ids, weights, _ = _located(used, triangles, corners[:, :2], threads)
        ids = finite[ids]
    else:
        ids, weights = _nearest(points, finite, corners[:, :2])
    result[missing, 2] = _interpolated(points[:, 2], ids, weights)[missing]
    return result, {name: _interpolated(array, ids, weights) for name, array in values.items()}


def completed_on_ranks(ranks: Any, corners: np.ndarray, piece_of: Callable[[], Mesh],
                       threads: int) -> tuple[np.ndarray, dict[str, np.ndarray], bool]:
    """Does the same for the corners of each rank and the points of all ranks; also returns whether there are corners on
    any rank. `piece_of` returns this rank's piece of the points' triangulation. Collective."""
    every = ranks.allgather(corners)
    asked = np.concatenate(every)
    before = sum(len(others) for others in every[: ranks.Get_rank()])
    own = slice(before, before + len(corners))
    if len(asked) == 0:
        return corners, {}, False
    piece = piece_of()
    distances, found = np.full(len(asked), np.inf), {}
    if len(piece.cells):
        ids, weights, distances = _located(piece.points, piece.cells, asked[:, :2], threads)
        columns = {**_values_in(piece.point_data), _HEIGHT: piece.points[:, 2].astype(np.float64)}
        found = {name: _interpolated(array, ids, weights) for name, array in columns.items()}
    everyone = [one for one in ranks.allgather((distances, found)) if one[1]]
    result, missing = corners.copy(), np.isnan(corners[:, 2])
    if not everyone:
        return np.where(np.isnan(result), 0, result), {}, True
    nearest = np.argmin([one[0] for one in everyone], axis=0)[own]
    names = [name for name in everyone[0][1] if all(name in one[1] for one in everyone)]
    values = {name: np.array([one[1][name][own] for one in everyone])[nearest, np.arange(len(corners))] for name in names}
    result[missing, 2] = values.pop(_HEIGHT)[missing]
    return result, values, True


def _values_in(data: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    return {name: array for name, array in data.items() if name not in _NOT_VALUES}


def _located(points: np.ndarray, triangles: np.ndarray, xy: np.ndarray,
             threads: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Returns the (k, 3) ids of the points whose values count at each position, their weights, and the distances to the
    surface. The largest weight is the first; the order depends only on coordinates."""
    from . import _engine

    mesh = _engine.open_part(Mesh(points, triangles), threads)
    asked = in_space(xy)
    cells, weights = (np.array(values) for values in mesh.locate(asked))
    distances = np.zeros(len(xy))
    outside = np.flatnonzero((cells < 0) & np.isfinite(xy).all(axis=1))
    if len(outside):
        cells[outside], at, distances[outside] = mesh.closest(asked[outside])
        corners = points[:, :2].astype(np.float64)[triangles[cells[outside]]]
        weights[outside] = _weights(corners, np.asarray(at)[:, :2])
    ids = triangles[cells]
    order = np.lexsort((points[ids, 1], points[ids, 0], -weights), axis=1)
    return np.take_along_axis(ids, order, axis=1), np.take_along_axis(weights, order, axis=1), distances


def _weights(corners: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """Returns the barycentric coordinates of positions on the borders of triangles."""
    a, b, c = (corners[:, i] - xy for i in range(3))
    areas = np.abs(np.column_stack([_cross(b, c), _cross(c, a), _cross(a, b)]))
    areas[areas < 1e-12 * areas.max(axis=1, keepdims=True)] = 0  # the corner opposite to the border
    return areas / areas.sum(axis=1, keepdims=True)


def _cross(a: np.ndarray, b: np.ndarray) -> Any:
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]


def _nearest(points: np.ndarray, finite: np.ndarray, xy: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns the nearest point of each position, for points that have no triangles."""
    ids = np.zeros((len(xy), 3), np.int64)
    for i, position in enumerate(xy if len(finite) else xy[:0]):
        ids[i] = finite[np.argmin(((points[finite, :2] - position) ** 2).sum(axis=1))]
    return ids, np.tile([1.0, 0.0, 0.0], (len(xy), 1))


def _interpolated(array: np.ndarray, ids: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Interpolates linearly; integers are rounded."""
    corners = array[ids].astype(np.float64)
    shares = weights.reshape(*weights.shape, *[1] * (array.ndim - 1))
    # The differences to the first corner, which has the largest weight, keep a constant exactly.
    others = np.where(shares[:, 1:] == 0, 0, corners[:, 1:] - corners[:, :1]) * shares[:, 1:]
    result = corners[:, 0] + others.sum(axis=1)
    if array.dtype.kind != "f":
        limits = np.iinfo(array.dtype)
        result = np.clip(np.trunc(result + np.copysign(0.5, result)), limits.min, limits.max)
    return result.astype(array.dtype)
