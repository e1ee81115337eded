# SPDX-License-Identifier: BSD-3-Clause
"""VTK's classes, from `vtkmodules` or from `cvista`, a build of VTK that PyVista can use instead.

`from ._vtkmodules import vtkPoints` takes the class from the module of VTK that has it.
"""
from __future__ import annotations

import functools
import importlib
import importlib.util
import sys
from typing import Any

_PACKAGES = ("vtkmodules", "cvista")
_MODULES = ("vtkCommonCore", "vtkCommonDataModel", "vtkCommonExecutionModel", "util.numpy_support", "util.vtkAlgorithm")


@functools.lru_cache(maxsize=None)
def root() -> str | None:
    """Returns the name of the package with VTK's modules, or None without VTK. If PyVista is imported, it is the package
    that PyVista uses, because objects of two packages cannot be mixed."""
    if importlib.util.find_spec("._run", __package__):  # built with VTK: the package's filters use vtkmodules
        return "vtkmodules"
    mesh = getattr(sys.modules.get("pyvista"), "PolyData", None)
    if mesh is not None:
        packages = {base.__module__.split(".")[0] for base in mesh.__mro__}
        return "cvista" if "cvista" in packages else "vtkmodules"  # cvista uses vtkmodules' names for some bases
    return next((name for name in _PACKAGES if importlib.util.find_spec(name)), None)


def __getattr__(name: str) -> Any:
    if name.startswith("__"):
        raise AttributeError(name)
    if root() is None:
        raise ModuleNotFoundError("VTK is not installed.")
    modules = (importlib.import_module(f"{root()}.{module}") for module in _MODULES)
    found = next((module for module in modules if hasattr(module, name)), None)
    if found is None:
        raise AttributeError(f"VTK has no {name}.")
    return getattr(found, name)
