# SPDX-License-Identifier: BSD-3-Clause
"""Checks the constraints of delaunay_2d() and converts them to lists of point ids."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Iterable, Iterator, NamedTuple

import numpy as np

from . import _arguments as check
from ._arrays import converted, in_space

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


class Constraints(NamedTuple):
    """Lines and polygons as point ids. Ids from the number of points on refer to additional corners."""

    lines: list[np.ndarray]
    polygons: list[np.ndarray]
    corners: np.ndarray
    """(k, 3) coordinates"""


def constraints_of(
    count: int,
    edge_source: Any,
    edges: ArrayLike | None,
    polygons: Iterable[Any] | None,
) -> Constraints | None:
    """Combines the constraints of all arguments, for `count` points. Returns None if there are none."""
    if edge_source is not None:
        if edges is not None or polygons is not None:
            raise ValueError("edge_source cannot be combined with edges and polygons; give one or the others.")
        check.data_object(edge_source, "edge_source", ("vtkPolyData",), "a vtkPolyData")
        return None
    if edges is None and polygons is None:
        return None
    lines = [] if edges is None else _edges(edges, count)
    by_id: list[np.ndarray] = []
    by_position: list[np.ndarray] = []
    for number, polygon in enumerate([] if polygons is None else _polygons(polygons)):
        name = f"polygons[{number}]"
        rings = list(_rings(polygon)) if hasattr(polygon, "geom_type") else [polygon]
        for ring in rings:
            array = converted(ring, name)
            if array.ndim == 1 and array.dtype.kind in "iu":
                _require_ids(array, count, name)
                by_id.append(array)
            elif array.ndim == 2 and array.shape[1] in (2, 3) and array.dtype.kind in "fiu":
                by_position.append(in_space(array.astype(np.float64)))
            else:
                raise ValueError(f"{name} has the shape {array.shape} and type {array.dtype}; give point ids, or "
                                 "coordinates of shape (k, 2) or (k, 3).")
    starts = np.cumsum([count, *(len(corners) for corners in by_position)])
    by_id += [np.arange(first, first + len(corners)) for first, corners in zip(starts, by_position)]
    return Constraints(lines, by_id, np.concatenate([np.zeros((0, 3)), *by_position]))


def rings_of(polygons: Any) -> Iterator[Any]:
    """Yields the rings of a list of polygons (arrays or Shapely polygons), or of a single Shapely polygon."""
    for polygon in _polygons(polygons):
        yield from _rings(polygon) if hasattr(polygon, "geom_type") else [polygon]


def _polygons(polygons: Any) -> Iterable[Any]:
    if hasattr(polygons, "geom_type"):
        return [polygons]
    if isinstance(polygons, (str, bytes)) or not isinstance(polygons, Iterable):
        raise TypeError("polygons is not a list; give a list of polygons.")
    return polygons


def _require_ids(ids: np.ndarray, count: int, name: str) -> None:
    wrong = ids[(ids < 0) | (ids >= count)]
    if wrong.size > 0:
        raise ValueError(f"{name}: there is no point {wrong.flat[0]}, because there are {count} points; ids count from 0.")


def _edges(edges: ArrayLike, count: int) -> list[np.ndarray]:
    array = converted(edges, "edges")
    if array.ndim != 2 or array.shape[1] != 2 or array.dtype.kind not in "iu":
        raise ValueError(f"edges have the shape {array.shape} and type {array.dtype}; give point ids of shape (m, 2).")
    _require_ids(array, count, "edges")
    return list(array)


def _rings(polygon: Any) -> Iterator[np.ndarray]:
    """Yields the rings of a Shapely polygon: outer rings counter-clockwise, inner ones clockwise."""
    for ring, is_hole in shapely_rings(polygon, "a polygon"):
        corners = np.asarray(ring.coords)[:-1]  # the last one is the first
        yield corners if ring.is_ccw != is_hole else corners[::-1]


def shapely_rings(polygon: Any, name: str) -> Iterator[tuple[Any, bool]]:
    """Yields the rings of a Shapely polygon, and whether each is a hole."""
    if polygon.geom_type == "MultiPolygon":
        for part in polygon.geoms:
            yield from shapely_rings(part, name)
    elif polygon.geom_type != "Polygon":
        raise TypeError(f"{name} is a Shapely {polygon.geom_type}; give a Polygon or a MultiPolygon.")
    elif not polygon.is_empty:
        yield polygon.exterior, False
        for ring in polygon.interiors:
            yield ring, True
