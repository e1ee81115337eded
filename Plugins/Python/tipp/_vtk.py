# SPDX-License-Identifier: BSD-3-Clause
"""Converts between NumPy and VTK arrays, without copies where possible."""
from __future__ import annotations

import ctypes
import mmap
import os
import sys
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any, Mapping

import numpy as np

from ._arrays import attribute, attributes, coordinates, require_values
from ._data import CONSTRAINT_IDS, Image, Mesh
from ._vtkmodules import (
    numpy_to_vtk,
    vtk_to_numpy,
    vtkCellArray,
    vtkDataArray,
    vtkDataObject,
    vtkDoubleArray,
    vtkFloatArray,
    vtkIdTypeArray,
    vtkImageData,
    vtkPartitionedDataSet,
    vtkPoints,
    vtkPolyData,
    vtkTypeInt32Array,
    vtkTypeInt64Array,
    vtkUnstructuredGrid,
)

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

_BLOCK = 4096  # rows
_SHARE = 64 * _BLOCK  # rows that a thread copies at a time
_MOST_THREADS = 8
_MADV_POPULATE_WRITE = 23  # Linux 5.14
# By dtype.char; C has two names for integers of 64 bits.
_CLASSES = {"f": vtkFloatArray, "d": vtkDoubleArray, "i": vtkTypeInt32Array, "l": vtkTypeInt64Array,
            "q": vtkTypeInt64Array}


def vtk_points(points: ArrayLike) -> vtkPoints:
    """Converts an (n, 2) or (n, 3) array to vtkPoints.

    They share the memory of a writable (n, 3) array of float32 or float64 in C order; any other array is
    copied once.
    """
    array = coordinates(points)
    has_kind = array.dtype.char in "fd"
    kind = array.dtype if has_kind else np.dtype(np.float64)
    is_shared = array.shape[1] == 3 and has_kind and array.flags.carray  # in C order, aligned and writable
    result = vtkPoints()
    result.SetData(_shared(array, 3) if is_shared else _copied(array, kind))
    return result


def _shared(array: np.ndarray, columns: int) -> vtkDataArray:
    """Returns a VTK array that shares a C-order array and keeps it alive. Ten times faster than numpy_to_vtk()."""
    result = _CLASSES[array.dtype.char]()
    if columns > 1:
        result.SetNumberOfComponents(columns)
    result.SetVoidArray(array, array.size, 1)
    result._numpy_reference = array
    return result


def _copied(points: np.ndarray, kind: np.dtype) -> vtkDataArray:
    """Copies x, y and z (0 if missing) to vtkPoints.

    NumPy would request huge pages, whose first touch takes several times as long in a virtual machine that returns
    free memory to its host. Threads copy block by block, which suits the cache, and small pages are committed many at
    a time. A few points are copied in one step.
    """
    if len(points) <= _BLOCK:
        few = np.zeros((len(points), 3), kind)
        for axis in range(points.shape[1]):
            few[:, axis] = points[:, axis]
        return _shared(few, 3)
    result = vtkFloatArray() if kind == np.float32 else vtkDoubleArray()
    result.SetNumberOfComponents(3)
    result.SetNumberOfTuples(len(points))
    target = vtk_to_numpy(result)

    def fill(first: int) -> None:
        last = min(first + _SHARE, len(points))
        _touch(target[first:last])
        for begin in range(first, last, _BLOCK):
            rows = slice(begin, begin + _BLOCK)
            for axis in range(3):
                target[rows, axis] = points[rows, axis] if axis < points.shape[1] else 0

    shares = range(0, len(points), _SHARE)
    with ThreadPoolExecutor(min(_MOST_THREADS, _processors())) as threads:
        list(map(fill, shares) if len(shares) == 1 else threads.map(fill, shares))
    return result


def _processors() -> int:
    """Returns the number of processors that this process may use; on systems that do not tell, of all."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _touch(array: np.ndarray) -> None:
    """Asks Linux to commit an array's memory before it is written. Older kernels ignore this, which is harmless."""
    if sys.platform == "linux":
        begin = array.__array_interface__["data"][0]
        page = begin // mmap.PAGESIZE * mmap.PAGESIZE
        ctypes.CDLL(None).madvise(ctypes.c_void_p(page), ctypes.c_size_t(begin + array.nbytes - page),
                                  _MADV_POPULATE_WRITE)


def vtk_array(name: str, values: ArrayLike) -> Any:
    """Returns a named VTK array of one value or one row for each point.

    It shares the memory of values if they are writable, contiguous and of a type that VTK has.
    """
    array = attribute(name, values)
    result = numpy_to_vtk(array if array.flags.writeable else array.copy())
    result.SetName(name)
    return result


