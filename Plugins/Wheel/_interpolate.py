# SPDX-License-Identifier: BSD-3-Clause
"""tipp.LinearNDInterpolator and tipp.griddata: scipy's, over exact triangulations."""
from __future__ import annotations

from typing import Any

import numpy as np

from . import _arguments as check
from ._arrays import columns_of, converted, coordinates
from ._delaunay import Delaunay

_METHODS = {"linear": 0, "nearest": 1, "cubic": 2}


def _joined(given: tuple[Any, ...], name: str) -> np.ndarray:
    """Returns arrays of each coordinate, which are broadcast, as one array with the coordinates along its last axis."""
    arrays = [converted(one, name) for one in given]
    try:
        return np.stack(np.broadcast_arrays(*arrays), axis=-1)
    except ValueError:
        shapes = " and ".join(str(array.shape) for array in arrays)
        raise ValueError(f"{name} has coordinates of the shapes {shapes}; give arrays that can be broadcast.") from None


def _points_of(points: Any) -> np.ndarray:
    """Returns (n, d) points of an array or table, or of a tuple of coordinates."""
    return coordinates(_joined(points, "points") if isinstance(points, tuple) and points else points)


def _fill(value: Any, is_complex: bool) -> Any:
    """Returns the value outside the hull as a number of the values' kind."""
    array = np.asarray(value)
    if array.ndim or array.dtype.kind not in ("fiubc" if is_complex else "fiub"):
        raise TypeError(f"fill_value is of type {array.dtype if array.ndim == 0 else type(value).__name__}; give a "
                        f"{'complex' if is_complex else 'real'} number.")
    return complex(value) if is_complex else float(value)


class _Scaled:
    """Moves points by their mean and, if rescaled, to unit extents."""

    def __init__(self, points: np.ndarray):
        self._offset = points.mean(axis=0)
        extent = np.ptp(points, axis=0)
        self._scale = np.where(extent > 0, extent, 1.0)

    def __call__(self, points: np.ndarray) -> np.ndarray:
        return (points - self._offset) / self._scale


class LinearNDInterpolator:
    """Interpolates linearly in each triangle or tetrahedron of the exact Delaunay triangulation, as
    scipy.interpolate.LinearNDInterpolator.

    Parameters
    ----------
    points
        (n, d) coordinates with d = 2 or 3; a tuple of d arrays with n coordinates; or a tipp.Delaunay.
    values
        A value, or an array of values, for each point; real or complex.
    fill_value
        The value of points outside the hull.
    rescale
        Whether to triangulate the points after scaling them to the unit square or cube.
    threads
        Number of threads; 0: OMP_NUM_THREADS, or one per processor.

    Attributes
    ----------
    tri : tipp.Delaunay

    Raises
    ------
    TypeError, ValueError
        If an argument is of a wrong type, shape or value.
    RuntimeError
        As tipp.Delaunay.

    Examples
    --------
    >>> height = tipp.LinearNDInterpolator(points, z)
    >>> height(x, y)
    """

    def __init__(self, points: Any, values: Any, fill_value: float = np.nan, rescale: bool = False, *,
                 threads: int = 0):
        self._threads = check.threads(threads)
        self._scaled: _Scaled | None = None
        is_rescaled = check.flag(rescale, "rescale")
        if isinstance(points, Delaunay):
            if is_rescaled:
                raise ValueError("rescale needs points, not a Delaunay; scale the points of the Delaunay.")
            self.tri = points
        else:
            array = _points_of(points)
            if is_rescaled:
                self._scaled = _Scaled(array)
                array = self._scaled(array)
            self.tri = Delaunay(array, threads=threads)
        array = np.asarray(values)
        if array.dtype.kind not in "fiubc" or array.ndim == 0:
            raise TypeError(f"values are of type {array.dtype}; give a number for each point.")
        if len(array) != self.tri.npoints:
            raise ValueError(f"values have another length than points: {len(array)} values for {self.tri.npoints} "
                             "points; give one for each.")
        self._is_complex = array.dtype.kind == "c"
        self.fill_value = _fill(fill_value, self._is_complex)
        self._shape = array.shape[1:]
        flat = np.ascontiguousarray(array.reshape(len(array), -1), np.complex128 if self._is_complex else np.float64)
        self.values = flat
        self._columns = flat.view(np.float64)

    def __call__(self, *xi: Any) -> np.ndarray:
        """Returns the values at points of shape (..., d), or at d arrays of coordinates, also as a tuple, which are
        broadcast. A single point of shape (d,) gives one value in an array."""
        given = xi[0] if len(xi) == 1 else xi
        array = _joined(given, "xi") if isinstance(given, tuple) and given else converted(columns_of(given, "xi"), "xi")
        if array.ndim == 1 and not isinstance(given, tuple):
            array = array[np.newaxis]
        queries, shape = self.tri._queries(array, "xi")
        if self._scaled is not None:
            queries = self._scaled(queries)
        fill = np.nan if self._is_complex else self.fill_value
        samples = self.tri._locator.interpolate(queries, self._columns, fill, self._threads)
        if self._is_complex:
            samples = samples.view(np.complex128)
            samples[self.tri._locator.find(queries, self._threads) < 0] = self.fill_value
        return samples.reshape((*shape, *self._shape))


