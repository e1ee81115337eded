# SPDX-License-Identifier: BSD-3-Clause
"""Compares the wheel with scipy, VTK and the Debian build, and prints each figure with its target.

Usage: python figures.py WHEEL WITH_PEERS ALONE DEBIAN [POINTS [QUERIES [REPEATS]]]
WITH_PEERS and ALONE are Python interpreters with the wheel: one with VTK 9.7, PyVista and scipy, the other with only
NumPy. DEBIAN is the folder of the Debian build's Python package, or -. Utilities/benchmark.sh makes them and runs this.

Each figure is measured in its own process. Of repeated runs, the least time counts.
"""
import json
import os
import subprocess
import sys
import time

import numpy as np

THREADS = 2


def least(call, repeats):
    times = []
    for _ in range(repeats):
        begin = time.perf_counter()
        call()
        times.append(time.perf_counter() - begin)
    return min(times)


def points_of(count, dimension=2):
    return np.random.default_rng(1).random((count, dimension))


def measure_triangulation(count, repeats):
    """Seconds of tipp.delaunay() in this Python."""
    import tipp

    points = points_of(count)
    tipp.delaunay(points[:1000], threads=THREADS)
    return {"seconds": least(lambda: tipp.delaunay(points, threads=THREADS), repeats)}


def measure_scipy(count, dimension=2):
    from scipy.spatial import Delaunay

    points = points_of(count, dimension)
    return {"seconds": least(lambda: Delaunay(points), 1)}


def measure_class(count, dimension, repeats):
    """Seconds of tipp.Delaunay(), and of it and its neighbors, which it computes when they are asked for."""
    import tipp

    points = points_of(count, dimension)
    tipp.Delaunay(points[:1000], threads=THREADS)
    return {"seconds": least(lambda: tipp.Delaunay(points, threads=THREADS), repeats),
            "linked": least(lambda: tipp.Delaunay(points, threads=THREADS).neighbors, repeats)}


def measure_vtk(count):
    """PyVista's delaunay_2d with vtkDelaunay2D's faster order of points, for which PyVista has no keyword."""
    import pyvista
    from vtkmodules.vtkFiltersCore import vtkDelaunay2D

    cloud = pyvista.PolyData(np.column_stack([points_of(count), np.zeros(count)]))

    def run():
        algorithm = vtkDelaunay2D()
        if hasattr(algorithm, "UseHilbertSorterOn"):
            algorithm.UseHilbertSorterOn()
        algorithm.SetInputData(cloud)
        algorithm.Update()
        return pyvista.wrap(algorithm.GetOutput())

    return {"seconds": least(run, 1), "hilbert": hasattr(vtkDelaunay2D, "UseHilbertSorterOn")}


