# SPDX-License-Identifier: BSD-3-Clause
"""tipp.dem in a package built with VTK. Arguments have been checked."""
from __future__ import annotations

from typing import Any

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

from . import _arguments as check
from ._arrays import as_array
from ._arguments import Progress
from ._properties import DEM, set_properties
from ._rasters import needs_elevation, require_bands, uncompressed
from ._run import run
from ._vtk import point_cloud
from .vtkTIPPFilters import vtkTIPPPointsToImage
from .vtkTIPPIO import vtkTIPPPointReader


def dem(points: Any, point_data: Any, options: dict[str, Any],
        progress: Progress | None) -> tuple[list[np.ndarray], tuple[float, ...], str | None]:
    """Computes the bands, with rows from north to south, their transform, and the CRS of points in files."""
    names, crs = options["attributes"], None
    if check.is_vtk_object(points):
        cloud = points
    elif isinstance(points, list) and points and isinstance(points[0], str):
        cloud, crs = _read(points, options)
    else:
        cloud = point_cloud(points, point_data)
        if np.shape(points)[1] == 2 and needs_elevation(options):
            raise ValueError("points have no elevation; give an array of shape (n, 3) or other attributes.")
    if cloud.GetNumberOfPoints() == 0:
        raise RuntimeError("There are no points.")
    arrays = cloud.GetPointData()
    require_bands(names, [arrays.GetArrayName(i) for i in range(arrays.GetNumberOfArrays()) if arrays.GetArray(i)])
    maker = vtkTIPPPointsToImage()
    maker.SetInputData(cloud)
    _set_constraints(maker, options)
    maker.SetResolution(options["resolution"])
    if options["bounds"] is not None:
        maker.UseInputBoundsOff()
        maker.SetSamplingBounds(*options["bounds"])
    maker.ClearBands()
    for name in names:
        maker.AddBand(name)
    set_properties(maker, DEM, options)
    run(maker, progress)
    image = maker.GetOutput()
    columns, rows, _ = image.GetDimensions()
    west, width, _, north, _, height = _transform_of(image)
    bands = [as_array(image, name).reshape(rows, columns)[::-1] for name in names]
    return bands, (width, 0.0, west, 0.0, height, north), crs


def _transform_of(image: Any) -> list[float]:
    numbers = image.GetFieldData().GetArray("GeoTransform")
    return [numbers.GetValue(i) for i in range(6)]


def _set_constraints(maker: Any, options: dict[str, Any]) -> None:
    for name, file_name, data in (("breaklines", maker.SetBreaklinesFileName, maker.SetBreaklinesData),
                                  ("boundary", maker.SetBoundaryFileName, maker.SetBoundaryData)):
        value = options[name]
        if isinstance(value, str):
            file_name(value)
        elif value is not None:
            data(_lines(*value))


def _lines(xy: np.ndarray, heights: np.ndarray, edges: np.ndarray) -> vtkPolyData:
    lines = point_cloud(np.column_stack([xy, heights if len(heights) else np.zeros(len(xy))]))
    cells = vtkCellArray()
    for a, b in edges:
        cells.InsertNextCell(2, (int(a), int(b)))
    lines.SetLines(cells)
    return lines


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
