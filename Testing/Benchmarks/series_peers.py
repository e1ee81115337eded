# SPDX-License-Identifier: BSD-3-Clause
"""Measures `tipp resample` on time steps, beside xugrid, scipy and VTK.

Usage: series_peers.py TIPP FOLDER [SIDE [STEPS [SAMPLES]]]

FOLDER gets a UGRID file of SIDE x SIDE nodes with STEPS steps, and the maps. SAMPLES: along each axis. Prints
- the wall-clock seconds per step of sampling by TIPP on one thread and on two, and its peak memory; the steps are read
  from a flat mesh meanwhile, which takes little time;
- the seconds of TIPP from NetCDF to NetCDF, and those of copying the same steps and maps with the same compression;
- the seconds per step of what peers do with weights that are kept: scipy's product of a sparse matrix with the values,
  and xugrid's regridders, which take values of cells; and of vtkProbeFilter, which keeps nothing. Peers that are not
  installed are left out.
"""
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import time

import netCDF4
import numpy as np


def least(work, repeats):
    best = np.inf
    for _ in range(repeats):
        begin = time.perf_counter()
        result = work()
        best = min(best, time.perf_counter() - begin)
    return best, result


def made_mesh(side):
    """Returns points in the unit square, jittered from a regular grid, and triangles."""
    random = np.random.default_rng(1)
    column, row = np.meshgrid(np.arange(side), np.arange(side))
    points = np.stack([column.ravel(), row.ravel()], 1) + random.uniform(-0.3, 0.3, (side * side, 2))
    first = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)).ravel()
    lower = np.stack([first, first + 1, first + side], 1)
    upper = np.stack([first + 1, first + side + 1, first + side], 1)
    return points / (side - 1), np.concatenate([lower, upper], 1).reshape(-1, 3)


def level(points, step):
    return (np.sin(6 * points[:, 0] + step / 10) * np.cos(5 * points[:, 1] - step / 5)).astype(np.float32)


def write_ugrid(path, points, triangles, steps):
    with netCDF4.Dataset(path, "w") as file:
        file.Conventions = "CF-1.8 UGRID-1.0"
        for name, size in (("node", len(points)), ("face", len(triangles)), ("three", 3), ("time", steps)):
            file.createDimension(name, size)
        mesh = file.createVariable("mesh", "i4")
        mesh.cf_role, mesh.topology_dimension = "mesh_topology", 2
        mesh.node_coordinates, mesh.face_node_connectivity = "x y", "faces"
        for axis, name in enumerate("xy"):
            file.createVariable(name, "f8", ("node",))[:] = points[:, axis]
        file.createVariable("faces", "i4", ("face", "three"))[:] = triangles
        times = file.createVariable("time", "f8", ("time",))
        times.units = "seconds since 2008-09-01"
        times[:] = 3600.0 * np.arange(steps)
        zeta = file.createVariable("zeta", "f4", ("time", "node"), zlib=True, complevel=1, shuffle=True,
                                   chunksizes=(1, len(points)))
        zeta.mesh, zeta.location = "mesh", "node"
        for step in range(steps):
            zeta[step] = level(points, step)


def run_tipp(tipp, source, output, samples, threads, *more):
    """Returns the wall-clock seconds, those of sampling, and the peak memory in MB."""
    words = [tipp, "resample", source, "-o", output, "--step", "all", "--arrays", "zeta", "--dims", str(samples),
             str(samples), "--threads", str(threads), *more]
    begin = time.perf_counter()
    text = subprocess.run(words, check=True, capture_output=True, text=True).stdout
    seconds = time.perf_counter() - begin
    return (seconds, float(re.search(r"([\d.]+) s sampling", text).group(1)),
            int(re.search(r"peak memory (\d+) MB", text).group(1)))


def copy(source, maps, output):
    """Reads the steps and the maps, and writes the maps with the compression that they have; the seconds without the
    reading of the maps."""
    with netCDF4.Dataset(source) as values, netCDF4.Dataset(maps) as given, netCDF4.Dataset(output, "w") as file:
        shape = given["zeta"].shape
        for name, size in zip(given["zeta"].dimensions, shape):
            file.createDimension(name, size)
        zeta = file.createVariable("zeta", "f4", given["zeta"].dimensions, zlib=True, complevel=1, shuffle=True,
                                   chunksizes=given["zeta"].chunking())
        seconds = 0.0
        for step in range(shape[0]):
            image = given["zeta"][step].filled(np.nan)
            begin = time.perf_counter()
            values["zeta"][step]
            zeta[step] = image
            seconds += time.perf_counter() - begin
        begin = time.perf_counter()
        file.sync()
        return seconds + time.perf_counter() - begin


