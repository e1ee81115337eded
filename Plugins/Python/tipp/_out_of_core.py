# SPDX-License-Identifier: BSD-3-Clause
"""tipp.delaunay_file: points in files, larger than memory."""
from __future__ import annotations

import os
from typing import Any, Iterable, Mapping, Sequence, Union

from . import _arguments as check
from . import _engine
from ._arguments import ProgressBar, progress_of

_Path = Union[str, "os.PathLike[str]"]

def _paths(points: Any) -> list[str]:
    is_list = isinstance(points, Iterable) and not isinstance(points, (str, bytes, os.PathLike, Mapping))
    return [check.path(path, "points") for path in (points if is_list else [points])]


def _column(value: Any, name: str) -> str:
    return value if isinstance(value, str) else str(check.whole(value, name))


def _optional_path(value: Any, name: str) -> str:
    return "" if value is None else check.path(value, name)


def delaunay_file(
    points: _Path | Sequence[_Path],
    output: _Path,
    *,
    memory: int | str = "2G",
    partitions: tuple[int, int] | None = None,
    columns: tuple[str | int, str | int] | None = None,
    max_edge: float = 0.0,
    map_duplicates: bool = False,
    neighbors: bool = False,
    constraints: _Path | None = None,
    boundary: _Path | None = None,
    holes: Sequence[tuple[float, float]] = (),
    crossings: str = "split",
    mark_constraints: bool = False,
    count_only: bool = False,
    resume: bool = False,
    scratch: _Path | None = None,
    threads: int = 0,
    progress_bar: ProgressBar = False,
) -> dict[str, int]:
    """Writes the exact Delaunay triangulation of points in files as a partitioned mesh, in bounded memory.

    Parameters
    ----------
    points
        One or more files, read as one input: .npy, .csv, .xyz or any format that VTK reads. Global ids of the mesh's
        points are indices into this input. A column z is the third coordinate; others become point arrays.
    output
        The folder to write, usually called NAME.tipp. It replaces an existing partitioned mesh.
    memory
        The memory limit of each process for points, triangles and buffers: bytes, or a text such as "512M" or "2G".
        Python and the threads' kernels need some more.
    partitions
        Columns and rows of a grid of pieces. None: boxes with equally many points.
    columns
        Which columns are x and y, by name or index from 0. None: columns with the usual names, else the first two.
    max_edge
        Triangles with an edge longer than this, in the units of the points, are removed. 0: no limit.
    map_duplicates
        Whether the mesh gets the point array RepresentativePointId.
    neighbors
        Whether the mesh gets the cell array NeighborIds: for each corner of a triangle the global id of the triangle
        across the opposite edge, -1 at the border.
    constraints
        A file of lines and polygons, whose edges become edges of the mesh. Only triangles inside of counter-clockwise
        polygons are kept; clockwise ones are holes. .csv, .poly, .14, or any format that VTK or GDAL reads.
    boundary
        A file of closed lines, which are constraints, too; triangles outside of them are removed.
    holes
        A point (x, y) in each hole: all triangles that are not separated from it by constraints are removed.
    crossings
        "split": where constraints cross, a new point is added after the others. "refuse": crossing constraints raise
        RuntimeError.
    mark_constraints
        Whether the mesh gets the cell array ConstraintEdges: for each corner of a triangle whether the opposite edge
        is part of a constraint.
    count_only
        Whether to count triangles and compute their checksum instead of writing them.
    resume
        Whether to resume a killed or interrupted run with the same output, input and options.
    scratch
        A folder for temporary files, for example on another disk. None: beside the output.
    threads, progress_bar
        As for delaunay().

    Returns
    -------
    dict
        Statistics: points, triangles, duplicates, rejected, pieces, spilled_bytes, mesh_bytes and resumed (0 or 1).
        With count_only also triangle_sum, a checksum of the triangles. With constraints also constraints,
        constraint_edges, crossing_points and crossing_rounds (unless resumed). If VTK's global controller has several
        ranks, all must call this function, and the first rank gets the statistics.

    Raises
    ------
    RuntimeError
        If it failed. The output path is then unchanged, and resume=True continues the work.
    KeyboardInterrupt
        Promptly after Ctrl-C; the same applies.

    Examples
    --------
    >>> numpy.save("points.npy", numpy.random.default_rng(1).random((100_000, 2)))
    >>> tipp.delaunay_file("points.npy", "mesh.tipp", memory="64M")["triangles"]
    199973
    >>> part = tipp.read("mesh.tipp", bounds=(0.2, 0.4, 0.5, 0.7, 0, 0))
    """
    options = {
        "memory": check.memory(memory, "memory"),
        "partitions": (0, 0) if partitions is None else tuple(check.several(partitions, "partitions", 2, check.whole)),
        "columns": ("", "") if columns is None else tuple(check.several(columns, "columns", 2, _column)),
        "max_edge": check.number(max_edge, "max_edge", at_least=0),
        "map_duplicates": check.flag(map_duplicates, "map_duplicates"),
        "neighbors": check.flag(neighbors, "neighbors"),
        "constraints": _optional_path(constraints, "constraints"),
        "boundary": _optional_path(boundary, "boundary"),
        "holes": [tuple(check.several(hole, "holes", 2, check.number)) for hole in check.a_list(holes, "holes")],
        "crossings": check.choice(crossings, "crossings", {"split": 1, "refuse": 0}),
        "mark_constraints": check.flag(mark_constraints, "mark_constraints"),
        "count_only": check.flag(count_only, "count_only"),
        "resume": check.flag(resume, "resume"),
        "scratch": _optional_path(scratch, "scratch"),
        "threads": check.threads(threads),
    }
    return _engine.delaunay_file(_paths(points), check.path(output, "output"), options, progress_of(progress_bar))
