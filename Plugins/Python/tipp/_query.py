# SPDX-License-Identifier: BSD-3-Clause
"""tipp.open: a mesh that answers queries."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Iterable, NamedTuple

import numpy as np

from . import _arguments as check
from . import _engine
from ._arrays import coordinates

if TYPE_CHECKING:
    import os

    from numpy.typing import ArrayLike


def open(  # pylint: disable=redefined-builtin
    mesh: Any,
    *,
    memory: int | str = "1G",
    step: int = 0,
    threads: int = 0,
) -> ResidentMesh:
    """Opens a mesh to ask it for values at points and for what lies around its points and cells.

    Parameters
    ----------
    mesh
        The path of a partitioned mesh of any size, of which only what a query needs is read; or a mesh in memory,
        of triangles, tetrahedra or cells that can be cut into these: of VTK, PyVista or a tipp.Mesh.
    memory
        Bytes, as a number or as '512M', for the pieces of a partitioned mesh that are in memory and what is made
        to search them. A query that needs more for one piece is refused.
    step
        Of a partitioned mesh's arrays that vary in time the step, counted from 0.
    threads
        Number of threads of a query; 0: as many as OpenMP would take.

    Returns
    -------
    ResidentMesh
        Close it, or use it in a with statement. Python threads may share it.

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
    source = mesh if check.is_vtk_object(mesh) or hasattr(mesh, "point_data") else check.path(mesh, "mesh")
    return ResidentMesh(_engine.open_mesh(source, options))


class Profile(NamedTuple):
    """A mesh along a polyline; ResidentMesh.profile() makes it."""

    distances: np.ndarray
    points: np.ndarray
    cells: np.ndarray
    values: dict[str, np.ndarray]


class Closest(NamedTuple):
    """Where a mesh is nearest to points; ResidentMesh.closest() makes it."""

    cells: np.ndarray
    points: np.ndarray
    distances: np.ndarray


class Zones(NamedTuple):
    """An array of a mesh in zones, a value for each; ResidentMesh.zones() makes it."""

    cells: np.ndarray
    area: np.ndarray
    minimum: np.ndarray
    maximum: np.ndarray
    mean: np.ndarray
    integral: np.ndarray
    volume_above: np.ndarray


class Descent(NamedTuple):
    """A way down; ResidentMesh.descend() makes it."""

    points: np.ndarray
    values: np.ndarray
    pit: int


