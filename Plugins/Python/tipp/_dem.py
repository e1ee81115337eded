# SPDX-License-Identifier: BSD-3-Clause
"""tipp.dem: makes a raster from points."""
from __future__ import annotations

import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Iterator, Mapping, Sequence

import numpy as np

from . import _arguments as check
from . import _engine
from ._arguments import ProgressBar, progress_of
from ._arrays import cloud_of, columns_of, converted, grid_position, in_space
from ._bounds import bounds_of, BoundsLike
from ._data import imported
from ._geometry import is_geometry, items_of, lines_of as lines_of_geometry, oriented_rings_of
from ._show import as_html, as_text, box_text, Rows

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

_RETURNS = {"all": 0, "first": 1, "last": 2}
_DUPLICATES = {"first": 0, "min": 1, "max": 2, "mean": 3}
_THINNINGS = {"min": 0, "max": 1, "nearest": 2}
_FLAGS = ("withheld", "synthetic", "overlap", "truncated", "uncounted")


@dataclass(frozen=True, eq=False, repr=False)
class Dem:
    """A raster of one or more bands in rasterio's layout: rows from north to south.

    `array, transform, crs = tipp.dem(...)` unpacks it, and numpy.asarray() returns the array.

    Attributes
    ----------
    array : (rows, columns) or (bands, rows, columns)
        NaN where there is no triangle. It has an axis of bands if `attributes` was a list.
    transform : tuple
        (width, 0, west, 0, -height, north) of the pixels: the arguments of affine.Affine.
    crs : str or None
        WKT or "EPSG:code" of the points' file, if it has one.
    bands : tuple of str
        The name of each band.

    Examples
    --------
    >>> raster = tipp.dem(xyz, 0.5, attributes=["elevation", "slope"])
    >>> raster.sel(band="slope").array.shape
    (200, 200)
    """

    array: NDArray[np.float64]
    transform: tuple[float, float, float, float, float, float]
    crs: str | None
    bands: tuple[str, ...]

    def __iter__(self) -> Iterator[Any]:
        return iter((self.array, self.transform, self.crs))

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        if copy is False and dtype is not None and np.dtype(dtype) != self.array.dtype:
            raise ValueError(f"the raster is of type {self.array.dtype}; another type needs a copy.")
        return np.array(self.array, dtype) if copy else np.asarray(self.array, dtype)

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """(xmin, xmax, ymin, ymax) of the pixels' borders, in the order of all ranges in this package."""
        width, _, west, _, height, north = self.transform
        rows, columns = self.array.shape[-2:]
        return west, grid_position(west, width, 2 * columns), grid_position(north, height, 2 * rows), north

    def sel(self, *, band: str) -> Dem:
        """Returns one band, whose array is (rows, columns). Raises KeyError if there is no such band."""
        if band not in self.bands:
            raise KeyError(f"there is no band '{band}'; there are {list(self.bands)}.")
        array = self.array if self.array.ndim == 2 else self.array[self.bands.index(band)]
        return Dem(array, self.transform, self.crs, (band,))

    def to_xarray(self) -> Any:
        """Converts to an xarray.DataArray with the coordinates band, y and x of the pixel centres.

        It states the missing value (NaN) and the coordinate reference system as rioxarray expects: `rio.nodata`,
        `rio.crs`, `rio.bounds()` and `rio.to_raster()` work, and so does `sel(band="slope")`. Its name is that of the
        band, or "dem" if there are several. Raises ModuleNotFoundError without xarray.
        """
        xarray = imported("xarray", "Dem.to_xarray()")
        width, _, west, _, height, north = self.transform
        rows, columns = self.array.shape[-2:]
        is_single = self.array.ndim == 2
        reference = {"GeoTransform": " ".join(repr(v) for v in (west, width, 0.0, north, 0.0, height))}
        if self.crs:
            reference.update(spatial_ref=self.crs, crs_wkt=self.crs)
        coordinates = {"band": self.bands[0] if is_single else list(self.bands),
                       "y": [grid_position(north, height, 2 * i + 1) for i in range(rows)],
                       "x": [grid_position(west, width, 2 * i + 1) for i in range(columns)],
                       "spatial_ref": ((), 0, reference)}
        result = xarray.DataArray(self.array, coordinates, ("band", "y", "x")[-self.array.ndim:],
                                  self.bands[0] if len(self.bands) == 1 else "dem", attrs={"_FillValue": np.nan})
        result.encoding["grid_mapping"] = "spatial_ref"
        return result

    def _rows(self) -> Rows:
        rows, columns = self.array.shape[-2:]
        return [("bands", ", ".join(self.bands)), ("pixels", f"{rows} rows x {columns} columns, {self.transform[0]:.10g} wide"),
                ("bounds", box_text(self.bounds)), ("crs", " ".join((self.crs or "none").split())[:80])]

    def __repr__(self) -> str:
        return as_text("tipp.Dem", self._rows())

    def _repr_html_(self) -> str:
        return as_html("tipp.Dem", self._rows())


