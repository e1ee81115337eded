# SPDX-License-Identifier: BSD-3-Clause
"""tipp.delaunay, delaunay_2d, delaunay_3d and delaunay_file: triangulations of points in memory and in files."""
from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Iterable, Mapping, Sequence, Union

import numpy as np

from . import _arguments as check
from . import _engine
from ._arguments import ProgressBar, progress_of
from ._arrays import cloud_of
from ._results import kind_of, result_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

_Path = Union[str, "os.PathLike[str]"]
_SCHEDULES = {"stages": 0, "dynamic": 1, "producer-consumer": 2}
_CROSSINGS = {"split": 1, "refuse": 0}
_MARKS = {"none": 0, "lines": 1, "flags": 2}
_ONLY_IN_THE_PLANE = {"partitions": (0, 0), "max_edge": 0, "constraints": "", "boundary": "", "holes": [], "crossings": 1,
                      "mark_constraints": False, "count_only": False}


def delaunay(
    points: ArrayLike,
    *,
    tol: float = 0.0,
    max_edge: float = 0.0,
    partitions: tuple[int, int] | None = None,
    schedule: str = "dynamic",
    threads: int = 0,
    progress_bar: ProgressBar = False,
) -> np.ndarray:
    """Computes the exact Delaunay triangulation of points in the x-y plane.

    Parameters
    ----------
    points
        Coordinates of shape (n, 2) or (n, 3); z is ignored. A writable (n, 3) array of float32 or float64 in C order
        is not copied; any other array is copied once. Masked coordinates become NaN. Or laspy's LasData, a table with
        columns x and y such as a DataFrame of pandas or polars, geometries of points such as a GeoSeries, a mesh of tipp,
        meshio, VTK or PyVista, or the pixels of an xarray raster.
    tol
        Points within this fraction of the bounding box's diagonal of each other are merged. 0 merges only coincident
        points.
    max_edge
        Triangles with an edge longer than this, in the units of the points, are removed. 0: no limit.
    partitions
        Columns and rows of a grid of partitions. None: chosen automatically. The triangles do not depend on it.
    schedule
        "dynamic", "stages" or "producer-consumer". The triangles do not depend on it.
    threads
        Number of threads; 0: OMP_NUM_THREADS, or one per processor.
    progress_bar
        Whether to show progress on standard error; or a function that is called with the fraction done and can stop
        the run by returning False.

    Returns
    -------
    numpy.ndarray
        (m, 3) point ids, counter-clockwise, with 32 bits if they fit, else with 64. Merged points and non-finite
        points are in no triangle; non-finite points cause a RuntimeWarning.

    Raises
    ------
    TypeError, ValueError
        If an argument is of a wrong type or value.
    RuntimeError
        If the triangulation failed; the message is the filter's.
    KeyboardInterrupt
        Promptly after Ctrl-C.

    Notes
    -----
    Within tipp.ranks() all ranks call it together, each with its own points. The ids then refer to the output's
    points, which only delaunay_2d() returns, so use that instead.

    Examples
    --------
    >>> points = numpy.random.default_rng(1).random((100_000, 2))
    >>> tipp.delaunay(points).shape
    (199964, 3)
    """
    options = _options(tol, max_edge, partitions, schedule, threads)
    check.require_point_set(points)
    return _engine.delaunay(points, options, progress_of(progress_bar))