class ResidentMesh:
    """A mesh that answers queries; tipp.open() makes it.

    Ids of cells and points are those of the partitioned mesh's source, or the indices of a mesh in memory. Triangles
    are found by x and y. A point on an edge, a face or a corner belongs to one cell, which is decided exactly: the
    same for any pieces and threads.
    """

    def __init__(self, engine: Any) -> None:
        self._engine = engine
        self._names: list[str] = engine.names()

    def __enter__(self) -> ResidentMesh:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Gives the memory back; queries raise ValueError from now on."""
        self._engine = None

    def _ask(self) -> Any:
        engine = self._engine
        if engine is None:
            raise ValueError("the mesh is closed; open it again.")
        return engine

    @property
    def array_names(self) -> list[str]:
        """The arrays that interpolate() knows; "elevation" is the z of triangles."""
        return list(self._names)

    def locate(self, points: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
        """The id of the cell that holds each point, -1 outside, and the barycentric weights of its corners.

        Parameters
        ----------
        points
            (n, 2) or (n, 3) coordinates.

        Returns
        -------
        cells, weights
            (n,) ids and (n, 3) or (n, 4) weights, which are 0 outside.
        """
        return self._ask().locate(_points(points))

    def interpolate(self, points: ArrayLike, arrays: str | Iterable[str] | None = None) -> Any:
        """The mesh's arrays at points: linear in each cell from its points' values, or the cell's own value.

        Parameters
        ----------
        points
            (n, 2) or (n, 3) coordinates.
        arrays
            The name of an array, or names. None: all.

        Returns
        -------
        array, or dict of arrays
            For one name its array, else a dict by name. Outside of the mesh NaN, or 0 in arrays of whole numbers.
        """
        _, values = self._sample(points, arrays)
        return values[arrays] if isinstance(arrays, str) else values

    def _sample(
        self, points: ArrayLike, arrays: str | Iterable[str] | None
    ) -> tuple[np.ndarray, dict[str, np.ndarray]]:
        """The cells that hold points, and the arrays there, located once."""
        wanted = self._names if arrays is None else check.names(arrays, "arrays")
        check.require_arrays(wanted, self._names, "")
        return self._ask().sample(_points(points), wanted)

    def neighbors(self, cells: ArrayLike) -> np.ndarray:
        """For each cell and each of its corners the cell across the opposite edge or face; -1: there is none."""
        return self._ask().neighbors(_ids(cells, "cells"))

    def star(self, points: ArrayLike) -> list[np.ndarray]:
        """The cells at each point, ascending."""
        return _split(*self._ask().star(_ids(points, "points")))

    def ring(self, *, points: ArrayLike | None = None, cells: ArrayLike | None = None, k: int = 1) -> list[np.ndarray]:
        """What lies within k steps around each point or cell, ascending, without itself.

        Points are one step apart if an edge joins them, cells if they share a point.
        """
        if (points is None) == (cells is None):
            raise ValueError("give either points or cells.")
        steps = check.whole(k, "k")
        engine = self._ask()
        if points is not None:
            return _split(*engine.ring_of_points(_ids(points, "points"), steps))
        return _split(*engine.ring_of_cells(_ids(cells, "cells"), steps))

    def boundary(self) -> list[np.ndarray]:
        """The border of a mesh of triangles: of each loop the ids of its points, with the mesh on the left."""
        return _split(*self._ask().boundary())

    def contours(self, levels: Iterable[float], array: str = "elevation", component: int = 0
                 ) -> list[tuple[float, np.ndarray]]:
        """Where an array of the points has these levels, on a mesh of triangles: (level, (n, 3) points) of each line.

        Lines go on across pieces. The first point of a closed line is also its last. The higher side is on the left.
        """
        name = check.text(array, "array")
        check.require_arrays([name], self._names, "")
        starts, found, points = self._ask().contours(
            name, check.whole(component, "component"), np.array([check.number(v, "levels") for v in levels], np.float64))
        return list(zip(found.tolist(), np.split(points, starts[1:-1]) if len(starts) > 1 else []))

    def profile(self, polyline: ArrayLike, spacing: float = 0, arrays: str | Iterable[str] | None = None) -> Profile:
        """The mesh along a polyline.

        Parameters
        ----------
        polyline
            (n, 2) or (n, 3) coordinates; over triangles x and y count.
        spacing
            The distance of samples; those at the polyline's corners come besides. 0: at its corners and wherever it
            crosses an edge of triangles or a face of tetrahedra.
        arrays
            The name of an array, or names. None: all.

        Returns
        -------
        Profile
            `distances`, `points` (n, 2) of triangles or (n, 3) of tetrahedra, `cells` and the arrays by name in
            `values`. With spacing 0 `cells` are those up to the next point, -1 before a gap.
        """
        wanted = self._names if arrays is None else check.names(arrays, "arrays")
        check.require_arrays(wanted, self._names, "")
        return Profile(*self._ask().profile(_points(polyline), check.number(spacing, "spacing", at_least=0), wanted))

    def closest(self, points: ArrayLike) -> Closest:
        """The nearest location of the mesh to each point; triangles are measured in x and y.

        Parameters
        ----------
        points
            (n, 2) or (n, 3) coordinates.

        Returns
        -------
        Closest
            `cells`, the nearest ones, `points` (n, 3), whose z is 0 for triangles, and `distances`, 0 inside. Of
            cells that are as near the lowest one counts. Without cells, or for points that are not finite, -1, NaN
            and infinity.
        """
        return Closest(*self._ask().closest(_points(points)))

    def cells_in(self, *, box: Iterable[float] | None = None, polygon: Any = None, whole: bool = False) -> np.ndarray:
        """The cells that have a point of a box or a polygon, with its border; ascending.

        Parameters
        ----------
        box
            x min, x max, y min, y max, and for tetrahedra z min, z max.
        polygon
            A polygon over triangles, as in zones().
        whole
            Only the cells that lie in it.
        """
        return self._ask().cells_in(*_region(box, polygon), check.flag(whole, "whole"))

    def points_in(self, *, box: Iterable[float] | None = None, polygon: Any = None) -> np.ndarray:
        """The mesh's points in a box or a polygon, with its border, as in cells_in(); ascending."""
        return self._ask().points_in(*_region(box, polygon))

    def zones(self, polygons: Iterable[Any], array: str = "elevation", *, component: int = 0, level: float = 0
              ) -> Zones:
        """Statistics of an array in polygons, on a mesh of triangles.

        Triangles are cut at the polygons' borders. An array of points is linear in each triangle. Triangles with a
        value that is NaN are left out. The values do not depend on pieces and threads.

        Parameters
        ----------
        polygons
            A zone each: corners of shape (k, 2), a list of such rings of which the first is the outer one and the
            others are holes, or a Polygon or MultiPolygon of Shapely's.
        array
            The name of the array; "elevation" is the z of the points.
        component
            Of an array that has several.
        level
            For the volume above it.

        Returns
        -------
        Zones
            `cells`, how many have an area in the zone, `area` of the mesh in it, `minimum`, `maximum`, `mean` (NaN
            where there is no area), `integral`, and `volume_above`, the integral of what the array exceeds the
            level by.
        """
        name = check.text(array, "array")
        check.require_arrays([name], self._names, "")
        zones = [polygons] if hasattr(polygons, "geom_type") else check.a_list(polygons, "polygons")
        return Zones(*self._ask().zones(
            _rings(zones), len(zones), name, check.whole(component, "component"), check.number(level, "level")))

    def descend(self, points: ArrayLike, array: str = "elevation", component: int = 0) -> list[Descent]:
        """The way down from each point, by the steepest descent of an array of the points of triangles.

        It leads down triangles, and along edges that both sides lead to or that are the border, to a pit.

        Returns
        -------
        list of Descent
            For each point `points` (n, 3), the array's `values` there, which fall, and `pit`, the mesh's point at
            the end; -1 if the line ends in a level triangle or edge, or begins outside of the mesh.
        """
        name = check.text(array, "array")
        check.require_arrays([name], self._names, "")
        starts, found, values, pits = self._ask().descend(_points(points), name, check.whole(component, "component"))
        lines = zip(_split(starts, found), _split(starts, values), pits.tolist())
        return [Descent(*line) for line in lines]

    def components(self) -> tuple[np.ndarray, np.ndarray]:
        """The connected component of each cell, by common edges or faces, and how many cells each component has."""
        return self._ask().components()