def dem(
    points: Any,
    resolution: float,
    *,
    bounds: BoundsLike | None = None,
    align: bool = True,
    attributes: str | Sequence[str] = "elevation",
    point_data: Mapping[str, ArrayLike] | None = None,
    max_edge: float = 0.0,
    duplicates: str = "first",
    thin: tuple[float, str] | None = None,
    classes: Sequence[int] | None = None,
    returns: str = "all",
    keep: Sequence[str] = (),
    breaklines: Any = None,
    boundary: Any = None,
    soft: bool = False,
    memory: int | str | None = None,
    threads: int = 0,
    progress_bar: ProgressBar = False,
    z: str | None = None,
    layer: str | None = None,
    crs: str | None = None,
) -> Dem:
    """Makes a raster of elevations: the exact Delaunay surface of points, sampled at the pixel centres.

    Parameters
    ----------
    points
        Coordinates of shape (n, 3), another object as for delaunay(), a vtkPointSet, or one or more files: .las, .laz,
        .npy, .csv, .xyz or any format that VTK reads.
    resolution
        Width and height of a pixel, in the units of the points.
    bounds
        (xmin, xmax, ymin, ymax), a tipp.Bounds, or a data set, geometry or raster, whose bounds are used; z is not used.
        A range that does not meet the points' bounds, or is more than ten times as long along an axis, is an error.
        None: the bounds of the points. The pixels are those of all points. The wheel reads only the points of LAS and
        LAZ files that they depend on.
    align
        Whether pixel borders are at multiples of the resolution. Otherwise the first pixel starts at the bounds.
    attributes
        The bands: "elevation" and names of point_data or of columns of the files; "slope" and "aspect" (in degrees),
        "hillshade" (1 to 255) of the triangles, "density" (points per square unit, counting half a point per
        triangle), and "void" (1 where there is no triangle, else 0).
    point_data
        For an array of points: a dictionary of arrays with values at the points.
    max_edge
        Triangles with an edge longer than this, measured in x and y, are removed, so that pixels there have no value.
        0: no limit.
    duplicates
        Which values to use for several points at one position: those of the "first", the lowest ("min") or the highest
        ("max") point, or the "mean" of each column.
    thin
        (side, rule): keeps one point in each square of this side: the lowest ("min"), the highest ("max"), or the
        "nearest" to its centre.
    classes, returns, keep
        For LAS files: the classes to read (None: all), the returns ("all", "first" or "last"), and which flagged
        points to read, too ("withheld", "synthetic", "overlap"). "truncated" reads a file that ends too early as far
        as it goes, "uncounted" also the points beyond the number in its header.
    breaklines
        Lines that become edges of triangles: a file as for --breaklines of `tipp dem`, a vtkPolyData, a list of
        arrays of corners of shape (k, 2) or (k, 3), or Shapely geometries, a GeoSeries or a GeoDataFrame of lines or
        polygons. If no heights are given, or all of an array, a geometry or a vtkPolyData are 0, the corners get the
        height of the surface without breaklines.
    boundary
        Closed lines outside of which there are no values: a file, a vtkPolyData, a list of arrays of corners, or
        Shapely polygons, a GeoSeries or a GeoDataFrame.
    soft
        Whether the heights of breaklines are not used, such as those of a file that has 0 for heights that are not
        known.
    memory
        The memory limit for points and triangles, in bytes or as a text such as "512M", not counting the raster and
        points passed as arrays. Data that does not fit is spilled to temporary files. A package built with VTK also
        keeps the points of files in memory. None: no limit.
    threads, progress_bar
        As for delaunay().
    z, layer
        For files of a GIS (.gpkg, .shp, .geojson, .fgb, .kml, .dxf): the attribute that has the heights (None: z of
        the points), and the layer to read (None: all).
    crs
        The coordinate reference system of the points, such as "EPSG:25832", whatever the files state. None: that of
        the files, which must be the same in all of them.

    Returns
    -------
    Dem
        array, transform, crs and bands; to_xarray() makes a DataArray of it.

    Raises
    ------
    TypeError, ValueError
        If an argument is of a wrong type or value.
    KeyError
        If an attribute does not exist.
    RuntimeError
        If a file cannot be read, there are no points, or the bounds are an error as above.
    KeyboardInterrupt
        Promptly after Ctrl-C.

    Examples
    --------
    >>> xyz = numpy.random.default_rng(1).random((10_000, 3)) * 100
    >>> tipp.dem(xyz, 0.5).array.shape
    (200, 200)
    """
    size = check.number(resolution, "resolution")
    if not size > 0:
        raise ValueError(f"resolution is {resolution!r}; give a number above 0.")
    names = check.names(attributes, "attributes")
    _check_selection(classes, returns, keep)
    options = {
        "resolution": size,
        "bounds": None if bounds is None else bounds_of(bounds, "bounds")[:4],
        "strict_bounds": True,
        "align": check.flag(align, "align"),
        "attributes": names,
        "max_edge": check.number(max_edge, "max_edge", at_least=0),
        "duplicates": check.choice(duplicates, "duplicates", _DUPLICATES),
        "thin_size": 0.0,
        "thin_rule": 0,
        **({} if thin is None else _thinning(thin)),
        "breaklines": lines_of(breaklines, "breaklines", False),
        "boundary": lines_of(boundary, "boundary", True),
        "soft": check.flag(soft, "soft"),
        "memory": 0 if memory is None else check.memory(memory, "memory"),
        "classes": None if classes is None else [check.whole(number, "classes") for number in classes],
        "returns": _RETURNS[returns],
        "keep": check.a_list(keep, "keep"),
        "threads": check.threads(threads),
        "z": "" if z is None else check.text(z, "z"),
        "layer": "" if layer is None else check.text(layer, "layer"),
        "crs": "" if crs is None else check.text(crs, "crs"),
    }
    progress = progress_of(progress_bar)
    given: Any
    if check.are_files(points):
        if point_data is not None:
            raise ValueError("point_data needs an array of points; files have their own columns.")
        given = [check.path(p, "points") for p in ([points] if isinstance(points, (str, os.PathLike)) else points)]
    else:
        check.require_point_set(points, point_data, "a vtkPointSet, an array or names of files")
        given, point_data = cloud_of(points, point_data)
    bands, transform, stated = _engine.dem(given, point_data, options, progress)
    array = bands[0] if isinstance(attributes, str) else np.stack(bands)
    return Dem(array, transform, crs or stated, tuple(names))  # type: ignore[arg-type]