def scipy_step(points, grid):
    from scipy.sparse import csr_matrix
    from scipy.spatial import Delaunay

    mesh = Delaunay(points)
    cells = mesh.find_simplex(grid)
    of = mesh.transform[cells]
    weights = np.einsum("nij,nj->ni", of[:, :2], grid - of[:, 2])
    weights = np.concatenate([weights, 1 - weights.sum(1, keepdims=True)], 1).astype(np.float32)
    weights[cells < 0] = 0
    matrix = csr_matrix((weights.ravel(), mesh.simplices[cells].ravel(), 3 * np.arange(len(grid) + 1)),
                        (len(grid), len(points)))
    values = level(points, 0)
    return least(lambda: matrix @ values, 5)[0]


def xugrid_steps(points, triangles, axis):
    import xarray
    import xugrid

    source = xugrid.Ugrid2d(points[:, 0], points[:, 1], -1, triangles)
    data = xugrid.UgridDataArray(xarray.DataArray(level(source.centroids, 0), dims=[source.face_dimension]), source)
    target = xarray.DataArray(np.zeros((len(axis), len(axis))), coords={"y": axis[::-1], "x": axis}, dims=("y", "x"))
    for name in ("CentroidLocatorRegridder", "BarycentricInterpolator"):
        regridder = getattr(xugrid, name)(data, target)
        regridder.regrid(data)  # compiles
        yield name, least(lambda: regridder.regrid(data), 5)[0]  # noqa: B023


def vtk_step(points, triangles, axis):
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray

    mesh = vtk.vtkPolyData()
    nodes = vtk.vtkPoints()
    nodes.SetData(numpy_to_vtk(np.concatenate([points, np.zeros((len(points), 1))], 1), deep=1))
    cells = vtk.vtkCellArray()
    cells.SetData(numpy_to_vtkIdTypeArray(3 * np.arange(len(triangles) + 1), deep=1),
                  numpy_to_vtkIdTypeArray(triangles.ravel().astype(np.int64), deep=1))
    mesh.SetPoints(nodes)
    mesh.SetPolys(cells)
    values = numpy_to_vtk(level(points, 0), deep=1)
    values.SetName("zeta")
    mesh.GetPointData().AddArray(values)
    image = vtk.vtkImageData()
    image.SetDimensions(len(axis), len(axis), 1)
    image.SetOrigin(axis[0], axis[0], 0)
    image.SetSpacing(axis[1] - axis[0], axis[1] - axis[0], 1)
    probe = vtk.vtkProbeFilter()
    probe.SetInputData(image)
    probe.SetSourceData(mesh)
    return least(probe.Update, 1)[0]


def is_installed(name):
    return importlib.util.find_spec(name) is not None


def main():
    if not 3 <= len(sys.argv) <= 6:
        sys.exit(__doc__)
    tipp, folder = sys.argv[1:3]
    side, steps, samples = (int(word) for word in (sys.argv[3:] + ["1000", "100", "2048"][len(sys.argv) - 3:]))
    os.makedirs(folder, exist_ok=True)
    source, maps = os.path.join(folder, "steps.nc"), os.path.join(folder, "maps.nc")
    points, triangles = made_mesh(side)
    write_ugrid(source, points, triangles, steps)
    print(f"{side * side} nodes, {steps} steps, {samples} x {samples} samples")
    flat, highest = os.path.join(folder, "flat"), os.path.join(folder, "highest.npy")
    shutil.rmtree(flat, ignore_errors=True)
    subprocess.run([tipp, "flatten", source, "-o", flat], check=True, stdout=subprocess.DEVNULL)
    ours = 0.0
    for threads in (1, 2):
        runs = [run_tipp(tipp, flat, highest, samples, threads, "--reduce", "max") for _ in range(5)]
        ours = max(0.001, min(sampling for _, sampling, _ in runs)) / steps  # it is printed in milliseconds
        print(f"tipp, threads {threads}: {ours:.4f} s a step, peak memory {max(memory for *_, memory in runs)} MB")
    whole = min(run_tipp(tipp, source, maps, samples, 2)[0] for _ in range(2))
    print(f"tipp, from NetCDF to NetCDF: {whole:.2f} s")
    copying = min(copy(source, maps, os.path.join(folder, "copy.nc")) for _ in range(2))
    print(f"copying the steps read and the maps written: {copying:.2f} s; tipp takes {whole / copying:.2f} times that")

    def report(name, seconds):
        print(f"{name}: {seconds:.3f} s a step, {seconds / ours:.1f} times tipp's on two threads")

    axis = np.linspace(points.min(), points.max(), samples)
    if is_installed("scipy"):
        report("scipy, sparse matrix", scipy_step(points, np.stack(np.meshgrid(axis, axis), 2).reshape(-1, 2)))
    if is_installed("xugrid"):
        for name, seconds in xugrid_steps(points, triangles, axis):
            report("xugrid, " + name, seconds)
    if is_installed("vtk"):
        report("vtkProbeFilter", vtk_step(points, triangles, axis))


main()
