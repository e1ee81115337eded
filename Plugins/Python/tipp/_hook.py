# SPDX-License-Identifier: BSD-3-Clause
"""Registers mesh.tipp on PyVista's data sets once PyVista is imported; it need not be installed."""
from __future__ import annotations

import sys

TYPE_CHECKING = False  # type checkers take it for true; other imports would multiply the time of `import tipp`
if TYPE_CHECKING:
    from importlib.machinery import ModuleSpec
    from types import ModuleType
    from typing import Any


def _register(pyvista: ModuleType) -> None:
    from ._pyvista import register  # it imports NumPy

    register(pyvista)


class _Loader:
    """Loads a module with its own loader, then registers the accessor."""

    def __init__(self, loader: Any, finder: _Finder):
        self._loader = loader
        self._finder = finder

    def create_module(self, spec: ModuleSpec) -> ModuleType | None:
        return self._loader.create_module(spec)

    def exec_module(self, module: ModuleType) -> None:
        if module.__spec__ is not None:
            module.__spec__.loader = self._loader  # it also reads the package's files
        module.__loader__ = self._loader
        self._loader.exec_module(module)
        if self._finder in sys.meta_path:
            sys.meta_path.remove(self._finder)
        _register(module)


class _Finder:
    """Waits until pyvista is imported, so that `import tipp` does not import it."""

    def find_spec(self, name: str, path: Any, target: Any = None) -> ModuleSpec | None:
        if name != "pyvista":
            return None
        import importlib.util

        sys.meta_path.remove(self)
        try:
            spec = importlib.util.find_spec(name)
        finally:
            sys.meta_path.insert(0, self)  # find_spec() may also be called without an import
        if spec is not None and spec.loader is not None:
            spec.loader = _Loader(spec.loader, self)
        return spec


def register_when_imported() -> None:
    if "pyvista" in sys.modules:
        _register(sys.modules["pyvista"])
    else:
        sys.meta_path.insert(0, _Finder())
