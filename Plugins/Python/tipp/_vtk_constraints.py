# SPDX-License-Identifier: BSD-3-Clause
"""Constraints of a triangulation as the source of vtkTIPPDelaunay2D."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

from ._constraints import constraints_of
from ._vtk import vtk_points

if TYPE_CHECKING:
    from vtkmodules.vtkCommonDataModel import vtkPointSet


def source_of(data: vtkPointSet, options: dict[str, Any]) -> tuple[vtkPolyData | None, bool]:
    """What the arguments of delaunay_2d() name together, or None; and whether it has points of its own."""
    constraints = constraints_of(
        data.GetNumberOfPoints(), options["edge_source"], options["edges"], options["polygons"])
    if constraints is None:
        return options["edge_source"], False
    source = vtkPolyData()
    has_points = len(constraints.corners) > 0
    if has_points:
        # Ids mean the input's points, so that these come first.
        points = data.GetPoints()
        own = vtk_to_numpy(points.GetData()) if points is not None else np.zeros((0, 3))
        source.SetPoints(vtk_points(np.concatenate([own.astype(np.float64), constraints.corners])))
    source.SetLines(_cells(constraints.lines))
    source.SetPolys(_cells(constraints.polygons))
    return source, has_points


def _cells(lists: list[np.ndarray]) -> vtkCellArray:
    cells = vtkCellArray()
    offsets = np.concatenate([[0], np.cumsum([len(ids) for ids in lists])]).astype(np.int64)
    ids = np.concatenate(lists).astype(np.int64) if lists else np.zeros(0, np.int64)
    cells.SetData(numpy_to_vtkIdTypeArray(offsets, deep=True), numpy_to_vtkIdTypeArray(ids, deep=True))
    return cells
