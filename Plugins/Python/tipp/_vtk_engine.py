# SPDX-License-Identifier: BSD-3-Clause
"""The engine of a package built with VTK: runs its wrapped filters. Arguments are already checked."""
from __future__ import annotations

from typing import Any, TYPE_CHECKING

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

from . import _arguments as check
from ._constraints import constraints_of
from ._arguments import Progress
from ._properties import (
    array_of, DELAUNAY_2D, DELAUNAY_3D, DELAUNAY_FILE, READ, set_properties, TRIANGULATION, WRITE)
from ._run import run
from ._vtk import point_cloud, triangles_of, vtk_points, wrapped_like
from ._vtk_dem import dem
from ._vtk_query import open_mesh
from .vtkTIPPFilters import vtkRangeResampleFilter, vtkTIPPDelaunay2D, vtkTIPPDelaunay3D, vtkTIPPOutOfCoreDelaunay2D
from .vtkTIPPIO import vtkPartitionedUnstructuredReader, vtkPartitionedUnstructuredWriter

if TYPE_CHECKING:
    from vtkmodules.vtkCommonDataModel import vtkPointSet

__all__ = ["delaunay", "delaunay_2d", "delaunay_3d", "delaunay_file", "dem", "open_mesh", "read", "require_ranks",
           "resample", "write"]

_FIGURES = ("points", "triangles", "duplicates", "rejected", "pieces", "spilled_bytes", "mesh_bytes", "resumed",
            "triangle_sum")
_CONSTRAINT_FIGURES = ("constraints", "constraint_edges", "crossing_points", "crossing_rounds")
_STATISTICS = ("points", "triangles", "tetrahedra", "duplicates", "rejected", "partitions", "initial_points",
               "worker_vertices", "threads", *_CONSTRAINT_FIGURES)


def source_of(data: vtkPointSet, options: dict[str, Any]) -> tuple[vtkPolyData | None, bool]:
    """Combines the constraints of delaunay_2d() into one source (or None); also returns whether it has its own
    points."""
    constraints = constraints_of(
        data.GetNumberOfPoints(), options["edge_source"], options["edges"], options["polygons"])
    if constraints is None:
        return options["edge_source"], False
    source = vtkPolyData()
    has_points = len(constraints.corners) > 0
    if has_points:
        # Ids refer to the input's points, so these come first.
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


def require_ranks() -> None:
    """Raises an exception if the package cannot work on several ranks."""


def delaunay(points: Any, options: dict[str, Any], progress: Progress | None) -> np.ndarray:
    algorithm = vtkTIPPDelaunay2D()
    algorithm.SetInputData(_cloud_of(points, None))
    set_properties(algorithm, TRIANGULATION, options)
    run(algorithm, progress)
    return triangles_of(algorithm.GetOutput())


def delaunay_2d(points: Any, point_data: Any, options: dict[str, Any],
                progress: Progress | None) -> tuple[Any, dict[str, Any]]:
    algorithm = vtkTIPPDelaunay2D()
    algorithm.SetInputData(_cloud_of(points, point_data))
    source, has_points = source_of(algorithm.GetInput(), options)
    if source is not None:
        algorithm.SetSourceData(source)
        algorithm.SetMergeSourcePoints(has_points)
    set_properties(algorithm, DELAUNAY_2D, options)
    run(algorithm, progress)
    return wrapped_like(algorithm.GetOutput(), points), _statistics(algorithm.GetStatistics().GetFieldData())


def _cloud_of(points: Any, point_data: Any) -> Any:
    return points if check.is_vtk_object(points) else point_cloud(points, point_data)


def delaunay_3d(points: Any, point_data: Any, options: dict[str, Any],
                progress: Progress | None) -> tuple[Any, dict[str, Any]]:
    algorithm = vtkTIPPDelaunay3D()
    algorithm.SetInputData(_cloud_of(points, point_data))
    set_properties(algorithm, DELAUNAY_3D, options)
    run(algorithm, progress)
    return wrapped_like(algorithm.GetOutput(), points), _statistics(algorithm.GetStatistics().GetFieldData())


def _statistics(totals: Any) -> dict[str, Any]:
    arrays = {totals.GetAbstractArray(i).GetName(): totals.GetAbstractArray(i)
              for i in range(totals.GetNumberOfArrays())}
    result: dict[str, Any] = {key: arrays[array_of(key)].GetValue(0) for key in _STATISTICS if array_of(key) in arrays}
    names, seconds = arrays.get("PhaseName"), arrays.get("PhaseSeconds")
    if names is not None and seconds is not None:
        result["seconds"] = {names.GetValue(i): seconds.GetValue(i) for i in range(names.GetNumberOfValues())}
    return result


