# SPDX-License-Identifier: BSD-3-Clause
"""tipp.read, write and resample: meshes in files, and images of meshes."""
from __future__ import annotations

import math
import os
from typing import Any, Iterable, Sequence

import numpy as np

from . import _arguments as check
from . import _engine
from ._arguments import ProgressBar, progress_of
from ._bounds import bounds_of, BoundsLike, open_bound
from ._data import as_mesh
from ._results import kind_of, result_of


def read(
    path: str | os.PathLike[str],
    bounds: BoundsLike | None = None,
    *,
    time: float | None = None,
    values: str | os.PathLike[str] | Iterable[Any] = (),
    wrap: bool = False,
    point_arrays: str | Iterable[str] | None = None,
    cell_arrays: str | Iterable[str] | None = None,
    borrowed: bool = False,
    merge: bool = True,
    tiling: str = "grid:4x4",
    memory_limit: int | str = 1 << 31,
    return_type: str | None = None,
    progress_bar: ProgressBar = False,
) -> Any:
    """Reads a partitioned or flat mesh, or the output of a model, or the part of it that meets a range.

    Parameters
    ----------
    path
        A folder NAME.tipp, a folder of .npy arrays, or a .vtu file with appended, raw data. Or the output of a model, of
        which missing values are NaN: NetCDF (.nc) by UGRID, ADCIRC, SCHISM, FVCOM, FESOM or MPAS, SELAFIN (.slf), or a
        mesh of ADCIRC (.14, .grd), SCHISM (.gr3) or SMS (.2dm). In the wheel, also a .vtp or .vti file with appended, raw
        data, of which the options only select arrays; a .vti file gives an image.
    bounds
        (xmin, xmax, ymin, ymax) or (xmin, xmax, ymin, ymax, zmin, zmax) in the mesh's units, a tipp.Bounds, or a data
        set, geometry or raster, whose bounds are used: reads only the cells that share a point with this closed box;
        triangles are tested by x and y only. Pieces that do not meet it are not opened. Bounds may be infinite. A finite
        range that does not meet the mesh, or is more than ten times as long along an axis, is an error. None: reads
        everything.
    time
        The time at which to read arrays that vary in time: the last step that is not after it. None: the first step.
        tipp.times() lists the times.
    values
        Of the output of a model: the name or the names of more files, with values at the mesh's nodes or cells, such as
        fort.63 beside fort.14.
    wrap
        Of the output of a model in degrees: whether cells that cross the meridian at which longitudes jump are on either
        side of it. False: such cells are an error.
    point_arrays, cell_arrays
        The name or the names of the arrays to read. None: all.
    borrowed
        Whether pieces include the cells that they borrow, as ghost cells.
    merge
        Whether to return one mesh instead of its pieces.
    tiling
        How a flat mesh is partitioned, as for write().
    memory_limit
        The memory limit, in bytes or as a text such as "512M", for loading a flat mesh, not counting its pieces.
    return_type
        "tipp" (None), "vtk" or "pyvista": what the result is.
    progress_bar
        As for delaunay().

    Returns
    -------
    tipp.Mesh, vtkUnstructuredGrid or pyvista.UnstructuredGrid
        The mesh. If `merge` is False, a list of tipp.Mesh, a vtkPartitionedDataSet or a pyvista.PartitionedDataSet. Within
        tipp.ranks() each rank gets its own pieces.

    Raises
    ------
    TypeError, ValueError
        If an argument is of a wrong type or value.
    RuntimeError
        If the mesh cannot be read, or the bounds do not meet it or are far too long; the message says why.
    ModuleNotFoundError
        If return_type needs a library that is not installed.
    KeyError
        If the mesh has no such array.

    Examples
    --------
    >>> part = tipp.read("mesh.tipp", bounds=(0.2, 0.4, 0.5, 0.7))
    """
    options = {
        "bounds": None if bounds is None else _range_to_read(bounds),
        "strict_bounds": True,
        "borrowed": check.flag(borrowed, "borrowed"),
        "merge": check.flag(merge, "merge"),
        "tiling": check.text(tiling, "tiling"),
        "memory_limit": check.memory(memory_limit, "memory_limit"),
        "time": None if time is None else check.number(time, "time"),
        "values": check.paths(values, "values"),
        "wrap": check.flag(wrap, "wrap"),
        "point_arrays": None if point_arrays is None else check.names(point_arrays, "point_arrays"),
        "cell_arrays": None if cell_arrays is None else check.names(cell_arrays, "cell_arrays"),
    }
    kind = kind_of(return_type, None)
    source = check.path(path, "path")
    with check.python_words():
        found = _engine.read(source, options, progress_of(progress_bar))
    return result_of(found, kind, as_grid=True)