def measure_interpolation(count, queries, repeats):
    """Seconds of interpolation at scattered points, without the time for the triangulations."""
    import scipy.interpolate
    import tipp

    points = points_of(count)
    values = np.sin(9 * points[:, 0]) * np.cos(7 * points[:, 1])
    places = np.random.default_rng(2).random((queries, 2))
    mine = tipp.LinearNDInterpolator(points, values, threads=1)
    mine(places[:10])
    result = {"tipp": least(lambda: mine(places), repeats)}
    theirs = scipy.interpolate.LinearNDInterpolator(points, values)
    theirs(places[:10])
    tenth = places[: queries // 10]  # all would take minutes
    result["scipy"] = 10 * least(lambda: theirs(tenth), 1)
    sample = places[:10_000]
    difference = np.abs(mine(sample) - theirs(sample))
    assert np.nanmax(difference) < 1e-9 and np.isfinite(difference).mean() > 0.99
    return result


def measure_small_calls(calls):
    """Times for 1,000 points on one thread: a call, the part of it that is not the triangulation, and the same part of
    delaunay(), which returns an array."""
    import tipp

    points = np.random.default_rng(1).random((1000, 2))
    whole, beside, of_arrays = [], [], []
    for _ in range(calls):
        begin = time.perf_counter()
        _, statistics = tipp.delaunay_2d(points, threads=1, return_statistics=True)
        seconds = time.perf_counter() - begin
        phases = sum(statistics["seconds"].values())
        whole.append(seconds)
        beside.append(seconds - phases)
        begin = time.perf_counter()
        tipp.delaunay(points, threads=1)
        of_arrays.append(time.perf_counter() - begin - phases)
    return {"call": float(np.median(whole)), "overhead": float(np.median(beside)), "arrays": float(np.median(of_arrays))}


def measure_vtk_objects(calls):
    """Seconds that VTK needs to make the objects of such a mesh from existing arrays, and to delete them, after a
    triangulation as in a call."""
    import tipp
    from vtkmodules.util import numpy_support  # replaces VTK's array classes by those of NumPy, as in tipp
    from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints, vtkTypeInt32Array
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

    assert numpy_support
    points = np.random.default_rng(1).random((1000, 2))
    coordinates = np.zeros(3000)
    ids, offsets = np.zeros(6000, np.int32), np.arange(0, 6001, 3, dtype=np.int32)

    def lent(kind, array, components):
        result = kind()
        result.SetNumberOfComponents(components)
        result.SetVoidArray(array, len(array), 1)
        result._numpy_reference = array  # keeps the memory alive, as numpy_to_vtk() does
        return result

    def run():
        points, cells, mesh = vtkPoints(), vtkCellArray(), vtkPolyData()
        points.SetData(lent(vtkDoubleArray, coordinates, 3))
        cells.SetData(lent(vtkTypeInt32Array, offsets, 1), lent(vtkTypeInt32Array, ids, 1))
        mesh.SetPoints(points)
        mesh.SetPolys(cells)

    times = []
    for _ in range(calls):
        tipp.delaunay(points, threads=1)
        begin = time.perf_counter()
        run()
        times.append(time.perf_counter() - begin)
    return {"seconds": float(np.median(times))}


def run(python, *arguments, package=None):
    environment = {**os.environ, "PYTHONDONTWRITEBYTECODE": "1", "OMP_NUM_THREADS": str(THREADS)}
    environment.pop("PYTHONPATH", None)
    if package:
        environment["PYTHONPATH"] = package
    command = [python, __file__, "--measure", *map(str, arguments)]
    return json.loads(subprocess.run(command, env=environment, check=True, stdout=subprocess.PIPE).stdout)


def show(what, figure, bound, is_kept):
    print(f"{what:62} {figure:>28}  {bound:16} {'kept' if is_kept else 'MISSED'}", flush=True)


def report(wheel, peers, alone, debian, count, queries, repeats):
    size = os.path.getsize(wheel) / 1e6
    show("size of the wheel", f"{size:.2f} MB", "< 4 MB", size < 4)

    runs = [{"wheel": run(peers, "triangulation", count, 3)["seconds"],
             "debian": run("/usr/bin/python3", "triangulation", count, 3, package=debian)["seconds"]
             if debian != "-" else np.nan} for _ in range(repeats)]
    mine = min(one["wheel"] for one in runs)
    debian_build = min(one["debian"] for one in runs)
    name = f"tipp.delaunay of {count} points, {THREADS} threads"
    scipy = run(peers, "scipy", count)["seconds"]
    show(f"{name}, beside scipy", f"{mine:.3f} s, {scipy:.2f} s: {scipy / mine:.1f}x", ">= 40x", scipy >= 40 * mine)
    for number, dimension, bound in ((count, 2, 50), (100_000, 3, 25)):
        theirs = run(peers, "scipy", number, dimension)["seconds"]
        ours = run(peers, "class", number, dimension, repeats)
        what = f"tipp.Delaunay of {number} points in {dimension}D, {THREADS} threads, beside scipy"
        ratio = theirs / ours["seconds"]
        show(what, f"{ours['seconds']:.3f} s, {theirs:.2f} s: {ratio:.1f}x", f">= {bound}x", ratio >= bound)
        print(f"{'with its neighbors':62} {theirs / ours['linked']:>27.1f}x")
    few = 1e6 * run(peers, "class", 1000, 2, 2000)["seconds"]
    show("tipp.Delaunay of 1000 points", f"{few:.0f} us", "< 100 us", few < 100)
    vtk = run(peers, "vtk", count)
    order = "Hilbert order" if vtk["hilbert"] else "no Hilbert order"
    show(f"{name}, beside VTK ({order})", f"{mine:.3f} s, {vtk['seconds']:.2f} s: {vtk['seconds'] / mine:.1f}x",
         ">= 30x", vtk["seconds"] >= 30 * mine)
    if debian != "-":
        show(f"{name}, beside the Debian build", f"{mine:.3f} s, {debian_build:.3f} s: {mine / debian_build:.3f}",
             "<= 1.05", mine <= 1.05 * debian_build)

    samples = run(peers, "interpolation", count, queries, repeats)
    ratio = samples["scipy"] / samples["tipp"]
    show(f"{queries} samples of {count} points, 1 thread, beside ten times scipy's tenth",
         f"{samples['tipp']:.2f} s, {samples['scipy']:.2f} s: {ratio:.1f}x", ">= 5x", ratio >= 5)

    for python, kind in ((alone, "without VTK"), (peers, "beside VTK")):
        small = [run(python, "small_calls", 2000) for _ in range(repeats)]
        call, overhead, arrays = (1e6 * min(one[key] for one in small) for key in ("call", "overhead", "arrays"))
        show(f"delaunay_2d of 1000 points, {kind}", f"{call:.0f} us", "< 600 us", call < 600)
        show(f"delaunay_2d of 1000 points, {kind}, overhead", f"{overhead:.1f} us", "< 20 us", overhead < 20)
    objects = 1e6 * min(run(peers, "vtk_objects", 2000)["seconds"] for _ in range(repeats))
    print(f"{'of which VTK itself takes for the objects of the mesh':62} {f'{objects:.1f} us':>28}")
    show("delaunay of 1000 points to an array beside VTK, overhead", f"{arrays:.1f} us", "< 20 us", arrays < 20)


def main():
    if sys.argv[1:2] == ["--measure"]:
        measure = globals()["measure_" + sys.argv[2]]
        print(json.dumps(measure(*map(int, sys.argv[3:]))))
    elif len(sys.argv) < 5:
        sys.exit(__doc__)
    else:
        numbers = [int(value) for value in sys.argv[5:]]
        defaults = [1_000_000, 4_000_000, 5]
        report(*sys.argv[1:5], *numbers, *defaults[len(numbers):])


main()
