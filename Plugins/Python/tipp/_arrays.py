# SPDX-License-Identifier: BSD-3-Clause
"""NumPy arrays as VTK's and back, without copies where VTK allows."""
from __future__ import annotations

import ctypes
import mmap
import os
import sys
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any, Mapping

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkFloatArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkPolyData

from ._arguments import data_object, text

if TYPE_CHECKING:
    from numpy.typing import ArrayLike
    from vtkmodules.vtkCommonCore import vtkDataArray
    from vtkmodules.vtkCommonDataModel import vtkDataSet, vtkImageData

_BLOCK = 4096  # rows
_SHARE = 64 * _BLOCK  # of a thread, at a time
_MOST_THREADS = 8
_MADV_POPULATE_WRITE = 23  # Linux 5.14


def taken(values: ArrayLike, name: str) -> np.ndarray:
    """The array that every function takes its numbers from: in the machine's byte order, of a type that VTK has.

    It shares the memory of `values` where that is possible. Masked entries become NaN. Raises TypeError or ValueError
    where a conversion would lose something.
    """
    try:
        array = values if isinstance(values, np.ma.MaskedArray) else np.asarray(values)
    except (TypeError, ValueError) as error:
        raise type(error)(f"{name} cannot be made an array of numbers; give rows of equal length.") from None
    kind, size = array.dtype.kind, array.dtype.itemsize
    if kind not in "fiub":
        raise TypeError(f"{name} is of type {array.dtype}; give real numbers.")
    if kind == "f" and size > 8:
        raise TypeError(f"{name} is of type {array.dtype}, which VTK does not have; give float64, "
                        "as by astype(numpy.float64), which rounds.")
    if np.ma.is_masked(array):
        if kind != "f":
            raise ValueError(f"{name} has masked entries and is of type {array.dtype}, which has no NaN; give floats, "
                             "or a value for them, as by filled(-1).")
        array = array.filled(np.nan)
    native = "u1" if kind == "b" else "f4" if kind == "f" and size == 2 else f"{kind}{size}"
    return np.asarray(array).astype(native, copy=False)


def _coordinates(points: ArrayLike) -> np.ndarray:
    if isinstance(points, np.ma.MaskedArray) and points.dtype.kind in "iu":
        points = np.ma.MaskedArray(_as_doubles(points.data, points.mask), points.mask)
    array = taken(points, "points")
    if array.ndim != 2 or array.shape[1] not in (2, 3):
        raise ValueError(f"points have the shape {array.shape}; give an array of shape (n, 2) or (n, 3).")
    if np.asarray(points).dtype.kind == "b":
        raise TypeError("points are of type bool; give real numbers.")
    return _as_doubles(array) if array.dtype.kind in "iu" and array.dtype.itemsize == 8 else array


def _as_doubles(integers: np.ndarray, mask: Any = False) -> np.ndarray:
    """Integers as doubles, none of them rounded but those under the mask."""
    doubles = integers.astype(np.float64)
    beyond = np.abs(doubles) >= 2.0**53
    if beyond.any():
        too_large = doubles >= (2.0**63 if integers.dtype.kind == "i" else 2.0**64)
        back = np.where(too_large, 0, doubles).astype(integers.dtype)
        rounded = beyond & (too_large | (back != integers)) & ~np.asarray(mask)
        if rounded.any():
            raise ValueError(f"points have {int(rounded.sum())} integers beyond 2**53 that a double cannot hold; "
                             "subtract an offset from them.")
    return doubles


def vtk_points(points: ArrayLike) -> vtkPoints:
    """VTK's points of an (n, 2) or (n, 3) array.

    They share the memory of a writable (n, 3) array of float32 or float64 in C order; any other array is
    copied once.
    """
    array = _coordinates(points)
    kind = array.dtype if array.dtype in (np.float32, np.float64) else np.dtype(np.float64)
    is_shared = (array.shape[1] == 3 and array.dtype == kind and array.flags.c_contiguous and array.flags.writeable)
    result = vtkPoints()
    result.SetData(numpy_to_vtk(array) if is_shared else _copied(array, kind))
    return result