def point_cloud(points: ArrayLike, point_data: Mapping[str, ArrayLike] | None = None) -> vtkPolyData:
    """Returns points with point data as a data set; see vtk_points() about copies."""
    cloud = vtkPolyData()
    cloud.SetPoints(vtk_points(points))
    for name, array in attributes(point_data, cloud.GetNumberOfPoints()).items():
        cloud.GetPointData().AddArray(vtk_array(name, array))
    return cloud


def triangles_of(mesh: vtkPolyData) -> np.ndarray:
    """Returns the (n, 3) point ids of a mesh of triangles, in the memory of the mesh."""
    return vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)


_VERTEX, _LINE, _TRIANGLE, _TETRAHEDRON = 1, 3, 5, 10  # VTK_VERTEX and so on
_TYPES = {1: _VERTEX, 2: _LINE, 3: _TRIANGLE, 4: _TETRAHEDRON}  # by their number of corners
_THIN = (0, 1, 2, 3, 4)  # VTK_EMPTY_CELL to VTK_POLY_LINE


def xyz_of(data: Any) -> np.ndarray:
    """Returns the coordinates of a vtkPointSet's points."""
    points = data.GetPoints()
    return numpy_of(points.GetData()) if points and points.GetNumberOfPoints() else np.empty((0, 3))


def cells_of(ids: np.ndarray) -> vtkCellArray:
    """Returns cells with as many points as the array has columns, in the array's memory."""
    count, size = ids.shape
    if ids.dtype not in (np.int32, np.int64):
        ids = ids.astype(np.int64)
    cells = vtkCellArray()
    arrays = np.arange(0, size * count + 1, size, dtype=ids.dtype), np.ascontiguousarray(ids)
    cells.SetData(*(_shared(array, 1) for array in arrays))
    cells._numpy_reference = arrays  # VTK 9.1 keeps the arrays' memory, but not the arrays
    return cells


def cell_lists(cells: vtkCellArray) -> list[np.ndarray]:
    """Returns the point ids of each cell."""
    legacy = vtkIdTypeArray()
    cells.ExportLegacyFormat(legacy)
    values = vtk_to_numpy(legacy).astype(np.int64)
    lists = []
    at = 0
    while at < len(values):  # the number of ids, then the ids
        lists.append(values[at + 1:at + 1 + values[at]])
        at += 1 + int(values[at])
    return lists


def surface_of(mesh: Mesh, data: Any) -> vtkPolyData:
    """Returns a VTK mesh of triangles. Reuses the points and point data of a data set if they are the same."""
    result = vtkPolyData()
    _set_points(mesh, data, result)
    result.SetPolys(cells_of(mesh.cells))
    if mesh.vertices is not None:
        result.SetVerts(cells_of(mesh.vertices))
    if mesh.lines is not None:
        result.SetLines(cells_of(mesh.lines))
    _add_arrays(_cell_arrays(mesh.blocks()), result.GetCellData())
    return result


def _set_points(mesh: Mesh, data: Any, result: Any) -> None:
    if data is None:
        result.SetPoints(vtk_points(mesh.points))
    else:
        if data.GetPoints():
            result.SetPoints(data.GetPoints())
        result.GetPointData().PassData(data.GetPointData())
    for name, values in mesh.point_data.items():
        # A data set that was triangulated before has its old representatives.
        if data is None or name == "RepresentativePointId" or not result.GetPointData().HasArray(name):
            _add_arrays({name: values}, result.GetPointData())


def _cell_arrays(blocks: list[tuple[np.ndarray, dict[str, np.ndarray]]]) -> dict[str, np.ndarray]:
    """Returns the cell arrays with values for all cells of Mesh.blocks(), in their order."""
    return {name: np.concatenate([arrays[name] for _, arrays in blocks]) if len(blocks) > 1 else values
            for name, values in blocks[0][1].items()}


def _add_arrays(arrays: dict[str, np.ndarray], target: Any) -> None:
    for name, values in arrays.items():
        if name in ("GlobalPointIds", "GlobalCellIds"):
            target.SetGlobalIds(numpy_to_vtk(values, array_type=12))  # VTK_ID_TYPE
            target.GetGlobalIds().SetName(name)
        else:
            target.AddArray(vtk_array(name, values))


