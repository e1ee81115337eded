# SPDX-License-Identifier: BSD-3-Clause
"""tipp.read and tipp.write: partitioned and flat meshes."""
from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Iterable, Sequence

from ._run import run
from .vtkTIPPIO import vtkPartitionedUnstructuredReader, vtkPartitionedUnstructuredWriter

if TYPE_CHECKING:
    from vtkmodules.vtkCommonDataModel import vtkDataObject


def _keep_only(selection: Any, names: Iterable[str] | None, what: str) -> None:
    if names is None:
        return
    known = [selection.GetArrayName(i) for i in range(selection.GetNumberOfArrays())]
    wanted = list(names)
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
    point_arrays: Iterable[str] | None = None,
    cell_arrays: Iterable[str] | None = None,
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
        The names of the arrays to read. None: all.
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
    reader.SetFileName(os.fspath(path))
    if bounds is not None:
        reader.SetBounds(*bounds)
    reader.SetBorrowerMode(reader.OWNED_AND_BORROWED if borrowed else reader.OWNED)
    reader.SetMergePieces(merge)
    reader.SetTiling(tiling)
    reader.SetMemoryLimit(memory_limit)
    run(reader, call=reader.UpdateInformation)
    _keep_only(reader.GetPointDataArraySelection(), point_arrays, "point")
    _keep_only(reader.GetCellDataArraySelection(), cell_arrays, "cell")
    controller = reader.GetController()
    rank = controller.GetLocalProcessId() if controller else 0
    size = controller.GetNumberOfProcesses() if controller else 1
    run(reader, progress_bar, lambda: _update(reader, rank, size, time))
    return reader.GetOutputDataObject(0)


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
    if isinstance(mesh, (str, os.PathLike)):
        writer.SetInputFileName(os.fspath(mesh))
    else:
        writer.SetInputData(mesh)
    writer.SetFileName(os.fspath(path))
    writer.SetTiling(tiling)
    writer.SetDuplicateBorrowers(duplicate_borrowers)
    writer.SetMemoryLimit(memory_limit)
    writer.SetNumberOfThreads(threads)
    run(writer, progress_bar, writer.Write)
