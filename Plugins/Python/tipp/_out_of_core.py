# SPDX-License-Identifier: BSD-3-Clause
"""tipp.delaunay_file: points in files, larger than memory."""
from __future__ import annotations

import os
import re
from typing import Sequence, Union

from ._run import run
from .vtkTIPPFilters import vtkTIPPOutOfCoreDelaunay2D

_Path = Union[str, "os.PathLike[str]"]

_FIGURES = {
    "points": "Points",
    "triangles": "Triangles",
    "duplicates": "DuplicatePoints",
    "rejected": "RejectedPoints",
    "pieces": "Pieces",
    "spilled_bytes": "SpilledBytes",
    "mesh_bytes": "MeshBytes",
    "resumed": "Resumed",
    "triangle_sum": "TriangleSum",
}


def _bytes_of(memory: int | str) -> int:
    match = re.fullmatch(r"([0-9]+)([KMG]?)", str(memory))
    size = int(match[1]) << {"": 0, "K": 10, "M": 20, "G": 30}[match[2]] if match else 0
    if not 0 < size < 1 << 63:
        raise ValueError(f"memory is {memory!r}; it is a number of bytes, as 536870912 or '512M' or '2G'.")
    return size


def delaunay_file(
    points: _Path | Sequence[_Path],
    output: _Path,
    *,
    memory: int | str = "2G",
    partitions: tuple[int, int] | None = None,
    columns: tuple[str | int, str | int] | None = None,
    map_duplicates: bool = False,
    neighbors: bool = False,
    count_only: bool = False,
    resume: bool = False,
    scratch: _Path | None = None,
    threads: int = 0,
    progress_bar: bool = False,
) -> dict[str, int]:
    """Exact Delaunay triangulation of points in files into a partitioned mesh, in bounded memory.

    Parameters
    ----------
    points
        One or more files, which are one input: .npy, .csv, .xyz or any that VTK reads. Global ids of
        the mesh's points are places in it. A column z is the third coordinate, others become point
        arrays.
    output
        The folder to write, by custom NAME.tipp. A partitioned mesh there is replaced.
    memory
        What points, triangles and buffers may take in each process: bytes, or a text as "512M" or
        "2G". What Python and the threads' kernels take comes on top.
    partitions
        Columns and rows of a grid of pieces. None: boxes of equally many points.
    columns
        Which columns are x and y, by name or number from 0. None: by the usual names, else the first two.
    map_duplicates
        Whether the mesh gets the point array RepresentativePointId.
    neighbors
        Whether the mesh gets the cell array NeighborIds: for each corner of a triangle the global id of
        the triangle opposite to it, -1 at the hull.
    count_only
        Whether to count triangles and sum them up instead of writing them.
    resume
        Whether to go on where a run for this output, input and options was killed or interrupted.
    scratch
        A folder on another disk for what is temporary. None: beside the output.
    threads
        Threads; 0 is OpenMP's choice.
    progress_bar
        Whether to show progress on the standard error stream.

    Returns
    -------
    dict
        Numbers: points, triangles, duplicates, rejected, pieces, spilled_bytes, mesh_bytes,
        resumed (0 or 1), and with count_only triangle_sum, a checksum of the triangles. Where VTK's
        global controller has several ranks, all must call this, and the numbers are on the first.

    Raises
    ------
    RuntimeError
        If it failed; what was at the output is still there, and resume goes on from what was done.
    KeyboardInterrupt
        On Ctrl-C, soon; the same holds.

    Examples
    --------
    >>> numpy.save("points.npy", numpy.random.default_rng(1).random((100_000, 2)))
    >>> tipp.delaunay_file("points.npy", "mesh.tipp", memory="64M")["triangles"]
    199973
    >>> part = tipp.read("mesh.tipp", bounds=(0.2, 0.4, 0.5, 0.7, 0, 0))
    """
    algorithm = vtkTIPPOutOfCoreDelaunay2D()
    for path in [points] if isinstance(points, (str, os.PathLike)) else points:
        algorithm.AddInputFileName(os.fspath(path))
    algorithm.SetFileName(os.fspath(output))
    algorithm.SetMemoryLimit(_bytes_of(memory))
    algorithm.SetNumberOfPartitions(*(partitions or (0, 0)))
    if columns is not None:
        algorithm.SetXColumn(str(columns[0]))
        algorithm.SetYColumn(str(columns[1]))
    algorithm.SetGenerateRepresentativeIds(map_duplicates)
    algorithm.SetGenerateNeighborIds(neighbors)
    algorithm.SetCountOnly(count_only)
    algorithm.SetResume(resume)
    algorithm.SetScratchFolder(None if scratch is None else os.fspath(scratch))
    algorithm.SetNumberOfThreads(threads)
    run(algorithm, progress_bar)
    totals = algorithm.GetOutput().GetFieldData()
    arrays = {key: totals.GetArray(name) for key, name in _FIGURES.items()}
    return {key: array.GetValue(0) for key, array in arrays.items() if array is not None}
