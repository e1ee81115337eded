# SPDX-License-Identifier: BSD-3-Clause
"""The engine of a package built with VTK: runs its wrapped filters. Arguments are already checked."""
from __future__ import annotations

import contextlib
import math
import threading
import warnings
from typing import Any, Callable, Iterator, Tuple, TYPE_CHECKING

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDataArray, vtkDoubleArray, vtkIdTypeArray, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkCellTypes, vtkGenericCell, vtkPointData, vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkParallelCore import vtkMultiProcessController

from . import _arguments as check
from ._arguments import (
    array_of, DELAUNAY_2D, DELAUNAY_3D, DELAUNAY_FILE, DEM, MESHING, Progress, QUERY, READ, SERIES, set_properties,
    TRIANGULATION, WRITE)
from ._data import as_array, Mesh
from ._constraints import Constraints, constraints_of
from ._results import in_vtk
from ._run import run
from ._surface import completed, completed_on_ranks
from ._vtk import (
    arrays_of, from_vtk, grid_of, numpy_of, point_arrays, point_cloud, triangles_of, vtk_array, vtk_points,
    xyz_of)
from .vtkTIPPFilters import (
    vtkPartitionedMeshQuery, vtkRangeResampleFilter, vtkTIPPCutFill, vtkTIPPDelaunay2D, vtkTIPPDelaunay3D,
    vtkTIPPOutOfCoreDelaunay2D, vtkTIPPPointsToImage, vtkTIPPRefine2D, vtkTIPPRemap, vtkTIPPResampleSeries)
from .vtkTIPPIO import vtkPartitionedUnstructuredReader, vtkPartitionedUnstructuredWriter, vtkTIPPPointReader

if TYPE_CHECKING:
    from vtkmodules.vtkCommonDataModel import vtkPointSet

_FIGURES = ("points", "triangles", "duplicates", "rejected", "pieces", "spilled_bytes", "mesh_bytes", "resumed",
            "triangle_sum")
_CONSTRAINT_FIGURES = ("constraints", "constraint_edges", "crossing_points", "crossing_rounds")
_STATISTICS = ("points", "triangles", "tetrahedra", "duplicates", "rejected", "partitions", "initial_points",
               "worker_vertices", "threads", "default_threads", "default_threads_from", *_CONSTRAINT_FIGURES)


def source_of(data: vtkPointSet, options: dict[str, Any]) -> tuple[vtkPolyData | None, bool]:
    """Combines the constraints of delaunay_2d() into one source (or None); also returns whether the sources of all ranks
    have their own points. Collective."""
    constraints = constraints_of(
        data.GetNumberOfPoints(), options["edge_source"], options["edges"], options["polygons"])
    corners = np.zeros((0, 3)) if constraints is None else constraints.corners
    corners, values, has_points = _completed(data, corners, options["threads"])
    if constraints is None:
        return options["edge_source"], has_points
    source = vtkPolyData()
    if has_points:
        constraints = _with_own_points(source, data, constraints._replace(corners=corners), values)
    source.SetLines(_cells(constraints.lines))
    source.SetPolys(_cells(constraints.polygons))
    return source, has_points


def _completed(data: vtkPointSet, corners: np.ndarray, threads: int) -> tuple[np.ndarray, dict[str, np.ndarray], bool]:
    """Returns the corners with heights, the values of the point arrays there, and whether any rank has corners.
    Collective."""
    if _count_ranks() == 1:
        if len(corners) == 0:
            return corners, {}, False
        return (*completed(xyz_of(data), point_arrays(data), corners, threads), True)
    from mpi4py import MPI

    def piece_of() -> Mesh:
        algorithm = vtkTIPPDelaunay2D()
        algorithm.SetInputData(data)
        algorithm.SetNumberOfThreads(threads)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", RuntimeWarning)  # those of the caller's run
            run(algorithm)
        piece = algorithm.GetOutput()
        return Mesh(xyz_of(piece), triangles_of(piece), point_arrays(piece))

    return completed_on_ranks(MPI.COMM_WORLD, corners, piece_of, threads)


