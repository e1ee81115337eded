# SPDX-License-Identifier: BSD-3-Clause
"""tipp.mesh: meshes of bounded angles and sizes between lines and polygons."""
from __future__ import annotations

import math
import os
import sys
from typing import Any, Callable, Iterable, Mapping, NamedTuple, Sequence, TYPE_CHECKING, Union

import numpy as np

from . import _arguments as check
from . import _engine
from ._arguments import ProgressBar, progress_of
from ._arrays import attributes, cloud_of, converted, coordinates, in_space
from ._constraints import Constraints, constraints_of
from ._data import Mesh
from ._results import kind_of, result_of
from ._surface import completed

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

LARGEST_ANGLE = 34  # degrees; of the core
_CROSSINGS = {"split": 1, "refuse": 0}
_MARKS = {"none": 0, "lines": 1}
_SAMPLES = 512  # intervals of the lattice on which a function of sizes is evaluated, along its longer side

Size = Union[float, "ArrayLike", Callable[[np.ndarray, np.ndarray], "ArrayLike"]]


class Domain(NamedTuple):
    """Points with values, and lines and polygons between them."""

    points: np.ndarray
    """(n, 3)"""
    point_data: dict[str, np.ndarray]
    lines: list[np.ndarray]
    """Ids of points."""
    polygons: list[np.ndarray]


def mesh(
    points: Any = None,
    segments: Any = None,
    *,
    polygons: Iterable[Any] | None = None,
    min_angle: float = 30.0,
    max_area: float | None = None,
    size: Size | None = None,
    holes: Sequence[tuple[float, float]] = (),
    regions: Sequence[tuple[float, ...]] = (),
    convex: bool = False,
    keep_border: bool = False,
    keep_segments: bool = False,
    shortest_edge: float = 0.0,
    most_points: int | None = None,
    smooth: int = 0,
    crossings: str = "split",
    marks: str = "none",
    point_data: Mapping[str, ArrayLike] | None = None,
    memory: int | str | None = None,
    scratch: str | os.PathLike[str] | None = None,
    return_type: str | None = None,
    threads: int = 0,
    progress_bar: ProgressBar = False,
) -> Any:
    """Computes a mesh of triangles with bounded angles and sizes, by Delaunay refinement.

    Starts with the exact constrained Delaunay triangulation, and adds points until all triangles are within the bounds.
    Every segment is a chain of edges of the mesh.

    Parameters
    ----------
    points
        An array of shape (n, 2) or (n, 3), another object as for delaunay_2d(), or a vtkPolyData or pyvista.PolyData, whose
        lines and polygons are segments and polygons, too. None: only the corners of segments and polygons.
    segments
        Edges that the mesh must have: an (m, 2) array of point ids; or a list of lines, each an array of coordinates, a
        LineString or another geometry; or a GeoSeries or GeoDataFrame of these. Without polygons, the domain is what they
        enclose; without both, it is the convex hull of the points.
    polygons
        The domain: sequences of point ids; arrays of coordinates of shape (k, 2) or (k, 3); or Shapely polygons with their
        holes, a GeoSeries or a GeoDataFrame. Only triangles inside of counter-clockwise polygons are kept; clockwise ones
        are holes. Polygons that are geometries may have any orientation. Corners of polygons and segments where `points`
        has no point are new points, after the others, with interpolated values.
    min_angle
        The smallest angle of a triangle in degrees, from 0, no bound, to 34. Up to 20.7 refinement is proved to end, up to
        33 it usually does.
    max_area
        The largest area of a triangle, in the square of the points' unit. None: no limit.
    size
        The wanted length of edges, h, in the points' unit: no triangle is larger than the equilateral triangle of side h.
        A number; an array with a value for each point, linear in the triangles of the points, for which segments and
        polygons must have no corners of their own; or a function of two arrays x and y that returns an array. It is
        called once, with 512 intervals along the longer side of the points' bounds and about as wide ones along the
        other, and h is linear between these positions.
    holes
        A point (x, y) in each hole: all triangles that segments do not separate from it are removed.
    regions
        (x, y) or (x, y, area) of each region: a point, and the largest area of triangles that segments do not separate
        from it. The cell array Region has the number of each triangle's region, from 0, or -1.
    convex
        Whether the domain is the convex hull of the points, in which segments and polygons enclose nothing.
    keep_border, keep_segments
        Whether no points are added on the border of the domain, or on any segment.
    shortest_edge
        Edges are not made shorter than this. 0: 2^-36 of the domain's longest side, or 2^-44 of the largest coordinate if
        that is more.
    most_points
        The largest number of points that refinement adds, in one thread then. None: no limit.
    smooth
        The largest number of rounds in which points that refinement added inside the domain are moved towards the mean
        of their neighbours. A point moves only if the smallest angle around it grows and all bounds hold. 0: none; 5 is
        mostly enough.
    crossings
        "split": where segments cross, a new point is added. "refuse": crossing segments raise RuntimeError.
    marks
        "lines": the mesh has the segments as lines, with the array ConstraintId: the number of the line or polygon, lines
        first, or -1 on the border of none. "none": it has no lines.
    point_data
        For an array of points: a dictionary of arrays with values at the points.
    memory
        A memory limit for the process while it makes the mesh, in bytes or as a text such as "512M": the mesh is in
        temporary files then, and the result is the same. The result itself is in memory. None: no limit.
    scratch
        With memory: the folder of these files, on a disk. None: the system's folder for temporary files, which may be in
        memory.
    return_type
        "tipp", "vtk" or "pyvista": what the result is. None: tipp's for arrays, VTK's for a data set of VTK, and PyVista's
        for one of PyVista.
    threads
        Number of threads; 0: OMP_NUM_THREADS, or one per processor. The mesh does not depend on it.
    progress_bar
        Whether to show progress on standard error; or a function that is called with the fraction done and can stop
        the run by returning False.

    Returns
    -------
    tipp.Mesh, vtkPolyData or pyvista.PolyData
        The points given come first, with the same ids. Values at new points are interpolated along their segment or in
        the triangulation before refinement. The cell array OutsideBounds is 0 for triangles within the bounds; others are
        too large or have a smaller angle, because 1: segments meet at an angle below 60 degrees, 2: shortest_edge or
        rounding allows no more points, 3: keep_border or keep_segments forbids them, 4: most_points was reached.

    Raises
    ------
    TypeError, ValueError
        If an argument is of a wrong type or value.
    RuntimeError
        If it failed, for example for a region's point outside of the domain.
    KeyboardInterrupt
        Promptly after Ctrl-C.

    Notes
    -----
    The algorithms are those of Ruppert (1995) and Shewchuk (2002), with the off-centers of Üngör (2004). Within
    tipp.ranks() it works on one rank only.

    Examples
    --------
    >>> square = [[0, 0], [4, 0], [4, 4], [0, 4]]
    >>> mesh = tipp.mesh(square, [[0, 1], [1, 2], [2, 3], [3, 0]], size=lambda x, y: 0.1 + 0.2 * x)
    """
    options: dict[str, Any] = {
        "min_angle": angle_of(min_angle, "min_angle"),
        "max_area": math.inf if max_area is None else positive(max_area, "max_area"),
        "holes": [tuple(check.several(hole, "holes", 2, check.number)) for hole in check.a_list(holes, "holes")],
        "regions": [_region(region, f"regions[{i}]") for i, region in enumerate(check.a_list(regions, "regions"))],
        "convex": check.flag(convex, "convex"),
        "keep_border": check.flag(keep_border, "keep_border"),
        "keep_segments": check.flag(keep_segments, "keep_segments"),
        "shortest_edge": check.number(shortest_edge, "shortest_edge", at_least=0),
        "most_points": 0 if most_points is None else check.whole(most_points, "most_points", at_least=1),
        "smooth": check.whole(smooth, "smooth", at_least=0),
        "crossings": check.choice(crossings, "crossings", _CROSSINGS),
        "marks": check.choice(marks, "marks", _MARKS),
        "memory": 0 if memory is None else check.memory(memory, "memory"),
        "scratch": "" if scratch is None else check.path(scratch, "scratch"),
        "threads": check.threads(threads),
    }
    if scratch is not None and memory is None:
        raise ValueError("scratch has no effect without memory; give a memory limit.")
    progress = progress_of(progress_bar)
    check.require_point_set(points, point_data)
    kind = kind_of(return_type, points)
    given, domain = _domain_of(points, point_data, segments, polygons, options["threads"])
    surface = _set_size(size, given, domain, options)
    found = _engine.mesh(domain.points, domain.point_data, domain.lines, domain.polygons, options, surface, progress)
    return result_of(found, kind)