def griddata(points: Any, values: Any, xi: Any, method: str = "linear", fill_value: float = np.nan,
             rescale: bool = False, *, threads: int = 0) -> np.ndarray:
    """Interpolates scattered values, as scipy.interpolate.griddata.

    Parameters
    ----------
    points
        (n, d) coordinates with d = 2 or 3, or a tuple of d arrays with n coordinates.
    values
        A value, or an array of values, for each point; real or complex.
    xi
        Points of shape (..., d), or a tuple of d arrays of coordinates, which are broadcast.
    method
        "linear": in the triangles or tetrahedra of the exact Delaunay triangulation. "nearest": the value of the
        nearest point. "cubic": scipy's Clough-Tocher interpolation in the exact triangles, in the plane only. The last
        two need scipy.
    fill_value
        The value of points outside the hull. "nearest" has no outside.
    rescale
        Whether to scale the points to the unit square or cube first.
    threads
        The number of threads; 0: OMP_NUM_THREADS, else one per processor.

    Returns
    -------
    numpy.ndarray
        A value for each point, in the shape of xi.

    Raises
    ------
    TypeError, ValueError
        If an argument is of a wrong type, shape or value.
    RuntimeError
        As tipp.Delaunay; or if the method needs scipy, which is not installed.

    Examples
    --------
    >>> heights = tipp.griddata((x, y), z, (grid_x, grid_y))
    """
    check.choice(method, "method", _METHODS)
    if method == "linear":
        return LinearNDInterpolator(points, values, fill_value, rescale, threads=threads)(xi)
    array = _points_of(points)
    if method == "cubic" and array.shape[1] != 2:
        raise ValueError("method is 'cubic', which is for points in the plane; give 'linear' or 'nearest' in space.")
    try:
        from scipy.interpolate import CloughTocher2DInterpolator, NearestNDInterpolator
    except ModuleNotFoundError:
        raise RuntimeError(f"method='{method}' needs scipy, which is not installed; install it, or give 'linear'.") from None
    if method == "nearest":
        return NearestNDInterpolator(array, values, rescale=check.flag(rescale, "rescale"))(xi)
    scaled = _Scaled(array) if check.flag(rescale, "rescale") else lambda points: points
    mesh = Delaunay(scaled(array), threads=threads)
    queries = _joined(xi, "xi") if isinstance(xi, tuple) else np.atleast_2d(converted(columns_of(xi, "xi"), "xi"))
    return CloughTocher2DInterpolator(mesh.to_scipy(), values, fill_value)(scaled(queries))
