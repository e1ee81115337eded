# SPDX-License-Identifier: BSD-3-Clause
"""tipp.resample."""
from __future__ import annotations

from typing import Any, Iterable, Sequence

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
    arrays: Iterable[str] | None = None,
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
        The names of the arrays to sample. None: all.
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
    RuntimeError
        If the filter failed; the message is the filter's.
    KeyboardInterrupt
        On Ctrl-C, soon.

    Examples
    --------
    >>> image = tipp.resample(mesh, bounds=(0, 10, 0, 5, 0, 0), dimensions=(1000, 500, 1))
    """
    algorithm = vtkRangeResampleFilter()
    algorithm.SetInputDataObject(mesh)
    if bounds is not None:
        algorithm.SetUseInputBounds(False)
        algorithm.SetSamplingBounds(*bounds)
    if spacing is not None:
        algorithm.SetDelta(*spacing)
    algorithm.SetSamplingDimensions(*(dimensions or ((1, 1, 1) if spacing is not None else (256, 0, 0))))
    algorithm.SetNullValue(null_value)
    if no_data is not None:
        algorithm.SetUseNoDataValue(True)
        algorithm.SetNoDataValue(no_data)
    if arrays is not None:
        _select(algorithm, mesh, list(arrays))
    run(algorithm, call=lambda: algorithm.SetDeviceChoice(device))
    algorithm.SetNumberOfThreads(threads)
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
