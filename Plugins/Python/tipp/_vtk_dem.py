# SPDX-License-Identifier: BSD-3-Clause
"""tipp.dem in a package built with VTK. Arguments have been checked."""
from __future__ import annotations

import contextlib
import importlib.util
import math
import os
import tempfile
from typing import Any, Iterator

import numpy as np

from . import _arguments as check
from ._arrays import as_array
from ._progress import Progress
from ._run import run
from ._terrain import DERIVED, derived, distinct, thinned
from ._vtk import point_cloud, triangles_of, vtk_array, xyz_of
from .vtkTIPPFilters import vtkRangeResampleFilter, vtkTIPPDelaunay2D
from .vtkTIPPIO import vtkTIPPPointReader


def dem(points: Any, point_data: Any, options: dict[str, Any],
        progress: Progress | None) -> tuple[list[np.ndarray], tuple[float, ...], str | None]:
    """The bands of the attributes from the north to the south, their transform and the CRS of points in files."""
    names, size, crs = options["attributes"], options["resolution"], None
    if check.is_vtk_object(points):
        cloud = points
    elif isinstance(points, list) and points and isinstance(points[0], str):
        cloud, crs = _read(points, options)
    else:
        cloud = point_cloud(points, point_data)
        if np.shape(points)[1] == 2 and _needs_elevation(options):
            raise ValueError("points have no elevation; give an array of shape (n, 3) or other attributes.")
    if options["thin"] or options["duplicates"] != "first":
        cloud = _selected(cloud, options)
    west, south, columns, rows = _grid(options["bounds"] or _bounds_of(cloud), size, options["align"])
    mesh = vtkTIPPDelaunay2D()
    mesh.SetInputData(cloud)
    mesh.SetMaximumEdgeLength(options["max_edge"])
    mesh.SetNumberOfThreads(options["threads"])
    run(mesh, progress)
    surface = mesh.GetOutput()
    point_arrays = surface.GetPointData()
    if "elevation" in names and not point_arrays.HasArray("elevation"):
        _add_elevation(surface)
    for name in names:
        if name in DERIVED:
            _add_derived(surface, name)
        elif not point_arrays.HasArray(name):
            known = [point_arrays.GetArrayName(i) for i in range(point_arrays.GetNumberOfArrays())]
            raise KeyError(f"there is no attribute '{name}'; there are {known}.")
    image = _sample(surface, names, (west, south, columns, rows), size, options["threads"], progress)
    bands = [as_array(image, name).reshape(rows, columns)[::-1] for name in names]
    bands = [np.where(np.isnan(band), 1.0, band) if name == "void" else band for name, band in zip(names, bands)]
    return bands, (size, 0.0, west, 0.0, -size, south + rows * size), crs


def _read(paths: list[str], options: dict[str, Any]) -> tuple[Any, str | None]:
    reader = vtkTIPPPointReader()
    if options["classes"] is not None:
        reader.SetClasses(",".join(str(number) for number in options["classes"]))
    reader.SetReturns(options["returns"])
    for flag in options["keep"]:
        getattr(reader, "SetKeep" + flag.capitalize())(True)
    reader.SetColumns(",".join(options["attributes"]))
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


def _needs_elevation(options: dict[str, Any]) -> bool:
    rules = {options["duplicates"], *(options["thin"] or ())[1:]}
    return not {"elevation", "slope", "aspect", "hillshade"}.isdisjoint(options["attributes"]) or not rules.isdisjoint({"min", "max"})


def _selected(cloud: Any, options: dict[str, Any]) -> Any:
    """The points that thinning keeps, one at each place, with the data that are numbers."""
    arrays = cloud.GetPointData()
    names = [arrays.GetArrayName(i) for i in range(arrays.GetNumberOfArrays()) if arrays.GetArray(i)]
    data = {name: as_array(cloud, name) for name in names if arrays.GetArray(name).GetNumberOfComponents() == 1}
    xyz = xyz_of(cloud).astype(np.float64)
    if options["thin"]:
        kept = thinned(xyz, *options["thin"])
        xyz, data = xyz[kept], {name: values[kept] for name, values in data.items()}
    if options["duplicates"] != "first":
        _, xyz, data = distinct(xyz, data, options["duplicates"])
    return point_cloud(xyz, data)


def _add_derived(surface: Any, name: str) -> None:
    corners = xyz_of(surface).astype(np.float64)[triangles_of(surface)]
    surface.GetCellData().AddArray(vtk_array(name, derived(name, corners)))


def _add_elevation(surface: Any) -> None:
    points = surface.GetPoints().GetData()
    elevation = points.NewInstance()
    elevation.SetName("elevation")
    elevation.SetNumberOfTuples(points.GetNumberOfTuples())
    elevation.CopyComponent(0, points, 2)
    surface.GetPointData().AddArray(elevation)


def _sample(surface: Any, names: list[str], grid: tuple[float, float, int, int], size: float, threads: int,
            progress: Progress | None) -> Any:
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
    of_cells = sampler.GetCellDataArraySelection()
    of_cells.SetUnknownArraySetting(0)
    for name in names:
        (of_cells if name in DERIVED else selection).EnableArray(name)
    run(sampler, progress)
    return sampler.GetOutput()
