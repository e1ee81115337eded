# SPDX-License-Identifier: BSD-3-Clause
"""The engine of the wheel: calls the C++ cores with NumPy arrays. Arguments are already checked.

If VTK is installed, in any version, functions also accept data sets of VTK and PyVista.
"""
from __future__ import annotations

import contextlib
import os
import sys
import threading
import warnings
from typing import Any, Iterable, Iterator

import numpy as np

from . import _arguments as check
from . import _core
from . import _segments as constraints
from . import _vtkxml
from ._arrays import attribute, attributes, coordinates, grid_position, in_space, require_values
from ._arguments import finish, Progress
from ._data import Image, Mesh

_HIDDEN = 32  # vtkDataSetAttributes::HIDDENCELL
_GHOSTS = "vtkGhostType"
_OWN_IDS = ("GlobalPointIds", "GlobalCellIds")
_LEAST_OFFSET = 2.5  # vtkTIPPDelaunay3D's


_kept = threading.local()


@contextlib.contextmanager
def kept_warnings() -> Iterator[list[str]]:
    """A context in which warn() appends to the list instead of issuing warnings in this thread."""
    before = getattr(_kept, "sentences", None)
    _kept.sentences = []
    try:
        yield _kept.sentences
    finally:
        _kept.sentences = before


def warn(sentences: Iterable[str]) -> None:
    """Issues warnings for the line that called the package."""
    kept = getattr(_kept, "sentences", None)
    if kept is not None:
        kept.extend(sentences)
        return
    level = 1
    here = os.path.dirname(__file__)
    frame: Any = sys._getframe()
    while frame is not None and os.path.dirname(frame.f_code.co_filename) == here:
        frame, level = frame.f_back, level + 1
    for sentence in sentences:
        warnings.warn(sentence, RuntimeWarning, stacklevel=level)


def plain(points: np.ndarray) -> np.ndarray:
    """Returns the points in C order, as float32 or float64."""
    return np.ascontiguousarray(points, points.dtype if points.dtype == np.float32 else np.float64)


