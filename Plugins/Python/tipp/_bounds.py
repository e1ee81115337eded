# SPDX-License-Identifier: BSD-3-Clause
"""Ranges: in VTK's order of numbers, as tipp.Bounds, or those of an object. No other library is imported."""
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Iterable, Mapping, Protocol, Union

from ._arguments import is_vtk_object, number, several, shown

ORDER = "(xmin, xmax, ymin, ymax) or (xmin, xmax, ymin, ymax, zmin, zmax)"


class HasBounds(Protocol):
    """An object with bounds: a data set, a geometry, a raster."""

    @property
    def bounds(self) -> Any: ...


@dataclass(frozen=True, init=False)
class Bounds:
    """A range in the plane whose sides are named, so that their order cannot be mistaken.

    Parameters
    ----------
    west, south, east, north
        The lowest x, the lowest y, the highest x and the highest y, in the units of the points.

    Raises
    ------
    TypeError, ValueError
        If one is no finite number, or if west is above east or south above north.

    Examples
    --------
    >>> tipp.Bounds(west=0, south=10, east=5, north=20).bounds
    (0.0, 5.0, 10.0, 20.0)
    """

    west: float
    south: float
    east: float
    north: float

    def __init__(self, *, west: float, south: float, east: float, north: float) -> None:
        for name, value in (("west", west), ("south", south), ("east", east), ("north", north)):
            object.__setattr__(self, name, number(value, name))
        if self.west > self.east or self.south > self.north:
            raise ValueError(f"the range is from west {self.west:.10g} to east {self.east:.10g} and from south "
                             f"{self.south:.10g} to north {self.north:.10g}; give the lower number of each first.")

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """(xmin, xmax, ymin, ymax), the order of all ranges in this package, of VTK and of PyVista."""
        return self.west, self.east, self.south, self.north

    @property
    def extent(self) -> tuple[float, float, float, float]:
        """(west, south, east, north), the order of GDAL, rasterio and Shapely."""
        return self.west, self.south, self.east, self.north


BoundsLike = Union[Iterable[float], Bounds, HasBounds]
"""What functions accept as a range: see bounds_of()."""


def bounds_of(value: Any, name: str, *, check: Any = number) -> list[float]:
    """Returns a range as 4 or 6 numbers in VTK's order.

    `value` has 4 or 6 numbers in this order, or is a tipp.Bounds or another object with bounds. Each library has its own
    order, so objects of others are refused. `check` converts each number.
    """
    numbers = _in_vtk_order(value, name)
    if len(numbers) not in (4, 6):
        raise ValueError(f"{name} has {len(numbers)} bounds; give 4 or 6: {ORDER}.")
    return several(numbers, name, len(numbers), check)


def open_bound(value: Any, name: str) -> float:
    """Returns a bound that may be infinite, but not NaN."""
    result = number(value, name, finite=False)
    if math.isnan(result):
        raise ValueError(f"{name} is nan; give a number.")
    return result


def _in_vtk_order(value: Any, name: str) -> list[Any]:
    if is_vtk_object(value):
        if not hasattr(value, "GetBounds"):
            raise TypeError(f"{name} is a {value.GetClassName()}, which has no bounds; give a data set.")
        return list(value.GetBounds())
    if hasattr(value, "left") and hasattr(value, "top"):  # rasterio's BoundingBox, which is a tuple, too
        return [value.left, value.right, value.bottom, value.top]
    if isinstance(value, Iterable) and not isinstance(value, (str, bytes, Mapping, set, frozenset)) and not _library(value):
        return list(value)
    found = _of_library(value, name)
    if found is None:
        raise TypeError(f"{name} is {shown(value)}; give {ORDER}, a tipp.Bounds, or a data set, geometry or raster "
                        "with bounds.")
    return found


def _library(value: Any) -> str:
    """Returns which library's object with bounds this is; empty for others."""
    packages = {kind.__module__.split(".")[0] for kind in type(value).__mro__}
    known = ("tipp", "shapely", "geopandas", "rasterio", "xarray")
    return next((package for package in known if package in packages), "")


def _of_library(value: Any, name: str) -> list[Any] | None:
    library = _library(value)
    if library == "tipp":
        return list(value.bounds) if hasattr(value, "bounds") else None
    if library == "rasterio":
        return _in_vtk_order(value.bounds, name) if hasattr(value, "bounds") else None
    if library == "geopandas":
        west, south, east, north = value.total_bounds
    elif library == "shapely":
        west, south, east, north = value.bounds
    elif library == "xarray":
        if not hasattr(value, "rio"):
            raise TypeError(f"{name} is an xarray object, whose bounds rioxarray knows; import rioxarray.")
        west, south, east, north = value.rio.bounds()
    else:
        return None
    return [west, east, south, north]
