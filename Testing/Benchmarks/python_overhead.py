# SPDX-License-Identifier: BSD-3-Clause
"""What tipp.delaunay costs beside the triangulation itself, which the filter times.

Usage: python3 python_overhead.py [POINTS] [REPEATS]      (or in ParaView: pvbatch python_overhead.py ...)
Prints the least seconds of all repeats: of the filter's own phases, of the filter's Update() from Python, and of
tipp.delaunay on arrays of three columns, which are not copied, and of two, which are once.
"""
import sys
import time

import numpy as np

import tipp


def phases(algorithm):
    seconds = algorithm.GetStatistics().GetFieldData().GetArray("PhaseSeconds")
    return sum(seconds.GetValue(i) for i in range(seconds.GetNumberOfValues()))


def seconds_of(call):
    begin = time.perf_counter()
    result = call()
    seconds = time.perf_counter() - begin
    del result
    return seconds


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000_000
    repeats = int(sys.argv[2]) if len(sys.argv) > 2 else 3
    points = np.random.default_rng(1).random((count, 3))
    flat = points[:, :2].copy()
    cloud = tipp._arrays.point_cloud(points)
    rows = []
    for _ in range(repeats):
        algorithm = tipp.vtkTIPPDelaunay2D()
        algorithm.SetInputData(cloud)
        update = seconds_of(algorithm.Update)
        core = phases(algorithm)
        del algorithm
        rows.append((core, update, seconds_of(lambda: tipp.delaunay(points)),
                     seconds_of(lambda: tipp.delaunay(flat))))
    names = ("filter's phases", "Update()", "tipp.delaunay of (n, 3)", "tipp.delaunay of (n, 2)")
    for name, seconds in zip(names, np.min(rows, axis=0)):
        print(f"{name:24} {seconds:7.3f} s")


main()
