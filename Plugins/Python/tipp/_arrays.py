# SPDX-License-Identifier: BSD-3-Clause
"""Arrays of points and values: conversions and checks."""
from __future__ import annotations

from typing import Any, Mapping, TYPE_CHECKING

import numpy as np

from ._arguments import is_vtk_object
from ._geometry import is_geometry, points_of
from ._xarray import is_xarray, raster_points, Table

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


def grid_position(origin: float, step: float, halves: int) -> float:
    """Returns origin + halves / 2 * step, computed with the numbers as they are written, and rounded once."""
    from fractions import Fraction  # takes a fifth of the time in which the package is loaded

    return float(Fraction(repr(float(origin))) + Fraction(repr(float(step))) * halves / 2)


_DOUBLE = np.dtype(np.float64)


def converted(values: ArrayLike, name: str) -> np.ndarray:
    """Converts values to an array in the machine's byte order, of a type that VTK has.

    It shares the memory of `values` if possible. Masked entries become NaN. Raises TypeError or ValueError if the
    conversion would lose information.
    """
    try:
        array = values if isinstance(values, np.ma.MaskedArray) else np.asarray(values)
    except (TypeError, ValueError) as error:
        raise type(error)(f"{name} cannot be converted to an array of numbers; give rows of equal length.") from None
    kind, size = array.dtype.kind, array.dtype.itemsize
    if kind not in "fiub":
        raise TypeError(f"{name} is of type {array.dtype}; give real numbers.")
    if kind == "f" and size > 8:
        raise TypeError(f"{name} is of type {array.dtype}, which VTK does not have; give float64, "
                        "for example by astype(numpy.float64), which rounds.")
    if np.ma.is_masked(array):
        if kind != "f":
            raise ValueError(f"{name} has masked entries and is of type {array.dtype}, which has no NaN; give floats, "
                             "or a value for them, for example by filled(-1).")
        array = array.filled(np.nan)
    native = "u1" if kind == "b" else "f4" if kind == "f" and size == 2 else f"{kind}{size}"
    return np.asarray(array).astype(native, copy=False)


def coordinates(points: ArrayLike) -> np.ndarray:
    if type(points) is np.ndarray and points.dtype is _DOUBLE and points.ndim == 2 and points.shape[1] in (2, 3):
        return points  # the usual case, to keep small calls fast
    points = positions_of(points)
    if isinstance(points, np.ma.MaskedArray) and points.dtype.kind in "iu":
        points = np.ma.MaskedArray(_as_doubles(points.data, points.mask), points.mask)
    array = converted(points, "points")
    if array.ndim != 2 or array.shape[1] not in (2, 3):
        raise ValueError(f"points have the shape {array.shape}; give an array of shape (n, 2) or (n, 3).")
    if np.asarray(points).dtype.kind == "b":
        raise TypeError("points are of type bool; give real numbers.")
    return _as_doubles(array) if array.dtype.kind in "iu" and array.dtype.itemsize == 8 else array


def positions_of(points: Any) -> Any:
    """Returns the coordinates of tables, of laspy's LasData and others with xyz or x, y and z, of meshes of tipp and
    meshio, of rasters and variables of xarray, and of a GeoSeries and other geometries of points; other values as they
    are."""
    if isinstance(points, (np.ndarray, list)) or is_vtk_object(points):
        return points
    if is_mesh(points):
        return np.asarray(points.points)
    if is_xarray(points):
        if hasattr(points, "data_vars"):
            return columns_of(Table(points, "points"), "points")
        has_columns = points.ndim == 2 and points.shape[1] in (2, 3) and not points.coords
        return np.asarray(points) if has_columns else raster_points(points, "points")
    if hasattr(points, "geometry") or is_geometry(points):
        return points_of(points, "points")
    if hasattr(points, "columns"):
        return columns_of(points, "points")
    if hasattr(points, "xyz"):
        return np.asarray(points.xyz)
    if all(hasattr(points, axis) for axis in "xyz"):
        return np.column_stack([np.asarray(points.x), np.asarray(points.y), np.asarray(points.z)])
    return points


def is_mesh(value: Any) -> bool:
    """Returns whether the value is a mesh of arrays: a tipp.Mesh or a meshio.Mesh."""
    return hasattr(value, "points") and isinstance(getattr(value, "point_data", None), dict)