def delaunay_2d(
    points: Any,
    *,
    tol: float = 0.0,
    max_edge: float = 0.0,
    alpha: float = 0.0,
    offset: float = 1.0,
    bound: bool = False,
    point_data: Mapping[str, ArrayLike] | None = None,
    edges: Any = None,
    polygons: Iterable[Any] | None = None,
    edge_source: Any = None,
    crossings: str = "split",
    marks: str = "none",
    map_duplicates: bool = True,
    neighbors: bool = False,
    return_statistics: bool = False,
    return_type: str | None = None,
    partitions: tuple[int, int] | None = None,
    schedule: str = "dynamic",
    threads: int = 0,
    progress_bar: ProgressBar = False,
) -> Any:
    """Computes the exact Delaunay triangulation as a mesh, with the keywords of PyVista's delaunay_2d.

    With `edges`, `polygons` or `edge_source` it is a constrained Delaunay triangulation.

    Parameters
    ----------
    points
        An array or an object as for delaunay(), a mesh of tipp or meshio, or a vtkPointSet or PyVista data set.
    tol, max_edge, partitions, schedule, threads, progress_bar
        As for delaunay().
    alpha
        The largest circumradius, in the units of the points. Triangles with a larger one are removed; edges and points
        that are then in no triangle become lines and vertices. 0: all triangles.
    offset
        With bound: the radius of the circle, as a multiple of the bounding box's diagonal.
    bound
        Whether to add eight points on a circle around the others.
    point_data
        For an array of points: a dictionary of arrays with values at the points.
    edges
        Constraints, which become edges of the triangulation: an (m, 2) array of point ids; or a list of lines, each an
        array of coordinates, a LineString or another geometry; or a GeoSeries or GeoDataFrame of these.
    polygons
        Closed polygons: sequences of point ids; arrays of coordinates of shape (k, 2) or (k, 3); or Shapely polygons
        with their holes, a GeoSeries or a GeoDataFrame. Only triangles inside of counter-clockwise polygons are kept;
        clockwise ones are holes. Polygons that are geometries may have any orientation. Corners of polygons and lines
        where `points` has no point are new points. Values at them are interpolated from the points, and so is z if no
        corner has one, or if all are 0.
    edge_source
        Instead of both: a vtkPolyData or pyvista.PolyData whose lines and polygons are constraints. Their point ids
        refer to `points`.
    crossings
        "split": where constraints cross, a new point is added after the others. "refuse": crossing constraints raise
        RuntimeError.
    marks
        How the mesh marks constraints. "lines": as line cells, with the cell array ConstraintId. "flags": in the cell
        array ConstraintEdges: for each corner of a triangle whether the opposite edge is part of a constraint. "none":
        not at all.
    map_duplicates
        Whether the mesh gets the point array RepresentativePointId, if there are coincident or non-finite points: the
        lowest id of the coincident points, or -1 for a non-finite point.
    neighbors
        Whether the mesh gets the cell array NeighborIds: for each corner of a triangle the id of the triangle across
        the opposite edge, -1 at the border.
    return_statistics
        Whether to return (mesh, statistics): a dictionary of counts (points, triangles, duplicates, rejected,
        partitions, threads, constraints, crossing_points, ...), the seconds of each phase, and where the default number
        of threads comes from (default_threads_from).
    return_type
        "tipp", "vtk" or "pyvista": what the result is. None: tipp's for arrays, VTK's for a data set of VTK, and PyVista's
        for one of PyVista, whatever is installed.

    Returns
    -------
    tipp.Mesh, vtkPolyData or pyvista.PolyData
        The input's points and point data, with triangles. See return_type.

    Raises
    ------
    ModuleNotFoundError
        If return_type needs a library that is not installed.
    RuntimeError, KeyboardInterrupt
        As delaunay().

    Examples
    --------
    >>> mesh = tipp.delaunay_2d(xyz, point_data={"depth": depth})

    With breaklines between points, inside a boundary:

    >>> mesh = tipp.delaunay_2d(xyz, edges=[[0, 17], [17, 5]], polygons=[[2, 40, 31, 8]])
    """
    options = _options(tol, max_edge, partitions, schedule, threads)
    options["alpha"] = check.number(alpha, "alpha", at_least=0)
    options["offset"] = check.number(offset, "offset", at_least=0)
    options["bound"] = check.flag(bound, "bound")
    check.require_point_set(points, point_data)
    kind = kind_of(return_type, points)
    points, point_data = cloud_of(points, point_data)
    options["edges"], options["polygons"], options["edge_source"] = edges, polygons, edge_source
    options["crossings"] = check.choice(crossings, "crossings", _CROSSINGS)
    options["marks"] = check.choice(marks, "marks", _MARKS)
    options["map_duplicates"] = check.flag(map_duplicates, "map_duplicates")
    options["neighbors"] = check.flag(neighbors, "neighbors")
    wants_statistics = check.flag(return_statistics, "return_statistics")
    found, statistics = _engine.delaunay_2d(points, point_data, options, progress_of(progress_bar))
    mesh = result_of(found, kind)
    return (mesh, statistics) if wants_statistics else mesh


