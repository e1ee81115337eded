# SPDX-License-Identifier: BSD-3-Clause
"""tipp.open: opens a mesh for queries."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Iterable, NamedTuple

import numpy as np

from . import _arguments as check
from . import _engine
from ._arrays import columns_of, coordinates, in_space, is_mesh
from ._bounds import bounds_of, BoundsLike
from ._data import as_mesh
from ._geometry import is_geometry, items_of, parts_of, rings_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

_HIGHEST = float(np.finfo(np.float64).max)  # a z without limit


def open(  # pylint: disable=redefined-builtin
    mesh: Any,
    *,
    memory: int | str = "1G",
    step: int = 0,
    threads: int = 0,
) -> ResidentMesh:
    """Opens a mesh for queries: values at points, neighbours of points and cells, and more.

    Parameters
    ----------
    mesh
        The path of a partitioned mesh of any size, of which only the pieces that a query needs are read; or a mesh in
        memory (of tipp, VTK, PyVista or meshio) of triangles, tetrahedra or cells that can be divided into these.
    memory
        The memory limit for pieces of a partitioned mesh and their search structures: bytes, or a text such as '512M'.
        A query that needs more for a single piece raises RuntimeError.
    step
        The time step at which a partitioned mesh's time-varying arrays are evaluated, as an index from 0.
    threads
        Number of threads of a query; 0: OMP_NUM_THREADS, or one per processor.

    Returns
    -------
    ResidentMesh
        The opened mesh. Close it, or use it in a with statement. Several Python threads may share it.

    Raises
    ------
    RuntimeError
        If the mesh cannot be used; the message says why.

    Examples
    --------
    >>> with tipp.open("large.tipp", memory="512M") as mesh:
    ...     cells, weights = mesh.locate(points)
    ...     level = mesh.interpolate(points, "elevation")
    """
    options = {
        "memory": check.memory(memory, "memory"),
        "step": check.whole(step, "step"),
        "threads": check.threads(threads),
    }
    source = as_mesh(mesh) if check.is_vtk_object(mesh) or is_mesh(mesh) else check.path(mesh, "mesh")
    return ResidentMesh(_engine.open_mesh(source, options))


class Profile(NamedTuple):
    """A mesh along a polyline; the result of ResidentMesh.profile()."""

    distances: np.ndarray
    points: np.ndarray
    cells: np.ndarray
    values: dict[str, np.ndarray]


class Closest(NamedTuple):
    """The locations on a mesh nearest to points; the result of ResidentMesh.closest()."""

    cells: np.ndarray
    points: np.ndarray
    distances: np.ndarray


class Zones(NamedTuple):
    """Statistics of an array in zones, one value per zone; the result of ResidentMesh.zones()."""

    cells: np.ndarray
    area: np.ndarray
    minimum: np.ndarray
    maximum: np.ndarray
    mean: np.ndarray
    integral: np.ndarray
    volume_above: np.ndarray


class Descent(NamedTuple):
    """A line of steepest descent; the result of ResidentMesh.descend()."""

    points: np.ndarray
    values: np.ndarray
    pit: int


class ResidentMesh:
    """A mesh that is open for queries; the result of tipp.open().

    Ids of cells and points are the global ids of a partitioned mesh, or indices for a mesh in memory. Triangles are
    located by x and y. A point on an edge, face or corner belongs to exactly one cell, which does not depend on pieces
    and threads.
    """

    def __init__(self, engine: Any) -> None:
        self._engine = engine
        self._names: list[str] = engine.names()

    def __enter__(self) -> ResidentMesh:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Frees the memory. Afterwards queries raise ValueError."""
        self._engine = None

    def _opened(self) -> Any:
        engine = self._engine
        if engine is None:
            raise ValueError("the mesh is closed; open it again.")
        return engine

    @property
    def array_names(self) -> list[str]:
        """The names of the arrays that interpolate() evaluates; "elevation" is the z of triangles."""
        return list(self._names)

    def locate(self, points: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
        """Finds the cell that contains each point, and the barycentric weights of the cell's corners.

        Parameters
        ----------
        points
            (n, 2) or (n, 3) coordinates.

        Returns
        -------
        cells, weights
            (n,) cell ids, -1 outside, and (n, 3) or (n, 4) weights, which are 0 outside.
        """
        return self._opened().locate(_points(points))

    def interpolate(self, points: ArrayLike, arrays: str | Iterable[str] | None = None) -> Any:
        """Evaluates the mesh's arrays at points: point arrays are interpolated linearly, cell arrays have the cell's
        value.

        Parameters
        ----------
        points
            (n, 2) or (n, 3) coordinates.
        arrays
            The name of an array, or names. None: all.

        Returns
        -------
        array, or dict of arrays
            For a single name its array, else a dict by name. Values outside of the mesh are NaN, or 0 in integer
            arrays.
        """
        _, values = self._sample(points, arrays)
        return values[arrays] if isinstance(arrays, str) else values

    def _sample(
        self, points: ArrayLike, arrays: str | Iterable[str] | None
    ) -> tuple[np.ndarray, dict[str, np.ndarray]]:
        """Locates points once; returns their cells and the arrays' values there."""
        wanted = self._wanted(arrays)
        return self._opened().sample(_points(points), wanted)

    def _wanted(self, arrays: str | Iterable[str] | None) -> list[str]:
        """Returns the names of the arrays to evaluate. Raises KeyError if the mesh lacks one."""
        wanted = self._names if arrays is None else check.names(arrays, "arrays")
        check.require_arrays(wanted, self._names)
        return wanted

    def neighbors(self, cells: ArrayLike) -> np.ndarray:
        """Returns, for each cell and each of its corners, the cell across the opposite edge or face, or -1."""
        return self._opened().neighbors(_ids(cells, "cells"))

    def star(self, points: ArrayLike) -> list[np.ndarray]:
        """Returns the cells at each point, in ascending order."""
        return _split(*self._opened().star(_ids(points, "points")))

    def ring(self, *, points: ArrayLike | None = None, cells: ArrayLike | None = None, k: int = 1) -> list[np.ndarray]:
        """Returns the points or cells within k steps of each point or cell, ascending, without itself.

        Points are one step apart if an edge joins them, cells if they share a point.
        """
        if (points is None) == (cells is None):
            raise ValueError("give either points or cells.")
        steps = check.whole(k, "k")
        engine = self._opened()
        if points is not None:
            return _split(*engine.ring_of_points(_ids(points, "points"), steps))
        return _split(*engine.ring_of_cells(_ids(cells, "cells"), steps))

    def boundary(self) -> list[np.ndarray]:
        """Returns the border of a mesh of triangles: the point ids of each loop, with the mesh on the left."""
        return _split(*self._opened().boundary())

    def contours(self, levels: Iterable[float], array: str = "elevation", component: int = 0
                 ) -> list[tuple[float, np.ndarray]]:
        """Computes contour lines of a point array on a mesh of triangles: (level, (n, 3) points) for each line.

        Lines continue across pieces. A closed line's first point is repeated as its last. Higher values are on the
        left.
        """
        name = check.text(array, "array")
        check.require_arrays([name], self._names)
        starts, found, points = self._opened().contours(
            name, check.whole(component, "component"), np.array([check.number(v, "levels") for v in levels], np.float64))
        return list(zip(found.tolist(), np.split(points, starts[1:-1]) if len(starts) > 1 else []))

    def profile(self, polyline: ArrayLike, spacing: float = 0, arrays: str | Iterable[str] | None = None) -> Profile:
        """Samples the mesh along a polyline.

        Parameters
        ----------
        polyline
            (n, 2) or (n, 3) coordinates, or a LineString; for triangles only x and y are used.
        spacing
            The distance between samples, in addition to those at the polyline's corners. 0: samples at its corners and
            wherever it crosses an edge of a triangle or a face of a tetrahedron.
        arrays
            As for interpolate().

        Returns
        -------
        Profile
            `distances`, `points` (n, 2) for triangles or (n, 3) for tetrahedra, `cells`, and the arrays by name in
            `values`. With spacing 0, `cells` has the cell between each point and the next, -1 before a gap.
        """
        distance = check.number(spacing, "spacing", at_least=0)
        return Profile(*self._opened().profile(_points(_corners(polyline)), distance, self._wanted(arrays)))

    def closest(self, points: ArrayLike) -> Closest:
        """Finds the location on the mesh nearest to each point; for triangles, distances are measured in x and y.

        Parameters
        ----------
        points
            As for locate().

        Returns
        -------
        Closest
            `cells`, the nearest cells; `points` (n, 3), whose z is 0 for triangles; and `distances`, 0 inside. Of
            several nearest cells the one with the lowest id is returned. If the mesh has no cells, or for non-finite
            points, these are -1, NaN and infinity.
        """
        return Closest(*self._opened().closest(_points(points)))

    def cells_in(self, *, box: BoundsLike | None = None, polygon: Any = None, whole: bool = False) -> np.ndarray:
        """Returns the cells that share a point with a closed box or polygon, in ascending order.

        Parameters
        ----------
        box
            (xmin, xmax, ymin, ymax) or (xmin, xmax, ymin, ymax, zmin, zmax), a tipp.Bounds, or a data set, geometry or
            raster, whose bounds are used. z counts for tetrahedra only.
        polygon
            For triangles: a polygon as in zones().
        whole
            Whether to return only the cells that lie inside.
        """
        return self._opened().cells_in(*_region(box, polygon), check.flag(whole, "whole"))

    def points_in(self, *, box: BoundsLike | None = None, polygon: Any = None) -> np.ndarray:
        """Returns the mesh's points in a closed box or polygon, as in cells_in(), in ascending order."""
        return self._opened().points_in(*_region(box, polygon))

    def zones(self, polygons: Iterable[Any], array: str = "elevation", *, component: int = 0, level: float = 0
              ) -> Zones:
        """Computes statistics of an array in polygons, on a mesh of triangles.

        Triangles are clipped at the polygons' borders. Point arrays are interpolated linearly. Triangles with a NaN
        value are left out. The values do not depend on pieces and threads.

        Parameters
        ----------
        polygons
            One zone each: corners of shape (k, 2); a list of such rings, the first of which is the outer ring and the
            others are holes; or a Shapely Polygon or MultiPolygon. A GeoSeries or GeoDataFrame has one in each row.
        array
            The array's name; "elevation" is the z of the points.
        component
            The component of an array that has several.
        level
            The level for volume_above.

        Returns
        -------
        Zones
            `cells`, the number of cells with an area in the zone; `area` of the mesh in the zone; `minimum`, `maximum`
            and `mean` (NaN if there is no area); `integral`; and `volume_above`, the integral of the amount by which
            the array exceeds the level.
        """
        name = check.text(array, "array")
        check.require_arrays([name], self._names)
        zones = items_of(polygons, "polygons")
        return Zones(*self._opened().zones(
            _rings(zones), len(zones), name, check.whole(component, "component"), check.number(level, "level")))

    def descend(self, points: ArrayLike, array: str = "elevation", component: int = 0) -> list[Descent]:
        """Follows the steepest descent of a point array from each point, on a mesh of triangles.

        A line descends across triangles, and along edges to which both sides descend or that are on the border, to a
        pit.

        Returns
        -------
        list of Descent
            For each point: `points` (n, 3), the array's descending `values` there, and `pit`, the id of the mesh point
            at the end, or -1 if the line ends in a level triangle or edge, or starts outside of the mesh.
        """
        name = check.text(array, "array")
        check.require_arrays([name], self._names)
        starts, found, values, pits = self._opened().descend(_points(points), name, check.whole(component, "component"))
        lines = zip(_split(starts, found), _split(starts, values), pits.tolist())
        return [Descent(*line) for line in lines]

    def components(self) -> tuple[np.ndarray, np.ndarray]:
        """Returns the connected component of each cell, by common edges or faces, and each component's number of
        cells."""
        return self._opened().components()


def _region(box: Any, polygon: Any) -> tuple[list[float], Any]:
    """Returns the bounds of a box, or the rings of a polygon."""
    if (box is None) == (polygon is None):
        raise ValueError("give either box or polygon.")
    if box is None:
        return [0.0] * 6, _rings([polygon])
    bounds = bounds_of(box, "box")
    return (bounds if len(bounds) == 6 else [*bounds, -_HIGHEST, _HIGHEST]), None


def _rings(zones: list[Any]) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Returns (n, 2) corners, the first corner of each ring and the end, each ring's zone, and whether it is a hole."""
    corners, zone_of, holes = [np.zeros((0, 2))], [], []
    for number, zone in enumerate(zones):
        for ring, is_hole in _rings_of(zone, f"polygons[{number}]"):
            points = np.asarray(columns_of(ring, f"polygons[{number}]"), np.float64)
            if points.ndim != 2 or points.shape[1] not in (2, 3):
                raise ValueError(f"polygons[{number}] has a ring of shape {points.shape}; give corners (k, 2).")
            corners.append(points[:, :2])
            zone_of.append(number)
            holes.append(int(is_hole))
    starts = np.cumsum([len(c) for c in corners])
    return np.concatenate(corners), starts.astype(np.int64), np.array(zone_of, np.int64), np.array(holes, np.int64)


def _rings_of(zone: Any, name: str) -> list[tuple[Any, bool]]:
    if zone is None or is_geometry(zone):
        return list(rings_of(zone, name))
    if isinstance(zone, np.ndarray):
        return [(zone, False)]
    rings = check.a_list(zone, name)
    if rings and all(np.ndim(corner) == 1 for corner in rings):
        return [(rings, False)]
    return [(ring, i > 0) for i, ring in enumerate(rings)]


def _corners(polyline: Any) -> Any:
    """Returns the corners of a line, or the array as it is."""
    if not is_geometry(polyline):
        return polyline
    parts = list(parts_of(polyline, "polyline"))
    if len(parts) != 1 or parts[0].kind not in ("LineString", "LinearRing"):
        raise TypeError("polyline is not one line; give a LineString.")
    return parts[0].corners


def _points(points: ArrayLike) -> np.ndarray:
    return in_space(np.asarray(coordinates(points), np.float64))


def _ids(ids: Any, name: str) -> np.ndarray:
    array = np.atleast_1d(np.asarray(ids))
    if array.size == 0:
        return np.zeros(0, np.int64)
    if array.ndim != 1 or array.dtype.kind not in "iu":
        raise TypeError(f"{name} are of type {array.dtype} and shape {array.shape}; give a list of whole numbers.")
    return np.ascontiguousarray(array, np.int64)


def _split(starts: np.ndarray, ids: np.ndarray) -> list[np.ndarray]:
    return np.split(ids, starts[1:-1]) if len(starts) > 1 else []
