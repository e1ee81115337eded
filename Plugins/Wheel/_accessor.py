# SPDX-License-Identifier: BSD-3-Clause
"""PyVista imports this module at the first use of `mesh.tipp` (entry point group pyvista.accessors)."""
import pyvista

from ._pyvista import register

if not hasattr(pyvista.DataSet, "tipp"):
    register(pyvista)
