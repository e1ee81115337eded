# SPDX-License-Identifier: BSD-3-Clause
"""Values at new corners of constraints: those of the surface of the points, without the constraints."""
from __future__ import annotations

import warnings
from typing import Any, Mapping

import numpy as np

from ._arrays import in_space, Mesh

# Ids are not interpolated, and marks of ghosts are not values.
_NOT_VALUES = ("GlobalPointIds", "vtkGhostType", "vtkOriginalPointIds", "RepresentativePointId")
_OPTIONS = {"tolerance": 0.0, "max_edge": 0.0, "partitions": (0, 0), "schedule": 1}


def completed(points: np.ndarray, data: Mapping[str, np.ndarray], corners: np.ndarray,
              threads: int) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Returns (k, 3) corners with a height for each NaN, and the values of arrays at the corners.

    Outside of the surface they are those of the nearest location on it.
    """
    values = {name: array for name, array in data.items() if name not in _NOT_VALUES}
    missing = np.isnan(corners[:, 2])
    has_heights = points.shape[1] == 3
    if len(corners) == 0 or len(points) == 0 or not (values or (missing.any() and has_heights)):
        return np.where(np.isnan(corners), 0, corners), {}
    ids, weights = _located(points, corners[:, :2], threads)
    heights = _interpolated(points[:, 2], ids, weights) if has_heights else np.zeros(len(corners))
    result = corners.copy()
    result[missing, 2] = heights[missing]
    return result, {name: _interpolated(array, ids, weights) for name, array in values.items()}


def _located(points: np.ndarray, xy: np.ndarray, threads: int) -> tuple[np.ndarray, np.ndarray]:
    """Returns the (k, 3) ids of the points whose values count at each position, and their weights; the largest is the
    first."""
    from . import _engine

    finite = np.flatnonzero(np.isfinite(points[:, :2]).all(axis=1))
    used = points if len(finite) == len(points) else points[finite]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)  # of points on one line, which the caller's run gives, too
        triangles = _engine.delaunay(used, {**_OPTIONS, "threads": threads}, None)
    if len(triangles) == 0:
        return _nearest(points, finite, xy)
    mesh = _engine.open_mesh(Mesh(in_space(used), triangles), {"memory": 1, "step": 0, "threads": threads})
    asked = in_space(xy)
    cells, weights = mesh.locate(asked)
    cells, weights = np.array(cells), np.array(weights)
    outside = np.flatnonzero((cells < 0) & np.isfinite(xy).all(axis=1))
    if len(outside):
        near, at, _ = mesh.closest(asked[outside])
        cells[outside] = near
        weights[outside] = _weights(used[:, :2].astype(np.float64)[triangles[near]], np.asarray(at)[:, :2])
    order = np.argsort(-weights, axis=1, kind="stable")
    return finite[np.take_along_axis(triangles[cells], order, axis=1)], np.take_along_axis(weights, order, axis=1)


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
