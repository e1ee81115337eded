# SPDX-License-Identifier: BSD-3-Clause
"""Measures what tipp.delaunay costs in addition to the triangulation, which the filter times.

Usage: python3 python_overhead.py [POINTS] [REPEATS]      (or in ParaView: pvbatch python_overhead.py ...)

Runs alternately in one process: the filter's Update() on points that are VTK objects already, tipp.delaunay on arrays
of three columns, which are not copied, and on arrays of two columns, which are copied once. From each run, the seconds
of the core in that run are subtracted: the phases of the filter's statistics, except those that read and make VTK
objects. Prints the least of all repeats. Copies: the memory that making VTK points of an array adds to the process,
in arrays of three columns of float64.
"""
import sys
import time

import numpy as np

import tipp
import tipp._triangulate

# Phases that do not belong to the core, or are part of other phases.
BESIDE = ("projection", "VTK output")


class Remembered:
    """Replaces the filter's class in tipp, and keeps the last filter that was made."""

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
    filters = tipp._engine.vtkTIPPDelaunay2D = Remembered()

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
