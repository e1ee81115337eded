# SPDX-License-Identifier: BSD-3-Clause
"""tipp.resample."""
from __future__ import annotations

from typing import Any, Iterable, Sequence

from . import _arguments as check
from ._arrays import wrapped_like
from ._run import run
from .vtkTIPPFilters import vtkRangeResampleFilter


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
    progress_bar: bool = False,
) -> Any:
    """Samples a mesh of triangles or tetrahedra on a regular grid.

    Parameters
    ----------
    mesh
        A vtkPointSet with cells, a composite of such, or a PyVista data set.
    bounds
        (x from, x to, y from, y to, z from, z to), both ends included, in the mesh's units. None: the
        mesh's box.
    dimensions
        The number of samples along x, y and z. 0 keeps the distance of the first axis with a number;
        along z it means one sample for surfaces. None: (256, 0, 0).
    spacing
        The distance between samples along x, y and z instead, from the lower bound on; 0 along an
        axis: as dimensions tell.
    null_value
        What arrays have where no cell answers.
    no_data
        Cells with a corner that has this value answer nothing (as ADCIRC's -99999 at dry nodes).
    arrays
        The name or the names of the arrays to sample. None: all.
    device
        "auto", "openmp", "opencl", "opencl:INDEX" or "opencl:NAME".
    threads
        OpenMP threads; 0 is OpenMP's choice.
    progress_bar
        Whether to show progress on the standard error stream.

    Returns
    -------
    vtkImageData or pyvista.ImageData
        With the arrays, and vtkValidPointMask, which is 1 where a cell answers. as_array() gives its
        rows. A PyVista input makes a PyVista output.

    Raises
    ------
    TypeError, ValueError
        If an argument is of a wrong type or value.
    KeyError
        If the mesh has no such array.
    RuntimeError
        If the filter failed; the message is the filter's.
    KeyboardInterrupt
        On Ctrl-C, soon.

    Examples
    --------
    >>> image = tipp.resample(mesh, bounds=(0, 10, 0, 5, 0, 0), dimensions=(1000, 500, 1))
    """
    check.data_object(mesh, "mesh", ("vtkPointSet", "vtkCompositeDataSet"), "a mesh or a composite of meshes")
    algorithm = vtkRangeResampleFilter()
    algorithm.SetInputDataObject(mesh)
    if bounds is not None:
        algorithm.SetUseInputBounds(False)
        algorithm.SetSamplingBounds(*check.several(bounds, "bounds", 6, check.number))
    if spacing is not None:
        algorithm.SetDelta(*check.several(spacing, "spacing", 3, check.number, at_least=0))
    if dimensions is None:
        dimensions = (1, 1, 1) if spacing is not None else (256, 0, 0)
    algorithm.SetSamplingDimensions(*check.several(dimensions, "dimensions", 3, check.whole))
    algorithm.SetNullValue(check.number(null_value, "null_value", finite=False))
    if no_data is not None:
        algorithm.SetUseNoDataValue(True)
        algorithm.SetNoDataValue(check.number(no_data, "no_data", finite=False))
    if arrays is not None:
        _select(algorithm, mesh, check.names(arrays, "arrays"))
    check.text(device, "device")
    check.flag(progress_bar, "progress_bar")
    algorithm.SetNumberOfThreads(check.threads(threads))
    run(algorithm, call=lambda: algorithm.SetDeviceChoice(device))
    run(algorithm, progress_bar)
    return wrapped_like(algorithm.GetOutput(), mesh)


def _select(algorithm: vtkRangeResampleFilter, mesh: Any, names: list[str]) -> None:
    """Samples these arrays only; a name that the mesh has not is a warning of the filter's."""
    of_cells = hasattr(mesh, "GetCellData") and mesh.GetCellData()
    for selection, wanted in (
        (algorithm.GetPointDataArraySelection(), [n for n in names if not (of_cells and of_cells.HasArray(n))]),
        (algorithm.GetCellDataArraySelection(), [n for n in names if of_cells and of_cells.HasArray(n)]),
    ):
        selection.SetUnknownArraySetting(0)
        for name in wanted:
            selection.EnableArray(name)
