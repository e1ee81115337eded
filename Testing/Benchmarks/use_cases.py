# SPDX-License-Identifier: BSD-3-Clause
"""Compares gridding of scattered points and meshes with scipy, gdal_grid, VTK and matplotlib.

Usage: use_cases.py TIPP NAME=INPUT:WIDTH...   (TIPP: the tool; INPUT: a .npy file of x, y and a value per point,
       or a mesh of triangles that tipp.read reads; WIDTH: samples along x)

In memory, from NumPy arrays to a NumPy grid: tipp.delaunay_2d and tipp.resample against scipy's
LinearNDInterpolator. From file to file: `tipp delaunay` and `tipp resample` against gdal_grid with its linear
algorithm, which triangulates too. Meshes: all point arrays are sampled by tipp.resample and vtkProbeFilter, and one
array by matplotlib's LinearTriInterpolator. Each peer runs once, ours three times.
"""
import importlib.util
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

import tipp

PATIENCE = 300  # seconds that gdal_grid may take

VRT = """<OGRVRTDataSource><OGRVRTLayer name="points"><SrcDataSource>{csv}</SrcDataSource>
<GeometryType>wkbPoint</GeometryType>
<GeometryField encoding="PointFromColumns" x="x" y="y" z="value"/></OGRVRTLayer></OGRVRTDataSource>
"""


def timed(work, repeat=1):
    best = None
    for _ in range(repeat):
        start = time.perf_counter()
        result = work()
        seconds = time.perf_counter() - start
        best = seconds if best is None else min(best, seconds)
    return best, result


class Grid:
    """Positions of samples as in tipp.resample: from bound to bound, with the last sample on the upper bound."""

    def __init__(self, points, width):
        (self.x0, self.y0), (self.x1, self.y1) = points[:, :2].min(axis=0), points[:, :2].max(axis=0)
        self.width = width
        self.height = max(2, round(width * (self.y1 - self.y0) / (self.x1 - self.x0)))

    def axes(self):
        return np.linspace(self.x0, self.x1, self.width), np.linspace(self.y0, self.y1, self.height)

    def bounds(self):
        return (self.x0, self.x1, self.y0, self.y1, 0, 0)


def ours(points, grid):
    mesh = tipp.delaunay_2d(points[:, :2], point_data={"value": points[:, 2]})
    image = tipp.resample(mesh, grid.bounds(), (grid.width, grid.height, 1), null_value=np.nan)
    return tipp.as_array(image, "value")


def scipys(points, grid):
    from scipy.interpolate import LinearNDInterpolator
    x, y = grid.axes()
    return LinearNDInterpolator(points[:, :2], points[:, 2])(*np.meshgrid(x, y))


def ours_by_files(tool, folder, grid):
    mesh, image = str(folder / "mesh.vtu"), str(folder / "grid.vti")
    subprocess.run([tool, "delaunay", str(folder / "points.csv"), "-o", mesh], check=True, capture_output=True)
    subprocess.run([tool, "resample", mesh, "-o", image, "--dims", str(grid.width), str(grid.height), "1"],
                   check=True, capture_output=True)


def gdals(folder, grid):
    x, y = (grid.x1 - grid.x0) / (grid.width - 1) / 2, (grid.y1 - grid.y0) / (grid.height - 1) / 2
    subprocess.run(["gdal_grid", "-q", "-a", "linear:radius=0:nodata=nan", "-ot", "Float64", "-l", "points",
                    "-txe", repr(grid.x0 - x), repr(grid.x1 + x), "-tye", repr(grid.y0 - y), repr(grid.y1 + y),
                    "-outsize", str(grid.width), str(grid.height), "--config", "GDAL_NUM_THREADS", "ALL_CPUS",
                    str(folder / "points.vrt"), str(folder / "grid.tif")], check=True, timeout=PATIENCE)