def _options(tol: Any, max_edge: Any, partitions: Any, schedule: Any, threads: Any) -> dict[str, Any]:
    """Checks and returns the options that delaunay() and delaunay_2d() share."""
    return {
        "tolerance": check.number(tol, "tol", at_least=0),
        "max_edge": check.number(max_edge, "max_edge", at_least=0),
        "partitions": _grid(partitions),
        "schedule": check.choice(schedule, "schedule", _SCHEDULES),
        "threads": check.threads(threads),
    }


def _grid(partitions: Any) -> tuple[int, ...]:
    return (0, 0) if partitions is None else tuple(check.several(partitions, "partitions", 2, check.whole))


def delaunay_3d(
    points: Any,
    *,
    alpha: float = 0.0,
    tol: float = 0.0,
    offset: float = 2.5,
    bound: bool = False,
    point_data: Mapping[str, ArrayLike] | None = None,
    map_duplicates: bool = True,
    neighbors: bool = False,
    return_statistics: bool = False,
    return_type: str | None = None,
    partitions: int = 0,
    threads: int = 0,
    progress_bar: ProgressBar = False,
) -> Any:
    """Computes the exact Delaunay tetrahedralization as a mesh, with the keywords of PyVista's delaunay_3d.

    If all points are in one plane, the mesh has triangles.

    Parameters
    ----------
    points
        An array of shape (n, 3) or another object as for delaunay(), a mesh of tipp or meshio, or a vtkPointSet or
        PyVista data set.
    alpha
        The largest circumradius, in the units of the points. Tetrahedra with a larger one are removed; facets, edges
        and points that are then in no tetrahedron become triangles, lines and vertices. 0: all tetrahedra.
    tol
        Points within this fraction of the bounding box's diagonal of each other are merged. 0 merges only coincident
        points.
    offset
        With bound: the distance of the octahedron's corners from the centre, as a multiple of the bounding box's
        diagonal; at least 2.5.
    bound
        Whether to add the corners of an octahedron around the points.
    point_data
        For an array of points: a dictionary of arrays with values at the points.
    map_duplicates
        Whether the mesh gets the point array RepresentativePointId, if there are coincident or non-finite points: the
        lowest id of the coincident points, or -1 for a non-finite point.
    neighbors
        Whether the mesh gets the cell array NeighborIds: for each corner of a tetrahedron the id of the tetrahedron
        across the opposite facet, -1 at the border.
    return_statistics
        Whether to return (mesh, statistics): a dictionary of counts (points, tetrahedra, duplicates, rejected,
        partitions, threads, ...) and the seconds of each phase.
    return_type
        "tipp", "vtk" or "pyvista": what the result is. None: tipp's for arrays, VTK's for a data set of VTK, and PyVista's
        for one of PyVista, whatever is installed.
    partitions
        The number of partitions, at most 512. 0: chosen automatically. The result does not depend on it.
    threads, progress_bar
        As for delaunay().

    Returns
    -------
    tipp.Mesh, vtkUnstructuredGrid or pyvista.UnstructuredGrid
        The input's points and point data, with tetrahedra. See return_type.

    Raises
    ------
    TypeError, ValueError
        If an argument is of a wrong type or value.
    RuntimeError
        If it failed; the message is the filter's.
    KeyboardInterrupt
        Promptly after Ctrl-C.

    Examples
    --------
    >>> mesh = tipp.delaunay_3d(xyz, point_data={"density": density})
    """
    options = {
        "alpha": check.number(alpha, "alpha", at_least=0),
        "tolerance": check.number(tol, "tol", at_least=0),
        "offset": check.number(offset, "offset", at_least=0),
        "bound": check.flag(bound, "bound"),
        "map_duplicates": check.flag(map_duplicates, "map_duplicates"),
        "neighbors": check.flag(neighbors, "neighbors"),
        "partitions": check.whole(partitions, "partitions", at_most=512),
        "threads": check.threads(threads),
    }
    check.require_point_set(points, point_data)
    kind = kind_of(return_type, points)
    points, point_data = cloud_of(points, point_data)
    is_array = not check.is_vtk_object(points) and np.ndim(points) == 2
    if is_array and np.shape(points)[1] == 2 and np.asarray(points).dtype.kind in "iuf":
        raise ValueError(f"points has the shape {np.shape(points)}; points in space have the shape (n, 3).")
    wants_statistics = check.flag(return_statistics, "return_statistics")
    found, statistics = _engine.delaunay_3d(points, point_data, options, progress_of(progress_bar))
    mesh = result_of(found, kind, as_grid=True)
    return (mesh, statistics) if wants_statistics else mesh