def _with_own_points(source: vtkPolyData, data: vtkPointSet, constraints: Constraints,
                     values: dict[str, np.ndarray]) -> Constraints:
    """Sets the source's points: those of the input that constraints name, and the corners, with their values. Returns
    the constraints with the source's ids."""
    points, corners = xyz_of(data), constraints.corners
    used = np.unique(np.concatenate([*constraints.lines, *constraints.polygons]))
    used = used[used < len(points)].astype(np.int64)
    source.SetPoints(vtk_points(np.concatenate([points[used].astype(np.float64), corners])))
    for name, its in values.items():
        given = data.GetPointData().GetArray(name)
        if given is None:  # of a rank without points
            continue
        array = vtkDataArray.CreateDataArray(given.GetDataType())
        array.SetName(name)
        array.SetNumberOfComponents(given.GetNumberOfComponents())
        array.SetNumberOfTuples(len(used) + len(corners))
        vtk_to_numpy(array)[:] = np.concatenate([numpy_of(given)[used], its])
        source.GetPointData().AddArray(array)

    def renumbered(ids: np.ndarray) -> np.ndarray:
        return np.where(ids < len(points), np.searchsorted(used, ids), ids - len(points) + len(used))

    return Constraints([renumbered(ids) for ids in constraints.lines],
                       [renumbered(ids) for ids in constraints.polygons], corners)


def _count_ranks() -> int:
    controller = vtkMultiProcessController.GetGlobalController()
    return controller.GetNumberOfProcesses() if controller else 1


def _cells(lists: list[np.ndarray]) -> vtkCellArray:
    starts = np.concatenate([[0], np.cumsum([len(ids) for ids in lists])])
    return _cell_array(starts, np.concatenate(lists) if lists else np.zeros(0))


def _cell_array(starts: np.ndarray, ids: np.ndarray) -> vtkCellArray:
    cells = vtkCellArray()
    cells.SetData(_ids(starts), _ids(ids))
    return cells


def _ids(values: np.ndarray) -> vtkIdTypeArray:
    return numpy_to_vtkIdTypeArray(values.astype(np.int64, copy=False), deep=True)


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
    algorithm.SetMergeSourcePoints(has_points)  # must be the same on all ranks
    set_properties(algorithm, DELAUNAY_2D, options)
    run(algorithm, progress)
    return algorithm.GetOutput(), _statistics(algorithm.GetStatistics().GetFieldData())


def _cloud_of(points: Any, point_data: Any) -> Any:
    return points if check.is_vtk_object(points) else point_cloud(points, point_data)


def delaunay_3d(points: Any, point_data: Any, options: dict[str, Any],
                progress: Progress | None) -> tuple[Any, dict[str, Any]]:
    algorithm = vtkTIPPDelaunay3D()
    algorithm.SetInputData(_cloud_of(points, point_data))
    set_properties(algorithm, DELAUNAY_3D, options)
    run(algorithm, progress)
    return algorithm.GetOutput(), _statistics(algorithm.GetStatistics().GetFieldData())


def _statistics(totals: Any) -> dict[str, Any]:
    arrays = {totals.GetAbstractArray(i).GetName(): totals.GetAbstractArray(i)
              for i in range(totals.GetNumberOfArrays())}
    result: dict[str, Any] = {key: arrays[array_of(key)].GetValue(0) for key in _STATISTICS if array_of(key) in arrays}
    names, seconds = arrays.get("PhaseName"), arrays.get("PhaseSeconds")
    if names is not None and seconds is not None:
        result["seconds"] = {names.GetValue(i): seconds.GetValue(i) for i in range(names.GetNumberOfValues())}
    return result


def mesh(points: np.ndarray, point_data: dict[str, np.ndarray], lines: list[np.ndarray], polygons: list[np.ndarray],
         options: dict[str, Any], surface: Mesh | None, progress: Progress | None) -> Mesh:
    """Meshes (n, 3) points with lines and polygons between them. `surface` has the point array "size", or is None."""
    if _count_ranks() > 1:
        raise RuntimeError("a mesh is made on one rank; call the function outside of tipp.ranks().")
    source = point_cloud(points, point_data)
    source.SetLines(_cells(lines))
    source.SetPolys(_cells(polygons))
    maker = vtkTIPPRefine2D()
    maker.SetInputData(source)
    set_properties(maker, MESHING, {**options, "max_area": _limit(options["max_area"])})
    for x, y in options["holes"]:
        maker.AddHole(x, y)
    for x, y, area in options["regions"]:
        maker.AddRegion(x, y, _limit(area))
    if surface is not None:
        maker.SetSizeData(surface.to_vtk())
        maker.SetSizeArrayName("size")
    name = ""
    if options["lengths"] is not None:
        while not name or name in point_data:
            name += "size"
        source.GetPointData().AddArray(vtk_array(name, options["lengths"]))
        maker.SetSizeArrayName(name)
    run(maker, progress)
    result = from_vtk(maker.GetOutput())
    result.point_data.pop(name, None)
    return result


