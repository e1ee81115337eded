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
    """Exact Delaunay triangulation of points in files into a partitioned mesh, in bounded memory.

    Parameters
    ----------
    points
        One or more files, which are one input: .npy, .csv, .xyz or any that VTK reads. Global ids of
        the mesh's points are indices into it. A column z is the third coordinate, others become point
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
    max_edge
        Triangles with an edge longer than this, in the units of the points, are left out. 0: none are.
    map_duplicates
        Whether the mesh gets the point array RepresentativePointId.
    neighbors
        Whether the mesh gets the cell array NeighborIds: for each corner of a triangle the global id of
        the triangle opposite to it, -1 at the hull.
    constraints
        A file of lines, whose edges are edges of the mesh, and of polygons: counter-clockwise ones keep what is
        inside, clockwise ones are holes. .csv, .poly, .14, or any that VTK or GDAL reads.
    boundary
        A file of closed lines, which are constraints, too: triangles outside of them are left out.
    holes
        A point (x, y) in each hole: triangles that constraints do not part from it are left out.
    crossings
        "split": constraints that cross get a new point there, after the others. "refuse": a RuntimeError.
    mark_constraints
        Whether the mesh gets the cell array ConstraintEdges: for each corner whether the edge opposite to it is a
        constraint.
    count_only
        Whether to count triangles and sum them up instead of writing them.
    resume
        Whether to go on where a run for this output, input and options was killed or interrupted.
    scratch
        A folder on another disk for what is temporary. None: beside the output.
    threads
        Threads; 0 is OpenMP's choice.
    progress_bar
        Whether to show progress on the standard error stream; or a function that is told the fraction done, and
        ends the run by returning False.

    Returns
    -------
    dict
        Numbers: points, triangles, duplicates, rejected, pieces, spilled_bytes, mesh_bytes,
        resumed (0 or 1), with count_only triangle_sum, a checksum of the triangles, and with constraints
        constraints, constraint_edges, crossing_points and crossing_rounds (unless resumed). Where VTK's
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
