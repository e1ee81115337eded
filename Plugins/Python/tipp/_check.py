# SPDX-License-Identifier: BSD-3-Clause
"""An independent checker of triangulations: evaluates determinants in floating point, and in integers if a sign is
uncertain."""
from __future__ import annotations

from typing import Any, Callable, NamedTuple, TYPE_CHECKING

import numpy as np

from . import _arguments as argument
from ._arrays import converted, coordinates
from ._data import as_mesh, Mesh

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

_EPSILON = 2.0**-53
_SMALLEST = 2.0**-1000  # below this, products may have underflowed
_BLOCK = 1 << 18  # rows


def _orientation(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns the orientation determinant, and the sum of the magnitudes of its terms."""
    left = (b[0] - a[0]) * (c[1] - a[1])
    right = (b[1] - a[1]) * (c[0] - a[0])
    return left - right, abs(left) + abs(right)


def _in_circle(a: np.ndarray, b: np.ndarray, c: np.ndarray, d: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns the same for the in-circle determinant: positive if d is inside the circle through a, b and c, which must
    be counter-clockwise."""
    (ax, ay), (bx, by), (cx, cy) = ([p[0] - d[0], p[1] - d[1]] for p in (a, b, c))
    value, size = 0, 0
    for (px, py), (qx, qy), (rx, ry) in (((ax, ay), (bx, by), (cx, cy)), ((bx, by), (cx, cy), (ax, ay)),
                                         ((cx, cy), (ax, ay), (bx, by))):
        lift = px * px + py * py
        value = value + lift * (qx * ry - qy * rx)
        size = size + lift * (abs(qx * ry) + abs(qy * rx))
    return value, size


def _signs(determinant: Callable[..., tuple[np.ndarray, np.ndarray]], roundings: int,
           corners: list[np.ndarray]) -> np.ndarray:
    """Returns the exact sign (-1, 0 or 1) of the determinant for each row of (n, 2) corners."""
    result = np.empty(len(corners[0]), np.int8)
    for begin in range(0, len(result), _BLOCK):
        rows = [corner[begin:begin + _BLOCK] for corner in corners]
        with np.errstate(over="ignore", invalid="ignore", under="ignore"):
            value, size = determinant(*(row.T for row in rows))
            certain = (np.abs(value) > roundings * _EPSILON * size) & (size > _SMALLEST) & np.isfinite(size)
        signs = np.sign(np.where(certain, value, 0)).astype(np.int8)
        uncertain = np.flatnonzero(~certain)
        if len(uncertain):
            exact = _integers(np.stack([row[uncertain] for row in rows]))
            value, _ = determinant(*(points.T for points in exact))
            signs[uncertain] = [(v > 0) - (v < 0) for v in value]
        result[begin:begin + _BLOCK] = signs
    return result


def _integers(values: np.ndarray) -> np.ndarray:
    """Returns the numbers as Python integers, multiplied by a power of two that makes all of them integers."""
    mantissas, exponents = np.frexp(values)
    whole = (mantissas * 2.0**53).astype(np.int64)
    exponents = np.where(whole == 0, 0, exponents)
    lowest = exponents[whole != 0].min() if (whole != 0).any() else 0
    shifts = np.where(whole == 0, 0, exponents - lowest)
    result = np.empty(values.shape, object)
    result.ravel()[:] = [m << s for m, s in zip(whole.ravel().tolist(), shifts.ravel().tolist())]
    return result


def orientations(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> np.ndarray:
    """Returns 1 where a, b and c are counter-clockwise, -1 where clockwise, 0 where collinear."""
    return _signs(_orientation, 8, [a, b, c])


def in_circles(a: np.ndarray, b: np.ndarray, c: np.ndarray, d: np.ndarray) -> np.ndarray:
    """Returns 1 where d is inside the circle through a, b and c (counter-clockwise), 0 where on the circle, else -1."""
    return _signs(_in_circle, 32, [a, b, c, d])


class CheckReport(NamedTuple):
    """The result of check(). Its truth value is True if there are no faults."""

    points: int
    distinct_points: int
    """Distinct points with finite coordinates."""
    triangles: int
    boundary_edges: int
    """Edges of one triangle."""
    ties: int
    """Interior edges whose four points are on one circle."""
    faults: dict[str, int]
    """The number of faults of each kind."""

    def __bool__(self) -> bool:
        return not self.faults


def check(
    points: Any,
    triangles: Any = None,
    *,
    edges: ArrayLike | None = None,
    tie_rule: bool = False,
    boundary_free: bool = False,
) -> CheckReport:
    """Checks, in exact arithmetic, that triangles are the Delaunay triangulation of points.

    It checks that every edge is in at most two triangles, all triangles are counter-clockwise, every interior edge is
    locally Delaunay, the boundary is one convex chain, and every distinct point is a corner. If a mesh has the cell
    array NeighborIds, that is checked, too.

    Parameters
    ----------
    points
        An array or an object as for delaunay(), or a mesh of tipp, meshio, VTK or PyVista, which has its own triangles.
    triangles
        (m, 3) point ids, or a mesh. None: the triangles of `points`, which must be a mesh.
    edges
        Constraints as an (m, 2) array of point ids: these edges must exist, and need not be locally Delaunay.
    tie_rule
        Whether to check also which of the two diagonals of four co-circular points is an edge: it must be the one that
        does not end at the lexicographically largest point.
    boundary_free
        Whether the mesh may have any boundary, for example that of polygons. Then neither the boundary is checked, nor
        that all points are corners.

    Returns
    -------
    CheckReport
        points, distinct_points, triangles, boundary_edges, ties and faults, a dictionary that is empty if the
        triangulation is correct.

    Examples
    --------
    >>> points = numpy.random.default_rng(1).random((1000, 2))
    >>> bool(tipp.check(points, tipp.delaunay(points)))
    True
    """
    ties_matter = argument.flag(tie_rule, "tie_rule")
    is_free = argument.flag(boundary_free, "boundary_free")
    xy, own, neighbors = _points_and_triangles(points, "points")
    if triangles is not None:
        own, neighbors = _triangles(triangles)
    if own is None:
        raise ValueError("triangles is None, and points is not a mesh; give the triangles.")
    pairs = np.empty((0, 2), np.int64) if edges is None else _ids(edges, "edges", 2)
    return _Checker(xy, own, neighbors, pairs).report(ties_matter, is_free)


def _points_and_triangles(points: Any, name: str) -> tuple[np.ndarray, np.ndarray | None, np.ndarray | None]:
    """Returns (n, 2) coordinates; for a mesh also its triangles, and their neighbours if it has them."""
    points = as_mesh(points)
    if isinstance(points, Mesh):
        return _plane(points.points), _ids(points.cells, name, 3), points.cell_data.get("NeighborIds")
    if not argument.is_vtk_object(points):
        return _plane(coordinates(points)), None, None
    argument.data_object(points, name, ("vtkPointSet",), "an array or a mesh")
    from ._vtk import simplices_of, xyz_of

    if points.GetNumberOfCells() == 0 or points.GetCellType(0) in (1, 2):  # vertices: a cloud
        return _plane(xyz_of(points)), None, None
    mesh, _ = simplices_of(points)
    return _plane(xyz_of(points)), _ids(mesh.cells, name, 3), mesh.cell_data.get("NeighborIds")


def _triangles(triangles: Any) -> tuple[np.ndarray, np.ndarray | None]:
    triangles = as_mesh(triangles)
    if isinstance(triangles, Mesh) or argument.is_vtk_object(triangles):
        _, own, neighbors = _points_and_triangles(triangles, "triangles")
        return (np.empty((0, 3), np.int64) if own is None else own), neighbors
    return _ids(triangles, "triangles", 3), None


def _plane(points: np.ndarray) -> np.ndarray:
    return np.ascontiguousarray(points[:, :2], np.float64)


def _ids(values: Any, name: str, columns: int) -> np.ndarray:
    array = converted(values, name)
    if array.size == 0:
        return np.empty((0, columns), np.int64)
    if array.ndim != 2 or array.shape[1] != columns or array.dtype.kind not in "iu":
        raise ValueError(f"{name} have the shape {array.shape} and type {array.dtype}; give point ids of shape "
                         f"(m, {columns}).")
    return array.astype(np.int64)


class _Checker:
    def __init__(self, xy: np.ndarray, triangles: np.ndarray, neighbors: Any, pairs: np.ndarray):
        self.xy = xy
        self.all = triangles
        self.neighbors = neighbors
        self.faults: dict[str, int] = {}
        self.is_finite = np.isfinite(xy).all(axis=1)
        is_good = ((triangles >= 0) & (triangles < len(xy))).all(axis=1)
        is_good[is_good] = self.is_finite[triangles[is_good]].all(axis=1)
        self.count("triangles that name no point, or one that is not finite", (~is_good).sum())
        self.are_all_good = bool(is_good.all())
        self.triangles = triangles[is_good]
        # Edge i of a triangle is opposite to its corner i.
        t = self.triangles
        self.start, self.end = t[:, [1, 2, 0]].ravel(), t[:, [2, 0, 1]].ravel()
        self.key = np.minimum(self.start, self.end) * len(xy) + np.maximum(self.start, self.end)
        wanted = pairs[((pairs >= 0) & (pairs < len(xy))).all(axis=1)]
        self.constraints = wanted.min(axis=1) * len(xy) + wanted.max(axis=1)
        lost = len(pairs) - len(wanted) + (~np.isin(self.constraints, self.key)).sum()
        self.count("constraints that are no edge", lost)

    def count(self, what: str, number: Any) -> None:
        if number:
            self.faults[what] = self.faults.get(what, 0) + int(number)

    def report(self, ties_matter: bool, is_free: bool) -> CheckReport:
        t = self.triangles
        turns = orientations(self.xy[t[:, 0]], self.xy[t[:, 1]], self.xy[t[:, 2]])
        self.count("triangles that are clockwise or flat", (turns <= 0).sum())
        first, second, boundary = self.match_edges()
        ties = self.check_circles(first, second, ties_matter)
        finite = self.xy[self.is_finite] + 0.0  # -0 is 0
        distinct = len(np.unique(finite, axis=0))
        used = np.unique(t)
        self.count("corners with equal coordinates under several ids", len(used) - len(np.unique(self.xy[used] + 0.0, axis=0)))
        if not is_free and (len(t) or not _are_collinear(finite)):
            self.count("distinct points in no triangle", max(distinct - len(used), 0))
            self.check_hull(boundary)
            self.count("triangles more or fewer than Euler's number", abs(len(self.all) - (2 * distinct - 2 - len(boundary))))
        self.check_neighbors(first, second, boundary)
        return CheckReport(len(self.xy), distinct, len(self.all), len(boundary), ties, self.faults)

    def match_edges(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Returns the pairs of half-edges of interior edges, and the half-edges of the boundary."""
        order = np.argsort(self.key, kind="stable")
        _, begins, counts = np.unique(self.key[order], return_index=True, return_counts=True)
        self.count("edges in three or more triangles", (counts > 2).sum())
        first, second = order[begins[counts == 2]], order[begins[counts == 2] + 1]
        is_opposite = self.start[first] == self.end[second]
        self.count("edges that two triangles have in one direction", (~is_opposite).sum())
        return first[is_opposite], second[is_opposite], order[begins[counts == 1]]

    def check_circles(self, first: np.ndarray, second: np.ndarray, ties_matter: bool) -> int:
        is_free = ~np.isin(self.key[first], self.constraints)
        first, second = first[is_free], second[is_free]
        a, b = self.start[first], self.end[first]
        c, d = self.triangles.ravel()[first], self.triangles.ravel()[second]
        signs = in_circles(*(self.xy[ids] for ids in (a, b, c, d)))
        self.count("interior edges with a point inside the circle", (signs > 0).sum())
        is_tie = signs == 0
        if ties_matter and is_tie.any():
            x, y = (self.xy[np.stack([a, b, c, d])[:, is_tie]][..., axis] for axis in (0, 1))
            is_last = x == x.max(axis=0)
            largest = np.where(is_last, y, -np.inf).argmax(axis=0)
            self.count("ties that are broken the other way", (largest < 2).sum())
        return int(is_tie.sum())

    def check_hull(self, boundary: np.ndarray) -> None:
        """Checks that the boundary is one closed chain that winds once and never turns right."""
        what = "boundary edges that are not in one convex closed chain"
        after = dict(zip(self.start[boundary].tolist(), self.end[boundary].tolist()))
        if len(after) < len(boundary):
            self.count(what, len(boundary) - len(after))
            return
        chain = []
        at = next(iter(after), None)
        while at is not None:
            chain.append(at)
            at = after.pop(at, None)
        if after or len(chain) < 4 or chain[0] != chain[-1]:
            self.count(what, max(len(after), 1))
            return
        p = self.xy[chain[:-1]]
        before, following = np.roll(p, 1, axis=0), np.roll(p, -1, axis=0)
        turns = orientations(before, p, following)
        # An edge goes up (or to the right) or down; a chain that winds once changes from down to up once.
        goes_down = (following[:, 1] < p[:, 1]) | ((following[:, 1] == p[:, 1]) & (following[:, 0] < p[:, 0]))
        rises = (np.roll(goes_down, 1) & ~goes_down).sum()
        self.count(what, (turns < 0).sum() + abs(int(rises) - 1))

    def check_neighbors(self, first: np.ndarray, second: np.ndarray, boundary: np.ndarray) -> None:
        if self.neighbors is None or not self.are_all_good or len(self.neighbors) != len(self.all):
            return
        stored = np.asarray(self.neighbors).reshape(-1)
        wrong = (stored[first] != second // 3).sum() + (stored[second] != first // 3).sum()
        wrong += (stored[boundary] != -1).sum()
        self.count("neighbours that are not those over the edge", wrong)


def _are_collinear(points: np.ndarray) -> bool:
    distinct = np.unique(points, axis=0)
    if len(distinct) < 3:
        return True
    ends = [np.broadcast_to(distinct[i], distinct.shape) for i in (0, -1)]
    return not orientations(ends[0], ends[1], distinct).any()
