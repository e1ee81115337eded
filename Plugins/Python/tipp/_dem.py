# SPDX-License-Identifier: BSD-3-Clause
"""tipp.dem: a raster of points."""
from __future__ import annotations

import contextlib
import importlib.util
import math
import os
import tempfile
from typing import TYPE_CHECKING, Any, Iterable, Iterator, Mapping, NamedTuple, Sequence, Union

import numpy as np

from . import _arguments as check
from ._arrays import as_array, point_cloud
from ._run import run
from .vtkTIPPFilters import vtkRangeResampleFilter, vtkTIPPDelaunay2D
from .vtkTIPPIO import vtkTIPPPointReader

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

_Path = Union[str, "os.PathLike[str]"]
_RETURNS = {"all": 0, "first": 1, "last": 2}
_FLAGS = ("withheld", "synthetic", "overlap")


class Dem(NamedTuple):
    """A raster, as rasterio has it: rows from the north to the south."""

    array: np.ndarray
    """(rows, columns), or (bands, rows, columns) for several attributes; NaN where there is no triangle."""
    transform: tuple[float, float, float, float, float, float]
    """(width, 0, west, 0, -height, north) of the pixels: the arguments of affine.Affine."""
    crs: str | None
    """WKT or "EPSG:code" of the points' file, if it has one."""

    def to_xarray(self) -> Any:
        """An xarray.DataArray with the coordinates of the pixels' centres."""
        import xarray

        width, _, west, _, height, north = self.transform
        rows, columns = self.array.shape[-2:]
        names = ("band", "y", "x")[-self.array.ndim:]
        coordinates = {"x": west + width * (np.arange(columns) + 0.5), "y": north + height * (np.arange(rows) + 0.5)}
        return xarray.DataArray(self.array, coordinates, names, attrs={"crs": self.crs} if self.crs else {})