def cloud_of(points: Any, point_data: Any) -> tuple[Any, Any]:
    """Returns the points as positions_of(), and their data: those of a mesh and `point_data`."""
    if is_mesh(points):
        point_data = {**points.point_data, **attributes(point_data, len(points.points))}
    return positions_of(points), point_data


def columns_of(table: Any, name: str) -> Any:
    """Returns x, y and, if there are heights, z of a DataFrame or another table, by the names of its columns as in
    files. Other values, and tables whose columns only have numbers, are returned as they are."""
    if isinstance(table, (np.ndarray, list)) or not hasattr(table, "columns"):
        return table
    names = list(table.column_names if hasattr(type(table), "column_names") else table.columns)  # the former in pyarrow
    if len(names) < 2 or all(str(each).removeprefix("column_").isdigit() for each in names):  # column_0 in polars
        return table
    from . import _engine

    try:
        chosen = [names[i] for i in _engine.find_coordinates([str(each) for each in names])]
    except ValueError as error:
        raise ValueError(f"{name} is a table that {error}; give the columns of x and y (and z) as an array, such as "
                         "df[['a', 'b']].to_numpy().") from None
    if len(set(chosen)) < len(chosen):  # the two columns of one name
        return table
    columns = [converted(table[each], f"{name}['{each}']") for each in chosen]
    if len({column.dtype for column in columns}) > 1:  # NumPy would round large integers
        columns = [_as_doubles(column) if column.dtype.kind in "iu" else column for column in columns]
    return np.column_stack(columns)


def _as_doubles(integers: np.ndarray, mask: Any = False) -> np.ndarray:
    """Converts integers to doubles; raises ValueError if an unmasked one would be rounded."""
    doubles = integers.astype(np.float64)
    beyond = np.abs(doubles) >= 2.0**53
    if beyond.any():
        too_large = doubles >= (2.0**63 if integers.dtype.kind == "i" else 2.0**64)
        back = np.where(too_large, 0, doubles).astype(integers.dtype)
        rounded = beyond & (too_large | (back != integers)) & ~np.asarray(mask)
        if rounded.any():
            raise ValueError(f"points have {int(rounded.sum())} integers beyond 2**53 that a double cannot hold; "
                             "subtract an offset from them.")
    return doubles


def in_space(points: np.ndarray) -> np.ndarray:
    """Returns (n, 2) or (n, 3) points as (n, 3) points in C order; a missing z is 0."""
    if points.shape[1] == 3:
        return np.ascontiguousarray(points)
    spatial = np.zeros((len(points), 3), points.dtype)
    for axis in range(2):  # faster than copying both at once
        spatial[:, axis] = points[:, axis]
    return spatial


def attribute(name: str, values: ArrayLike, argument: str = "point_data") -> np.ndarray:
    """Returns an array with one value or row per point (or cell), as by converted(), in C order."""
    argument = f"{argument}['{name}']"
    array = converted(values, argument)
    if array.ndim not in (1, 2) or array.shape[-1:] == (0,) and array.ndim == 2:
        raise ValueError(f"{argument} has the shape {array.shape}; give one value or one row for each point.")
    return np.ascontiguousarray(array)


def attributes(point_data: Mapping[str, ArrayLike] | None, points: int) -> dict[str, np.ndarray]:
    """Returns the arrays of `point_data` after checking them."""
    if point_data is not None and not isinstance(point_data, Mapping):
        raise TypeError("point_data is not a mapping; give a dictionary of arrays by name.")
    result = {}
    for name, values in (point_data or {}).items():
        if not isinstance(name, str):
            raise TypeError(f"point_data has the key {name!r}; give names as keys.")
        result[name] = attribute(name, values)
        if len(result[name]) != points:
            raise ValueError(f"point_data['{name}'] has {len(result[name])} values for {points} points.")
    return result


def require_values(name: str, found: int, due: int, of: str) -> None:
    """Raises RuntimeError if an array has fewer values than there are points or cells."""
    if found < due:
        raise RuntimeError(f"the array '{name}' has {found} values for {due} {of}; repair it or write it again.")