def lines_of(lines: Any, name: str, is_closed: bool) -> str | tuple[np.ndarray, ...] | None:
    """Returns a path, or (k, 2) coordinates, heights (may be empty), and the (m, 2) ids of the ends of edges."""
    if lines is None:
        return None
    if isinstance(lines, (str, os.PathLike)):
        return check.path(lines, name)
    if check.is_vtk_object(lines):
        from ._vtk import cell_lists, xyz_of

        check.data_object(lines, name, ("vtkPolyData",), "a vtkPolyData, a file or a list of arrays")
        corners = np.asarray(xyz_of(lines), np.float64)
        chains = cell_lists(lines.GetLines()) + [np.r_[ids, ids[:1]] for ids in cell_lists(lines.GetPolys())]
    else:
        parts = [_corners(part, f"{name}[{number}]") for number, item in enumerate(items_of(lines, name))
                 for part in _parts_of(item, f"{name}[{number}]", is_closed)]
        starts = np.cumsum([0, *(len(part) for part in parts)])
        chains = [np.arange(first, first + len(part)) for first, part in zip(starts, parts)]
        if is_closed:
            chains = [np.r_[ids, ids[:1]] for ids in chains]
        corners = np.concatenate([np.zeros((0, 3)), *parts])
    edges = np.concatenate([np.zeros((0, 2), np.int64), *(np.column_stack([ids[:-1], ids[1:]]) for ids in chains)])
    edges = edges[(corners[edges[:, 0], :2] != corners[edges[:, 1], :2]).any(axis=1)]  # a ring may repeat its first corner
    heights = corners[:, 2] if corners[:, 2].any() else np.zeros(0)
    return np.ascontiguousarray(corners[:, :2]), np.ascontiguousarray(heights), np.ascontiguousarray(edges, np.int64)


def _parts_of(item: Any, name: str, is_closed: bool) -> list[Any]:
    """Returns the lines of a geometry or, if `is_closed`, the rings of its polygons. An array is one line."""
    if item is not None and not is_geometry(item):
        return [item]
    return list((oriented_rings_of if is_closed else lines_of_geometry)(item, name))


def _corners(part: Any, name: str) -> np.ndarray:
    array = converted(columns_of(part, name), name)
    if array.ndim != 2 or array.shape[1] not in (2, 3) or array.dtype.kind not in "fiu":
        raise ValueError(f"{name} has the shape {array.shape} and type {array.dtype}; give corners of shape (k, 2) or (k, 3).")
    return in_space(array.astype(np.float64))


def _thinning(thin: Any) -> dict[str, Any]:
    pair = check.a_list(thin, "thin")
    if len(pair) != 2:
        raise ValueError(f"thin is {thin!r}; give a side and a rule, such as (0.5, 'min').")
    side = check.number(pair[0], "thin")
    if not side > 0:
        raise ValueError(f"thin is {thin!r}; give a side above 0.")
    return {"thin_size": side, "thin_rule": check.choice(pair[1], "thin", _THINNINGS)}


def _check_selection(classes: Any, returns: Any, keep: Any) -> None:
    for number in [] if classes is None else check.a_list(classes, "classes"):
        check.whole(number, "classes", at_most=255)
    check.choice(returns, "returns", _RETURNS)
    for flag in check.a_list(keep, "keep"):
        check.choice(flag, "keep", dict.fromkeys(_FLAGS, 0))