def _limit(largest: float) -> float:
    """Returns a limit of VTK's classes, for which 0 means none."""
    return 0.0 if math.isinf(largest) else largest


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


def delaunay_file_3d(
    paths: list[str], output: str, options: dict[str, Any], progress: Progress | None
) -> dict[str, int]:
    raise RuntimeError("dimension=3 needs the wheel of tipp, or the command 'tipp delaunay3d'; here delaunay_file() makes "
                       "triangles.")


def dem(points: Any, point_data: Any, options: dict[str, Any],
        progress: Progress | None) -> tuple[list[np.ndarray], tuple[float, ...], str | None]:
    """Returns the bands, with rows from north to south, their transform, and the CRS of points in files."""
    names, crs = options["attributes"], None
    if check.is_vtk_object(points):
        cloud = points
    elif check.are_files(points):
        cloud, crs = _read(points, options)
    else:
        cloud = point_cloud(points, point_data)
        if np.shape(points)[1] == 2 and check.needs_elevation(options):
            raise ValueError("points have no elevation; give an array of shape (n, 3) or other attributes.")
    if cloud.GetNumberOfPoints() == 0:
        raise RuntimeError("There are no points.")
    arrays = cloud.GetPointData()
    check.require_bands(names, [arrays.GetArrayName(i) for i in range(arrays.GetNumberOfArrays()) if arrays.GetArray(i)])
    maker = vtkTIPPPointsToImage()
    maker.SetInputData(cloud)
    _set_constraints(maker, options)
    maker.SetResolution(options["resolution"])
    if options["bounds"] is not None:
        maker.UseInputBoundsOff()
        maker.SetSamplingBounds(*options["bounds"])
        maker.StrictBoundsOn()
    maker.ClearBands()
    for name in names:
        maker.AddBand(name)
    set_properties(maker, DEM, options)
    run(maker, progress)
    image = maker.GetOutput()
    columns, rows, _ = image.GetDimensions()
    numbers = image.GetFieldData().GetArray("GeoTransform")
    west, width, _, north, _, height = (numbers.GetValue(i) for i in range(6))
    bands = [as_array(image, name).reshape(rows, columns)[::-1] for name in names]
    return bands, (width, 0.0, west, 0.0, height, north), crs


def _set_constraints(maker: Any, options: dict[str, Any]) -> None:
    for name in ("breaklines", "boundary"):
        value = options[name]
        if isinstance(value, str):
            getattr(maker, f"Set{name.capitalize()}FileName")(value)
        elif value is not None:
            getattr(maker, f"Set{name.capitalize()}Data")(_lines(*value))


def _lines(xy: np.ndarray, heights: np.ndarray, edges: np.ndarray) -> vtkPolyData:
    lines = point_cloud(np.column_stack([xy, heights if len(heights) else np.zeros(len(xy))]))
    lines.SetLines(_cell_array(2 * np.arange(len(edges) + 1), edges.ravel()))
    return lines


def _read(paths: list[str], options: dict[str, Any]) -> tuple[Any, str | None]:
    reader = _reader_of(paths, options)
    reader.SetColumns(",".join(options["attributes"]))
    run(reader)
    cloud = reader.GetOutput()
    arrays = cloud.GetPointData()
    has_all = all(arrays.HasArray(name) for name in options["attributes"] if name not in (*check.DERIVED_BANDS, "elevation"))
    if cloud.GetNumberOfPoints() and not (has_all and (reader.GetHasHeights() or not check.needs_elevation(options))):
        check.require_columns(options, _columns_in(paths, options))
    text = cloud.GetFieldData().GetAbstractArray("CoordinateReferenceSystem")
    return cloud, text.GetValue(0) if text else None


