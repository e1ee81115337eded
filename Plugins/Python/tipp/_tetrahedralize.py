# SPDX-License-Identifier: BSD-3-Clause
"""tipp.delaunay_3d."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Mapping

import numpy as np

from . import _arguments as check
from . import _engine
from ._arguments import ProgressBar, progress_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


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
    partitions: int = 0,
    threads: int = 0,
    progress_bar: ProgressBar = False,
) -> Any:
    """Computes the exact Delaunay tetrahedralization as a mesh, with the keywords of PyVista's delaunay_3d.

    If all points are in one plane, the mesh has triangles.

    Parameters
    ----------
    points
        A vtkPointSet, a PyVista data set with points, or an array of shape (n, 3).
    alpha
        The largest circumradius, in the units of the points. Tetrahedra with a larger one are removed; facets, edges
        and points that are then in no tetrahedron become triangles, lines and vertices. 0: all tetrahedra.
    tol
        Points within this fraction of the bounding box's diagonal of each other are merged. 0 merges only coincident
        points.
    offset
        With bound: the distance of the octahedron's corners from the centre, as a multiple of the bounding box's
        diagonal.
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
    partitions
        The number of partitions, at most 512. 0: chosen automatically. The result does not depend on it.
    threads, progress_bar
        As for delaunay().

    Returns
    -------
    vtkUnstructuredGrid or pyvista.UnstructuredGrid
        The input's points and point data, with tetrahedra. A PyVista input gives a PyVista output.

    Raises
    ------
    TypeError, ValueError
        If an argument is of a wrong type or value.
    RuntimeError
        If it failed, or in the wheel, which has no tetrahedralization.
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
    is_array = not check.is_vtk_object(points) and np.ndim(points) == 2
    if is_array and np.shape(points)[1] == 2 and np.asarray(points).dtype.kind in "iuf":
        raise ValueError(f"points has the shape {np.shape(points)}; points in space have the shape (n, 3).")
    wants_statistics = check.flag(return_statistics, "return_statistics")
    mesh, statistics = _engine.delaunay_3d(points, point_data, options, progress_of(progress_bar))
    return (mesh, statistics) if wants_statistics else mesh