def grid_of(mesh: Mesh | None, data: Any = None) -> vtkUnstructuredGrid:
    """Returns a VTK mesh of all cells, those of fewer dimensions last as in vtkTIPPDelaunay3D. Reuses the points and point
    data of a data set if they are the same."""
    grid = vtkUnstructuredGrid()
    if mesh is not None:
        _set_points(mesh, data, grid)
        blocks = mesh.blocks()[::-1]
        _set_cells(grid, [ids for ids, _ in blocks])
        _add_arrays(_cell_arrays(blocks), grid.GetCellData())
    return grid


def _set_cells(grid: vtkUnstructuredGrid, blocks: list[np.ndarray]) -> None:
    """Sets the cells of a grid: blocks of ids, each of one kind of cell."""
    if len(blocks) == 1:
        grid.SetCells(_TYPES[blocks[0].shape[1]], cells_of(blocks[0]))
        return
    sizes = np.concatenate([np.full(len(ids), ids.shape[1]) for ids in blocks])
    arrays = np.concatenate([[0], np.cumsum(sizes)]), np.concatenate([ids.ravel() for ids in blocks]).astype(np.int64)
    cells = vtkCellArray()
    cells.SetData(*(_shared(array, 1) for array in arrays))
    cells._numpy_reference = arrays
    types = np.concatenate([np.full(len(ids), _TYPES[ids.shape[1]], np.uint8) for ids in blocks])
    grid.SetCells(numpy_to_vtk(types, deep=True), cells)


def partitioned(grids: list[vtkUnstructuredGrid]) -> vtkPartitionedDataSet:
    result = vtkPartitionedDataSet()
    result.SetNumberOfPartitions(len(grids))
    for i, grid in enumerate(grids):
        result.SetPartition(i, grid)
    return result


def image_of(image: Image) -> vtkImageData:
    result = vtkImageData()
    result.SetDimensions(*image.dimensions)
    result.SetOrigin(*image.origin)
    result.SetSpacing(*image.spacing)
    _add_arrays(image.point_data, result.GetPointData())
    _add_arrays(image.cell_data, result.GetCellData())
    if "vtkValidPointMask" in image.point_data:
        _add_ghosts(image, result)
    return result


def _add_ghosts(image: Image, result: vtkImageData) -> None:
    """Hides the samples outside of all cells, and the image's cells that have such a corner."""
    valid = image.array("vtkValidPointMask").reshape(image.dimensions[::-1]) != 0
    hidden_point, hidden_cell = 2, 32  # vtkDataSetAttributes
    of_points = np.where(valid, 0, hidden_point).astype(np.uint8)
    for axis in range(3):
        if valid.shape[axis] > 1:
            valid = np.delete(valid, -1, axis) & np.delete(valid, 0, axis)
    of_cells = np.where(valid, 0, hidden_cell).astype(np.uint8)
    result.GetPointData().AddArray(vtk_array("vtkGhostType", of_points.ravel()))
    result.GetCellData().AddArray(vtk_array("vtkGhostType", of_cells.ravel()))


def from_vtk(data: Any) -> Any:
    """Returns a mesh of triangles or tetrahedra as a Mesh, an image as an Image, and a vtkPartitionedDataSet as a list of
    Meshes. They share the memory of the data set, and leave out its marks of ghosts in images, which an image has in
    vtkValidPointMask."""
    if data.IsA("vtkPartitionedDataSet"):
        return [from_vtk(data.GetPartitionAsDataObject(i)) for i in range(data.GetNumberOfPartitions())]
    if data.IsA("vtkImageData"):
        arrays = [arrays_of(data.GetPointData()), arrays_of(data.GetCellData())]
        for its in arrays:
            its.pop("vtkGhostType", None)
        return Image(data.GetOrigin(), data.GetSpacing(), data.GetDimensions(), *arrays)
    mesh, _ = simplices_of(data)
    if data.IsA("vtkPolyData"):
        thin = {1: _ids_of(data.GetVerts()), 2: _ids_of(data.GetLines())}
    else:
        thin = {size: _ids_of_type(data, kind) for size, kind in _TYPES.items() if size < np.shape(mesh.cells)[1]}
    found = {size: ids.reshape(-1, size) for size, ids in thin.items() if len(ids)}
    mesh.vertices, mesh.lines, mesh.triangles = (found.get(size) for size in (1, 2, 3))
    if mesh.lines is not None and CONSTRAINT_IDS in mesh.cell_data:
        del mesh.cell_data[CONSTRAINT_IDS]
        first = 0 if mesh.vertices is None else len(mesh.vertices)
        marks = numpy_of(data.GetCellData().GetArray(CONSTRAINT_IDS))
        mesh.line_data[CONSTRAINT_IDS] = marks[first:first + len(mesh.lines)]
    return mesh


