# SPDX-License-Identifier: BSD-3-Clause
"""Calls every public function with types that mypy --strict and pyright accept."""
from __future__ import annotations

import importlib.util
import pathlib
import tempfile
from typing import Any

import numpy as np
from numpy.typing import NDArray

import tipp

POINTS: NDArray[np.float64] = np.random.default_rng(1).random((500, 3))
PART = tipp.Bounds(west=0.2, south=0.3, east=0.6, north=0.7)


def show(fraction: float) -> bool:
    return fraction <= 1


def triangulate(folder: pathlib.Path) -> tipp.Mesh:
    triangles: NDArray[np.integer] = tipp.delaunay(POINTS, tol=0, threads=1, partitions=(1, 1), progress_bar=show)
    report: tipp.CheckReport = tipp.check(POINTS, triangles)
    assert report and triangles.shape[1] == 3
    mesh, statistics = tipp.delaunay_2d(
        POINTS, point_data={"height": POINTS[:, 2]}, edges=[[0, 1]], marks="lines", return_statistics=True)
    assert isinstance(mesh, tipp.Mesh) and statistics["points"] == 500
    np.save(folder / "points.npy", POINTS)
    counts: dict[str, int] = tipp.delaunay_file(folder / "points.npy", folder / "mesh.tipp", memory="64M")
    assert counts["triangles"] == len(triangles)
    tetrahedra = tipp.delaunay_3d(POINTS)
    assert isinstance(tetrahedra, tipp.Mesh) and tetrahedra.cells.shape[1] == 4
    refined = tipp.mesh(POINTS[:, :2], size=lambda x, y: 0.05 + 0.1 * x, regions=[(0.5, 0.5, 0.1)])
    assert isinstance(refined, tipp.Mesh) and refined.cell_data["OutsideBounds"].shape == refined.cells.shape[:1]
    arrays: dict[str, NDArray[Any]] = tipp.triangulate({"vertices": POINTS[:, :2]}, "q30a0.01", threads=1)
    assert arrays["triangles"].shape[1] == 3
    try:
        ranks(POINTS)
    except RuntimeError as error:
        assert "TIPP" in str(error)
    else:
        raise AssertionError("the wheel has no ranks")
    return mesh


def ranks(points: NDArray[np.float64]) -> None:
    with tipp.ranks() as world:
        tipp.delaunay(points[world.rank :: world.size])


def sample(mesh: tipp.Mesh) -> None:
    image = tipp.resample(mesh, PART, (20, 30), null_value=-1, arrays=["height"], return_type="tipp")
    assert isinstance(image, tipp.Image) and image.dimensions == (20, 30, 1)
    grid: NDArray[np.float64] = tipp.as_array(image, "height")
    means = tipp.resample(mesh, PART, (20, 30), method="conservative", covered_share=True)
    assert tipp.as_array(means, "CoveredShare").shape == (30, 20)
    remapped = tipp.remap(mesh, tipp.delaunay_2d(POINTS[:50]), arrays="height", null_value=-1)
    assert isinstance(remapped, tipp.Mesh) and "CoveredShare" in remapped.cell_data
    volumes: tipp.CutFill = tipp.volume(mesh, tipp.delaunay_2d(POINTS[:50]), bounds=PART, threads=2)
    net: float = volumes.net
    assert net == volumes.fill - volumes.cut and volumes.area > 0
    dem: tipp.Dem = tipp.dem(POINTS, 0.1, bounds=PART, attributes=["elevation", "slope"])
    array, transform, crs = dem
    west: float = dem.transform[2]
    assert grid.shape == (30, 20) and np.asarray(dem).shape == array.shape and west == transform[2] and crs is None
    assert dem.sel(band="slope").bands == ("slope",)


def store(mesh: tipp.Mesh, folder: pathlib.Path) -> None:
    path = folder / "stored.tipp"
    tipp.write(tipp.Mesh(mesh.points, mesh.cells, mesh.point_data), path, tiling="grid:2x2", memory_limit="64M")
    part = tipp.read(path, bounds=(0.2, 0.6, 0.3, 0.7), point_arrays="height")
    assert isinstance(part, tipp.Mesh) and 0 < len(part.cells) < len(mesh.cells)
    maps = tipp.resample_series(path, PART, (20, 30), arrays="height", return_type="tipp")
    assert isinstance(maps, tipp.Maps) and maps.arrays["height"].shape == (30, 20) and not tipp.times(path).values.size


def query(mesh: tipp.Mesh) -> None:
    asked = [(0.4, 0.5), (0.5, 0.5)]
    opened: tipp.ResidentMesh
    with tipp.open(mesh, memory="64M") as opened:
        cells, weights = opened.locate(asked)
        heights: NDArray[np.float64] = opened.interpolate(asked, "height")
        assert weights.shape == (2, 3) and np.isfinite(heights).all() and "height" in opened.array_names
        assert opened.neighbors(cells).shape == (2, 3)
        assert len(opened.star([0])) == len(opened.ring(points=[0], k=2)) == 1
        assert len(opened.boundary()) == 1 and opened.contours([0.5], "height")
        assert opened.profile(asked, 0.1).distances[0] == 0 and opened.closest(asked).distances[0] == 0
        assert opened.cells_in(box=PART).size and opened.points_in(box=PART.bounds).size
        assert opened.zones([[(0.2, 0.2), (0.6, 0.2), (0.6, 0.6)]], "height").area[0] > 0
        assert len(opened.descend(asked, "height")) == 2 and opened.components()[1].sum() == len(mesh.cells)


def replace_scipy() -> None:
    triangulation = tipp.Delaunay(POINTS[:, :2])
    found: NDArray[np.int32] = triangulation.find_simplex([[0.5, 0.5]])
    assert found[0] >= 0
    assert tipp.LinearNDInterpolator(triangulation, POINTS[:, 2])([[0.5, 0.5]]).shape == (1,)


def convert(mesh: tipp.Mesh) -> None:
    assert mesh.bounds[1] <= 1 and mesh["height"].size == 500
    if importlib.util.find_spec("vtkmodules"):
        algorithm = tipp.vtkTIPPDelaunay2D()
        algorithm.SetInputData(mesh.to_vtk())
        algorithm.Update()
        assert algorithm.GetOutput().GetNumberOfPolys() > 0
    if importlib.util.find_spec("pyvista"):
        assert mesh.to_pyvista().tipp.delaunay_2d(0, alpha=0.2).n_points == 500


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        mesh = triangulate(folder)
        sample(mesh)
        store(mesh, folder)
        query(mesh)
        replace_scipy()
        convert(mesh)
    print("every function was called")


main()