def dem(
    points: ArrayLike | _Path | Sequence[_Path],
    resolution: float,
    *,
    bounds: Sequence[float] | None = None,
    align: bool = True,
    attributes: str | Sequence[str] = "elevation",
    point_data: Mapping[str, ArrayLike] | None = None,
    max_edge: float = 0.0,
    classes: Sequence[int] | None = None,
    returns: str = "all",
    keep: Sequence[str] = (),
    threads: int = 0,
    progress_bar: bool = False,
) -> Dem:
    """A raster of elevations: the exactly triangulated surface of points at the pixels' centres.

    Parameters
    ----------
    points
        Coordinates of shape (n, 3), a vtkPointSet, or one or more files: .las, .laz, .npy, .csv, .xyz or any that VTK
        reads. .laz files that this build does not read are read by laspy, if it is installed.
    resolution
        Width and height of a pixel, in the units of the points.
    bounds
        (xmin, xmax, ymin, ymax); None: those of the points.
    align
        Whether borders of pixels are at multiples of the resolution; else the first ones are at the
        bounds.
    attributes
        The bands: "elevation" and names of point_data or of columns of the files.
    point_data
        With an array of points: arrays of values at them, by name.
    max_edge
        Triangles with an edge longer than this, in the plane, have no values. 0: all have.
    classes, returns, keep
        Of LAS files: the classes to read (None: all), the returns ("all", "first" or "last"), and which
        flagged points are read, too ("withheld", "synthetic", "overlap").
    threads
        OpenMP threads; 0 is OpenMP's choice.
    progress_bar
        Whether to show progress on the standard error stream.

    Returns
    -------
    Dem
        array, transform and crs.

    Raises
    ------
    TypeError, ValueError
        If an argument is of a wrong type or value.
    KeyError
        If there is no such attribute.
    RuntimeError
        If a file cannot be read, or there are no points.
    KeyboardInterrupt
        On Ctrl-C, soon.

    Examples
    --------
    >>> xyz = numpy.random.default_rng(1).random((10_000, 3)) * 100
    >>> tipp.dem(xyz, 0.5).array.shape
    (200, 200)
    """
    size = check.number(resolution, "resolution")
    if not size > 0:
        raise ValueError(f"resolution is {resolution!r}; give a number above 0.")
    limits = None if bounds is None else check.several(bounds, "bounds", 4, check.number)
    names = check.names(attributes, "attributes")
    _check_selection(classes, returns, keep)
    distance = check.number(max_edge, "max_edge", at_least=0)
    aligned = check.flag(align, "align")
    count = check.threads(threads)
    check.flag(progress_bar, "progress_bar")
    crs = None
    if _are_files(points):
        if point_data is not None:
            raise ValueError("point_data goes with an array of points; files have columns of their own.")
        cloud, crs = _read(points, names, classes, returns, keep)
    elif check.is_vtk_object(points):
        if point_data is not None:
            raise ValueError("point_data goes with an array of points; a data set has its own.")
        cloud = check.data_object(points, "points", ("vtkPointSet",), "a vtkPointSet, an array or names of files")
    else:
        cloud = point_cloud(points, point_data)
        if np.shape(points)[1] == 2 and "elevation" in names:
            raise ValueError("points have no elevation; give an array of shape (n, 3) or other attributes.")
    west, south, columns, rows = _grid(limits or _bounds_of(cloud), size, aligned)
    mesh = vtkTIPPDelaunay2D()
    mesh.SetInputData(cloud)
    mesh.SetMaximumEdgeLength(distance)
    mesh.SetNumberOfThreads(count)
    run(mesh, progress_bar)
    surface = mesh.GetOutput()
    point_arrays = surface.GetPointData()
    if "elevation" in names and not point_arrays.HasArray("elevation"):
        _add_elevation(surface)
    for name in names:
        if not point_arrays.HasArray(name):
            known = [point_arrays.GetArrayName(i) for i in range(point_arrays.GetNumberOfArrays())]
            raise KeyError(f"there is no attribute '{name}'; there are {known}.")
    image = _sample(surface, names, (west, south, columns, rows), size, count, progress_bar)
    bands = [as_array(image, name).reshape(rows, columns)[::-1] for name in names]
    array = bands[0] if isinstance(attributes, str) else np.stack(bands)
    return Dem(array, (size, 0.0, west, 0.0, -size, south + rows * size), crs)


def _sequence(values: Any, name: str) -> list[Any]:
    if isinstance(values, (str, bytes, Mapping)) or not isinstance(values, Iterable):
        raise TypeError(f"{name} is {values!r}; give a list.")
    return list(values)


def _check_selection(classes: Any, returns: Any, keep: Any) -> None:
    for number in [] if classes is None else _sequence(classes, "classes"):
        check.whole(number, "classes", at_most=255)
    check.choice(returns, "returns", _RETURNS)
    for flag in _sequence(keep, "keep"):
        check.choice(flag, "keep", dict.fromkeys(_FLAGS, 0))


def _are_files(points: Any) -> bool:
    is_list = isinstance(points, Iterable) and not isinstance(points, (str, bytes, os.PathLike, np.ndarray))
    first = next(iter(points), None) if is_list and isinstance(points, (list, tuple)) else points
    return isinstance(first, (str, os.PathLike))


def _read(points: Any, names: list[str], classes: Any, returns: str, keep: Sequence[str]) -> tuple[Any, str | None]:
    paths = [check.path(p, "points") for p in ([points] if isinstance(points, (str, os.PathLike)) else points)]
    reader = vtkTIPPPointReader()
    if classes is not None:
        reader.SetClasses(",".join(str(check.whole(c, "classes", at_most=255)) for c in _sequence(classes, "classes")))
    reader.SetReturns(check.choice(returns, "returns", _RETURNS))
    for flag in _sequence(keep, "keep"):
        getattr(reader, "SetKeep" + flag.capitalize())(True)
    reader.SetColumns(",".join(names))
    reader.SetGenerateVertices(False)
    with _uncompressed(paths) as files:
        for path in files:
            reader.AddFileName(path)
        run(reader)
    cloud = reader.GetOutput()
    text = cloud.GetFieldData().GetAbstractArray("CoordinateReferenceSystem")
    return cloud, text.GetValue(0) if text else None