def _range_to_read(bounds: Any) -> list[float]:
    given = bounds_of(bounds, "bounds", check=open_bound)
    for axis, low, high in zip("xyz", given[::2], given[1::2]):
        if low > high:
            raise ValueError(f"bounds are from {low:.10g} to {high:.10g} along {axis}; give the lower one first.")
    return given if len(given) == 6 else [*given, -math.inf, math.inf]


def write(
    mesh: Any,
    path: str | os.PathLike[str],
    *,
    tiling: str = "grid:4x4",
    duplicate_borrowers: bool = False,
    memory_limit: int | str = 1 << 31,
    threads: int = 0,
    progress_bar: ProgressBar = False,
) -> None:
    """Writes a mesh as a partitioned mesh.

    Ranges of it can then be read without the rest, see read().

    Parameters
    ----------
    mesh
        A mesh of tipp or meshio, a vtkDataSet or vtkPartitionedDataSet, a PyVista data set, or the path of a flat mesh or
        of any file that VTK reads.
    path
        The folder to write, usually called NAME.tipp. It replaces an existing partitioned mesh.
    tiling
        "grid:4x4", "grid:4x4x2", "quadtree:N" or "octree:N". A tree's boxes are split until each meets at most about N
        cells.
    duplicate_borrowers
        Whether cells that meet several partitions are stored in each of their pieces.
    memory_limit
        The memory limit, in bytes or as a text such as "512M", not counting a mesh in memory.
    threads, progress_bar
        As for delaunay().

    Raises
    ------
    RuntimeError
        If the mesh cannot be written. The path is then unchanged.

    Examples
    --------
    >>> tipp.write(mesh, "mesh.tipp", tiling="quadtree:100000")
    """
    if isinstance(mesh, (str, bytes, os.PathLike)):
        mesh = check.path(mesh, "mesh")
    options = {
        "tiling": check.text(tiling, "tiling"),
        "duplicate_borrowers": check.flag(duplicate_borrowers, "duplicate_borrowers"),
        "memory_limit": check.memory(memory_limit, "memory_limit"),
        "threads": check.threads(threads),
    }
    _engine.write(as_mesh(mesh), check.path(path, "path"), options, progress_of(progress_bar))


