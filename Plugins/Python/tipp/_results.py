# SPDX-License-Identifier: BSD-3-Clause
"""The type of results: tipp's own for arrays and files, VTK's for data sets of VTK, PyVista's for those of PyVista."""
from __future__ import annotations

import sys
from typing import Any

from . import _arguments as check
from ._data import Image, imported, Mesh, require_vtk

KINDS = {"tipp": 0, "vtk": 1, "pyvista": 2}


def kind_of(return_type: Any, source: Any) -> str:
    """Returns the kind of result for an argument `return_type` and the data that the result is made from. Raises
    ModuleNotFoundError if a library that it needs is not installed."""
    if return_type is None:
        pyvista = sys.modules.get("pyvista")
        is_pyvista = pyvista is not None and isinstance(source, pyvista.DataObject)
        return "pyvista" if is_pyvista else "vtk" if check.is_vtk_object(source) else "tipp"
    check.choice(return_type, "return_type", KINDS)
    if return_type != "tipp":
        require_vtk(f"return_type='{return_type}'")
    if return_type == "pyvista":
        imported("pyvista", "return_type='pyvista'")
    return str(return_type)


def result_of(data: Any, kind: str, as_grid: bool = False) -> Any:
    """Converts a Mesh, an Image, a list of Meshes or a VTK data object to one of the kinds, without copying arrays.
    `as_grid` makes a vtkUnstructuredGrid also of triangles."""
    if kind == "tipp":
        if isinstance(data, (Mesh, Image, list)):
            return data
        from ._vtk import from_vtk

        return from_vtk(data)
    data = in_vtk(data, as_grid)
    return imported("pyvista", "return_type='pyvista'").wrap(data) if kind == "pyvista" else data


def in_vtk(data: Any, as_grid: bool = False) -> Any:
    """Returns a Mesh or an Image as a data set of VTK, and a list of Meshes as a vtkPartitionedDataSet of grids."""
    if isinstance(data, Image) or isinstance(data, Mesh) and not as_grid:
        return data.to_vtk()
    if isinstance(data, (Mesh, list)):
        from ._vtk import grid_of, partitioned

        return grid_of(data) if isinstance(data, Mesh) else partitioned([grid_of(mesh) for mesh in data])
    return data
