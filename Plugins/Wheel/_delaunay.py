# SPDX-License-Identifier: BSD-3-Clause
"""tipp.Delaunay: scipy.spatial.Delaunay with exact results, in the plane and in space."""
from __future__ import annotations

import functools
from functools import cached_property
from typing import Any

import numpy as np

from . import _arguments as check
from . import _core
from ._arrays import columns_of, converted, coordinates
from ._show import as_html, as_text, box_text, Rows

# By dimension: the corners of the facet opposite to each corner, so that facets face outward.
_FACETS = {2: np.array([[1, 2], [2, 0], [0, 1]]),
           3: np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])}
_KEPT = ("points", "simplices", "_duplicates", "_threads", "_is_incremental")


class Delaunay:
    """Exact Delaunay triangulation of points in the plane or in space, with the attributes of scipy.spatial.Delaunay.

    Parameters
    ----------
    points
        (n, 2) or (n, 3) coordinates, all finite.
    furthest_site
        Must be False; scipy's furthest-site triangulation does not exist here.
    incremental
        Whether add_points() may be called.
    qhull_options
        Must be None: the result is exact without any options.
    threads
        The number of threads; 0: OMP_NUM_THREADS, else one per processor.

    Attributes
    ----------
    ndim, npoints, nsimplex : int
        The dimension d (2 or 3), the number of points, and the number m of triangles or tetrahedra.
    points : (n, d) float64
    simplices : (m, d + 1) int32
        Point ids. Triangles are counter-clockwise; the volume of tetrahedra, as a determinant, is positive. Of
        coincident points, only the one with the lowest id is a corner.

    Raises
    ------
    ValueError
        If points have another shape, or are not finite; or if furthest_site or qhull_options are given.
    RuntimeError
        If all points are on one line or, in space, in one plane; or if there are fewer than d + 1 distinct points.

    Examples
    --------
    >>> mesh = tipp.Delaunay(points)
    >>> mesh.find_simplex([[0.5, 0.5]])
    """

    furthest_site = False

    def __init__(self, points: Any, furthest_site: bool = False, incremental: bool = False, qhull_options: Any = None,
                 *, threads: int = 0):
        if check.flag(furthest_site, "furthest_site"):
            raise ValueError("furthest_site is True; tipp has no furthest-site triangulation: use scipy's.")
        if qhull_options is not None:
            raise ValueError("qhull_options are Qhull's; the result is exact without options: leave them out.")
        self._is_incremental = check.flag(incremental, "incremental")
        self._threads = check.threads(threads)
        self._triangulate(coordinates(points))

    def _triangulate(self, points: np.ndarray) -> None:
        points = np.array(points, np.float64, order="C")  # a copy that callers cannot change
        if points.shape[1] == 2:
            result = _core.triangulate(
                points, None, None, 0, False, False, 0.0, 0.0, 0, 0, False, self._threads, False, True, None)
            simplices = result["triangles"]
        else:
            result = _core.tetrahedralize(points, 0.0, 0, self._threads, False, None)
            simplices = result["cells"]
        if len(result["rejected"]):
            raise ValueError("points have a NaN or infinite coordinate; leave these points out.")
        if simplices.shape[1] == points.shape[1]:
            raise RuntimeError("No tetrahedra: all points are in one plane; give coordinates in it, of shape (n, 2).")
        if len(simplices) == 0:
            raise RuntimeError(result["warnings"][0])
        self.points = points
        self.simplices = simplices.astype(np.int32, copy=False)
        self._duplicates = result["duplicates"]

    def __getstate__(self) -> dict[str, Any]:
        return {name: self.__dict__[name] for name in _KEPT}

    def _rows(self) -> Rows:
        bounds = np.column_stack([self.min_bound, self.max_bound]).ravel()
        kinds = ("triangles", "edges") if self.ndim == 2 else ("tetrahedra", "triangles")
        return [("points", f"{self.npoints}, {box_text(bounds)}"), ("simplices", f"{self.nsimplex} {kinds[0]}"),
                ("hull", f"{np.count_nonzero(self.neighbors == -1)} {kinds[1]}"),
                ("coplanar", f"{len(self._duplicates)} points left out")]

    def __repr__(self) -> str:
        return as_text("tipp.Delaunay", self._rows())

    def _repr_html_(self) -> str:
        return as_html("tipp.Delaunay", self._rows())

    @property
    def ndim(self) -> int:
        return self.points.shape[1]

    @property
    def npoints(self) -> int:
        return len(self.points)

    @property
    def nsimplex(self) -> int:
        return len(self.simplices)

    @cached_property
    def neighbors(self) -> np.ndarray:
        """(m, d + 1) int32: for each corner the cell across the opposite edge or facet; -1 at the hull."""
        return _core.neighbors(self.simplices)

    @cached_property
    def min_bound(self) -> np.ndarray:
        """(d,) lowest coordinates of the points."""
        return self.points.min(axis=0)

    @cached_property
    def max_bound(self) -> np.ndarray:
        """(d,) highest coordinates of the points."""
        return self.points.max(axis=0)

    @cached_property
    def convex_hull(self) -> np.ndarray:
        """(k, d) point ids of the edges or facets of the hull, counter-clockwise seen from outside."""
        cells, corners = np.nonzero(self.neighbors == -1)
        return self.simplices[cells[:, np.newaxis], _FACETS[self.ndim][corners]]

    @cached_property
    def vertex_to_simplex(self) -> np.ndarray:
        """(n,) a cell at each point; -1 for points that were left out."""
        result = np.full(self.npoints, -1, np.int32)
        result[self.simplices.ravel()] = np.repeat(np.arange(self.nsimplex, dtype=np.int32), self.ndim + 1)
        return result

    @cached_property
    def coplanar(self) -> np.ndarray:
        """(k, 3) for each point left out because a point with a lower id has the same coordinates: its id, a cell at
        that point, and that point's id."""
        point, kept = self._duplicates.T
        return np.column_stack([point, self.vertex_to_simplex[kept], kept]).astype(np.int32)

    @cached_property
    def vertex_neighbor_vertices(self) -> tuple[np.ndarray, np.ndarray]:
        """(indptr, indices): the neighbours of point k are indices[indptr[k]:indptr[k + 1]]."""
        columns = self.simplices.T.astype(np.int64)
        pairs = [a * self.npoints + b for i, a in enumerate(columns) for j, b in enumerate(columns) if i != j]
        first, second = np.divmod(np.unique(np.concatenate(pairs)), self.npoints)
        return (np.searchsorted(first, np.arange(self.npoints + 1)).astype(np.int32), second.astype(np.int32))

    @cached_property
    def transform(self) -> np.ndarray:
        """(m, d + 1, d) affine maps to barycentric coordinates. With T = transform[i, :d] and r = transform[i, d], which
        is the last corner of cell i, the first d coordinates of x are T @ (x - r), and all d + 1 add up to 1. NaN for
        cells whose determinant rounds to 0."""
        corners = self.points[self.simplices]
        last = corners[:, -1]
        sides = np.moveaxis(corners[:, :-1] - corners[:, -1:], 1, 0)
        if self.ndim == 2:
            (a, b) = sides
            rows = np.stack([np.stack([b[:, 1], -b[:, 0]], axis=-1), np.stack([-a[:, 1], a[:, 0]], axis=-1)], axis=1)
        else:
            a, b, c = sides
            rows = np.stack([np.cross(b, c), np.cross(c, a), np.cross(a, b)], axis=1)
        volume = np.einsum("ij,ij->i", sides[0], rows[:, 0])
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            rows /= volume[:, np.newaxis, np.newaxis]
        rows[~np.isfinite(rows).all(axis=(1, 2))] = np.nan
        return np.concatenate([rows, last[:, np.newaxis]], axis=1)

    @cached_property
    def _paraboloid(self) -> tuple[float, float]:
        squares = (self.points ** 2).sum(axis=1)
        # As Qhull's Qbb and Qz: to the range of the coordinates, with a point at infinity 10 % above the highest one.
        scale = float(np.abs(self.points).max() / (1.1 * squares.max() - squares.min()))
        return scale, float(-squares.min() * scale)

    @property
    def paraboloid_scale(self) -> float:
        return self._paraboloid[0]

    @property
    def paraboloid_shift(self) -> float:
        return self._paraboloid[1]

    def lift_points(self, x: Any) -> np.ndarray:
        """Returns points (..., d) lifted to the paraboloid: (..., d + 1), with scale * |x|**2 + shift as the last
        coordinate."""
        points, shape = self._queries(x, "x")
        scale, shift = self._paraboloid
        lifted = np.column_stack([points, (points ** 2).sum(axis=1) * scale + shift])
        return lifted.reshape(*shape, self.ndim + 1)

    @cached_property
    def equations(self) -> np.ndarray:
        """(m, d + 2) unit normal, pointing down, and offset of each cell's plane through its corners on the
        paraboloid."""
        lifted = self.lift_points(self.points)[:, -1][self.simplices]
        gradient = np.einsum("ij,ijk->ik", lifted[:, :-1] - lifted[:, -1:], self.transform[:, :-1])
        at = lifted[:, -1] - np.einsum("ij,ij->i", gradient, self.transform[:, -1])
        planes = np.column_stack([gradient, np.full(self.nsimplex, -1.0), at])
        return planes / np.sqrt(1 + (gradient ** 2).sum(axis=1))[:, np.newaxis]

    def plane_distance(self, xi: Any) -> np.ndarray:
        """Returns the distances (..., m) of points (..., d), lifted to the paraboloid, from the planes of all cells.
        Those of cells whose circumscribed circle or sphere has the point inside are positive."""
        lifted = self.lift_points(xi)
        return lifted @ self.equations[:, :-1].T + self.equations[:, -1]

    @cached_property
    def _locator(self) -> Any:
        if self.ndim == 2:
            return _core.Locator(self.points, self.simplices, self.neighbors)
        return _Tetrahedra(self)

    def find_simplex(self, xi: Any, bruteforce: bool = False, tol: float | None = None) -> np.ndarray:
        """Returns the cell that contains each point (..., d), its border included, or -1. The result is exact, so
        `bruteforce` and `tol` are not used."""
        points, shape = self._queries(xi, "xi")
        return self._locator.find(points, self._threads).reshape(shape)

    def _queries(self, points: Any, name: str) -> tuple[np.ndarray, tuple[int, ...]]:
        """Returns the points as (n, d) float64, and the shape of the results."""
        array = converted(columns_of(points, name), name)
        if array.ndim == 0 or array.shape[-1] != self.ndim:
            raise ValueError(f"{name} has the shape {array.shape}; give {'x and y' if self.ndim == 2 else 'x, y and z'} "
                             "along the last axis.")
        return np.ascontiguousarray(array.reshape(-1, self.ndim), np.float64), array.shape[:-1]

    def add_points(self, points: Any, restart: bool = False) -> None:
        """Adds points (k, d) after the others, if the object was made with incremental=True. All points are triangulated
        again, which takes as long as a new object; so `restart` makes no difference. Raises RuntimeError after
        close()."""
        if not self._is_incremental:
            raise RuntimeError("no points can be added: make the Delaunay with incremental=True, and do not close it.")
        more = coordinates(points)
        if more.shape[1] != self.ndim:
            raise ValueError(f"points have the shape {more.shape}; give an array of shape (n, {self.ndim}).")
        self._triangulate(np.concatenate([self.points, more]))
        self.__dict__ = self.__getstate__()  # without what was computed from the former cells

    def close(self) -> None:
        """Ends adding points."""
        self._is_incremental = False

    def to_scipy(self) -> Any:
        """Returns a scipy.spatial.Delaunay of these cells, for functions that take nothing else, such as
        CloughTocher2DInterpolator. Raises ModuleNotFoundError without scipy."""
        return _scipys_class()(self)


