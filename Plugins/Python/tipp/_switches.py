# SPDX-License-Identifier: BSD-3-Clause
"""tipp.triangulate: the function, the dictionaries and the switches of the package triangle."""
from __future__ import annotations

import math
import re
from typing import Any, Mapping, NamedTuple

import numpy as np

from . import _arguments as check
from . import _engine
from ._arrays import converted, in_space
from ._data import Mesh
from ._mesh import angle_of, positive

_KEYS = ("vertices", "vertex_attributes", "vertex_markers", "segments", "segment_markers", "holes", "regions", "triangles",
         "triangle_max_area")
_NUMBER = r"((?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?|\.?)"  # 'a1e' has the switch e, as it has no exponent
_SWITCH = re.compile(rf"q{_NUMBER}|a{_NUMBER}|S([0-9]*)|.", re.DOTALL)
_WITHOUT_EFFECT = "QVziFl"  # output on the terminal, ids from 0, and the choice of an algorithm
_ANGLE = 20.0  # of q without a number, as in Triangle


class _Switches(NamedTuple):
    letters: frozenset[str]
    keeps_segments: bool
    """YY"""
    min_angle: float
    max_area: float
    uses_areas: bool
    """A bare a: the areas of regions or triangles are limits, too."""
    most_points: int | None


class _Input(NamedTuple):
    """The arrays of a dictionary; those that it lacks are empty."""

    vertices: np.ndarray
    attributes: np.ndarray | None
    markers: np.ndarray
    """(n,)"""
    segments: np.ndarray
    segment_markers: np.ndarray
    holes: np.ndarray
    regions: np.ndarray
    triangles: np.ndarray
    areas: np.ndarray
    """The largest area of each triangle; 0 or less: no limit."""


def triangulate(tri: Mapping[str, Any], opts: str = "", *, threads: int = 0) -> dict[str, np.ndarray]:
    """Computes a triangulation or a mesh, with the dictionaries and switches of triangle.triangulate().

    Users of the package triangle only change the import. The meshes meet the same bounds, but have other points.

    Parameters
    ----------
    tri
        A dictionary with some of these arrays: vertices (n, 2); vertex_attributes (n, k) and vertex_markers (n, 1);
        segments (m, 2), ids of their ends from 0, and segment_markers (m, 1); holes (h, 2), a point in each; regions
        (r, 4): a point, an attribute and the largest area, below 0 for no limit; triangles (t, 3) and triangle_max_area
        (t, 1).
    opts
        Triangle's switches. p: segments, holes and regions are used. q, q30: no angle is below 20 or 30 degrees, at most
        34. a0.1, a1e-5: no triangle is larger; a: the areas of regions or, with r, those of triangle_max_area are used; both
        may be given, as in a0.1a. c: the domain is the convex hull. r: the domain is that of the given triangles, and with p also their segments are kept.
        A: triangles get the attribute of their region, or 0. e, n: the result has edges or neighbors. j: vertices of no
        triangle are left out. Y, YY: no points are added on the border, or on any segment. S100: refinement adds at most
        100 points. Q, V, z, i, F and l have no effect on the result. Others, such as D, are not supported.
    threads
        Number of threads; 0: OMP_NUM_THREADS, or one per processor. The result does not depend on it.

    Returns
    -------
    dict
        vertices, those given first; vertex_attributes, if given, linear at new vertices; vertex_markers; triangles,
        counter-clockwise; triangle_attributes with A; neighbors with n; segments and segment_markers with p or c; holes
        and regions with p, if given; edges and edge_markers with e. Ids and markers are int32. Markers are 0 inside,
        those of segments on these, and 1 on the border where none is given. Edges on segments have their markers.

    Raises
    ------
    TypeError, ValueError
        If the dictionary or the switches are wrong, or not supported; also if the triangles for r overlap.
    RuntimeError
        If it failed, for example for a region's point outside of the domain.

    Notes
    -----
    With r, the domain is triangulated again by the exact constrained Delaunay triangulation of all vertices: a mesh that
    is not such a triangulation loses its edges, except those on the border and those that are segments.

    Examples
    --------
    >>> square = {"vertices": [[0, 0], [1, 0], [1, 1], [0, 1]], "segments": [[0, 1], [1, 2], [2, 3], [3, 0]]}
    >>> tipp.triangulate(square, "pq30a0.01")["triangles"].shape[1]
    3
    """
    switches = _switches_of(check.text(opts, "opts"))
    given = _input_of(tri)
    is_segmented, is_remade = "p" in switches.letters, "r" in switches.letters
    if is_remade and len(given.triangles) == 0:
        raise ValueError("opts has the switch r, but tri has no key 'triangles'; give the mesh to refine.")
    lines = list(given.segments) if is_segmented else []
    if is_remade:
        _require_manifold(given.triangles)
    rings = _rings(given.triangles) if is_remade else []
    areas = given.areas if is_remade and switches.uses_areas else np.zeros(0)
    attributes = {} if given.attributes is None else {"attributes": given.attributes}
    regions = given.regions if is_segmented else np.zeros((0, 4))
    found = _engine.mesh(
        in_space(given.vertices), attributes, lines, rings,
        {**_options(switches, regions if switches.uses_areas or "A" in switches.letters else regions[:0]),
         "holes": [tuple(hole) for hole in given.holes.tolist()] if is_segmented and not is_remade else [],
         "convex": not is_remade and ("c" in switches.letters or not is_segmented), "threads": check.threads(threads)},
        _area_surface(given.vertices, given.triangles, areas), None)
    if is_remade:
        _require_apart(given, found)
    return _result(found, given, switches, lines)


