# SPDX-License-Identifier: BSD-3-Clause
"""tipp.Delaunay and tipp.LinearNDInterpolator: the parts of scipy's classes that programs use, in the plane."""
from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np

from . import _arguments as check
from . import _core
from ._arrays import columns_of, converted, coordinates
from ._show import as_html, as_text, box_text, Rows


class Delaunay:
    """Exact Delaunay triangulation of points in the plane, with the attributes of scipy.spatial.Delaunay.

    Parameters
    ----------
    points
        (n, 2) coordinates, all finite.
    threads
        Number of threads; 0: OMP_NUM_THREADS, or one per processor.

    Attributes
    ----------
    points : (n, 2) float64
    simplices : (m, 3) int32
        Point ids, counter-clockwise. Of coincident points, only the one with the lowest id is in triangles.
    neighbors : (m, 3) int32
        For each corner the triangle across the opposite edge; -1 at the hull.
    convex_hull : (k, 2) int32
        The edges of the hull.
    coplanar : (d, 3) int32
        For each point left out because a point with a lower id has the same coordinates: its id, a triangle at that
        point, and that point's id.

    Raises
    ------
    ValueError
        If points have another shape than (n, 2), or are not finite.
    RuntimeError
        If there are fewer than three distinct points, or all are on one line.

    Examples
    --------
    >>> mesh = tipp.Delaunay(points)
    >>> mesh.find_simplex([[0.5, 0.5]])
    """

    ndim = 2

    def __init__(self, points: Any, *, threads: int = 0):
        array = coordinates(points)
        if array.shape[1] != 2:
            raise ValueError(f"points have the shape {array.shape}; give an array of shape (n, 2).")
        self.points = np.array(array, np.float64, order="C")  # a copy that callers cannot change
        if not np.isfinite(self.points).all():
            raise ValueError("points have a NaN or infinite coordinate; leave these points out.")
        self._threads = check.threads(threads)
        result = _core.triangulate(
            self.points, None, None, 0, False, False, 0.0, 0.0, 0, 0, False, self._threads, True, None)
        if len(result["triangles"]) == 0:
            raise RuntimeError(result["warnings"][0])
        self.simplices = result["triangles"].astype(np.int32, copy=False)
        self.neighbors = result["neighbors"].astype(np.int32)
        self._duplicates = result["duplicates"]

    @property
    def npoints(self) -> int:
        return len(self.points)

    @property
    def nsimplex(self) -> int:
        return len(self.simplices)

    @cached_property
    def convex_hull(self) -> np.ndarray:
        triangles, corners = np.nonzero(self.neighbors == -1)
        ends = [self.simplices[triangles, (corners + i) % 3] for i in (1, 2)]
        return np.column_stack(ends)

    @cached_property
    def vertex_to_simplex(self) -> np.ndarray:
        """A triangle at each point; -1 for points that were left out."""
        result = np.full(self.npoints, -1, np.int32)
        result[self.simplices.ravel()] = np.repeat(np.arange(self.nsimplex, dtype=np.int32), 3)
        return result

    @cached_property
    def coplanar(self) -> np.ndarray:
        point, kept = self._duplicates.T
        return np.column_stack([point, self.vertex_to_simplex[kept], kept]).astype(np.int32)

    @cached_property
    def vertex_neighbor_vertices(self) -> tuple[np.ndarray, np.ndarray]:
        """(indptr, indices): the neighbours of point k are indices[indptr[k]:indptr[k + 1]]."""
        edges = np.concatenate([self.simplices[:, [i, (i + 1) % 3]] for i in range(3)])
        edges = np.unique(np.concatenate([edges, edges[:, ::-1]]), axis=0)
        starts = np.searchsorted(edges[:, 0], np.arange(self.npoints + 1)).astype(np.int32)
        return starts, np.ascontiguousarray(edges[:, 1])

    @cached_property
    def _locator(self) -> Any:
        return _core.Locator(self.points, self.simplices, self.neighbors)

    def _rows(self) -> Rows:
        bounds = np.column_stack([self.points.min(axis=0), self.points.max(axis=0)]).ravel()
        return [("points", f"{self.npoints}, {box_text(bounds)}"), ("simplices", f"{self.nsimplex} triangles"),
                ("hull", f"{np.count_nonzero(self.neighbors == -1)} edges"),
                ("coplanar", f"{len(self._duplicates)} points left out")]

    def __repr__(self) -> str:
        return as_text("tipp.Delaunay", self._rows())

    def _repr_html_(self) -> str:
        return as_html("tipp.Delaunay", self._rows())

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name != "_locator"}

    def find_simplex(self, xi: Any, bruteforce: bool = False, tol: float | None = None) -> np.ndarray:
        """Returns the triangle that contains each point, its border included, or -1. The result is exact, so
        `bruteforce` and `tol` are not used. `xi` has x and y along its last axis."""
        queries, shape = _queries(xi)
        return self._locator.find(queries, self._threads).reshape(shape)


