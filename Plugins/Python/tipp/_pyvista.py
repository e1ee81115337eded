# SPDX-License-Identifier: BSD-3-Clause
"""mesh.tipp on PyVista's data sets, once PyVista is imported; it need not be installed."""
from __future__ import annotations

import importlib.abc
import importlib.machinery
import importlib.util
import sys
from types import ModuleType
from typing import Any, Iterable, Sequence

import numpy as np

from ._arguments import flag, number
from ._dem import dem
from ._meshes import resample, write
from ._query import open as open_mesh
from ._triangulate import delaunay_2d, delaunay_3d


class Accessor:
    """tipp's functions for one PyVista data set: mesh.tipp.delaunay_2d() and so on."""

    def __init__(self, dataset: Any):
        self._dataset = dataset

    def delaunay_2d(self, *, inplace: bool = False, **options: Any) -> Any:
        """Like tipp.delaunay_2d(mesh, ...); with `inplace` the data set is replaced by the result."""
        is_inplace = flag(inplace, "inplace")
        result = delaunay_2d(self._dataset, **options)
        if not is_inplace:
            return result
        mesh, *statistics = result if isinstance(result, tuple) else (result,)
        self._dataset.copy_from(mesh, deep=False)
        return (self._dataset, *statistics) if statistics else self._dataset

    def delaunay_3d(self, **options: Any) -> Any:
        """Like tipp.delaunay_3d(mesh, ...)."""
        return delaunay_3d(self._dataset, **options)

    def dem(self, resolution: float, **options: Any) -> Any:
        """Like tipp.dem(mesh, resolution, ...)."""
        return dem(self._dataset, resolution, **options)

    def resample_to_image(self, *, bounds: Sequence[float] | None = None, **options: Any) -> Any:
        """Like tipp.resample(mesh, ...)."""
        return resample(self._dataset, bounds, **options)

    def sample(self, target: Any, *, arrays: str | Iterable[str] | None = None, null_value: float = 0,
               memory: int | str = "1G", step: int = 0, threads: int = 0) -> Any:
        """Evaluates a mesh's arrays at the data set's points, like PyVista's sample(), but without a tolerance.

        Parameters
        ----------
        target
            The mesh, or the path of a partitioned one.
        arrays
            The name or names of the mesh's arrays; None: all. "elevation" is the z of triangles.
        null_value
            The value of floating-point arrays outside of the mesh. Integer arrays are 0 there.
        memory, step, threads
            As for tipp.open().

        Returns
        -------
        A copy of the data set with the arrays, "CellId" (-1 outside) and "vtkValidPointMask".
        """
        null = number(null_value, "null_value")
        result = self._dataset.copy(deep=False)
        points = np.asarray(self._dataset.points)
        with open_mesh(target, memory=memory, step=step, threads=threads) as mesh:
            names = [arrays] if isinstance(arrays, str) else arrays
            cells, values = mesh._sample(points, names)  # pylint: disable=protected-access
        for name, array in values.items():
            if array.dtype.kind == "f":
                array[cells < 0] = null
            result.point_data[name] = array
        result.point_data["CellId"] = cells
        result.point_data["vtkValidPointMask"] = (cells >= 0).astype(np.uint8)
        return result

    def save(self, path: str, **options: Any) -> None:
        """Like tipp.write(mesh, path, ...)."""
        write(self._dataset, path, **options)


def register(pyvista: ModuleType) -> None:
    """Registers the accessor for PyVista's data sets."""
    if hasattr(pyvista, "register_dataset_accessor"):  # since 0.48
        pyvista.register_dataset_accessor("tipp", pyvista.DataSet)(Accessor)
    else:
        pyvista.DataSet.tipp = property(Accessor, doc=Accessor.__doc__)


class _Loader(importlib.abc.Loader):
    """Loads a module with its own loader, then registers the accessor."""

    def __init__(self, loader: Any, finder: _Finder):
        self._loader = loader
        self._finder = finder

    def create_module(self, spec: importlib.machinery.ModuleSpec) -> ModuleType | None:
        return self._loader.create_module(spec)

    def exec_module(self, module: ModuleType) -> None:
        self._loader.exec_module(module)
        if self._finder in sys.meta_path:
            sys.meta_path.remove(self._finder)
        register(module)


class _Finder(importlib.abc.MetaPathFinder):
    """Waits until pyvista is imported, so that `import tipp` does not import it."""

    def find_spec(self, name: str, path: Any, target: Any = None) -> importlib.machinery.ModuleSpec | None:
        if name != "pyvista":
            return None
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
        register(sys.modules["pyvista"])
    else:
        sys.meta_path.insert(0, _Finder())
