# SPDX-License-Identifier: BSD-3-Clause
"""The engine of tipp.open() in a package built with VTK."""
from __future__ import annotations

import threading
from typing import Any, Callable, Tuple

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkIdTypeArray, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPointData, vtkPolyData

from . import _arguments as check
from ._arrays import Mesh
from ._properties import QUERY, set_properties
from ._run import run
from ._vtk import arrays_of, grid_of, vtk_points, xyz_of
from .vtkTIPPFilters import vtkPartitionedMeshQuery

Rings = Tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]
"""Rings of polygons: (n, 2) corners, the first corner of each ring and the end, each ring's zone, and whether it is a
hole."""


def open_mesh(mesh: Any, options: dict[str, Any]) -> MeshQuery:
    query = vtkPartitionedMeshQuery()
    set_properties(query, QUERY, options)
    if isinstance(mesh, str):
        query.SetFileName(mesh)
    else:
        source = grid_of(mesh) if isinstance(mesh, Mesh) else mesh
        query.SetSourceData(check.data_object(source, "mesh", ("vtkPointSet", "vtkCompositeDataSet"), "a mesh"))
    return MeshQuery(query)


class MeshQuery:
    """A vtkPartitionedMeshQuery with NumPy arguments and results. Its errors are VTK events, so only one Python thread
    at a time may query; each query itself uses several threads."""

    def __init__(self, query: vtkPartitionedMeshQuery) -> None:
        self._query = query
        self._turn = threading.Lock()

    def _run(self, call: Callable[[], Any]) -> None:
        with self._turn:
            run(self._query, call=call)

    def _name(self, names: list[str]) -> None:
        self._query.ClearArrays()
        for name in names:
            self._query.AddArray(name)

    def names(self) -> list[str]:
        names = vtkStringArray()
        self._run(lambda: self._query.GetNamesOfArrays(names))
        return [names.GetValue(i) for i in range(names.GetNumberOfValues())]

    def locate(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        cells, weights = vtkIdTypeArray(), vtkDoubleArray()
        self._run(lambda: self._query.Locate(vtk_points(points).GetData(), cells, weights))
        return vtk_to_numpy(cells), vtk_to_numpy(weights)

    def sample(self, points: np.ndarray, names: list[str]) -> tuple[np.ndarray, dict[str, np.ndarray]]:
        if not names:
            return self.locate(points)[0], {}
        values, cells = vtkPointData(), vtkIdTypeArray()

        def call() -> None:
            self._name(names)
            self._query.Interpolate(vtk_points(points).GetData(), values, cells)

        self._run(call)
        return vtk_to_numpy(cells), arrays_of(values)

    def neighbors(self, cells: np.ndarray) -> np.ndarray:
        found = vtkIdTypeArray()
        self._run(lambda: self._query.Neighbors(numpy_to_vtkIdTypeArray(cells, deep=True), found))
        return vtk_to_numpy(found)

    def star(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return self._lists(self._query.Star, points)

    def ring_of_points(self, points: np.ndarray, k: int) -> tuple[np.ndarray, np.ndarray]:
        return self._lists(self._query.RingOfPoints, points, k)

    def ring_of_cells(self, cells: np.ndarray, k: int) -> tuple[np.ndarray, np.ndarray]:
        return self._lists(self._query.RingOfCells, cells, k)

    def _lists(self, method: Any, ids: np.ndarray, *more: int) -> tuple[np.ndarray, np.ndarray]:
        starts, found = vtkIdTypeArray(), vtkIdTypeArray()
        self._run(lambda: method(numpy_to_vtkIdTypeArray(ids, deep=True), *more, starts, found))
        return vtk_to_numpy(starts), vtk_to_numpy(found)

    def boundary(self) -> tuple[np.ndarray, np.ndarray]:
        loops = vtkPolyData()
        self._run(lambda: self._query.Boundary(loops))
        if loops.GetNumberOfPoints() == 0:
            return np.zeros(1, np.int64), np.zeros(0, np.int64)
        return _starts(loops), vtk_to_numpy(loops.GetPointData().GetGlobalIds())

    def contours(self, array: str, component: int, levels: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        lines = vtkPolyData()
        self._run(lambda: self._query.Contours(array, component, numpy_to_vtk(levels, deep=True), lines))
        if lines.GetNumberOfPoints() == 0:
            return np.zeros(1, np.int64), np.zeros(0), np.zeros((0, 3))
        return _starts(lines), vtk_to_numpy(lines.GetCellData().GetScalars()), xyz_of(lines)

    def profile(self, polyline: np.ndarray, spacing: float, names: list[str]) -> tuple[Any, ...]:
        line = vtkPolyData()

        def call() -> None:
            self._name(names)
            self._query.Profile(vtk_points(polyline).GetData(), spacing, line)

        self._run(call)
        values = arrays_of(line.GetPointData())
        points = xyz_of(line)
        points = points if self._query.GetMeshDimension() == 3 else points[:, :2]
        return values.pop("Distance"), points, values.pop("CellId"), {name: values[name] for name in names}

    def closest(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        cells, locations, distances = vtkIdTypeArray(), vtkDoubleArray(), vtkDoubleArray()
        self._run(lambda: self._query.Closest(vtk_points(points).GetData(), cells, locations, distances))
        return vtk_to_numpy(cells), vtk_to_numpy(locations), vtk_to_numpy(distances)

    def cells_in(self, box: list[float], rings: Rings | None, whole: bool) -> np.ndarray:
        found = vtkIdTypeArray()
        self._run(lambda: self._query.CellsInBox(box, whole, found) if rings is None
                  else self._query.CellsInPolygons(_polygons(rings), whole, found))
        return vtk_to_numpy(found)

    def points_in(self, box: list[float], rings: Rings | None) -> np.ndarray:
        found = vtkIdTypeArray()
        self._run(lambda: self._query.PointsInBox(box, found) if rings is None
                  else self._query.PointsInPolygons(_polygons(rings), found))
        return vtk_to_numpy(found)

    def zones(self, rings: Rings, count: int, array: str, component: int, level: float) -> list[np.ndarray]:
        table = vtkPointData()
        self._run(lambda: self._query.ZoneStatistics(_polygons(rings), array, component, level, table))
        columns = [vtk_to_numpy(table.GetArray(i)) for i in range(table.GetNumberOfArrays())]
        # Zones without rings at the end are not in the data set.
        missing = [0, 0.0, np.nan, np.nan, np.nan, 0.0, 0.0]
        return [np.append(c, np.full(count - len(c), m, c.dtype)) for c, m in zip(columns, missing)]

    def descend(self, points: np.ndarray, array: str, component: int
                ) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        lines = vtkPolyData()
        self._run(lambda: self._query.Descend(vtk_points(points).GetData(), array, component, lines))
        pits, counts = np.full(len(points), -1, np.int64), np.zeros(len(points), np.int64)
        if lines.GetNumberOfPoints() == 0:
            return np.zeros(len(points) + 1, np.int64), np.zeros((0, 3)), np.zeros(0), pits
        data = lines.GetCellData()
        begun = vtk_to_numpy(data.GetArray("StartId"))
        pits[begun] = vtk_to_numpy(data.GetArray("PitId"))
        counts[begun] = np.diff(_starts(lines))
        values = vtk_to_numpy(lines.GetPointData().GetScalars())
        return np.concatenate([[0], np.cumsum(counts)]), xyz_of(lines), values, pits

    def components(self) -> tuple[np.ndarray, np.ndarray]:
        cells, sizes = vtkIdTypeArray(), vtkIdTypeArray()
        self._run(lambda: self._query.Components(cells, sizes))
        return vtk_to_numpy(cells), vtk_to_numpy(sizes)


def _polygons(rings: Rings) -> vtkPolyData:
    corners, starts, zones, holes = rings
    data = vtkPolyData()
    data.SetPoints(vtk_points(corners))
    cells = vtkCellArray()
    ids = np.arange(len(corners), dtype=np.int64)
    cells.SetData(numpy_to_vtkIdTypeArray(starts, deep=True), numpy_to_vtkIdTypeArray(ids, deep=True))
    data.SetPolys(cells)
    for name, values in (("ZoneId", zones), ("IsHole", holes)):
        array = numpy_to_vtkIdTypeArray(values, deep=True)
        array.SetName(name)
        data.GetCellData().AddArray(array)
    return data


def _starts(lines: vtkPolyData) -> np.ndarray:
    """The index of the first point of each line, and the number of points. A closed line repeats its first point, and
    so does a line of one point."""
    cells = lines.GetLines()
    firsts = vtk_to_numpy(cells.GetConnectivityArray())[vtk_to_numpy(cells.GetOffsetsArray())[:-1]]
    return np.append(firsts, lines.GetNumberOfPoints()).astype(np.int64)