def _switches_of(opts: str) -> _Switches:
    letters, angle, area, uses_areas, most, borders = set(), 0.0, math.inf, False, None, 0
    for match in _SWITCH.finditer(opts):
        letter = match[0][0]
        if letter not in "pqacrAenjYS" + _WITHOUT_EFFECT:
            advice = {"D": "meshes are constrained Delaunay; a smaller area splits segments, too", "C": "tipp.check() proves a triangulation",
                      "X": "the arithmetic is always exact"}.get(letter, "leave it out")
            raise ValueError(f"opts has the switch '{letter}', which is not supported: {advice}.")
        letters.add(letter)
        borders += letter == "Y"
        if letter == "q":
            angle = angle_of(_number(match[1], match[0]), "opts: the angle of q") if match[1] else _ANGLE
        elif letter == "a" and match[2]:
            area = positive(_number(match[2], match[0]), "opts: the area of a")
        elif letter == "a":
            uses_areas = True
        elif letter == "S":
            most = int(match[3] or 0)
    return _Switches(frozenset(letters), borders > 1, angle, area, uses_areas, most)


def _number(text: str, switch: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise ValueError(f"opts has the switch '{switch}' without a number; write, for example, q30 or a0.1.") from None


def _input_of(tri: Any) -> _Input:
    if not isinstance(tri, Mapping):
        raise TypeError(f"tri is {check.shown(tri)}; give a dictionary with the key 'vertices'.")
    unknown = [key for key in tri if key not in _KEYS]
    if unknown:
        raise ValueError(f"tri has the key {unknown[0]!r}, which is not supported; leave it out. The keys are "
                         f"{', '.join(_KEYS)}.")
    if "vertices" not in tri:
        raise ValueError("tri has no key 'vertices'; give an array of shape (n, 2).")
    vertices = _array(tri, "vertices", 2, np.float64)
    count = len(vertices)
    segments = _ids(tri, "segments", 2, count)
    triangles = _counter_clockwise(vertices, _ids(tri, "triangles", 3, count))
    attributes = _array(tri, "vertex_attributes", None, np.float64) if "vertex_attributes" in tri else None
    result = _Input(
        vertices, attributes, _markers(tri, "vertex_markers", count), segments,
        _markers(tri, "segment_markers", len(segments)), _array(tri, "holes", 2, np.float64),
        _array(tri, "regions", 4, np.float64), triangles, _array(tri, "triangle_max_area", 1, np.float64).ravel())
    for key, values, due in (("vertex_attributes", vertices if attributes is None else attributes, count),
                             ("triangle_max_area", result.areas, len(triangles))):
        if key in tri and len(values) != due:
            raise ValueError(f"tri['{key}'] has {len(values)} rows; give {due}.")
    for key in ("holes", "regions"):
        if not np.isfinite(getattr(result, key)).all():
            raise ValueError(f"tri['{key}'] has a number that is NaN or infinite; correct it.")
    return result


def _array(tri: Mapping[str, Any], key: str, columns: int | None, kind: Any) -> np.ndarray:
    """Returns an array with this number of columns; without the key, or if it has no values, one without rows."""
    array = converted(tri.get(key, ()), f"tri['{key}']")
    if array.size == 0:
        return np.zeros((0, columns or 1), kind)
    if array.ndim == 1 and columns in (1, None):
        array = array[:, np.newaxis]
    if array.ndim != 2 or columns is not None and array.shape[1] != columns:
        raise ValueError(f"tri['{key}'] has the shape {array.shape}; give an array of shape (n, {columns or 'k'}).")
    if np.dtype(kind).kind == "i" and array.dtype.kind not in "iu":
        raise TypeError(f"tri['{key}'] is of type {array.dtype}; give integers.")
    return np.ascontiguousarray(array, kind)


def _ids(tri: Mapping[str, Any], key: str, columns: int, count: int) -> np.ndarray:
    ids = _array(tri, key, columns, np.int64)
    wrong = ids[(ids < 0) | (ids >= count)]
    if len(wrong):
        raise ValueError(f"tri['{key}']: there is no vertex {wrong[0]}, because there are {count} vertices; ids count from 0.")
    return ids


def _counter_clockwise(vertices: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    a, b, c = (vertices[corner] for corner in triangles.T)
    (px, py), (qx, qy) = (b - a).T, (c - a).T
    return np.where((px * qy < py * qx)[:, np.newaxis], triangles[:, ::-1], triangles)


def _markers(tri: Mapping[str, Any], key: str, count: int) -> np.ndarray:
    if key not in tri:
        return np.zeros(count, np.int32)
    markers = _array(tri, key, 1, np.int64).ravel()
    if len(markers) != count:
        raise ValueError(f"tri['{key}'] has {len(markers)} rows; give {count}.")
    limits = np.iinfo(np.int32)
    if len(markers) and not limits.min <= markers.min() <= markers.max() <= limits.max:
        raise ValueError(f"tri['{key}'] has a marker that does not fit 32 bits; give smaller ones.")
    return markers.astype(np.int32)


def _options(switches: _Switches, regions: np.ndarray) -> dict[str, Any]:
    """Returns the engine's options but for holes, convex and threads."""
    refines = switches.most_points != 0
    return {
        "min_angle": switches.min_angle if refines else 0.0, "max_area": switches.max_area if refines else math.inf,
        "regions": [(x, y, area if switches.uses_areas and refines and area > 0 else math.inf)
                    for x, y, _, area in regions.tolist()],
        "keep_border": "Y" in switches.letters, "keep_segments": switches.keeps_segments, "shortest_edge": 0.0,
        "most_points": switches.most_points or 0, "smooth": 0, "memory": 0, "scratch": "", "crossings": 1, "marks": 1, "lengths": None,
    }


def _require_manifold(triangles: np.ndarray) -> None:
    """Requires that at most two triangles have an edge, one on each of its sides."""
    sides = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2).reshape(-1, 2)
    same = np.flatnonzero(sides[:, 0] == sides[:, 1])
    if len(same):
        raise ValueError(f"tri['triangles']: triangle {same[0] // 3} has the vertex {sides[same[0], 0]} twice; remove the "
                         "triangle.")
    _, first, inverse = np.unique(sides[:, 0] + 1j * sides[:, 1], return_index=True, return_inverse=True)
    again = np.flatnonzero(first[inverse.reshape(-1)] != np.arange(len(sides)))
    if len(again):
        other = first[inverse.reshape(-1)[again[0]]]
        raise ValueError(f"tri['triangles']: the triangles {other // 3} and {again[0] // 3} lie on the same side of the edge "
                         f"between vertices {sides[other, 0]} and {sides[other, 1]}; give a mesh whose triangles do not "
                         "overlap.")


def _require_apart(given: _Input, found: Mesh) -> None:
    """Requires that the triangles given do not overlap: then they cover as much as the mesh does."""
    def covered(points: np.ndarray, triangles: np.ndarray) -> tuple[float, float]:
        """Returns the area, and a bound of its terms."""
        a, b, c = (points[corner].astype(np.float64) for corner in triangles.T)
        (px, py), (qx, qy) = (b - a).T[:2], (c - a).T[:2]
        return math.fsum((px * qy - py * qx) / 2), math.fsum(np.abs(px * qy) + np.abs(py * qx))

    (asked, terms), (made, _) = covered(given.vertices, given.triangles), covered(found.points, found.cells)
    sides = given.vertices[given.triangles] - given.vertices[np.roll(given.triangles, -1, axis=1)]
    # Products are rounded, and so are points added on the border.
    error = 2.0**-48 * (terms + np.abs(given.vertices[given.triangles]).max() * np.abs(sides).sum())
    if abs(asked - made) > error:
        raise ValueError(f"tri['triangles'] have an area of {asked:.6g} in all, but cover {made:.6g}; give a mesh whose "
                         "triangles do not overlap.")


def _rings(triangles: np.ndarray) -> list[np.ndarray]:
    """Returns the border of counter-clockwise triangles as closed chains of vertices, with the triangles on their
    left."""
    following: dict[int, list[int]] = {}
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    known = {*map(tuple, edges.tolist())}
    for start, end in edges.tolist():
        if (end, start) not in known:
            following.setdefault(start, []).append(end)
    rings = []
    for start, ends in following.items():
        while ends:
            ring = [start]
            while (vertex := following[ring[-1]].pop()) != start:
                ring.append(vertex)
            rings.append(np.array(ring))
    return rings


def _area_surface(vertices: np.ndarray, triangles: np.ndarray, areas: np.ndarray) -> Mesh | None:
    """Returns a surface whose "size" in each triangle is the side of the equilateral triangle with its largest area."""
    limited = np.flatnonzero(areas > 0)
    if len(limited) == 0:
        return None
    corners = np.arange(3 * len(limited), dtype=np.int32).reshape(-1, 3)
    sides = np.repeat(np.sqrt(areas[limited] * 4 / math.sqrt(3)), 3)
    return Mesh(vertices[triangles[limited].ravel()], corners, {"size": sides})


class _Edges(NamedTuple):
    """The edges of triangles, each once."""

    ends: np.ndarray
    """(k, 2), the lower id first"""
    of_triangles: np.ndarray
    """(m, 3) index of the edge opposite to each corner"""
    is_border: np.ndarray


def _edges_of(triangles: np.ndarray, count: int) -> _Edges:
    sides = np.sort(np.stack([triangles[:, [1, 2]], triangles[:, [2, 0]], triangles[:, [0, 1]]], axis=1), axis=2)
    keys, of_triangles = np.unique(sides[:, :, 0].astype(np.int64) * max(count, 1) + sides[:, :, 1], return_inverse=True)
    of_triangles = of_triangles.reshape(-1, 3)
    sharing = np.bincount(of_triangles.ravel(), minlength=len(keys))
    return _Edges(np.column_stack(np.divmod(keys, max(count, 1))), of_triangles, sharing == 1)


def _neighbors(edges: _Edges) -> np.ndarray:
    """Returns the triangle across the edge opposite to each corner, or -1."""
    slots = np.argsort(edges.of_triangles, axis=None, kind="stable")
    numbers = edges.of_triangles.ravel()[slots]
    first = np.flatnonzero(numbers[1:] == numbers[:-1])
    result = np.full(edges.of_triangles.size, -1, np.int32)
    result[slots[first]], result[slots[first + 1]] = slots[first + 1] // 3, slots[first] // 3
    return result.reshape(-1, 3)


def _result(found: Mesh, given: _Input, switches: _Switches, lines: list[np.ndarray]) -> dict[str, np.ndarray]:
    """Returns the dictionary for a mesh whose lines are the segments."""
    letters, count = switches.letters, len(found.points)
    edges = _edges_of(found.cells, count)
    segments, numbers = np.zeros((0, 2), np.int32), np.zeros(0, np.int64)
    if found.lines is not None and "ConstraintId" in found.line_data:  # VTK has none if there are none
        segments, numbers = found.lines, found.line_data["ConstraintId"]
    of_segments = np.append(given.segment_markers, 0)[np.where(numbers < len(lines), numbers, -1)]
    ends = np.sort(segments, axis=1).astype(np.int64)
    known = np.searchsorted(edges.ends[:, 0] * count + edges.ends[:, 1], ends[:, 0] * count + ends[:, 1])
    markers = np.zeros(count, np.int32)
    markers[: len(given.markers)] = given.markers
    border = edges.ends[edges.is_border].ravel()
    for ids, values in ((segments.ravel(), np.repeat(of_segments, 2)), (border, np.ones(len(border), np.int32))):
        wanted = np.flatnonzero((markers[ids] == 0) & (values != 0))[::-1]  # the first one is assigned last
        markers[ids[wanted]] = values[wanted]
    of_segments = np.where((of_segments == 0) & edges.is_border[known], 1, of_segments).astype(np.int32)
    of_edges = edges.is_border.astype(np.int32)
    of_edges[known] = of_segments

    result: dict[str, np.ndarray] = {"vertices": np.ascontiguousarray(found.points[:, :2], np.float64)}
    if given.attributes is not None:
        result["vertex_attributes"] = found.point_data["attributes"].reshape(count, -1)
    result["vertex_markers"] = markers[:, np.newaxis]
    result["triangles"] = found.cells.astype(np.int32, copy=False)
    if "A" in letters and "Region" in found.cell_data:
        result["triangle_attributes"] = np.append(given.regions[:, 2], 0.0)[found.cell_data["Region"]][:, np.newaxis]
    if "n" in letters:
        result["neighbors"] = _neighbors(edges)
    if letters & {"p", "c"}:
        result["segments"], result["segment_markers"] = segments.astype(np.int32, copy=False), of_segments[:, np.newaxis]
    if "p" in letters:
        result.update({key: getattr(given, key) for key in ("holes", "regions") if len(getattr(given, key))})
    if "e" in letters:
        result["edges"], result["edge_markers"] = edges.ends.astype(np.int32), of_edges[:, np.newaxis]
    return _without_unused(result) if "j" in letters else result


def _without_unused(result: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Returns the arrays without the vertices of no triangle."""
    used = np.unique(result["triangles"])
    numbers = np.full(len(result["vertices"]), -1, np.int32)
    numbers[used] = np.arange(len(used), dtype=np.int32)
    kept = {**result}  # in the same order
    for key in ("vertices", "vertex_attributes", "vertex_markers"):
        if key in kept:
            kept[key] = kept[key][used]
    for key in ("triangles", "segments", "edges"):
        if key in kept:
            kept[key] = numbers[kept[key]]
    return kept