def _reader_of(paths: list[str], options: dict[str, Any]) -> vtkTIPPPointReader:
    reader = vtkTIPPPointReader()
    if options["classes"] is not None:
        reader.SetClasses(",".join(str(number) for number in options["classes"]))
    reader.SetReturns(options["returns"])
    for flag in options["keep"]:
        getattr(reader, "SetKeep" + flag.capitalize())(True)
    reader.SetZColumn(options["z"])
    reader.SetLayer(options["layer"])
    reader.SetCoordinateReferenceSystem(options["crs"])
    reader.SetGenerateVertices(False)
    for path in paths:
        reader.AddFileName(path)
    return reader


def find_coordinates(names: list[str]) -> list[int]:
    """Returns the indices of x, y and, if there are heights, z among the names of a table's columns. Raises ValueError
    with the reason if the names do not tell."""
    texts = vtkStringArray()
    for name in names:
        texts.InsertNextValue(name)
    columns = [-1, -1, -1]
    problem = vtkTIPPPointReader.FindCoordinates(texts, columns)
    if problem:
        raise ValueError(problem)
    return [column for column in columns if column >= 0]


def _columns_in(paths: list[str], options: dict[str, Any]) -> list[str]:
    """Returns the names of all columns besides x and y. Reads the files again."""
    reader = _reader_of(paths, options)
    run(reader)
    arrays = reader.GetOutput().GetPointData()
    return ["z"] * reader.GetHasHeights() + [arrays.GetArrayName(i) for i in range(arrays.GetNumberOfArrays())]


def resample(mesh: Any, options: dict[str, Any], progress: Progress | None) -> Any:
    mesh = _data_of(mesh)
    check.data_object(mesh, "mesh", ("vtkPointSet", "vtkCompositeDataSet"), "a mesh or a composite of meshes")
    algorithm = vtkRangeResampleFilter()
    algorithm.SetInputDataObject(mesh)
    if options["bounds"] is not None:
        algorithm.SetUseInputBounds(False)
        algorithm.StrictBoundsOn()
        algorithm.SetSamplingBounds(*_in_space(options["bounds"], mesh))
    if options["spacing"] is not None:
        algorithm.SetDelta(*options["spacing"])
    algorithm.SetSamplingDimensions(*options["dimensions"])
    algorithm.SetNullValue(options["null_value"])
    if options["no_data"] is not None:
        algorithm.SetUseNoDataValue(True)
        algorithm.SetNoDataValue(options["no_data"])
    if options["arrays"] is not None:
        _select(algorithm, mesh, options["arrays"])
    algorithm.SetMethod(algorithm.METHOD_CONSERVATIVE if options["conservative"] else algorithm.METHOD_LINEAR)
    algorithm.SetPassCoveredShare(options["covered_share"])
    algorithm.SetNumberOfThreads(options["threads"])
    run(algorithm, call=lambda: algorithm.SetDeviceChoice(options["device"]))
    run(algorithm, progress)
    return algorithm.GetOutput()


def remap(source: Any, target: Any, options: dict[str, Any], progress: Progress | None) -> Any:
    _require_one_rank("remap")
    source, target = _data_of(source), _data_of(target)
    check.data_object(source, "source", ("vtkPointSet", "vtkCompositeDataSet"), "a mesh or a composite of meshes")
    check.data_object(target, "target", ("vtkPointSet",), "a mesh")
    algorithm = vtkTIPPRemap()
    algorithm.SetInputDataObject(target)
    algorithm.SetSourceData(source)
    if options["arrays"] is not None:
        check.require_arrays(options["arrays"], _own_names_in(source))
        for name in options["arrays"]:
            algorithm.AddArray(name)
    algorithm.SetNullValue(options["null_value"])
    algorithm.SetNumberOfThreads(options["threads"])
    run(algorithm, progress)
    return algorithm.GetOutput()


def volume(before: Any, after: Any, options: dict[str, Any], progress: Progress | None) -> list[float]:
    """Returns cut, fill, the common area, and the areas of only one surface."""
    _require_one_rank("volume")
    algorithm = vtkTIPPCutFill()
    algorithm.SetInputDataObject(check.data_object(_data_of(before), "before", ("vtkPointSet",), "a mesh"))
    algorithm.SetSourceData(check.data_object(_data_of(after), "after", ("vtkPointSet",), "a mesh"))
    if options["bounds"] is not None:
        algorithm.UseBoundsOn()
        algorithm.SetBounds(*options["bounds"])
    algorithm.SetNumberOfThreads(options["threads"])
    run(algorithm, progress)
    row = algorithm.GetOutput()
    return [row.GetColumnByName(name).GetValue(0) for name in ("Cut", "Fill", "Area", "OnlyBefore", "OnlyAfter")]


