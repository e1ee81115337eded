# SPDX-License-Identifier: BSD-3-Clause
"""Geometries as arrays: of Shapely, GeoPandas and others with `__geo_interface__`, of GeoJSON, and with `coords`.

No such library is imported.
"""
from __future__ import annotations

from typing import Any, Iterable, Iterator, Mapping, NamedTuple

import numpy as np

_PARTS = {"MultiPoint": "Point", "MultiLineString": "LineString", "MultiPolygon": "Polygon"}
_LINES = ("LineString", "LinearRing")


class Part(NamedTuple):
    """A point, a line, or a ring of a polygon."""

    kind: str
    """"Point", "LineString", "LinearRing" or "Polygon": a ring of a polygon"""
    corners: np.ndarray
    """(k, 2) or (k, 3) coordinates. A ring repeats its first corner."""
    is_hole: bool


def is_geometry(value: Any) -> bool:
    return _mapping(value) is not None or (hasattr(value, "coords") and not hasattr(value, "dims"))  # xarray has both


def _mapping(value: Any) -> Mapping[str, Any] | None:
    """Returns a geometry as GeoJSON has it, or None if the value is none."""
    if isinstance(value, Mapping):
        return value if "type" in value else None
    interface = getattr(value, "__geo_interface__", None)
    return interface if isinstance(interface, Mapping) else None


def items_of(values: Any, name: str) -> list[Any]:
    """Returns the items of a list, of a GeoSeries or of a GeoDataFrame. A single geometry is a list of one."""
    geometry = getattr(values, "geometry", values)  # a GeoDataFrame's column
    mapping = _mapping(geometry)
    if mapping is not None and mapping["type"] == "FeatureCollection":
        return [feature["geometry"] for feature in mapping["features"]]
    if is_geometry(geometry):
        return [geometry]
    if isinstance(geometry, (str, bytes, Mapping)) or not isinstance(geometry, Iterable):
        raise TypeError(f"{name} is not a list; give a list of geometries or of arrays.")
    return list(geometry)


def parts_of(geometry: Any, name: str) -> Iterator[Part]:
    """Yields the parts of a geometry. None and empty geometries have none."""
    mapping = _mapping(geometry)
    if geometry is None:
        return
    if mapping is None:
        yield Part("LineString", _corners(geometry.coords, name), False)
        return
    kind = mapping["type"]
    if kind == "Feature":
        yield from parts_of(mapping["geometry"], name)
    elif kind in ("FeatureCollection", "GeometryCollection"):
        for part in mapping["features" if kind == "FeatureCollection" else "geometries"]:
            yield from parts_of(part, name)
    elif kind in _PARTS:
        for coordinates in mapping["coordinates"]:
            yield from parts_of({"type": _PARTS[kind], "coordinates": coordinates}, name)
    elif not len(mapping.get("coordinates", ())):
        return
    elif kind == "Polygon":
        for number, ring in enumerate(mapping["coordinates"]):
            yield Part(kind, _corners(ring, name), number > 0)
    elif kind in _LINES:
        yield Part(kind, _corners(mapping["coordinates"], name), False)
    elif kind == "Point":
        yield Part(kind, _corners([mapping["coordinates"]], name), False)
    else:
        raise TypeError(f"{name} is a {kind}; give points, lines or polygons.")


def rings_of(geometry: Any, name: str) -> Iterator[tuple[np.ndarray, bool]]:
    """Yields the rings of polygons, without the repeated corner, and whether each is a hole. A closed line is a ring."""
    for kind, corners, is_hole in parts_of(geometry, name):
        if kind == "Point" or (kind in _LINES and (len(corners) < 4 or (corners[0] != corners[-1]).any())):
            closed = " that is not closed" if kind in _LINES else ""
            raise TypeError(f"{name} is a {kind}{closed}; give a Polygon or a MultiPolygon.")
        yield corners[:-1] if (corners[0] == corners[-1]).all() else corners, is_hole


def oriented_rings_of(geometry: Any, name: str) -> Iterator[np.ndarray]:
    """Yields the rings of polygons: outer rings counter-clockwise, holes clockwise."""
    for corners, is_hole in rings_of(geometry, name):
        yield corners if (_area(corners) > 0) != is_hole else corners[::-1]


def lines_of(geometry: Any, name: str) -> Iterator[np.ndarray]:
    """Yields the corners of lines, and of the rings of polygons, which repeat their first corner."""
    for kind, corners, _ in parts_of(geometry, name):
        if kind == "Point":
            raise TypeError(f"{name} is a Point; give lines or polygons.")
        yield corners


def points_of(values: Any, name: str) -> np.ndarray:
    """Returns the coordinates of points, such as those of a GeoSeries."""
    corners = []
    for item in items_of(values, name):
        for kind, at, _ in parts_of(item, name):
            if kind != "Point":
                raise TypeError(f"{name} has a {kind}; give points.")
            corners.append(at)
    if len({at.shape[1] for at in corners}) > 1:
        raise ValueError(f"{name} have a z at some points only; give it at all or at none.")
    return np.concatenate(corners) if corners else np.zeros((0, 2))


def _area(corners: np.ndarray) -> float:
    x, y = (corners[:, :2] - corners[0, :2]).T  # differences, because coordinates are large
    return float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))


def _corners(coordinates: Any, name: str) -> np.ndarray:
    try:
        corners = np.array([tuple(corner) for corner in coordinates], np.float64)
    except (TypeError, ValueError):
        corners = np.zeros(0)
    if corners.ndim != 2 or corners.shape[1] not in (2, 3):
        raise ValueError(f"{name} has corners that are not all (x, y) or all (x, y, z).")
    return corners