def _ids_of_type(grid: Any, kind: int) -> np.ndarray:
    """Returns the point ids of the cells of one type."""
    if not grid.GetNumberOfCells():
        return np.zeros(0, np.int64)
    rows = np.flatnonzero(_types_of(grid) == kind)
    if not len(rows):
        return np.zeros(0, np.int64)
    size = next(corners for corners, its in _TYPES.items() if its == kind)
    begins = numpy_of(grid.GetCells().GetOffsetsArray())[rows]
    return _ids_of(grid.GetCells())[begins[:, np.newaxis] + np.arange(size)]


def numpy_of(array: Any) -> np.ndarray:
    """Returns the values of a VTK array, in its memory if it has them in one block. Implicit arrays, which compute their
    values, and arrays of one block for each component are copied."""
    if array.HasStandardMemoryLayout():
        return vtk_to_numpy(array)
    copy = vtkDataArray.CreateDataArray(array.GetDataType())
    copy.DeepCopy(array)
    return vtk_to_numpy(copy)


def arrays_of(data: Any, count: int = 0, of: str = "points") -> dict[str, np.ndarray]:
    """Returns the numeric arrays that have a name. Raises RuntimeError if one has fewer values than `count`."""
    arrays = [data.GetArray(i) for i in range(data.GetNumberOfArrays())]
    named = {array.GetName(): array for array in arrays if array is not None and array.GetName()}
    for name, array in named.items():
        require_values(name, array.GetNumberOfTuples(), count, of)
    return {name: numpy_of(array) for name, array in named.items()}


def point_arrays(data: Any) -> dict[str, np.ndarray]:
    """Returns the numeric point arrays of a data set, as arrays_of()."""
    return arrays_of(data.GetPointData(), data.GetNumberOfPoints())


def simplices_of(data: Any) -> tuple[Mesh, np.ndarray | None]:
    """Returns the triangles or tetrahedra of a data set, sharing its memory, and their indices among its cells; None if
    they are all its cells. Cells of fewer dimensions are left out. Raises RuntimeError for other cells."""
    found = None
    if data.IsA("vtkPolyData"):
        found = _triangles_in(data)
    elif data.IsA("vtkUnstructuredGrid"):
        found = _simplices_in(data)
    if found is None:
        raise RuntimeError(f"the mesh is a {data.GetClassName()} whose cells are not only triangles or only tetrahedra; "
                           "convert them first, for example by PyVista's triangulate().")
    corners, rows = found
    of_cells = arrays_of(data.GetCellData(), data.GetNumberOfCells(), "cells")
    if rows is not None:
        of_cells = {name: values[rows] for name, values in of_cells.items()}
    return Mesh(xyz_of(data), corners, point_arrays(data), of_cells), rows


def _triangles_in(surface: Any) -> tuple[np.ndarray, np.ndarray | None] | None:
    """Returns the corners of triangles, and their indices among all cells, which begin with vertices and lines."""
    cells = surface.GetPolys()
    if surface.GetNumberOfStrips() or cells.IsHomogeneous() not in (-1, 0, 3):
        return None
    corners = _ids_of(cells).reshape(-1, 3)
    before = surface.GetNumberOfVerts() + surface.GetNumberOfLines()
    return corners, np.arange(before, before + len(corners)) if before else None


def _simplices_in(grid: Any) -> tuple[np.ndarray, np.ndarray | None] | None:
    """Returns the same for the tetrahedra of a grid or, if it has none, for its triangles."""
    types = _types_of(grid) if grid.GetNumberOfCells() else np.zeros(0, np.uint8)
    kind = _TETRAHEDRON if (types == _TETRAHEDRON).any() else _TRIANGLE
    if not np.isin(types, (*_THIN, _TRIANGLE, kind)).all():
        return None
    size = 4 if kind == _TETRAHEDRON else 3
    cells = grid.GetCells()
    ids = _ids_of(cells)
    if (types == kind).all():
        return ids.reshape(-1, size), None
    rows = np.flatnonzero(types == kind)
    begins = numpy_of(cells.GetOffsetsArray())[rows]
    return ids[begins[:, np.newaxis] + np.arange(size)], rows


def _types_of(grid: Any) -> np.ndarray:
    try:
        return numpy_of(grid.GetCellTypes())  # since VTK 9.6
    except TypeError:
        return numpy_of(grid.GetCellTypesArray())


def _ids_of(cells: Any) -> np.ndarray:
    return numpy_of(cells.GetConnectivityArray()) if cells and cells.GetNumberOfCells() else np.zeros(0, np.int64)