def _copied(points: np.ndarray, kind: np.dtype) -> vtkDataArray:
    """x, y and z, or 0, in memory of VTK's.

    NumPy would ask for huge pages, whose first touch takes several times as long in a virtual machine that gives
    free memory back. Threads share the copying, block by block, which keeps to the cache; small pages are asked for
    many at once.
    """
    result = vtkFloatArray() if kind == np.float32 else vtkDoubleArray()
    result.SetNumberOfComponents(3)
    result.SetNumberOfTuples(len(points))
    if len(points) == 0:
        return result
    target = vtk_to_numpy(result)

    def fill(first: int) -> None:
        last = min(first + _SHARE, len(points))
        _touch(target[first:last])
        for begin in range(first, last, _BLOCK):
            rows = slice(begin, begin + _BLOCK)
            for axis in range(3):
                target[rows, axis] = points[rows, axis] if axis < points.shape[1] else 0

    shares = range(0, len(points), _SHARE)
    with ThreadPoolExecutor(min(_MOST_THREADS, len(os.sched_getaffinity(0)))) as threads:
        list(map(fill, shares) if len(shares) == 1 else threads.map(fill, shares))
    return result


def _touch(array: np.ndarray) -> None:
    """Has Linux map the memory of an array that will be written; older versions do not know how and need not."""
    if sys.platform == "linux":
        begin = array.__array_interface__["data"][0]
        page = begin // mmap.PAGESIZE * mmap.PAGESIZE
        ctypes.CDLL(None).madvise(ctypes.c_void_p(page), ctypes.c_size_t(begin + array.nbytes - page),
                                  _MADV_POPULATE_WRITE)


def vtk_array(name: str, values: ArrayLike) -> Any:
    """A named VTK array of one value or one row for each point.

    It shares the memory of values, if they are writable, contiguous and of a type that VTK has.
    """
    argument = f"point_data['{name}']"
    array = taken(values, argument)
    if array.ndim not in (1, 2) or array.shape[-1:] == (0,) and array.ndim == 2:
        raise ValueError(f"{argument} has the shape {array.shape}; give one value or one row for each point.")
    array = np.ascontiguousarray(array)
    result = numpy_to_vtk(array if array.flags.writeable else array.copy())
    result.SetName(name)
    return result


def point_cloud(points: ArrayLike, point_data: Mapping[str, ArrayLike] | None = None) -> vtkPolyData:
    """Points and values at them as a data set; see vtk_points for copies."""
    if point_data is not None and not isinstance(point_data, Mapping):
        raise TypeError("point_data is no mapping; give a dictionary of arrays by name.")
    cloud = vtkPolyData()
    cloud.SetPoints(vtk_points(points))
    for name, values in (point_data or {}).items():
        if not isinstance(name, str):
            raise TypeError(f"point_data has the key {name!r}; give names as keys.")
        array = vtk_array(name, values)
        if array.GetNumberOfTuples() != cloud.GetNumberOfPoints():
            raise ValueError(f"point_data['{name}'] has {array.GetNumberOfTuples()} values for "
                             f"{cloud.GetNumberOfPoints()} points.")
        cloud.GetPointData().AddArray(array)
    return cloud


def triangles_of(mesh: vtkPolyData) -> np.ndarray:
    """The (n, 3) point ids of a mesh of triangles, in the memory of the mesh."""
    return vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def as_array(data: vtkDataSet, name: str) -> np.ndarray:
    """An array of a data set's points or cells, in the data set's memory.

    Parameters
    ----------
    data
        Any VTK data set. Of an image the array has the image's shape, (z, y, x) without axes of one
        sample, and behind it the components, if there are several.
    name
        The array's name; points are looked at before cells.

    Returns
    -------
    numpy.ndarray
        A view: it keeps the data alive, and writing to it writes to the data set.

    Examples
    --------
    >>> grid = tipp.as_array(tipp.resample(mesh, dimensions=(300, 200, 1)), "height")
    >>> grid.shape
    (200, 300)
    """
    data_object(data, "data", ("vtkDataSet",), "a VTK data set")
    text(name, "name")
    of_points, of_cells = data.GetPointData(), data.GetCellData()
    array = of_points.GetArray(name) or of_cells.GetArray(name)
    if array is None:
        names = [d.GetArrayName(i) for d in (of_points, of_cells) for i in range(d.GetNumberOfArrays())]
        raise KeyError(f"there is no array '{name}'; there are {names}.")
    values = vtk_to_numpy(array)
    if not data.IsA("vtkImageData"):
        return values
    samples = _samples(data, bool(of_points.HasArray(name)))
    return values.reshape(*samples, *values.shape[1:])


def _samples(image: vtkImageData, of_points: bool) -> list[int]:
    counts = [n if of_points else max(n - 1, 1) for n in image.GetDimensions()]
    return [n for n in reversed(counts) if n > 1] or [1]


def wrapped_like(result: vtkDataObject, source: Any) -> Any:
    """The result as a PyVista object, if the source is one."""
    pyvista = sys.modules.get("pyvista")
    if pyvista is not None and isinstance(source, pyvista.DataObject):
        return pyvista.wrap(result)
    return result