def _require_one_rank(function: str) -> None:
    if _count_ranks() > 1:
        raise RuntimeError(f"tipp.{function}() works on one rank: call it outside of tipp.ranks().")


def _data_of(mesh: Any) -> Any:
    """Returns the triangles or tetrahedra of a Mesh as a data set of VTK, so that its cells keep their numbers; other
    values as they are."""
    return in_vtk(mesh.without_thin()) if isinstance(mesh, Mesh) else mesh


def _in_space(bounds: list[float], mesh: Any) -> list[float]:
    """Returns bounds with a z: that of all ranks' meshes if a cell is three-dimensional, else 0. Collective."""
    if len(bounds) == 6:
        return bounds
    cell = vtkGenericCell()
    low, high, is_volume = math.inf, -math.inf, False
    for leaf in _leaves(mesh):
        if leaf.GetNumberOfPoints():
            low, high = min(low, leaf.GetBounds()[4]), max(high, leaf.GetBounds()[5])
        types = vtkCellTypes()
        leaf.GetCellTypes(types)
        for i in range(types.GetNumberOfTypes()):
            cell.SetCellType(types.GetCellType(i))
            is_volume = is_volume or cell.GetCellDimension() == 3
    if _count_ranks() > 1:
        from mpi4py import MPI

        everywhere = MPI.COMM_WORLD.allgather((low, high, is_volume))
        low, high, is_volume = min(each[0] for each in everywhere), max(each[1] for each in everywhere), any(
            each[2] for each in everywhere)
    return [*bounds, low, high] if is_volume else [*bounds, 0.0, 0.0]


def _select(algorithm: vtkRangeResampleFilter, mesh: Any, names: list[str]) -> None:
    """Selects the arrays to sample. Raises KeyError for names that the mesh does not have."""
    of_points, of_cells = _names_in(mesh)
    if _count_ranks() == 1:  # this rank's part may have no arrays
        check.require_arrays(names, list(dict.fromkeys([*of_points, *of_cells])))
    for selection, wanted in (
        (algorithm.GetPointDataArraySelection(), [n for n in names if n in of_points or n not in of_cells]),
        (algorithm.GetCellDataArraySelection(), [n for n in names if n in of_cells and n not in of_points]),
    ):
        selection.SetUnknownArraySetting(0)
        for name in wanted:
            selection.EnableArray(name)


def _own_names_in(mesh: Any) -> list[str]:
    """Returns the names of a mesh's arrays of numbers, each once."""
    found = [(data, i) for leaf in _leaves(mesh) for data in (leaf.GetPointData(), leaf.GetCellData())
             for i in range(data.GetNumberOfArrays())]
    names = [data.GetArrayName(i) for data, i in found if data.GetArray(i) is not None]
    return list(dict.fromkeys(name for name in names if name and name != "vtkGhostType"))


def _names_in(mesh: Any) -> tuple[list[str], list[str]]:
    """Returns the names of the point arrays, with those that the filter adds, and of the cell arrays."""
    of_points: list[str] = []
    of_cells: list[str] = []
    for leaf in _leaves(mesh):
        for data, names in ((leaf.GetPointData(), of_points), (leaf.GetCellData(), of_cells)):
            its = [data.GetArrayName(i) for i in range(data.GetNumberOfArrays())]
            names.extend(name for name in its if name and name != "vtkGhostType")
        bounds = leaf.GetBounds()
        if bounds[4] < bounds[5]:
            of_points.append("elevation")
    return of_points, of_cells


def _leaves(mesh: Any) -> Iterator[Any]:
    if not mesh.IsA("vtkCompositeDataSet"):
        yield mesh
        return
    iterator = mesh.NewIterator()
    iterator.InitTraversal()
    while not iterator.IsDoneWithTraversal():
        if iterator.GetCurrentDataObject().IsA("vtkDataSet"):
            yield iterator.GetCurrentDataObject()
        iterator.GoToNextItem()


