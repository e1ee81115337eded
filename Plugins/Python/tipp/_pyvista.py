# SPDX-License-Identifier: BSD-3-Clause
"""mesh.tipp on PyVista's data sets: _hook registers it once PyVista is imported."""
from __future__ import annotations

import os
from types import ModuleType
from typing import Any, Iterable, Sequence

import numpy as np

from ._arguments import flag, number, ProgressBar
from ._bounds import BoundsLike
from ._dem import Dem, dem
from ._meshes import resample, write
from ._query import open as open_mesh
from ._triangulate import delaunay_2d, delaunay_3d


class Accessor:
    """tipp's functions for one PyVista data set: mesh.tipp.delaunay_2d() and so on."""

    def __init__(self, dataset: Any) -> None:
        self._dataset = dataset

    def delaunay_2d(
        self,
        tol: float = 0.0,
        alpha: float = 0.0,
        offset: float = 1.0,
        bound: bool = False,
        inplace: bool = False,
        edge_source: Any = None,
        progress_bar: ProgressBar = False,
        *,
        max_edge: float = 0.0,
        edges: Any = None,
        polygons: Iterable[Any] | None = None,
        crossings: str = "split",
        marks: str = "none",
        map_duplicates: bool = True,
        neighbors: bool = False,
        return_statistics: bool = False,
        partitions: tuple[int, int] | None = None,
        schedule: str = "dynamic",
        threads: int = 0,
    ) -> Any:
        """Computes the exact Delaunay triangulation of the data set's points in the x-y plane.

        The first arguments are those of PyVista's delaunay_2d(); all are those of tipp.delaunay_2d().

        Parameters
        ----------
        tol, alpha, offset, bound, edge_source, progress_bar
            As for tipp.delaunay_2d(). tol=0, the default, merges only coincident points.
        inplace
            Whether the data set is replaced by the result.
        max_edge, edges, polygons, crossings, marks, map_duplicates, neighbors, return_statistics, partitions, schedule, threads
            As for tipp.delaunay_2d().

        Returns
        -------
        pyvista.PolyData
            The points and point data, with triangles; and the statistics with return_statistics.
        """
        is_inplace = flag(inplace, "inplace")
        result = delaunay_2d(
            self._dataset, tol=tol, alpha=alpha, offset=offset, bound=bound, edge_source=edge_source, max_edge=max_edge,
            edges=edges, polygons=polygons, crossings=crossings, marks=marks, map_duplicates=map_duplicates,
            neighbors=neighbors, return_statistics=return_statistics, partitions=partitions, schedule=schedule,
            threads=threads, progress_bar=progress_bar)
        if not is_inplace:
            return result
        mesh, *statistics = result if isinstance(result, tuple) else (result,)
        self._dataset.copy_from(mesh, deep=False)
        return (self._dataset, *statistics) if statistics else self._dataset

    def delaunay_3d(
        self,
        alpha: float = 0.0,
        tol: float = 0.0,
        offset: float = 2.5,
        progress_bar: ProgressBar = False,
        *,
        bound: bool = False,
        map_duplicates: bool = True,
        neighbors: bool = False,
        return_statistics: bool = False,
        partitions: int = 0,
        threads: int = 0,
    ) -> Any:
        """Computes the exact Delaunay tetrahedralization of the data set's points.

        The first arguments are those of PyVista's delaunay_3d(); all are those of tipp.delaunay_3d(). tol=0, the default,
        merges only coincident points. Returns a pyvista.UnstructuredGrid.
        """
        return delaunay_3d(
            self._dataset, alpha=alpha, tol=tol, offset=offset, bound=bound, map_duplicates=map_duplicates,
            neighbors=neighbors, return_statistics=return_statistics, partitions=partitions, threads=threads,
            progress_bar=progress_bar)

    def dem(
        self,
        resolution: float,
        *,
        bounds: BoundsLike | None = None,
        align: bool = True,
        attributes: str | Sequence[str] = "elevation",
        max_edge: float = 0.0,
        duplicates: str = "first",
        thin: tuple[float, str] | None = None,
        breaklines: Any = None,
        boundary: Any = None,
        soft: bool = False,
        memory: int | str | None = None,
        threads: int = 0,
        progress_bar: ProgressBar = False,
        crs: str | None = None,
    ) -> Dem:
        """Makes a raster of elevations of the data set's points; the arguments are those of tipp.dem(). Returns a
        tipp.Dem."""
        return dem(
            self._dataset, resolution, bounds=bounds, align=align, attributes=attributes, max_edge=max_edge,
            duplicates=duplicates, thin=thin, breaklines=breaklines, boundary=boundary, soft=soft, memory=memory,
            threads=threads, progress_bar=progress_bar, crs=crs)

    def resample_to_image(
        self,
        dimensions: Sequence[int] | None = None,
        *,
        bounds: BoundsLike | None = None,
        spacing: Sequence[float] | None = None,
        null_value: float = 0.0,
        no_data: float | None = None,
        arrays: str | Iterable[str] | None = None,
        method: str = "linear",
        covered_share: bool = False,
        device: str = "auto",
        threads: int = 0,
        progress_bar: ProgressBar = False,
    ) -> Any:
        """Samples the mesh on a regular grid; the arguments are those of tipp.resample(). Returns a pyvista.ImageData."""
        return resample(
            self._dataset, bounds, dimensions, spacing=spacing, null_value=null_value, no_data=no_data, arrays=arrays,
            method=method, covered_share=covered_share, device=device, threads=threads, progress_bar=progress_bar)

    def sample(
        self,
        target: Any,
        *,
        pass_cell_data: bool = True,
        pass_point_data: bool = True,
        pass_field_data: bool = True,
        arrays: str | Iterable[str] | None = None,
        null_value: float = 0,
        memory: int | str = "1G",
        step: int = 0,
        threads: int = 0,
    ) -> Any:
        """Evaluates a mesh's arrays at the data set's points, like PyVista's sample(), but without a tolerance.

        Parameters
        ----------
        target
            The mesh, or the path of a partitioned one.
        pass_cell_data, pass_point_data, pass_field_data
            Whether the result keeps the data set's own arrays.
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
        for name, is_passed in (("cell_data", pass_cell_data), ("point_data", pass_point_data), ("field_data", pass_field_data)):
            if not flag(is_passed, f"pass_{name}"):
                getattr(result, name).clear()
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

    def save(
        self,
        path: str | os.PathLike[str],
        *,
        tiling: str = "grid:4x4",
        duplicate_borrowers: bool = False,
        memory_limit: int | str = 1 << 31,
        threads: int = 0,
        progress_bar: ProgressBar = False,
    ) -> None:
        """Writes the mesh as a partitioned mesh; the arguments are those of tipp.write()."""
        write(self._dataset, path, tiling=tiling, duplicate_borrowers=duplicate_borrowers, memory_limit=memory_limit,
              threads=threads, progress_bar=progress_bar)


def register(pyvista: ModuleType) -> None:
    """Registers the accessor for PyVista's data sets."""
    if hasattr(pyvista, "register_dataset_accessor"):  # since 0.48
        pyvista.register_dataset_accessor("tipp", pyvista.DataSet)(Accessor)
    else:
        pyvista.DataSet.tipp = property(Accessor, doc=Accessor.__doc__)