def resample(
    mesh: Any,
    bounds: BoundsLike | None = None,
    dimensions: Sequence[int] | None = None,
    *,
    spacing: Sequence[float] | None = None,
    null_value: float = 0.0,
    no_data: float | None = None,
    arrays: str | Iterable[str] | None = None,
    method: str = "linear",
    covered_share: bool = False,
    device: str = "auto",
    return_type: str | None = None,
    threads: int = 0,
    progress_bar: ProgressBar = False,
) -> Any:
    """Samples a mesh of triangles or tetrahedra on a regular grid.

    Point arrays of floating-point numbers are interpolated linearly in each cell; other arrays keep their values.

    Parameters
    ----------
    mesh
        A mesh of tipp or meshio, a vtkPointSet with cells, a composite data set of these, or a PyVista data set.
    bounds
        (xmin, xmax, ymin, ymax) or (xmin, xmax, ymin, ymax, zmin, zmax), both ends included, in the mesh's units, a
        tipp.Bounds, or a data set, geometry or raster, whose bounds are used. Without z it is 0 for surfaces, and the
        mesh's for tetrahedra. A range that does not meet the mesh, or is more than ten times as long along an axis, is
        an error. None: the mesh's bounding box.
    dimensions
        The number of samples along x, y and z; or along x and y, with one along z. 0 uses the spacing of the first
        axis with a number, but for surfaces means one sample along z. None: (256, 0, 0).
    spacing
        The distance between samples along x, y and z, from the lower bound on. Used instead of `dimensions` along axes
        where it is not 0.
    null_value
        The value of samples outside of all cells.
    no_data
        Cells with this value at a corner are not sampled (such as ADCIRC's -99999 at dry nodes).
    arrays
        The name or the names of the arrays to sample. None: all.
    method
        "linear": values at the samples. "conservative": exact means, as float64, over the part of each sample's pixel that
        cells cover, of cell data, and of point data, which are linear in each triangle. A pixel has the sample as its
        centre and reaches half way to the next ones. The sum of mean, area and covered share over all pixels is the
        integral of the mesh within them, up to rounding. Where cells overlap, each counts, with a warning. It needs a
        surface, one layer of samples, and two samples or a spacing along both other axes.
    covered_share
        With method="conservative": whether the image has the array "CoveredShare", float64, the share of each pixel that
        cells cover: from 0 to 1, and above 1 only where cells overlap.
    device
        "auto", "openmp", "opencl", "opencl:INDEX" or "opencl:NAME". Means are computed by threads, whatever it is.
    return_type
        "tipp", "vtk" or "pyvista": what the result is. None: tipp's for a mesh of arrays, VTK's for a data set of VTK, and PyVista's
        for one of PyVista, whatever is installed.
    threads, progress_bar
        As for delaunay().

    Returns
    -------
    tipp.Image, vtkImageData or pyvista.ImageData
        The image with the arrays and vtkValidPointMask, which is 1 for samples in a cell, or for means for pixels that
        cells cover in part at least. as_array() returns an array
        in the image's shape. See return_type.

    Raises
    ------
    TypeError, ValueError
        If an argument is of a wrong type or value.
    KeyError
        If the mesh has no such array.
    RuntimeError
        If the filter failed, the bounds are an error as above, or means need another mesh or range; the message says why.
    ModuleNotFoundError
        If return_type needs a library that is not installed.
    KeyboardInterrupt
        Promptly after Ctrl-C.

    Examples
    --------
    >>> image = tipp.resample(mesh, bounds=(0, 10, 0, 5), dimensions=(1000, 500))
    """
    options: dict[str, Any] = {
        "bounds": None if bounds is None else bounds_of(bounds, "bounds"),
        "strict_bounds": True,
        "spacing": None if spacing is None else _along_axes(spacing, "spacing", 3, check.number, at_least=0),
    }
    if dimensions is None:
        dimensions = (1, 1, 1) if spacing is not None else (256, 0, 0)
    options["dimensions"] = _along_axes(dimensions, "dimensions", 3, check.whole)
    options["null_value"] = check.number(null_value, "null_value", finite=False)
    options["no_data"] = None if no_data is None else check.number(no_data, "no_data", finite=False)
    options["arrays"] = None if arrays is None else check.names(arrays, "arrays")
    options["conservative"] = check.choice(method, "method", {"linear": 0, "conservative": 1}) == 1
    options["covered_share"] = check.flag(covered_share, "covered_share")
    if options["covered_share"] and not options["conservative"]:
        raise ValueError("covered_share needs method='conservative'.")
    options["device"] = check.text(device, "device")
    options["threads"] = check.threads(threads)
    kind = kind_of(return_type, mesh)
    return result_of(_engine.resample(as_mesh(mesh), options, progress_of(progress_bar)), kind)


def _along_axes(values: Any, name: str, count: int, convert: Any, **limits: Any) -> list[Any]:
    """Returns values for x, y and z; z may be omitted."""
    is_list = isinstance(values, Sequence) and not isinstance(values, (str, bytes))
    if (is_list or isinstance(values, np.ndarray) and values.ndim == 1) and len(values) == count * 2 // 3:
        of_z = {"spacing": [0], "dimensions": [1]}[name]
        values = [*values, *of_z]
    return check.several(values, name, count, convert, **limits)
