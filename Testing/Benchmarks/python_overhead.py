# SPDX-License-Identifier: BSD-3-Clause
"""What tipp.delaunay costs beside the triangulation itself, which the filter times.

Usage: python3 python_overhead.py [POINTS] [REPEATS]      (or in ParaView: pvbatch python_overhead.py ...)

In one process, alternately: the filter's Update() on points that are VTK's already, and tipp.delaunay on arrays of three
columns, which are not copied, and of two, which are once. Each run is set against the core's seconds in that run: the
phases of the filter's statistics without those that read and make VTK's objects. The least of all repeats is printed.
Copies: what making VTK's points of the array adds to the process's memory, in arrays of three columns of float64.
"""
import sys
import time

import numpy as np

import tipp
import tipp._triangulate

# Phases that are not the core's, or that others hold.
BESIDE = ("projection", "VTK output")


class Remembered:
    """Stands for the filter's class in tipp, and keeps the filter that was made last."""

    Kind = tipp.vtkTIPPDelaunay2D

    def __init__(self):
        self.last = None

    def __call__(self):
        self.last = self.Kind()
        return self.last


def core_seconds(algorithm):
    totals = algorithm.GetStatistics().GetFieldData()
    names, seconds = totals.GetAbstractArray("PhaseName"), totals.GetArray("PhaseSeconds")
    return sum(seconds.GetValue(i) for i in range(seconds.GetNumberOfValues()) if names.GetValue(i) not in BESIDE)


def resident_bytes():
    with open("/proc/self/status", encoding="utf-8") as file:
        return next(int(line.split()[1]) * 1024 for line in file if line.startswith("VmRSS:"))


def copies_of(points):
    before = resident_bytes()
    cloud = tipp._vtk.point_cloud(points)
    copies = (resident_bytes() - before) / (len(points) * 24)
    assert cloud.GetNumberOfPoints() == len(points)
    return copies


def timed(call, filters):
    begin = time.perf_counter()
    result = call()
    seconds = time.perf_counter() - begin
    del result
    core = core_seconds(filters.last)
    filters.last = None
    return core, seconds, seconds - core


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000_000
    repeats = int(sys.argv[2]) if len(sys.argv) > 2 else 5
    points = np.random.default_rng(1).random((count, 3))
    flat = points[:, :2].copy()
    cloud = tipp._vtk.point_cloud(points)
    copies = {"(n, 3)": copies_of(points), "(n, 2)": copies_of(flat)}
    filters = tipp._vtk_engine.vtkTIPPDelaunay2D = Remembered()

    def update():
        algorithm = filters()
        algorithm.SetInputData(cloud)
        algorithm.Update()

    cases = {"Update()": update, "tipp.delaunay of (n, 3)": lambda: tipp.delaunay(points),
             "tipp.delaunay of (n, 2)": lambda: tipp.delaunay(flat)}
    rows = {name: [] for name in cases}
    for _ in range(repeats):
        for name, call in cases.items():
            rows[name].append(timed(call, filters))
    print(f"{count} points, least of {repeats}")
    for name, runs in rows.items():
        core, seconds, more = np.min(runs, axis=0)
        note = next((f", copies {copies[kind]:.2f}" for kind in copies if name.endswith(kind)), "")
        print(f"{name:24} core {core:7.3f} s, in all {seconds:7.3f} s, overhead {more:7.3f} s: {more / core:6.1%}{note}")


main()
