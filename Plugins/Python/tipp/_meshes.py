# SPDX-License-Identifier: BSD-3-Clause
"""tipp.read and tipp.write: partitioned and flat meshes."""
from __future__ import annotations

import math
import os
from typing import TYPE_CHECKING, Any, Iterable, Sequence

from . import _arguments as check
from ._run import run
from .vtkTIPPIO import vtkPartitionedUnstructuredReader, vtkPartitionedUnstructuredWriter

if TYPE_CHECKING:
    from vtkmodules.vtkCommonDataModel import vtkDataObject


def _keep_only(selection: Any, wanted: list[str] | None, what: str) -> None:
    if wanted is None:
        return
    known = [selection.GetArrayName(i) for i in range(selection.GetNumberOfArrays())]
    for name in wanted:
        if name not in known:
            raise KeyError(f"the mesh has no {what} array '{name}'; it has {known}.")
    for name in known:
        selection.SetArraySetting(name, name in wanted)


def read(
    path: str | os.PathLike[str],
    bounds: Sequence[float] | None = None,
    *,
    time: float | None = None,
    point_arrays: str | Iterable[str] | None = None,
    cell_arrays: str | Iterable[str] | None = None,
    borrowed: bool = False,
    merge: bool = True,
    tiling: str = "grid:4x4",
    memory_limit: int = 1 << 31,
    progress_bar: bool = False,
) -> vtkDataObject:
    """Reads a partitioned or flat mesh, or the part of it that meets a range.

    Parameters
    ----------
    path
        A folder NAME.tipp, a folder of .npy arrays, or a .vtu file with appended, raw data.
    bounds
        (x from, x to, y from, y to, z from, z to) in the mesh's units: only cells that share a point
        with the closed box, of triangles by x and y alone. Pieces that it does not meet are not opened.
        None: everything.
    time
        Of arrays that vary in time the last step not after it. None: the first.
    point_arrays, cell_arrays
        The name or the names of the arrays to read. None: all.
    borrowed
        Whether pieces also have, as ghosts, the cells that they borrow.
    merge
        Whether to return one vtkUnstructuredGrid, else a vtkPartitionedDataSet of pieces.
    tiling
        How a flat mesh is partitioned, as for write().
    memory_limit
        Bytes that loading a flat mesh may take besides its pieces.
    progress_bar
        Whether to show progress on the standard error stream.

    Returns
    -------
    vtkUnstructuredGrid or vtkPartitionedDataSet
        What pyvista.wrap takes. Within tipp.ranks() each rank has its own pieces.

    Raises
    ------
    RuntimeError
        If the mesh cannot be read; the message is the reader's.
    KeyError
        If the mesh has no such array.

    Examples
    --------
    >>> part = tipp.read("mesh.tipp", bounds=(0.2, 0.4, 0.5, 0.7, 0, 0))
    """
    reader = vtkPartitionedUnstructuredReader()
    reader.SetFileName(check.path(path, "path"))
    if bounds is not None:
        reader.SetBounds(*check.several(bounds, "bounds", 6, _bound))
    reader.SetBorrowerMode(reader.OWNED_AND_BORROWED if check.flag(borrowed, "borrowed") else reader.OWNED)
    reader.SetMergePieces(check.flag(merge, "merge"))
    reader.SetTiling(check.text(tiling, "tiling"))
    reader.SetMemoryLimit(check.memory(memory_limit, "memory_limit"))
    check.flag(progress_bar, "progress_bar")
    time = None if time is None else check.number(time, "time")
    of_points = None if point_arrays is None else check.names(point_arrays, "point_arrays")
    of_cells = None if cell_arrays is None else check.names(cell_arrays, "cell_arrays")
    run(reader, call=reader.UpdateInformation)
    _keep_only(reader.GetPointDataArraySelection(), of_points, "point")
    _keep_only(reader.GetCellDataArraySelection(), of_cells, "cell")
    controller = reader.GetController()
    rank = controller.GetLocalProcessId() if controller else 0
    size = controller.GetNumberOfProcesses() if controller else 1
    run(reader, progress_bar, lambda: _update(reader, rank, size, time))
    return reader.GetOutputDataObject(0)


def _bound(value: Any, name: str) -> float:
    result = check.number(value, name, finite=False)
    if math.isnan(result):
        raise ValueError(f"{name} is nan; give a number.")
    return result


def _update(reader: vtkPartitionedUnstructuredReader, rank: int, size: int, time: float | None) -> None:
    if time is None:
        reader.UpdatePiece(rank, size, 0)
    else:
        reader.UpdateTimeStep(time, rank, size, 0)


def write(
    mesh: Any,
    path: str | os.PathLike[str],
    *,
    tiling: str = "grid:4x4",
    duplicate_borrowers: bool = False,
    memory_limit: int = 1 << 31,
    threads: int = 0,
    progress_bar: bool = False,
) -> None:
    """Writes a mesh as a partitioned mesh.

    Parameters
    ----------
    mesh
        A vtkDataSet or vtkPartitionedDataSet, a PyVista data set, or the path of a flat mesh or of any
        file that VTK reads.
    path
        The folder to write, by custom NAME.tipp. A partitioned mesh there is replaced.
    tiling
        "grid:4x4", "grid:4x4x2", "quadtree:N" or "octree:N": boxes are split until about N cells or
        fewer meet each.
    duplicate_borrowers
        Whether cells that several partitions meet are stored in each of their pieces.
    memory_limit
        Bytes that it may take, the mesh in memory aside.
    threads
        OpenMP threads; 0 is OpenMP's choice.
    progress_bar
        Whether to show progress on the standard error stream.

    Raises
    ------
    RuntimeError
        If the mesh cannot be written; what was at the path is still there.

    Examples
    --------
    >>> tipp.write(mesh, "mesh.tipp", tiling="quadtree:100000")
    """
    writer = vtkPartitionedUnstructuredWriter()
    if isinstance(mesh, (str, bytes, os.PathLike)):
        writer.SetInputFileName(check.path(mesh, "mesh"))
    else:
        writer.SetInputData(check.data_object(mesh, "mesh", ("vtkDataObject",), "a VTK data set or a path"))
    writer.SetFileName(check.path(path, "path"))
    writer.SetTiling(check.text(tiling, "tiling"))
    writer.SetDuplicateBorrowers(check.flag(duplicate_borrowers, "duplicate_borrowers"))
    writer.SetMemoryLimit(check.memory(memory_limit, "memory_limit"))
    writer.SetNumberOfThreads(check.threads(threads))
    check.flag(progress_bar, "progress_bar")
    run(writer, progress_bar, writer.Write)
