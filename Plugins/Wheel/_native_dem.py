# SPDX-License-Identifier: BSD-3-Clause
"""tipp.dem in the wheel. Arguments have been checked."""
from __future__ import annotations

import math
from typing import Any

import numpy as np

from . import _arguments as check
from . import _core
from ._arrays import attributes, coordinates
from ._native_run import plain, triangulated, warn
from ._progress import Progress, finish
from ._rasters import bounds_of, grid_over, sampling_of, uncompressed
from ._terrain import DERIVED, derived, needs_elevation, selected

_TRIANGULATION = {"tolerance": 0.0, "partitions": (0, 0), "schedule": 1}


def dem(points: Any, point_data: Any, options: dict[str, Any],
        progress: Progress | None) -> tuple[list[np.ndarray], tuple[float, ...], str | None]:
    """The bands of the attributes from the north to the south, their transform and the CRS of points in files."""
    names, size, crs = options["attributes"], options["resolution"], None
    if check.is_vtk_object(points):
        from ._vtk import arrays_of, xyz_of

        array, data = plain(xyz_of(points)), arrays_of(points.GetPointData())
    elif isinstance(points, list) and points and isinstance(points[0], str):
        array, data, crs = read_points(points, options)
    else:
        array = plain(coordinates(points))
        data = attributes(point_data, len(array))
        if array.shape[1] == 2 and needs_elevation(options):
            raise ValueError("points have no elevation; give an array of shape (n, 3) or other attributes.")
    if array.shape[1] == 2:
        array = np.column_stack([array, np.zeros(len(array), array.dtype)])
    if options["thin"] or options["duplicates"] != "first":
        single = {name: values for name, values in data.items() if values.ndim == 1}
        array, data = selected(array.astype(np.float64), single, options)
    grid = grid_over(options["bounds"] or bounds_of(array[:, :2]), size, options["align"])
    if "elevation" in names and "elevation" not in data:
        data = {**data, "elevation": np.ascontiguousarray(array[:, 2])}
    of_points = [name for name in names if name not in DERIVED]
    of_triangles = [name for name in names if name in DERIVED]
    for name in of_points:
        if name not in data:
            raise KeyError(f"there is no attribute '{name}'; there are {[*data]}.")
    half = None if progress is None else lambda done: progress(0.5 * done)
    result = triangulated(array, {**_TRIANGULATION, **options}, half)
    corners = array.astype(np.float64)[result["triangles"]] if of_triangles else None
    rest = None if progress is None else lambda done: progress(0.5 + 0.5 * done)
    *_, samples, _, notes = _core.resample(
        np.ascontiguousarray(array), result["triangles"], None,
        [np.ascontiguousarray(data[name]) for name in of_points],
        [np.ascontiguousarray(derived(name, corners)) for name in of_triangles], sampling_of(grid, size), [1, 1, 1], [size, size, 0.0],
        math.nan, "openmp", options["threads"], rest)
    finish(progress)
    warn([*result["warnings"], *notes])
    west, south, columns, rows = grid
    sampled = {name: band.reshape(rows, columns)[::-1] for name, band in zip([*of_points, *of_triangles], samples)}
    if "void" in sampled:
        sampled["void"] = np.where(np.isnan(sampled["void"]), 1.0, sampled["void"])
    bands = [sampled[name] for name in names]
    return bands, (size, 0.0, west, 0.0, -size, south + rows * size), crs or None


def read_points(paths: list[str], options: dict[str, Any]) -> tuple[np.ndarray, dict[str, np.ndarray], str]:
    """Coordinates (n, 3), the columns by name, and the coordinate reference system."""
    names = options["attributes"]
    wanted = None if names is None else [*(name for name in names if name not in DERIVED), "z", "Z"]
    with uncompressed(paths) as files:
        xy, columns, crs = _core.read_points(files, wanted, options["classes"] or [], options["returns"], options["keep"])
    z = next((columns.pop(name) for name in ("z", "Z") if name in columns), np.zeros(len(xy)))
    return np.column_stack([xy, z]), columns, crs