def read(path: str, options: dict[str, Any], progress: Progress | None) -> Any:
    reader = vtkPartitionedUnstructuredReader()
    reader.SetFileName(path)
    if options["bounds"] is not None:
        reader.SetBounds(*options["bounds"])
        reader.StrictBoundsOn()
    reader.SetBorrowerMode(reader.OWNED_AND_BORROWED if options["borrowed"] else reader.OWNED)
    _set_model(reader, options)
    set_properties(reader, READ, options)
    run(reader, call=reader.UpdateInformation)
    _keep_only(reader.GetPointDataArraySelection(), options["point_arrays"], "point")
    _keep_only(reader.GetCellDataArraySelection(), options["cell_arrays"], "cell")
    controller = reader.GetController()
    rank = controller.GetLocalProcessId() if controller else 0
    size = controller.GetNumberOfProcesses() if controller else 1
    time = options["time"]
    run(reader, progress, lambda: reader.UpdatePiece(rank, size, 0) if time is None
        else reader.UpdateTimeStep(time, rank, size, 0))
    return reader.GetOutputDataObject(0)


def times(path: str, options: dict[str, Any]) -> tuple[np.ndarray, str, str]:
    """Returns the times of the steps, their unit and calendar."""
    reader = vtkPartitionedUnstructuredReader()
    reader.SetFileName(path)
    _set_model(reader, options)
    run(reader, call=reader.UpdateInformation)
    key = vtkStreamingDemandDrivenPipeline.TIME_STEPS()
    information = reader.GetOutputInformation(0)
    found = information.Get(key) if information.Has(key) else ()
    return np.array(found, np.float64), reader.GetTimeUnits() or "", reader.GetCalendar() or ""


def _set_model(algorithm: Any, options: dict[str, Any]) -> None:
    """Sets how the output of a model is read."""
    for values in options["values"]:
        algorithm.AddValuesFileName(values)
    algorithm.SetWrap(options["wrap"])


def resample_series(path: str, options: dict[str, Any], progress: Progress | None) -> dict[str, Any]:
    """Returns the grid, the steps and the arrays of time steps on it."""
    _require_one_rank("resample_series")
    algorithm = vtkTIPPResampleSeries()
    algorithm.SetFileName(path)
    _set_model(algorithm, options)
    if options["bounds"] is not None:
        algorithm.UseBoundsOn()
        algorithm.SetBounds(*options["bounds"])
    set_properties(algorithm, SERIES, options)
    for name in options["arrays"]:
        algorithm.AddArray(name)
    for name in options["reduce"]:
        algorithm.AddReduction(name)
    if options["no_data"] is not None:
        algorithm.UseNoDataValueOn()
        algorithm.SetNoDataValue(options["no_data"])
    run(algorithm, progress)
    table = algorithm.GetOutput()
    fields = table.GetFieldData()

    def numbers(name: str) -> list[Any]:
        return numpy_of(fields.GetArray(name)).tolist() if fields.GetArray(name).GetNumberOfTuples() else []

    def texts(name: str) -> list[str]:
        array = fields.GetAbstractArray(name)
        return [array.GetValue(i) for i in range(array.GetNumberOfValues())]

    described = zip(texts("LongNames"), texts("StandardNames"), texts("Units"), numbers("Varies"))
    arrays = [(table.GetColumnName(i), np.ascontiguousarray(numpy_of(table.GetColumn(i)).T),
               {"long_name": long_name, "standard_name": standard_name, "units": units, "varies": bool(varies)})
              for i, (long_name, standard_name, units, varies) in enumerate(described)]
    return {"origin": numbers("Origin"), "spacing": numbers("Spacing"), "dimensions": numbers("Dimensions"),
            "steps": numbers("Steps"), "times": numbers("Times"), "time_units": texts("TimeUnits")[0],
            "calendar": texts("Calendar")[0], "crs": texts("ReferenceSystem")[0], "arrays": arrays}


def _keep_only(selection: Any, wanted: list[str] | None, what: str) -> None:
    if wanted is None:
        return
    known = [selection.GetArrayName(i) for i in range(selection.GetNumberOfArrays())]
    check.require_arrays(wanted, known, what)
    for name in known:
        selection.SetArraySetting(name, name in wanted)