def delaunay_file(
    paths: list[str], output: str, options: dict[str, Any], progress: Progress | None
) -> dict[str, int]:
    algorithm = vtkTIPPOutOfCoreDelaunay2D()
    for path in paths:
        algorithm.AddInputFileName(path)
    algorithm.SetFileName(output)
    algorithm.SetXColumn(options["columns"][0])
    algorithm.SetYColumn(options["columns"][1])
    for x, y in options["holes"]:
        algorithm.AddHole(x, y)
    set_properties(algorithm, DELAUNAY_FILE, options)
    run(algorithm, progress)
    totals = algorithm.GetOutput().GetFieldData()
    arrays = {key: totals.GetArray(array_of(key)) for key in (*_FIGURES, *_CONSTRAINT_FIGURES)}
    return {key: array.GetValue(0) for key, array in arrays.items() if array is not None}


def resample(mesh: Any, options: dict[str, Any], progress: Progress | None) -> Any:
    check.data_object(mesh, "mesh", ("vtkPointSet", "vtkCompositeDataSet"), "a mesh or a composite of meshes")
    algorithm = vtkRangeResampleFilter()
    algorithm.SetInputDataObject(mesh)
    if options["bounds"] is not None:
        algorithm.SetUseInputBounds(False)
        algorithm.SetSamplingBounds(*options["bounds"])
    if options["spacing"] is not None:
        algorithm.SetDelta(*options["spacing"])
    algorithm.SetSamplingDimensions(*options["dimensions"])
    algorithm.SetNullValue(options["null_value"])
    if options["no_data"] is not None:
        algorithm.SetUseNoDataValue(True)
        algorithm.SetNoDataValue(options["no_data"])
    if options["arrays"] is not None:
        _select(algorithm, mesh, options["arrays"])
    algorithm.SetNumberOfThreads(options["threads"])
    run(algorithm, call=lambda: algorithm.SetDeviceChoice(options["device"]))
    run(algorithm, progress)
    return wrapped_like(algorithm.GetOutput(), mesh)


def _select(algorithm: vtkRangeResampleFilter, mesh: Any, names: list[str]) -> None:
    """Selects the arrays to sample; the filter warns of names that the mesh does not have."""
    of_cells = hasattr(mesh, "GetCellData") and mesh.GetCellData()
    for selection, wanted in (
        (algorithm.GetPointDataArraySelection(), [n for n in names if not (of_cells and of_cells.HasArray(n))]),
        (algorithm.GetCellDataArraySelection(), [n for n in names if of_cells and of_cells.HasArray(n)]),
    ):
        selection.SetUnknownArraySetting(0)
        for name in wanted:
            selection.EnableArray(name)


def read(path: str, options: dict[str, Any], progress: Progress | None) -> Any:
    reader = vtkPartitionedUnstructuredReader()
    reader.SetFileName(path)
    if options["bounds"] is not None:
        reader.SetBounds(*options["bounds"])
    reader.SetBorrowerMode(reader.OWNED_AND_BORROWED if options["borrowed"] else reader.OWNED)
    set_properties(reader, READ, options)
    run(reader, call=reader.UpdateInformation)
    _keep_only(reader.GetPointDataArraySelection(), options["point_arrays"], "point")
    _keep_only(reader.GetCellDataArraySelection(), options["cell_arrays"], "cell")
    controller = reader.GetController()
    rank = controller.GetLocalProcessId() if controller else 0
    size = controller.GetNumberOfProcesses() if controller else 1
    run(reader, progress, lambda: _update(reader, rank, size, options["time"]))
    return reader.GetOutputDataObject(0)


def _keep_only(selection: Any, wanted: list[str] | None, what: str) -> None:
    if wanted is None:
        return
    known = [selection.GetArrayName(i) for i in range(selection.GetNumberOfArrays())]
    check.require_arrays(wanted, known, what)
    for name in known:
        selection.SetArraySetting(name, name in wanted)


def _update(reader: vtkPartitionedUnstructuredReader, rank: int, size: int, time: float | None) -> None:
    if time is None:
        reader.UpdatePiece(rank, size, 0)
    else:
        reader.UpdateTimeStep(time, rank, size, 0)


def write(mesh: Any, path: str, options: dict[str, Any], progress: Progress | None) -> None:
    writer = vtkPartitionedUnstructuredWriter()
    if isinstance(mesh, str):
        writer.SetInputFileName(mesh)
    else:
        writer.SetInputData(check.data_object(mesh, "mesh", ("vtkDataObject",), "a VTK data set or a path"))
    writer.SetFileName(path)
    set_properties(writer, WRITE, options)
    run(writer, progress, writer.Write)
