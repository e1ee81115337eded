# SPDX-License-Identifier: BSD-3-Clause
"""Checks the constraints of delaunay_2d() and converts them to lists of point ids."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Iterable, Mapping, NamedTuple

import numpy as np

from . import _arguments as check
from ._arrays import columns_of, converted
from ._geometry import is_geometry, items_of, lines_of, oriented_rings_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


class Constraints(NamedTuple):
    """Lines and polygons as point ids. Ids from the number of points on refer to additional corners."""

    lines: list[np.ndarray]
    polygons: list[np.ndarray]
    corners: np.ndarray
    """(k, 3) coordinates. z is NaN where it is to be that of the surface of the points."""


class _Builder:
    """Numbers the corners that are given by position after `count` points."""

    def __init__(self, count: int) -> None:
        self.count = count
        self.lines: list[np.ndarray] = []
        self.polygons: list[np.ndarray] = []
        self._corners = [np.zeros((0, 3))]
        self._next = count

    def add(self, values: Any, name: str, lists: list[np.ndarray]) -> None:
        """Appends a line or polygon, given by ids or by coordinates, to one of the lists."""
        array = converted(columns_of(values, name), name)
        if array.ndim == 1 and array.dtype.kind in "iu":
            self.require_ids(array, name)
            lists.append(array)
        elif array.ndim == 2 and array.shape[1] in (2, 3) and array.dtype.kind in "fiu":
            self._corners.append(with_height(array))
            lists.append(np.arange(self._next, self._next + len(array)))
            self._next += len(array)
        else:
            raise ValueError(f"{name} has the shape {array.shape} and type {array.dtype}; give point ids, or "
                             "coordinates of shape (k, 2) or (k, 3).")

    def require_ids(self, ids: np.ndarray, name: str) -> None:
        wrong = ids[(ids < 0) | (ids >= self.count)]
        if wrong.size > 0:
            raise ValueError(f"{name}: there is no point {wrong.flat[0]}, because there are {self.count} points; "
                             "ids count from 0.")

    def corners(self) -> np.ndarray:
        corners = np.concatenate(self._corners)
        given = corners[~np.isnan(corners[:, 2]), 2]
        if not given.any():  # lines without heights often have z = 0
            corners[:, 2] = np.nan
        return corners


def with_height(array: np.ndarray) -> np.ndarray:
    """Returns (k, 2) or (k, 3) coordinates as (k, 3) doubles; a missing z is NaN."""
    corners = np.full((len(array), 3), np.nan)
    corners[:, : array.shape[1]] = array
    return corners


def constraints_of(
    count: int,
    edge_source: Any,
    edges: Any,
    polygons: Iterable[Any] | None,
    edges_name: str = "edges",
) -> Constraints | None:
    """Combines the constraints of all arguments, for `count` points. Returns None if there are none. `edges_name` is the
    name of the argument `edges`, for messages."""
    if edge_source is not None:
        if edges is not None or polygons is not None:
            raise ValueError("edge_source cannot be combined with edges and polygons; give one or the others.")
        check.data_object(edge_source, "edge_source", ("vtkPolyData",), "a vtkPolyData")
        return None
    if edges is None and polygons is None:
        return None
    builder = _Builder(count)
    if edges is not None:
        _add_edges(edges, edges_name, builder)
    for number, polygon in enumerate([] if polygons is None else items_of(polygons, "polygons")):
        name = f"polygons[{number}]"
        for ring in oriented_rings_of(polygon, name) if polygon is None or is_geometry(polygon) else [polygon]:
            builder.add(ring, name, builder.polygons)
    return Constraints(builder.lines, builder.polygons, builder.corners())


def _add_edges(edges: ArrayLike | Any, argument: str, builder: _Builder) -> None:
    """Adds pairs of ids, or lines given by their corners."""
    are_ids = isinstance(edges, np.ndarray) and edges.ndim == 2 or isinstance(edges, (str, bytes))
    is_list = is_geometry(edges) or hasattr(edges, "geometry") or isinstance(edges, Iterable) and not isinstance(edges, Mapping)
    items = items_of(edges, argument) if is_list and not are_ids else []
    first = next((item for item in items if item is not None), None)
    if is_geometry(first) or (isinstance(first, (list, tuple, np.ndarray)) and np.ndim(first) == 2):
        for number, item in enumerate(items):
            name = f"{argument}[{number}]"
            for line in lines_of(item, name) if item is None or is_geometry(item) else [item]:
                builder.add(line, name, builder.lines)
        return
    array = converted(edges, argument)
    if array.ndim != 2 or array.shape[1] != 2 or array.dtype.kind not in "iu":
        raise ValueError(f"{argument} have the shape {array.shape} and type {array.dtype}; give point ids of shape (m, 2), or "
                         "lines.")
    builder.require_ids(array, argument)
    builder.lines.extend(array)