def write(mesh: Any, path: str, options: dict[str, Any], progress: Progress | None) -> None:
    writer = vtkPartitionedUnstructuredWriter()
    if isinstance(mesh, str):
        writer.SetInputFileName(mesh)
    else:
        writer.SetInputData(check.data_object(_data_of(mesh), "mesh", ("vtkDataObject",), "a VTK data set or a path"))
    writer.SetFileName(path)
    set_properties(writer, WRITE, options)
    run(writer, progress, writer.Write)
    if isinstance(mesh, Mesh) and mesh.count_thin():
        warnings.warn(check.THIN_LEFT_OUT.format(mesh.count_thin()), RuntimeWarning, stacklevel=3)


Rings = Tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]
"""Rings of polygons: (n, 2) corners, the first corner of each ring and the end, each ring's zone, and whether it is a
hole."""


def open_mesh(mesh: Any, options: dict[str, Any]) -> MeshQuery:
    query = vtkPartitionedMeshQuery()
    set_properties(query, QUERY, options)
    if isinstance(mesh, str):
        query.SetFileName(mesh)
    else:
        query.SetSourceData(check.data_object(_data_of(mesh), "mesh", ("vtkPointSet", "vtkCompositeDataSet"), "a mesh"))
    return MeshQuery(query)


def open_part(mesh: Mesh, threads: int) -> MeshQuery:
    """Opens a mesh for queries of this rank alone."""
    query = vtkPartitionedMeshQuery()
    query.SetController(None)
    query.SetNumberOfThreads(threads)
    query.SetSourceData(grid_of(mesh))
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

    def _found(self, method: Callable[..., Any], arguments: tuple[Any, ...], *kinds: Any) -> tuple[np.ndarray, ...]:
        """Calls a method of the query with new arrays for its results, which it returns."""
        results = [kind() for kind in kinds]
        self._run(lambda: method(*arguments, *results))
        return tuple(vtk_to_numpy(result) for result in results)

    def _found_lines(self, method: Callable[..., Any], *arguments: Any) -> vtkPolyData:
        lines = vtkPolyData()
        self._run(lambda: method(*arguments, lines))
        return lines

    def _name(self, names: list[str]) -> None:
        self._query.ClearArrays()
        for name in names:
            self._query.AddArray(name)

    def names(self) -> list[str]:
        names = vtkStringArray()
        self._run(lambda: self._query.GetNamesOfArrays(names))
        return [names.GetValue(i) for i in range(names.GetNumberOfValues())]

    def locate(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return self._found(self._query.Locate, (_positions(points),), vtkIdTypeArray, vtkDoubleArray)

    def sample(self, points: np.ndarray, names: list[str]) -> tuple[np.ndarray, dict[str, np.ndarray]]:
        if not names:
            return self.locate(points)[0], {}
        values, cells = vtkPointData(), vtkIdTypeArray()

        def call() -> None:
            self._name(names)
            self._query.Interpolate(_positions(points), values, cells)

        self._run(call)
        return vtk_to_numpy(cells), arrays_of(values)

    def neighbors(self, cells: np.ndarray) -> np.ndarray:
        return self._found(self._query.Neighbors, (_ids(cells),), vtkIdTypeArray)[0]

    def star(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return self._found(self._query.Star, (_ids(points),), vtkIdTypeArray, vtkIdTypeArray)

    def ring_of_points(self, points: np.ndarray, k: int) -> tuple[np.ndarray, np.ndarray]:
        return self._found(self._query.RingOfPoints, (_ids(points), k), vtkIdTypeArray, vtkIdTypeArray)

    def ring_of_cells(self, cells: np.ndarray, k: int) -> tuple[np.ndarray, np.ndarray]:
        return self._found(self._query.RingOfCells, (_ids(cells), k), vtkIdTypeArray, vtkIdTypeArray)

    def boundary(self) -> tuple[np.ndarray, np.ndarray]:
        loops = self._found_lines(self._query.Boundary)
        if loops.GetNumberOfPoints() == 0:
            return np.zeros(1, np.int64), np.zeros(0, np.int64)
        return _starts(loops), vtk_to_numpy(loops.GetPointData().GetGlobalIds())

    def contours(self, array: str, component: int, levels: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        lines = self._found_lines(self._query.Contours, array, component, numpy_to_vtk(levels, deep=True))
        if lines.GetNumberOfPoints() == 0:
            return np.zeros(1, np.int64), np.zeros(0), np.zeros((0, 3))
        return _starts(lines), vtk_to_numpy(lines.GetCellData().GetScalars()), xyz_of(lines)

    def profile(self, polyline: np.ndarray, spacing: float, names: list[str]) -> tuple[Any, ...]:
        line = vtkPolyData()

        def call() -> None:
            self._name(names)
            self._query.Profile(_positions(polyline), spacing, line)

        self._run(call)
        values = arrays_of(line.GetPointData())
        points = xyz_of(line)
        points = points if self._query.GetMeshDimension() == 3 else points[:, :2]
        return values.pop("Distance"), points, values.pop("CellId"), {name: values[name] for name in names}

    def closest(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        return self._found(
            self._query.Closest, (_positions(points),), vtkIdTypeArray, vtkDoubleArray, vtkDoubleArray)

    def cells_in(self, box: list[float], rings: Rings | None, whole: bool) -> np.ndarray:
        if rings is None:
            return self._found(self._query.CellsInBox, (box, whole), vtkIdTypeArray)[0]
        return self._found(self._query.CellsInPolygons, (_polygons(rings), whole), vtkIdTypeArray)[0]

    def points_in(self, box: list[float], rings: Rings | None) -> np.ndarray:
        if rings is None:
            return self._found(self._query.PointsInBox, (box,), vtkIdTypeArray)[0]
        return self._found(self._query.PointsInPolygons, (_polygons(rings),), vtkIdTypeArray)[0]

    def zones(self, rings: Rings, count: int, array: str, component: int, level: float) -> list[np.ndarray]:
        table = vtkPointData()
        corners, starts, zones, holes = rings
        present, numbers = np.unique(zones, return_inverse=True)  # some zones may have no rings
        used = corners, starts, numbers, holes
        self._run(lambda: self._query.ZoneStatistics(_polygons(used), array, component, level, table))
        results = []
        for i, missing in enumerate([0, 0.0, np.nan, np.nan, np.nan, 0.0, 0.0]):
            found = vtk_to_numpy(table.GetArray(i))
            results.append(np.full(count, missing, found.dtype))
            results[i][present] = found
        return results

    def descend(self, points: np.ndarray, array: str, component: int
                ) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        lines = self._found_lines(self._query.Descend, _positions(points), array, component)
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
        return self._found(self._query.Components, (), vtkIdTypeArray, vtkIdTypeArray)


def _positions(points: np.ndarray) -> Any:
    return vtk_points(points).GetData()


def _polygons(rings: Rings) -> vtkPolyData:
    corners, starts, zones, holes = rings
    data = vtkPolyData()
    data.SetPoints(vtk_points(corners))
    data.SetPolys(_cell_array(starts, np.arange(len(corners))))
    for name, values in (("ZoneId", zones), ("IsHole", holes)):
        array = _ids(values)
        array.SetName(name)
        data.GetCellData().AddArray(array)
    return data


def _starts(lines: vtkPolyData) -> np.ndarray:
    """The index of the first point of each line, and the number of points. A closed line repeats its first point, and
    so does a line of one point."""
    cells = lines.GetLines()
    firsts = vtk_to_numpy(cells.GetConnectivityArray())[vtk_to_numpy(cells.GetOffsetsArray())[:-1]]
    return np.append(firsts, lines.GetNumberOfPoints()).astype(np.int64)


@contextlib.contextmanager
def ranks() -> Iterator[Any]:
    """A context in which the functions of this package work on all ranks of an MPI run together.

    Requires mpi4py and a VTK built with MPI. Each rank passes its own points, or has its own piece of a mesh. Delete
    filters that were created inside before leaving it: they hold VTK's controller.

    Yields
    ------
    mpi4py.MPI.Comm
        The communicator of all ranks.

    Examples
    --------
    >>> with tipp.ranks() as world:
    ...     piece = tipp.delaunay_2d(my_points)
    ...     total = world.allreduce(len(piece.cells))
    """
    from mpi4py import MPI  # before VTK's controller is initialised
    from vtkmodules.vtkParallelMPI import vtkMPIController

    controller = vtkMPIController()
    controller.Initialize()
    controller.SetGlobalController(controller)
    try:
        yield MPI.COMM_WORLD
    finally:
        controller.SetGlobalController(None)
        controller.Finalize(1)