class _Tetrahedra:
    """Finds tetrahedra and interpolates in them, as the class Locator does for triangles."""

    def __init__(self, mesh: Delaunay) -> None:
        self._mesh = mesh.simplices
        self._query = _core.Query(mesh.points, mesh.simplices, {}, {}, None, mesh._threads)

    def find(self, points: np.ndarray, _threads: int) -> np.ndarray:
        return self._query.locate(points)[0].astype(np.int32)

    def interpolate(self, points: np.ndarray, values: np.ndarray, fill: float, _threads: int) -> np.ndarray:
        cells, weights = self._query.locate(points)
        inside = np.flatnonzero(cells >= 0)
        samples = np.full((len(points), values.shape[1]), fill)
        samples[inside] = np.einsum("ij,ijk->ik", weights[inside], values[self._mesh[cells[inside]]])
        return samples


@functools.lru_cache(maxsize=None)
def _scipys_class() -> type:
    """Returns a subclass of scipy's class whose attributes are those of a Delaunay here."""
    from scipy.spatial import Delaunay as Base

    def init(self: Any, mesh: Delaunay) -> None:
        self._mesh = mesh

    names = ("ndim", "npoints", "nsimplex", "points", "simplices", "neighbors", "equations", "paraboloid_scale",
             "paraboloid_shift", "transform", "vertex_to_simplex", "vertex_neighbor_vertices", "min_bound", "max_bound",
             "convex_hull", "coplanar", "furthest_site")
    shared = {name: property(lambda self, name=name: getattr(self._mesh, name)) for name in names}
    return type("Delaunay", (Base,), {"__init__": init, "__reduce__": lambda self: (Delaunay.to_scipy, (self._mesh,)),
                                      "_qhull": None, **shared})
