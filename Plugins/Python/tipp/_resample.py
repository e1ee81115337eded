# SPDX-License-Identifier: BSD-3-Clause
"""tipp.resample."""
from __future__ import annotations

from typing import Any, Iterable, Sequence

from . import _arguments as check
from . import _engine
from ._arguments import ProgressBar, progress_of


def resample(
    mesh: Any,
    bounds: Sequence[float] | None = None,
    dimensions: Sequence[int] | None = None,
    *,
    spacing: Sequence[float] | None = None,
    null_value: float = 0.0,
    no_data: float | None = None,
    arrays: str | Iterable[str] | None = None,
    device: str = "auto",
    threads: int = 0,
    progress_bar: ProgressBar = False,
) -> Any:
    """Samples a mesh of triangles or tetrahedra on a regular grid.

    Parameters
    ----------
    mesh
        A vtkPointSet with cells, a composite data set of these, or a PyVista data set.
    bounds
        (xmin, xmax, ymin, ymax, zmin, zmax), both ends included, in the mesh's units; z may be omitted for surfaces.
        None: the mesh's bounding box.
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
    device
        "auto", "openmp", "opencl", "opencl:INDEX" or "opencl:NAME".
    threads, progress_bar
        As for delaunay().

    Returns
    -------
    vtkImageData or pyvista.ImageData
        The image with the arrays and vtkValidPointMask, which is 1 for samples in a cell. as_array() returns an array
        in the image's shape. A PyVista input gives a PyVista output. Without VTK a tipp.Image.

    Raises
    ------
    TypeError, ValueError
        If an argument is of a wrong type or value.
    KeyError
        If the mesh has no such array.
    RuntimeError
        If the filter failed; the message is the filter's.
    KeyboardInterrupt
        Promptly after Ctrl-C.

    Examples
    --------
    >>> image = tipp.resample(mesh, bounds=(0, 10, 0, 5, 0, 0), dimensions=(1000, 500, 1))
    """
    options: dict[str, Any] = {
        "bounds": None if bounds is None else _along_axes(bounds, "bounds", 6, check.number),
        "spacing": None if spacing is None else _along_axes(spacing, "spacing", 3, check.number, at_least=0),
    }
    if dimensions is None:
        dimensions = (1, 1, 1) if spacing is not None else (256, 0, 0)
    options["dimensions"] = _along_axes(dimensions, "dimensions", 3, check.whole)
    options["null_value"] = check.number(null_value, "null_value", finite=False)
    options["no_data"] = None if no_data is None else check.number(no_data, "no_data", finite=False)
    options["arrays"] = None if arrays is None else check.names(arrays, "arrays")
    options["device"] = check.text(device, "device")
    options["threads"] = check.threads(threads)
    return _engine.resample(mesh, options, progress_of(progress_bar))


def _along_axes(values: Any, name: str, count: int, convert: Any, **limits: Any) -> list[Any]:
    """Returns values for x, y and z; z may be omitted."""
    if isinstance(values, Sequence) and not isinstance(values, (str, bytes)) and len(values) == count * 2 // 3:
        of_z = {"bounds": [0, 0], "spacing": [0], "dimensions": [1]}[name]
        values = [*values, *of_z]
    return check.several(values, name, count, convert, **limits)