def angle_of(value: Any, name: str) -> float:
    angle = check.number(value, name, at_least=0)
    if angle > LARGEST_ANGLE:
        raise ValueError(f"{name} is {check.shown(value)}; give at most {LARGEST_ANGLE} degrees: above, refinement rarely "
                         "ends.")
    return angle


def positive(value: Any, name: str) -> float:
    result = check.number(value, name)
    if result <= 0:
        raise ValueError(f"{name} is {check.shown(value)}; give a number above 0.")
    return result


def _region(value: Any, name: str) -> tuple[float, float, float]:
    values = check.a_list(value, name)
    if len(values) not in (2, 3):
        raise ValueError(f"{name} has {len(values)} values; give x and y, or x, y and the largest area.")
    x, y = (check.number(values[i], f"{name}[{i}]") for i in range(2))
    return x, y, positive(values[2], f"{name}[2]") if len(values) == 3 else math.inf


def _domain_of(points: Any, point_data: Any, segments: Any, polygons: Any, threads: int) -> tuple[int, Domain]:
    """Returns the number of points given, and the domain."""
    lines: list[np.ndarray] = []
    rings: list[np.ndarray] = []
    if check.is_vtk_object(points):
        from ._vtk import cell_lists, point_arrays, xyz_of

        array, data = xyz_of(points), point_arrays(points)
        if points.IsA("vtkPolyData"):
            lines, rings = cell_lists(points.GetLines()), cell_lists(points.GetPolys())
            if segments is not None or polygons is not None:
                raise ValueError("points is a data set, which has its own lines and polygons; leave out segments and "
                                 "polygons.")
    elif points is None:
        if segments is None and polygons is None:
            raise ValueError("there are neither points nor segments nor polygons; give one of them.")
        array, data = np.zeros((0, 3)), attributes(point_data, 0)
    else:
        cloud, values = cloud_of(points, point_data)
        array = coordinates(cloud)
        data = attributes(values, len(array))
    array = in_space(array if array.dtype in (np.float32, np.float64) else array.astype(np.float64))
    count = len(array)
    found = constraints_of(count, None, segments, polygons, "segments")
    if found is not None:
        array, data, found = _with_corners(array, data, found, threads)
        lines, rings = found.lines, found.polygons
    return count, Domain(array, data, lines, rings)


