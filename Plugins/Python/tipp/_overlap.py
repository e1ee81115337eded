# SPDX-License-Identifier: BSD-3-Clause
"""tipp.remap and tipp.volume: means and volumes over the exact common parts of two surfaces."""
from __future__ import annotations

import math
from typing import Any, Iterable, NamedTuple

from . import _arguments as check
from . import _engine
from ._arguments import ProgressBar, progress_of
from ._bounds import bounds_of, BoundsLike
from ._data import as_mesh
from ._results import kind_of, result_of


class CutFill(NamedTuple):
    """Volumes and areas between two surfaces, as floats, in the units of the coordinates.

    Attributes
    ----------
    cut
        The volume of what lies below the surface before and above the one after; at least 0.
    fill
        The volume of what lies above the surface before and below the one after; at least 0.
    net
        fill - cut.
    area
        The area in the plane of x and y that both surfaces cover, to which the volumes belong.
    only_before, only_after
        The area that only one of the surfaces covers, where no volume is computed. 0 if rounding alone can make it.
    """

    cut: float
    fill: float
    net: float
    area: float
    only_before: float
    only_after: float


def remap(
    source: Any,
    target: Any,
    *,
    arrays: str | Iterable[str] | None = None,
    null_value: float = math.nan,
    return_type: str | None = None,
    threads: int = 0,
    progress_bar: ProgressBar = False,
) -> Any:
    """Averages the arrays of a surface over the cells of another one, exactly and keeping integrals.

    Both surfaces are compared in the plane of x and y; z is not used. The value of a target cell is the mean of the source
    over the part of the cell that the source covers: values of cells are constant in each cell, values at points are
    linear in each triangle. The sum of mean, area and covered share over all target cells is the integral of the source
    where the target covers it, up to rounding. Whether two cells meet is decided exactly.

    Parameters
    ----------
    source
        The surface with the values: a mesh of tipp or meshio, a vtkPointSet with cells, a composite data set of these, or a
        PyVista data set; in the wheel, of triangles, and no composite. Where its cells overlap, each counts, with a warning.
    target
        The surface over whose cells the values are averaged, of the same kinds, but no composite.
    arrays
        The name or the names of the source's arrays to average. None: all arrays of numbers. Of a cell array and a point
        array with the same name, the cell array.
    null_value
        The mean in cells that are not covered.
    return_type
        "tipp", "vtk" or "pyvista": what the result is. None: that of the target.
    threads
        The number of threads; 0: as many as the processors that the process may use. The result does not depend on it.
    progress_bar
        Whether to show a progress bar; or a function that gets the finished fraction and returns False to stop.

    Returns
    -------
    tipp.Mesh, vtkPointSet or a PyVista data set
        The target's points and cells, in their order, with cell arrays of float64: the means, (m,) or (m, k) for m cells
        and arrays of k components, and "CoveredShare", (m,), the share of each cell that the source covers: from 0 to 1,
        and above 1 only where cells of the source overlap. The target's own arrays are left out.

    Raises
    ------
    TypeError, ValueError
        If an argument is of a wrong type or value.
    KeyError
        If the source has no such array.
    RuntimeError
        If a mesh has cells with a volume, the target has no cells with an area, or within tipp.ranks() on several ranks;
        the message says why.
    ModuleNotFoundError
        If return_type needs a library that is not installed.

    Examples
    --------
    >>> coarse = tipp.remap(fine, coarse, arrays="depth")
    >>> coarse.cell_data["depth"].shape, coarse.cell_data["CoveredShare"].max()
    ((2000,), 1.0)
    """
    options = {
        "arrays": None if arrays is None else check.names(arrays, "arrays"),
        "null_value": check.number(null_value, "null_value", finite=False),
        "threads": check.threads(threads),
    }
    kind = kind_of(return_type, target)
    return result_of(_engine.remap(as_mesh(source), as_mesh(target), options, progress_of(progress_bar)), kind)


def volume(
    before: Any,
    after: Any,
    *,
    bounds: BoundsLike | None = None,
    threads: int = 0,
    progress_bar: ProgressBar = False,
) -> CutFill:
    """Computes the cut and fill volumes between two surfaces, exactly.

    Heights are the z of the points, linear in each triangle. The triangles of both surfaces are overlaid exactly. In each
    common part of two triangles the difference of the heights is linear, so its integrals have no error but rounding.

    Parameters
    ----------
    before, after
        The surfaces: each a mesh of tipp or meshio, a vtkPointSet with cells, or a PyVista data set; in the wheel, of
        triangles. Points are (n, 3). Cells with a corner that is not finite are left out, and where cells of a surface
        overlap, each counts; warnings say so.
    bounds
        (xmin, xmax, ymin, ymax) in the units of the points, a tipp.Bounds, or a data set, geometry or raster, whose bounds
        are used; z is not used. Only what is inside is compared. A range that does not meet the surface before, or is more
        than ten times as long along an axis, is an error. None: everything.
    threads
        The number of threads; 0: as many as the processors that the process may use. The result does not depend on it.
    progress_bar
        Whether to show a progress bar; or a function that gets the finished fraction and returns False to stop.

    Returns
    -------
    tipp.CutFill
        A named tuple of floats: cut, fill, net, area, only_before, only_after. Volumes are in the units of x times y times
        z, and belong to `area`, which both surfaces cover.

    Raises
    ------
    TypeError, ValueError
        If an argument is of a wrong type or value, or the bounds have no area.
    RuntimeError
        If a mesh has cells with a volume, the surfaces have no area in common, the bounds are an error as above, or within
        tipp.ranks() on several ranks; the message says why.

    Examples
    --------
    >>> cut, fill, *_ = tipp.volume(before, after)
    >>> tipp.volume(before, after, bounds=(0, 10, 0, 5)).net
    -12.25
    """
    box = None if bounds is None else bounds_of(bounds, "bounds")[:4]
    if box is not None and not (box[0] < box[1] and box[2] < box[3]):
        raise ValueError(f"bounds are from {box[0]:.10g} to {box[1]:.10g} along x and from {box[2]:.10g} to {box[3]:.10g} "
                         "along y, which has no area; give the lower number of each first.")
    options = {"bounds": box, "threads": check.threads(threads)}
    cut, fill, area, only_before, only_after = _engine.volume(
        as_mesh(before), as_mesh(after), options, progress_of(progress_bar))
    return CutFill(cut, fill, fill - cut, area, only_before, only_after)