def _region(box: Any, polygon: Any) -> tuple[list[float], Any]:
    """The six bounds of a box, or the rings of a polygon."""
    if (box is None) == (polygon is None):
        raise ValueError("give either box or polygon.")
    if box is None:
        return [0.0] * 6, _rings([polygon])
    bounds = check.a_list(box, "box")
    if len(bounds) not in (4, 6):
        raise ValueError(f"box has {len(bounds)} bounds; give x min, x max, y min, y max, and z min, z max.")
    return [check.number(b, "box") for b in bounds] + [0.0] * (6 - len(bounds)), None


def _rings(zones: list[Any]) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """(n, 2) corners, where each ring begins and the end, its zone, and whether it is a hole."""
    corners, zone_of, holes = [np.zeros((0, 2))], [], []
    for number, zone in enumerate(zones):
        for ring, is_hole in _rings_of(zone, f"polygons[{number}]"):
            points = np.asarray(ring, np.float64)
            if points.ndim != 2 or points.shape[1] not in (2, 3):
                raise ValueError(f"polygons[{number}] has a ring of shape {points.shape}; give corners (k, 2).")
            corners.append(points[:, :2])
            zone_of.append(number)
            holes.append(int(is_hole))
    starts = np.cumsum([len(c) for c in corners])
    return np.concatenate(corners), starts.astype(np.int64), np.array(zone_of, np.int64), np.array(holes, np.int64)


def _rings_of(zone: Any, name: str) -> list[tuple[Any, bool]]:
    kind = getattr(zone, "geom_type", None)
    if kind == "MultiPolygon":
        return [ring for part in zone.geoms for ring in _rings_of(part, name)]
    if kind == "Polygon":
        rings = [] if zone.is_empty else [zone.exterior, *zone.interiors]
        return [(np.asarray(ring.coords), i > 0) for i, ring in enumerate(rings)]
    if kind is not None:
        raise TypeError(f"{name} is a Shapely {kind}; give a Polygon or a MultiPolygon.")
    if isinstance(zone, np.ndarray):
        return [(zone, False)]
    rings = check.a_list(zone, name)
    if rings and all(np.ndim(corner) == 1 for corner in rings):
        return [(rings, False)]
    return [(ring, i > 0) for i, ring in enumerate(rings)]


def _points(points: ArrayLike) -> np.ndarray:
    array = np.asarray(coordinates(points), np.float64)
    if array.shape[1] == 2:
        spatial = np.zeros((len(array), 3))
        spatial[:, :2] = array
        return spatial
    return np.ascontiguousarray(array)


def _ids(ids: Any, name: str) -> np.ndarray:
    array = np.atleast_1d(np.asarray(ids))
    if array.size == 0:
        return np.zeros(0, np.int64)
    if array.ndim != 1 or array.dtype.kind not in "iu":
        raise TypeError(f"{name} are of type {array.dtype} and shape {array.shape}; give a list of whole numbers.")
    return np.ascontiguousarray(array, np.int64)


def _split(starts: np.ndarray, ids: np.ndarray) -> list[np.ndarray]:
    return np.split(ids, starts[1:-1]) if len(starts) > 1 else []
