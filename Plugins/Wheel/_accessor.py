# SPDX-License-Identifier: BSD-3-Clause
"""What PyVista imports at the first `mesh.tipp` (entry point group pyvista.accessors)."""
import pyvista

from ._pyvista import register

if not hasattr(pyvista.DataSet, "tipp"):
    register(pyvista)
