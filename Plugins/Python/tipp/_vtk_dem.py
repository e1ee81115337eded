# SPDX-License-Identifier: BSD-3-Clause
"""tipp.dem in a package built with VTK. Arguments have been checked."""
from __future__ import annotations

import math
from typing import Any

import numpy as np

from . import _arguments as check
from ._arrays import as_array
from ._arguments import Progress
from ._rasters import bounds_of, derived, DERIVED, grid_over, needs_elevation, sampling_of, selected, uncompressed
from ._run import run
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
        if np.shape(points)[1] == 2 and needs_elevation(options):
            raise ValueError("points have no elevation; give an array of shape (n, 3) or other attributes.")
    if options["thin"] or options["duplicates"] != "first":
        cloud = _selected(cloud, options)
    west, south, columns, rows = grid_over(options["bounds"] or _bounds_of(cloud), size, options["align"])
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
    with uncompressed(paths) as files:
        for path in files:
            reader.AddFileName(path)
        run(reader)
    cloud = reader.GetOutput()
    text = cloud.GetFieldData().GetAbstractArray("CoordinateReferenceSystem")
    return cloud, text.GetValue(0) if text else None


def _bounds_of(cloud: Any) -> list[float]:
    from vtkmodules.util.numpy_support import vtk_to_numpy

    points = cloud.GetPoints()
    return bounds_of(vtk_to_numpy(points.GetData())[:, :2] if cloud.GetNumberOfPoints() else np.empty((0, 2)))


def _selected(cloud: Any, options: dict[str, Any]) -> Any:
    """The points that thinning keeps, one at each position, with the data that are numbers."""
    arrays = cloud.GetPointData()
    names = [arrays.GetArrayName(i) for i in range(arrays.GetNumberOfArrays()) if arrays.GetArray(i)]
    data = {name: as_array(cloud, name) for name in names if arrays.GetArray(name).GetNumberOfComponents() == 1}
    xyz, data = selected(xyz_of(cloud).astype(np.float64), data, options)
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
    sampler = vtkRangeResampleFilter()
    sampler.SetInputDataObject(surface)
    sampler.SetUseInputBounds(False)
    sampler.SetSamplingBounds(*sampling_of(grid, size))
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