def _with_corners(points: np.ndarray, data: dict[str, np.ndarray], constraints: Constraints,
                  threads: int) -> tuple[np.ndarray, dict[str, np.ndarray], Constraints]:
    """Appends the corners that have no point at their position, with interpolated values, and renumbers the others."""
    count, corners = len(points), constraints.corners
    if len(corners) == 0:
        return points, data, constraints
    every = np.concatenate([points[:, :2].astype(np.float64), corners[:, :2]]) + 0.0  # no -0
    _, first, inverse = np.unique(every[:, 0] + 1j * every[:, 1], return_index=True, return_inverse=True)
    same = first[inverse.reshape(-1)]
    is_new = same[count:] == np.arange(count, len(every))
    numbers = np.arange(len(every))
    numbers[count:][is_new] = np.arange(count, count + np.count_nonzero(is_new))
    numbers = numbers[same]
    corners, values = completed(points, data, corners[is_new], threads)
    if len(corners):
        points = np.concatenate([points.astype(np.float64), corners])
        data = {name: np.concatenate([array, values[name]]) for name, array in data.items() if name in values}
    return points, data, Constraints([numbers[ids] for ids in constraints.lines],
                                     [numbers[ids] for ids in constraints.polygons], corners)


def _set_size(size: Any, given: int, domain: Domain, options: dict[str, Any]) -> Mesh | None:
    """Sets the options for a size. Returns the surface of a function of sizes, with the point array "size"."""
    options["lengths"] = None
    if size is None:
        return None
    if callable(size) and not hasattr(size, "__array__"):
        return _sampled(size, domain.points)
    if np.ndim(size) == 0:
        h = positive(size, "size")
        area = math.sqrt(3) / 4 * h * h
        if area < sys.float_info.min:
            raise ValueError(f"size is {h}; give a larger one.")
        options["max_area"] = min(options["max_area"], area)
        return None
    lengths = np.ascontiguousarray(converted(size, "size"), np.float64)
    if lengths.shape != (given,):
        raise ValueError(f"size has the shape {lengths.shape}; give one value for each of the {given} points.")
    if len(domain.points) > given:
        raise ValueError("size has a value for each point, but segments or polygons have corners of their own; give their "
                         "ids among the points, or size as a function.")
    _require_sizes(lengths, lambda i: f"size[{i}]")
    options["lengths"] = lengths
    return None


def _require_sizes(lengths: np.ndarray, name: Callable[[int], str]) -> None:
    wrong = np.flatnonzero(~((lengths > 0) & np.isfinite(lengths)))
    if len(wrong):
        raise ValueError(f"{name(int(wrong[0]))} is {lengths[wrong[0]]}; give numbers above 0.")


def _sampled(size: Callable[[np.ndarray, np.ndarray], Any], points: np.ndarray) -> Mesh | None:
    """Evaluates a function on a lattice over the points."""
    finite = points[np.isfinite(points[:, :2]).all(axis=1), :2].astype(np.float64)
    if len(finite) == 0 or (finite.min(axis=0) == finite.max(axis=0)).any():
        return None  # there are no triangles
    low, high = finite.min(axis=0), finite.max(axis=0)
    step = (high - low).max() / _SAMPLES
    x, y = (np.linspace(low[i], high[i], 1 + max(1, math.ceil((high[i] - low[i]) / step))) for i in range(2))
    at = np.column_stack([np.tile(x, len(y)), np.repeat(y, len(x))])
    found = converted(size(at[:, 0].copy(), at[:, 1].copy()), "the result of size")
    if found.shape not in ((), (len(at),)):
        raise ValueError(f"size returns the shape {found.shape} for x and y of shape ({len(at)},); return an array of this "
                         "shape.")
    lengths = np.ascontiguousarray(np.broadcast_to(found, (len(at),)), np.float64)
    _require_sizes(lengths, lambda i: f"size({at[i, 0]}, {at[i, 1]})")
    corner = (np.arange(len(y) - 1)[:, np.newaxis] * len(x) + np.arange(len(x) - 1)).ravel()
    triangles = np.concatenate([np.column_stack([corner, corner + 1, corner + len(x) + 1]),
                                np.column_stack([corner, corner + len(x) + 1, corner + len(x)])])
    return Mesh(at, triangles.astype(np.int32), {"size": lengths})