def _queries(xi: Any) -> tuple[np.ndarray, tuple[int, ...]]:
    """Returns the points as (n, 2) float64, and the shape of the results."""
    array = converted(columns_of(xi, "xi"), "xi")
    if array.ndim == 0 or array.shape[-1] != 2:
        raise ValueError(f"xi has the shape {array.shape}; give x and y along the last axis.")
    return np.ascontiguousarray(array.reshape(-1, 2), np.float64), array.shape[:-1]


class LinearNDInterpolator:
    """Interpolates linearly in each triangle of the exact Delaunay triangulation, as
    scipy.interpolate.LinearNDInterpolator.

    Parameters
    ----------
    points
        (n, 2) coordinates, or a tipp.Delaunay.
    values
        A value, or an array of values, for each point; real or complex.
    fill_value
        The value of points outside the hull.
    rescale
        Whether to triangulate the points after scaling them to the unit square.
    threads
        Number of threads; 0: OMP_NUM_THREADS, or one per processor.

    Examples
    --------
    >>> height = tipp.LinearNDInterpolator(points, z)
    >>> height(x, y)
    """

    def __init__(self, points: Any, values: Any, fill_value: float = np.nan, rescale: bool = False, *,
                 threads: int = 0):
        self._threads = check.threads(threads)
        self._is_rescaled = check.flag(rescale, "rescale")
        if not isinstance(points, Delaunay):
            if rescale:
                array = coordinates(points)
                self._offset = array.mean(axis=0)
                extent = np.ptp(array, axis=0)
                self._scale = np.where(extent > 0, extent, 1.0)
                points = (array - self._offset) / self._scale
            points = Delaunay(points, threads=threads)
        elif rescale:
            raise ValueError("rescale needs points, not a Delaunay; scale the points of the Delaunay.")
        self.tri = points
        array = np.asarray(values)
        if array.dtype.kind not in "fiubc" or array.ndim == 0:
            raise TypeError(f"values are of type {array.dtype}; give a number for each point.")
        if len(array) != self.tri.npoints:
            raise ValueError(f"there are {len(array)} values for {self.tri.npoints} points.")
        self.fill_value = fill_value
        self._is_complex = array.dtype.kind == "c"
        self._shape = array.shape[1:]
        flat = np.ascontiguousarray(array.reshape(len(array), -1), np.complex128 if self._is_complex else np.float64)
        self.values = flat
        self._columns = flat.view(np.float64)

    def __call__(self, *xi: Any) -> np.ndarray:
        """Returns the values at points of shape (..., 2), or at x and y, which are broadcast."""
        if len(xi) == 2:
            xi = (np.stack(np.broadcast_arrays(*(converted(one, "xi") for one in xi)), axis=-1),)
        if len(xi) != 1:
            raise TypeError(f"there are {len(xi)} arguments; give points, or x and y.")
        queries, shape = _queries(xi[0])
        if self._is_rescaled:
            queries = (queries - self._offset) / self._scale
        fill = np.nan if self._is_complex else float(self.fill_value)
        samples = self.tri._locator.interpolate(queries, self._columns, fill, self._threads)
        if self._is_complex:
            samples = samples.view(np.complex128)
            samples[self.tri._locator.find(queries, self._threads) < 0] = self.fill_value
        return samples.reshape((*shape, *self._shape))