def run(tool, name, points, width):
    points = points[np.isfinite(points).all(axis=1)]
    grid = Grid(points, width)
    seconds, values = timed(lambda: ours(points, grid), 3)
    print(f"{name}: {len(points)} points, {grid.width} x {grid.height} samples")
    print(f"  in memory: ours {seconds:.3f} s", end="")
    if importlib.util.find_spec("scipy"):
        peer, other = timed(lambda: scipys(points, grid))
        both = np.isfinite(values) & np.isfinite(other)
        apart = np.abs(values[both] - other[both]) > 1e-6 * np.ptp(points[:, 2])
        print(f", scipy {peer:.2f} s, {peer / seconds:.0f} times ours; "
              f"{apart.mean():.2%} of the samples differ, {(np.isfinite(values) & ~both).sum()} are ours alone, "
              f"{(np.isfinite(other) & ~both).sum()} scipy's")
    else:
        print("; scipy is not installed")
    with tempfile.TemporaryDirectory() as work:
        folder = pathlib.Path(work)
        np.savetxt(folder / "points.csv", points, delimiter=",", header="x,y,value", comments="", fmt="%.17g")
        (folder / "points.vrt").write_text(VRT.format(csv=folder / "points.csv"), encoding="utf-8")
        seconds, _ = timed(lambda: ours_by_files(tool, folder, grid), 3)
        print(f"  from file to file: ours {seconds:.3f} s", end="")
        if shutil.which("gdal_grid"):
            try:
                peer, _ = timed(lambda: gdals(folder, grid))
                print(f", gdal_grid {peer:.2f} s, {peer / seconds:.0f} times ours")
            except subprocess.TimeoutExpired:
                print(f", gdal_grid more than {PATIENCE} s, {PATIENCE / seconds:.0f} times ours")
        else:
            print("; gdal_grid is not installed")


def probes(mesh, image):
    from vtkmodules.vtkCommonDataModel import vtkImageData
    from vtkmodules.vtkFiltersCore import vtkProbeFilter
    lattice = vtkImageData()
    lattice.CopyStructure(image)
    probe = vtkProbeFilter()
    probe.SetInputData(lattice)
    probe.SetSourceData(mesh)
    probe.Update()


def matplotlibs(points, triangles, values, grid):
    from matplotlib.tri import LinearTriInterpolator, Triangulation
    mesh = Triangulation(points[:, 0], points[:, 1], triangles)
    return LinearTriInterpolator(mesh, values)(*np.meshgrid(*grid.axes()))


def run_mesh(name, mesh, width, array):
    points = vtk_to_numpy(mesh.GetPoints().GetData())
    grid = Grid(points, width)
    seconds, image = timed(
        lambda: tipp.resample(mesh, grid.bounds(), (grid.width, grid.height, 1)), 3)
    print(f"{name}: {mesh.GetNumberOfCells()} triangles, {grid.width} x {grid.height} samples")
    print(f"  in memory: ours {seconds:.3f} s", end="")
    peer, _ = timed(lambda: probes(mesh, image))
    print(f", vtkProbeFilter {peer:.2f} s, {peer / seconds:.0f} times ours", end="")
    if importlib.util.find_spec("matplotlib"):
        triangles = vtk_to_numpy(mesh.GetCells().GetConnectivityArray()).reshape(-1, 3)
        peer, _ = timed(lambda: matplotlibs(points, triangles, tipp.as_array(mesh, array), grid))
        print(f", matplotlib {peer:.2f} s, {peer / seconds:.0f} times ours")
    else:
        print("; matplotlib is not installed")


def main():
    if len(sys.argv) < 3 or not all("=" in word and ":" in word for word in sys.argv[2:]):
        sys.exit(__doc__)
    for word in sys.argv[2:]:
        name, rest = word.split("=", 1)
        path, width = rest.rsplit(":", 1)
        if path.endswith(".npy"):
            run(sys.argv[1], name, np.load(path), int(width))
        else:
            mesh = tipp.read(path, return_type="vtk")
            run_mesh(name, mesh, int(width), mesh.GetPointData().GetArrayName(0))


if __name__ == "__main__":
    main()