@contextlib.contextmanager
def _uncompressed(paths: list[str]) -> Iterator[list[str]]:
    """The files, with .laz files as temporary .las files, which laspy writes, where it is installed."""
    compressed = [path for path in paths if path.lower().endswith(".laz")]
    if not compressed or importlib.util.find_spec("laspy") is None:
        yield paths
        return
    import laspy

    with tempfile.TemporaryDirectory() as folder:
        files = []
        for number, path in enumerate(paths):
            if path not in compressed:
                files.append(path)
                continue
            files.append(os.path.join(folder, f"{number}.las"))
            try:
                with laspy.open(path) as source, laspy.open(files[-1], "w", header=source.header, do_compress=False) as to:
                    for block in source.chunk_iterator(1_000_000):
                        to.write_points(block)
            except Exception as error:
                raise RuntimeError(f"{path}: cannot be decompressed by laspy ({error}).") from None
        yield files


def _bounds_of(cloud: Any) -> list[float]:
    from vtkmodules.util.numpy_support import vtk_to_numpy

    if cloud.GetNumberOfPoints() == 0:
        raise RuntimeError("There are no points.")
    xy = vtk_to_numpy(cloud.GetPoints().GetData())[:, :2]
    xy = xy[np.isfinite(xy).all(axis=1)]
    if len(xy) == 0:
        raise RuntimeError("There is no point with finite coordinates.")
    low, high = xy.min(axis=0), xy.max(axis=0)
    return [float(low[0]), float(high[0]), float(low[1]), float(high[1])]


def _grid(bounds: list[float], size: float, aligned: bool) -> tuple[float, float, int, int]:
    """West, south, columns and rows: those of `tipp dem`."""

    def cover(low: float, high: float) -> tuple[float, int]:
        if low > high:
            raise ValueError(f"bounds go from {low} to {high}; give the lower one first.")
        origin = math.floor(low / size + 1e-9) * size if aligned else low
        return origin, max(1, math.ceil((high - origin) / size - 1e-9))

    (west, columns), (south, rows) = cover(*bounds[:2]), cover(*bounds[2:])
    return west, south, columns, rows


def _add_elevation(surface: Any) -> None:
    points = surface.GetPoints().GetData()
    elevation = points.NewInstance()
    elevation.SetName("elevation")
    elevation.SetNumberOfTuples(points.GetNumberOfTuples())
    elevation.CopyComponent(0, points, 2)
    surface.GetPointData().AddArray(elevation)


def _sample(surface: Any, names: list[str], grid: tuple[float, float, int, int], size: float, threads: int,
            progress_bar: bool) -> Any:
    west, south, columns, rows = grid
    low = west + 0.5 * size, south + 0.5 * size
    sampler = vtkRangeResampleFilter()
    sampler.SetInputDataObject(surface)
    sampler.SetUseInputBounds(False)
    # Half a step more on the far side, so that roundings do not cost the last column or row.
    sampler.SetSamplingBounds(low[0], low[0] + (columns - 0.5) * size, low[1], low[1] + (rows - 0.5) * size, 0, 0)
    sampler.SetSamplingDimensions(1, 1, 1)
    sampler.SetDelta(size, size, 0)
    sampler.SetNullValue(math.nan)
    sampler.SetDeviceChoice("openmp")
    sampler.SetNumberOfThreads(threads)
    selection = sampler.GetPointDataArraySelection()
    selection.SetUnknownArraySetting(0)
    for name in names:
        selection.EnableArray(name)
    sampler.GetCellDataArraySelection().SetUnknownArraySetting(0)
    run(sampler, progress_bar)
    return sampler.GetOutput()