def delaunay_file(
    points: _Path | Sequence[_Path],
    output: _Path,
    *,
    dimension: int = 2,
    memory: int | str = "2G",
    partitions: tuple[int, int] | None = None,
    columns: tuple[str | int, ...] | None = None,
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
    dimension
        2: triangles in the x-y plane. 3: tetrahedra, for which the points have a column z, Z or elevation; then there
        are no partitions, max_edge, constraints, boundary, holes, crossings, mark_constraints and count_only.
    memory
        The memory limit of each process for points, triangles and buffers: bytes, or a text such as "512M" or "2G".
        Python and the threads' kernels need some more.
    partitions
        Columns and rows of a grid of pieces. None: boxes with equally many points.
    columns
        Which columns are x and y, and with dimension=3 z, by name or index from 0. None: columns with the usual names,
        else the first two or three.
    max_edge
        Triangles with an edge longer than this, in the units of the points, are removed. 0: no limit.
    map_duplicates
        Whether the mesh gets the point array RepresentativePointId.
    neighbors
        Whether the mesh gets the cell array NeighborIds: for each corner of a cell the global id of the cell across
        the opposite edge or facet, -1 at the border.
    constraints
        A file of lines and polygons, whose edges become edges of the mesh. Only triangles inside of counter-clockwise
        polygons are kept; clockwise ones are holes. .csv, .poly, .14, .gr3, or any format that VTK or GDAL reads.
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
        Statistics: points, triangles (or tetrahedra), duplicates, rejected, pieces, spilled_bytes, mesh_bytes and resumed (0 or 1).
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
    size = check.whole(dimension, "dimension")
    if size not in (2, 3):
        raise ValueError(f"dimension is {size}; give 2 or 3.")
    options = {
        "memory": check.memory(memory, "memory"),
        "partitions": _grid(partitions),
        "columns": ("",) * size if columns is None else tuple(check.several(columns, "columns", size, _column)),
        "max_edge": check.number(max_edge, "max_edge", at_least=0),
        "map_duplicates": check.flag(map_duplicates, "map_duplicates"),
        "neighbors": check.flag(neighbors, "neighbors"),
        "constraints": _optional_path(constraints, "constraints"),
        "boundary": _optional_path(boundary, "boundary"),
        "holes": [tuple(check.several(hole, "holes", 2, check.number)) for hole in check.a_list(holes, "holes")],
        "crossings": check.choice(crossings, "crossings", _CROSSINGS),
        "mark_constraints": check.flag(mark_constraints, "mark_constraints"),
        "count_only": check.flag(count_only, "count_only"),
        "resume": check.flag(resume, "resume"),
        "scratch": _optional_path(scratch, "scratch"),
        "threads": check.threads(threads),
    }
    paths, folder = _paths(points), check.path(output, "output")
    if size == 2:
        return _engine.delaunay_file(paths, folder, options, progress_of(progress_bar))
    for name, default in _ONLY_IN_THE_PLANE.items():
        if options[name] != default:
            raise ValueError(f"{name} needs dimension=2; leave it out for tetrahedra.")
    return _engine.delaunay_file_3d(paths, folder, options, progress_of(progress_bar))


def _paths(points: Any) -> list[str]:
    is_list = isinstance(points, Iterable) and not isinstance(points, (str, bytes, os.PathLike, Mapping))
    return [check.path(path, "points") for path in (points if is_list else [points])]


def _column(value: Any, name: str) -> str:
    return value if isinstance(value, str) else str(check.whole(value, name))


def _optional_path(value: Any, name: str) -> str:
    return "" if value is None else check.path(value, name)