def box(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns the lowest and the highest coordinates of the finite points."""
    finite = points
    if len(points) and not np.isfinite(points.sum()):
        finite = points[np.isfinite(points).all(axis=1)]
    if len(finite) == 0:
        return np.zeros(3), np.zeros(3)
    low, high = np.zeros(3), np.zeros(3)
    low[: points.shape[1]], high[: points.shape[1]] = finite.min(axis=0), finite.max(axis=0)
    return low, high


def diagonal(points: np.ndarray) -> float:
    low, high = box(points)
    return float(np.sqrt(((high - low) ** 2).sum()))


def triangulated(points: np.ndarray, options: dict[str, Any], progress: Progress | None,
                 segments: constraints.Segments | None = None, details: bool = True) -> dict[str, Any]:
    """Returns the core's result. `points` are those of the segments, perhaps followed by others.
    `details`: duplicates, rejected points and statistics, too."""
    tolerance = options["tolerance"]
    pairs, cells, begin = ((None, None, 0) if segments is None
                           else (segments.pairs, segments.cells, segments.polygon_begin))
    result = _core.triangulate(
        points, pairs, cells, begin, options.get("crossings") == 1,
        segments is not None and options["marks"] == 2 and options["alpha"] == 0,
        tolerance * diagonal(points) if tolerance > 0 else 0.0, options["max_edge"], *options["partitions"],
        options["schedule"] == 0, options["threads"], options.get("neighbors", False), details, progress)
    finish(progress)
    return result


def raster(points: Any, point_data: Any, options: dict[str, Any],
           progress: Progress | None) -> tuple[list[np.ndarray], tuple[float, float, int, int], str]:
    """Returns the bands, each (rows, columns) from south to north; the grid's west, south, columns and rows; and the
    CRS of points in files."""
    source = points if check.are_files(points) else _points_and_columns(points, point_data, options)
    try:
        bands, grid, crs, rejected = _core.dem(source, options, progress)
    except KeyError:
        if check.are_files(points):
            check.require_columns(options, _core.column_names(points))
        raise
    finish(progress)
    if rejected:
        warn([f"{rejected} points with a NaN or infinite x or y are left out."])
    return [np.reshape(band, grid[:1:-1]) for band in bands], grid, crs


def dem(points: Any, point_data: Any, options: dict[str, Any],
        progress: Progress | None) -> tuple[list[np.ndarray], tuple[float, ...], str | None]:
    """Returns the bands with rows from north to south, their transform, and the CRS of points in files."""
    bands, (west, south, _, rows), crs = raster(points, point_data, options, progress)
    size = options["resolution"]
    return [band[::-1] for band in bands], (size, 0.0, west, 0.0, -size, grid_position(south, size, 2 * rows)), crs or None


def _points_and_columns(points: Any, point_data: Any, options: dict[str, Any]
                        ) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Returns the coordinates in the plane, and the columns that the bands need."""
    if check.is_vtk_object(points):
        from ._vtk import point_arrays, xyz_of

        array, data = xyz_of(points), point_arrays(points)
    else:
        array = coordinates(points)
        data = attributes(point_data, len(array))
        if array.shape[1] == 2 and check.needs_elevation(options):
            raise ValueError("points have no elevation; give an array of shape (n, 3) or other attributes.")
    if len(array) == 0:
        raise RuntimeError("There are no points.")
    check.require_bands(options["attributes"], data)
    wanted = [*options["attributes"], "elevation"]
    columns = {name: np.ascontiguousarray(values, np.float64) for name, values in data.items()
               if name in wanted and values.ndim == 1}
    if "elevation" not in columns and array.shape[1] == 3:
        columns = {**columns, "z": np.ascontiguousarray(array[:, 2], np.float64)}
    return np.ascontiguousarray(array[:, :2], np.float64), columns


def find_coordinates(names: list[str]) -> list[int]:
    """Returns the indices of x, y and, if there are heights, z among the names of a table's columns. Raises ValueError
    with the reason if the names do not tell."""
    return _core.find_coordinates(names)


def read_points(paths: list[str], options: dict[str, Any]) -> tuple[np.ndarray, dict[str, np.ndarray], str]:
    """Returns (n, 3) coordinates, the columns by name, and the coordinate reference system."""
    names = options["attributes"]
    wanted = None if names is None else [*(name for name in names if name not in check.DERIVED_BANDS), "z", "Z"]
    xy, columns, crs = _core.read_points(paths, wanted, options["classes"] or [], options["returns"], options["keep"])
    z = next((columns.pop(name) for name in ("z", "Z") if name in columns), np.zeros(len(xy)))
    return np.column_stack([xy, z]), columns, crs


def ranks() -> Any:
    """Raises RuntimeError, because the wheel works on one rank. In a TIPP with MPI and VTK, it is a context in which
    the functions of this package work on all ranks of an MPI run together."""
    raise RuntimeError("tipp.ranks() needs a TIPP that was built with MPI and VTK; the wheel works on one rank.")


def delaunay(points: Any, options: dict[str, Any], progress: Progress | None) -> np.ndarray:
    if check.is_vtk_object(points):
        from ._vtk import xyz_of

        array = xyz_of(points)
    else:
        array = coordinates(points)
    result = triangulated(plain(array), options, progress, details=False)
    if result["warnings"]:
        warn(result["warnings"])
    return result["triangles"]


def delaunay_2d(points: Any, point_data: Any, options: dict[str, Any],
                progress: Progress | None) -> tuple[Any, dict[str, Any]]:
    if check.is_vtk_object(points):
        return _delaunay_of_data_set(points, options, progress)
    array = plain(coordinates(points))
    if options["polygons"] is not None or options["edges"] is not None:  # their corners may have a z
        array = in_space(array)
    mesh, statistics, _ = _triangulated(array, attributes(point_data, len(array)), options, progress)
    mesh.points = _writable(in_space(mesh.points))
    mesh.point_data = {name: _writable(values) for name, values in mesh.point_data.items()}
    return mesh, statistics


def mesh(points: np.ndarray, point_data: dict[str, np.ndarray], lines: list[np.ndarray], polygons: list[np.ndarray],
         options: dict[str, Any], surface: Mesh | None, progress: Progress | None) -> Mesh:
    """Meshes (n, 3) points with lines and polygons between them. `surface` has the point array "size", or is None."""
    points = plain(points)
    pairs, cells, begin = constraints.edges_of(lines, polygons)
    sizes = None if surface is None else (
        plain(surface.points), np.ascontiguousarray(surface.cells, np.int32),
        np.ascontiguousarray(surface.point_data["size"], np.float64))
    result = _core.mesh(points, pairs, begin, options, options["lengths"], sizes, True, progress)
    finish(progress)
    ids, weights, new = result["ids"], result["weights"], result["new"]
    if len(new):
        points = _core.blend(np.ascontiguousarray(points, np.float64), ids, weights)
        points[-len(new):, :2] = new
        point_data = {name: _core.blend(values, ids, weights).reshape(-1, *values.shape[1:])
                      for name, values in point_data.items()}
    found = Mesh(_writable(points), result["triangles"], {name: _writable(values) for name, values in point_data.items()})
    if options["regions"]:
        found.cell_data["Region"] = result["regions"]
    found.cell_data["OutsideBounds"] = result["outside"]
    if options["marks"]:
        pieces = result["segments"]
        found.lines = np.ascontiguousarray(pieces[:, :2]).astype(found.cells.dtype, copy=False)
        found.line_data["ConstraintId"] = np.append(cells, -1)[pieces[:, 2]]  # -1 is the last
    if result["warnings"]:
        warn(result["warnings"])
    return found


def _writable(array: np.ndarray) -> np.ndarray:
    """Returns a copy of memory that is read-only, so that users can change each array of a result."""
    return array if array.flags.writeable else array.copy()


def _triangulated(points: np.ndarray, data: dict[str, np.ndarray], options: dict[str, Any],
                  progress: Progress | None) -> tuple[Mesh, dict[str, Any], bool]:
    """Returns a mesh whose points have as many columns as `points`, statistics, and whether the points are the same."""
    given = points
    segments = constraints.segments_of(points, data, options)
    if segments is not None:
        points, data = segments.points, data if segments.point_data is None else segments.point_data
    if options["bound"]:
        points, data = _with_circle(points, options["offset"]), {}
    is_marked = segments is not None and options["marks"] != 0
    has_lines = is_marked and options["marks"] == 1
    has_all = options["alpha"] == 0
    wants_neighbors = options["neighbors"] and has_all and not has_lines
    chosen = {**options, "neighbors": wants_neighbors}
    result = triangulated(points, chosen, progress, segments)
    sentences = [*([] if segments is None else segments.warnings), *result["warnings"]]
    crossings = result.get("crossings", ())
    if len(crossings):
        points = constraints.with_crossings(points, crossings)
        data = {name: constraints.interpolated(values, crossings) for name, values in data.items()}
    mesh = Mesh(points, result["triangles"], dict(data))
    if options["map_duplicates"] and (len(result["duplicates"]) or len(result["rejected"])):
        mesh.point_data["RepresentativePointId"] = _representatives(len(points), result)
    if wants_neighbors:
        mesh.cell_data["NeighborIds"] = result["neighbors"]
    elif options["neighbors"]:
        sentences.append("No NeighborIds: " + ("the output has lines, too." if has_lines else
                                               "with alpha not all triangles are output."))
    if not has_all:
        _, mesh.cells, mesh.lines, mesh.vertices = _core.alpha_shape(
            points, mesh.cells, options["alpha"], _left_out(len(points), result))
        if is_marked:
            sentences.append("No marks of constraints: with alpha not all triangles are output.")
    elif has_lines:
        pieces = result["pieces"]
        mesh.lines = np.ascontiguousarray(pieces[:, :2]).astype(mesh.cells.dtype, copy=False)
        mesh.line_data["ConstraintId"] = segments.cells[pieces[:, 2]]
    elif is_marked:
        mesh.cell_data["ConstraintEdges"] = result["marks"]
    if sentences:
        warn(sentences)
    return mesh, result["statistics"], mesh.points is given


def _representatives(count: int, result: dict[str, Any]) -> np.ndarray:
    ids = np.arange(count)
    point, kept = result["duplicates"].T
    ids[point] = kept
    ids[result["rejected"]] = -1
    return ids


def _left_out(count: int, result: dict[str, Any]) -> np.ndarray:
    """Returns 1 for duplicates and rejected points, else 0."""
    marks = np.zeros(count, np.uint8)
    marks[result["duplicates"][:, 0]] = 1
    marks[result["rejected"]] = 1
    return marks


def _with_circle(points: np.ndarray, offset: float) -> np.ndarray:
    """Returns the points and eight more on a circle around them."""
    low, high = box(points)
    centre, radius = 0.5 * low + 0.5 * high, offset * diagonal(points)
    angles = 2 * np.pi * np.arange(8) / 8
    circle = np.column_stack([centre[0] + radius * np.cos(angles), centre[1] + radius * np.sin(angles),
                              np.full(8, centre[2])])
    return np.vstack([points.astype(np.float64), circle[:, : points.shape[1]]])


def _delaunay_of_data_set(data: Any, options: dict[str, Any],
                          progress: Progress | None) -> tuple[Any, dict[str, Any]]:
    from ._vtk import point_arrays, surface_of, xyz_of

    has_constraints = any(options[name] is not None for name in ("edge_source", "edges", "polygons"))
    arrays = point_arrays(data) if has_constraints else {}
    mesh, statistics, is_same = _triangulated(plain(xyz_of(data)), arrays, options, progress)
    return surface_of(mesh, None if options["bound"] or not is_same else data), statistics


def delaunay_3d(points: Any, point_data: Any, options: dict[str, Any],
                progress: Progress | None) -> tuple[Any, dict[str, Any]]:
    mesh, source, statistics = tetrahedra(points, point_data, options, progress)
    if source is None:
        return mesh, statistics
    from ._vtk import grid_of

    return grid_of(mesh, source), statistics


def tetrahedra(points: Any, point_data: Any, options: dict[str, Any],
               progress: Progress | None) -> tuple[Mesh, Any, dict[str, Any]]:
    """Returns the mesh, the data set whose points and point data it has, or None, and statistics."""
    source = None
    if check.is_vtk_object(points):
        from ._vtk import xyz_of

        array, data, source = plain(xyz_of(points)), {}, points
    else:
        array = in_space(plain(coordinates(points)))
        data = attributes(point_data, len(array))
    if options["bound"] and len(array):
        array, data, source = _with_octahedron(array, max(options["offset"], _LEAST_OFFSET)), {}, None
    mesh, statistics = _tetrahedralized(array, data, options, progress)
    return mesh, source, statistics


def _tetrahedralized(points: np.ndarray, data: dict[str, np.ndarray], options: dict[str, Any],
                     progress: Progress | None) -> tuple[Mesh, dict[str, Any]]:
    tolerance, alpha = options["tolerance"], options["alpha"]
    result = _core.tetrahedralize(points, tolerance * diagonal(points) if tolerance > 0 else 0.0, options["partitions"],
                                  options["threads"], options["neighbors"] and alpha == 0, progress)
    finish(progress)
    mesh, sentences = Mesh(points, result["cells"], dict(data)), result["warnings"]
    if options["map_duplicates"] and (len(result["duplicates"]) or len(result["rejected"])):
        mesh.point_data["RepresentativePointId"] = _representatives(len(points), result)
    if alpha == 0:
        if options["neighbors"]:
            mesh.cell_data["NeighborIds"] = result["neighbors"]
    else:
        if options["neighbors"]:
            sentences.append("No NeighborIds: with alpha not all tetrahedra are output.")
        tetrahedra, triangles, mesh.lines, mesh.vertices = _core.alpha_shape(
            points, mesh.cells, alpha, _left_out(len(points), result))
        is_flat = mesh.cells.shape[1] == 3
        mesh.cells, mesh.triangles = (triangles, None) if is_flat else (tetrahedra, triangles)
    if sentences:
        warn(sentences)
    return mesh, result["statistics"]


def _with_octahedron(points: np.ndarray, offset: float) -> np.ndarray:
    """Returns the points and the six corners of an octahedron around them."""
    low, high = box(points)
    corners = np.repeat([0.5 * low + 0.5 * high], 6, axis=0)
    corners[range(6), np.arange(6) // 2] += offset * diagonal(points) * np.array([-1, 1] * 3)
    return np.vstack([points.astype(np.float64), corners])


def delaunay_file(
    paths: list[str], output: str, options: dict[str, Any], progress: Progress | None
) -> dict[str, int]:
    return _in_files(_core.triangulate_files, paths, output, options, progress)


def delaunay_file_3d(
    paths: list[str], output: str, options: dict[str, Any], progress: Progress | None
) -> dict[str, int]:
    return _in_files(_core.tetrahedralize_files, paths, output, options, progress)


def _in_files(core: Any, paths: list[str], output: str, options: dict[str, Any],
              progress: Progress | None) -> dict[str, int]:
    if not output:
        raise RuntimeError("FileName is not set; name the folder to write.")
    figures, sentences = core(paths, output, options, progress)
    finish(progress)
    warn(sentences)
    return figures


def read(path: str, options: dict[str, Any], progress: Progress | None) -> Mesh | Image | list[Mesh]:
    if _vtkxml.extension_of(path) in (*_vtkxml.FORMATS, *_vtkxml.OTHERS):
        return _vtkxml.read(path, options)
    if _vtkxml.extension_of(path) == ".vtu":
        _vtkxml.require_raw(path)
    of_points, of_cells = _core.array_names(path, options)
    check.require_arrays(options["point_arrays"], of_points, "point")
    check.require_arrays(options["cell_arrays"], of_cells, "cell")
    bounds = options["bounds"]
    if bounds is not None and bounds[0] > bounds[1]:
        bounds = None  # read everything, which is the reader's default
    if bounds is not None and (bounds[2] > bounds[3] or bounds[4] > bounds[5]):
        raise RuntimeError("Bounds have from > to along y or z; set from <= to, or from > to along x for everything.")
    pieces = _core.read(path, bounds, options, progress)
    finish(progress)
    meshes = [Mesh(**piece) for piece in pieces]
    empty = Mesh(np.empty((0, 3)), np.empty((0, 3), np.int32))
    return (meshes or [empty])[0] if options["merge"] else meshes


def times(path: str, options: dict[str, Any]) -> tuple[list[float], str, str]:
    """Returns the times of the steps, their unit and calendar."""
    return _core.times(path, options)


def resample_series(path: str, options: dict[str, Any], progress: Progress | None) -> dict[str, Any]:
    """Returns the grid, the steps and the arrays of time steps on it."""
    found = _core.resample_series(path, options, progress)
    finish(progress)
    warn(found["warnings"])
    return found


def write(mesh: Any, path: str, options: dict[str, Any], progress: Progress | None) -> None:
    if isinstance(mesh, str):
        _core.partition_file(mesh, path, options, progress)
    else:
        source = mesh
        mesh, _ = _simplices(source, "mesh", ("vtkDataObject",), "a VTK data set or a path")
        cells, cell_data = mesh.cells, mesh.cell_data
        sentences = []
        thin = _count_thin(source, mesh)
        if thin:
            sentences.append(check.THIN_LEFT_OUT.format(thin))
        if _GHOSTS in cell_data:
            owned = cell_data[_GHOSTS] == 0
            ghosts = len(cells) - int(owned.sum())
            if ghosts:
                sentences.append(f"{ghosts} ghost cells are left out.")
            cells, cell_data = cells[owned], {name: values[owned] for name, values in cell_data.items()}
        _core.partition_arrays(in_space(plain(mesh.points)), np.ascontiguousarray(cells), _numeric_arrays(mesh.point_data),
                               _numeric_arrays(cell_data), path, options, progress)
        warn(sentences)
    finish(progress)


def _count_thin(source: Any, simplices: Mesh) -> int:
    """Returns the number of a mesh's cells that are not among its simplices."""
    if isinstance(source, Mesh):
        return source.count_thin()
    return source.GetNumberOfCells() - len(simplices.cells)


def _numeric_arrays(data: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Returns the arrays to store: numeric ones, except those that a partitioned mesh always has."""
    return {name: np.ascontiguousarray(values) for name, values in data.items()
            if name not in (_GHOSTS, *_OWN_IDS) and values.dtype.kind in "iuf"}


def _simplices(mesh: Any, name: str, kinds: tuple[str, ...], wanted: str) -> tuple[Mesh, np.ndarray | None]:
    """Returns a data set of triangles or tetrahedra as arrays, after checking it, and their indices among its cells;
    None if they are all its cells."""
    rows = None
    if not isinstance(mesh, Mesh):
        check.data_object(mesh, name, kinds, wanted)
        from ._vtk import simplices_of

        mesh, rows = simplices_of(mesh)
    cells = np.asarray(mesh.cells)
    if cells.ndim != 2 or cells.shape[1] not in (3, 4) or cells.dtype.kind not in "iu":
        raise RuntimeError("the mesh's cells are not (n, 3) triangles or (n, 4) tetrahedra of whole numbers.")
    if len(cells) and not 0 <= cells.min() <= cells.max() < len(mesh.points):
        raise RuntimeError(f"the mesh's cells refer to points from {cells.min()} to {cells.max()}, but there are "
                           f"{len(mesh.points)} points; repair it or write it again.")
    if cells.dtype not in (np.int32, np.int64):
        cells = cells.astype(np.int64)
    return Mesh(mesh.points, np.ascontiguousarray(cells), _checked(mesh.point_data, len(mesh.points), "points"),
                _checked(mesh.cell_data, len(cells), "cells")), rows


def _checked(data: dict[str, np.ndarray], count: int, of: str) -> dict[str, np.ndarray]:
    """Returns the arrays with a value or a row for each point or cell, numbers as by attribute(). Raises RuntimeError
    if one has too few."""
    result = {}
    for name, values in data.items():
        array = np.atleast_1d(values)
        require_values(name, len(array), count, of)
        result[name] = attribute(name, array[:count], "the array") if array.dtype.kind in "iufb" else array[:count]
    return result


def open_mesh(mesh: Any, options: dict[str, Any]) -> Any:
    if isinstance(mesh, str):
        return _core.Query(mesh, options["memory"], options["step"], options["threads"])
    mesh, rows = _simplices(mesh, "mesh", ("vtkPolyData", "vtkUnstructuredGrid"), "a mesh")
    ids = None if rows is None else np.ascontiguousarray(rows, np.int64)
    return _core.Query(in_space(plain(mesh.points)), mesh.cells, _numeric_arrays(mesh.point_data),
                       _numeric_arrays(mesh.cell_data), ids, options["threads"])


def open_part(mesh: Mesh, threads: int) -> Any:
    return open_mesh(mesh, {"threads": threads})


def resample(mesh: Any, options: dict[str, Any], progress: Progress | None) -> Image:
    mesh, _ = _simplices(mesh, "mesh", ("vtkPointSet",), "a mesh")
    points = in_space(plain(np.asarray(mesh.points)))
    low, high = box(points)
    own = np.column_stack([low, high]).ravel().tolist()
    bounds = own if options["bounds"] is None else options["bounds"]
    if len(bounds) == 4:
        bounds = [*bounds, *(own[4:] if mesh.cells.shape[1] == 4 else (0.0, 0.0))]
    is_checked = options["bounds"] is not None and options["strict_bounds"] and len(points) > 0
    if options["bounds"] is None and not np.isfinite(points).all(axis=1).any():
        raise RuntimeError("the input has no points with finite coordinates, so its bounds give no range: "
                           "give bounds.")
    chosen = _selected_arrays(mesh, options["arrays"])
    hidden, sentences = _hidden_cells(mesh, points, options["no_data"], chosen[0])
    if options["conservative"]:
        return _pixel_means(mesh, points, hidden, chosen, bounds, own if is_checked else None, options, progress, sentences)
    (origin, spacing, dimensions), samples, mask, more = _core.resample(
        points, mesh.cells, hidden, chosen[0], chosen[1], bounds, own if is_checked else None,
        options["dimensions"], options["spacing"] or [0.0, 0.0, 0.0], options["null_value"], options["device"],
        options["threads"], progress)
    finish(progress)
    if len(mesh.cells) and not mask.any():
        sentences.append("No sample lies in a cell of the mesh: check the range and the number of samples.")
    warn([*sentences, *more])
    arrays = dict(zip([*chosen[0], *chosen[1]], samples))
    return Image(tuple(origin), tuple(spacing), dimensions, {**arrays, "vtkValidPointMask": mask})


def _pixel_means(mesh: Mesh, points: np.ndarray, hidden: np.ndarray | None,
                 chosen: tuple[dict[str, np.ndarray], dict[str, np.ndarray]], bounds: list[float], checked: Any,
                 options: dict[str, Any], progress: Progress | None, sentences: list[str]) -> Image:
    (origin, spacing, dimensions), means, shares = _core.pixel_means(
        points, mesh.cells, hidden, _as_doubles(chosen[0]), _as_doubles(chosen[1]), bounds, checked,
        options["dimensions"], options["spacing"] or [0.0, 0.0, 0.0], options["null_value"], options["threads"], progress)
    finish(progress)
    mask = (shares > 0).astype(np.int8)
    twice = int((shares > 1).sum())
    if twice:
        sentences.append(f"Cells overlap: {twice} pixels are covered more than once, and each of their cells counts.")
    if len(mesh.cells) and not mask.any():
        sentences.append("No sample lies in a cell of the mesh: check the range and the number of samples.")
    warn(sentences)
    arrays = dict(zip([*chosen[0], *chosen[1]], means))
    if options["covered_share"]:
        arrays["CoveredShare"] = shares
    return Image(tuple(origin), tuple(spacing), dimensions, {**arrays, "vtkValidPointMask": mask})


def _as_doubles(arrays: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    return {name: np.ascontiguousarray(values, np.float64) for name, values in arrays.items()}


def _surface(mesh: Any, name: str) -> tuple[Mesh, np.ndarray]:
    """Returns a mesh of triangles, and its points in space."""
    surface, _ = _simplices(mesh, name, ("vtkPointSet",), "a mesh")
    if surface.cells.shape[1] != 3:
        raise RuntimeError(f"the mesh '{name}' has cells with a volume: give a surface.")
    return surface, in_space(plain(np.asarray(surface.points)))


def remap(source: Any, target: Any, options: dict[str, Any], progress: Progress | None) -> Mesh:
    surface, points = _surface(source, "source")
    goal, corners = _surface(target, "target")
    if not len(goal.cells):
        raise RuntimeError("the target mesh has no cells with an area: give a surface.")
    of_points, of_cells = _selected_arrays(surface, options["arrays"])
    of_points = {name: values for name, values in of_points.items() if name not in of_cells}
    hidden, _ = _hidden_cells(surface, points, None, {})
    means, shares = _core.remap(points, surface.cells, hidden, _as_doubles(of_points), _as_doubles(of_cells), corners,
                                goal.cells, options["null_value"], options["threads"], progress)
    finish(progress)
    twice = int((shares > 1).sum())
    if twice:
        warn([f"Cells of the source overlap: {twice} cells of the result are covered more than once, and each cell "
              "counts."])
    arrays = dict(zip([*of_points, *of_cells], means))
    return Mesh(goal.points, goal.cells, {}, {**arrays, "CoveredShare": shares})


def volume(before: Any, after: Any, options: dict[str, Any], progress: Progress | None) -> list[float]:
    """Returns cut, fill, the common area, and the areas of only one surface."""
    surfaces = [_surface(before, "before"), _surface(after, "after")]
    names = ("the surface before", "the surface after")
    if not len(surfaces[0][0].cells):
        raise RuntimeError(f"{names[0]} has no cells with an area: give a surface.")
    arguments: list[Any] = []
    sentences = []
    extents = []
    for (surface, points), name in zip(surfaces, names):
        low, high = box(points)
        extents.append(np.column_stack([low, high]).ravel().tolist())
        hidden, count = _without_heights(surface, points)
        if count:
            sentences.append(f"{name} has cells with a corner that is not finite, which are left out: {count}.")
        arguments += [points, surface.cells, hidden]
    if options["bounds"] is not None:
        _core.require_sensible(options["bounds"], extents[0])
    result, twice = _core.volume(*arguments, options["bounds"], options["threads"], progress)
    finish(progress)
    if not result[2] > 0:
        ranges = [_core.bounds_in_words(extent) if len(surface.cells) else "no cells with an area"
                  for extent, (surface, _) in zip(extents, surfaces)]
        raise RuntimeError(
            f"the surfaces have no area in common{'' if options['bounds'] is None else ' within the bounds'}: {names[0]} has "
            f"{ranges[0]}, and {names[1]} has {ranges[1]}{'; cells that are not finite are left out' if sentences else ''}; "
            "give surfaces of the same region and reference system.")
    for count, name, other in zip(twice, names, names[::-1]):
        if count:
            sentences.append(f"{other} has cells that overlap, and each of them counts: triangles of {name} that they cover "
                             f"more than once: {count}.")
    warn(sentences)
    return list(result)


def _without_heights(surface: Mesh, points: np.ndarray) -> tuple[np.ndarray | None, int]:
    """Returns a mark for each triangle that is hidden or has a corner that is not finite, and the number of the latter."""
    hidden, _ = _hidden_cells(surface, points, None, {})
    finite = np.isfinite(points).all(axis=1)
    if finite.all():
        return hidden, 0
    bad = ~finite[surface.cells].all(axis=1)
    return (bad if hidden is None else bad | (hidden != 0)).astype(np.uint8), int(bad.sum())


def _selected_arrays(mesh: Mesh, names: list[str] | None) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray]]:
    """Returns the point arrays and cell arrays to sample. Raises KeyError for names that the mesh does not have."""
    result: tuple[dict[str, np.ndarray], dict[str, np.ndarray]] = ({}, {})
    for chosen, data in zip(result, (mesh.point_data, mesh.cell_data)):
        for name, values in data.items():
            if name != _GHOSTS and values.dtype.kind in "iuf" and (names is None or name in names):
                chosen[name] = np.ascontiguousarray(values)
    check.require_arrays(names, list(dict.fromkeys([*mesh.point_data, *mesh.cell_data])))
    return result


def _hidden_cells(mesh: Mesh, points: np.ndarray, no_data: float | None,
                  arrays: dict[str, np.ndarray]) -> tuple[np.ndarray | None, list[str]]:
    """Returns a mark for each cell that gives no values, and warnings."""
    marks = np.zeros(len(mesh.cells), bool)
    sentences = []
    if _GHOSTS in mesh.cell_data:
        marks |= (mesh.cell_data[_GHOSTS] & _HIDDEN) != 0
    axes = slice(0, 2 if mesh.cells.shape[1] == 3 else 3)
    finite = np.isfinite(points[:, axes]).all(axis=1)
    if not finite.all():
        bad = ~finite[mesh.cells].all(axis=1) & ~marks
        marks |= bad
        count = int(bad.sum())
        if count:
            sentences.append(f"{count} cell has a corner with a NaN or infinite coordinate and yields no value."
                             if count == 1 else
                             f"{count} cells have a corner with a NaN or infinite coordinate and yield no value.")
    if no_data is not None:
        for values in arrays.values():
            equal = values == values.dtype.type(no_data) if values.dtype.kind == "f" else values == no_data
            equal = equal.any(axis=1) if equal.ndim == 2 else equal
            marks |= equal[mesh.cells].any(axis=1)
    return (marks.astype(np.uint8) if marks.any() else None), sentences
