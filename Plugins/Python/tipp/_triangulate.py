# SPDX-License-Identifier: BSD-3-Clause
"""tipp.delaunay and tipp.delaunay_2d."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Iterable, Mapping

from . import _arguments as check
from . import _engine
from ._arguments import ProgressBar, progress_of

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike

_SCHEDULES = {"stages": 0, "dynamic": 1, "producer-consumer": 2}
_CROSSINGS = {"split": 1, "refuse": 0}
_MARKS = {"none": 0, "lines": 1, "flags": 2}


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
        is not copied; any other array is copied once. Masked coordinates become NaN.
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
        OpenMP threads; 0 is OpenMP's default.
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
    edges: ArrayLike | None = None,
    polygons: Iterable[Any] | None = None,
    edge_source: Any = None,
    crossings: str = "split",
    marks: str = "none",
    map_duplicates: bool = True,
    neighbors: bool = False,
    return_statistics: bool = False,
    partitions: tuple[int, int] | None = None,
    schedule: str = "dynamic",
    threads: int = 0,
    progress_bar: ProgressBar = False,
) -> Any:
    """Computes the exact Delaunay triangulation as a mesh, with the keywords of PyVista's delaunay_2d.

    Parameters
    ----------
    points
        A vtkPointSet, a PyVista data set with points, or an array as for delaunay().
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
        Constraints, which become edges of the triangulation, as an (m, 2) array of point ids.
    polygons
        Closed polygons: sequences of point ids; arrays of coordinates of shape (k, 2) or (k, 3), which add new points
        where `points` has none; or Shapely polygons with their holes. Only triangles inside of counter-clockwise polygons
        are kept; clockwise ones are holes. Shapely polygons may have any orientation.
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
        partitions, threads, constraints, crossing_points, ...) and the seconds of each phase.

    Returns
    -------
    vtkPolyData or pyvista.PolyData
        The input's points and point data, with triangles. A PyVista input gives a PyVista output. Without VTK a
        tipp.Mesh.

    Raises
    ------
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
    options["edges"], options["polygons"], options["edge_source"] = edges, polygons, edge_source
    options["crossings"] = check.choice(crossings, "crossings", _CROSSINGS)
    options["marks"] = check.choice(marks, "marks", _MARKS)
    options["map_duplicates"] = check.flag(map_duplicates, "map_duplicates")
    options["neighbors"] = check.flag(neighbors, "neighbors")
    wants_statistics = check.flag(return_statistics, "return_statistics")
    mesh, statistics = _engine.delaunay_2d(points, point_data, options, progress_of(progress_bar))
    return (mesh, statistics) if wants_statistics else mesh


def _options(tol: Any, max_edge: Any, partitions: Any, schedule: Any, threads: Any) -> dict[str, Any]:
    """Checks and returns the options that delaunay() and delaunay_2d() share."""
    return {
        "tolerance": check.number(tol, "tol", at_least=0),
        "max_edge": check.number(max_edge, "max_edge", at_least=0),
        "partitions": (0, 0) if partitions is None else tuple(check.several(partitions, "partitions", 2, check.whole)),
        "schedule": check.choice(schedule, "schedule", _SCHEDULES),
        "threads": check.threads(threads),
    }
