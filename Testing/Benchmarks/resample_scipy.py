# SPDX-License-Identifier: BSD-3-Clause
"""Compares tipp.resample with scipy's LinearNDInterpolator, which uses one thread.

Usage: resample_scipy.py POINTS SAMPLES [REPEATS]      (set OMP_NUM_THREADS=1 to have one thread here too)

Samples two values of uniform points, SAMPLES times along x and y. Triangulations are timed separately; scipy's is made
only once, because it takes long. Times of sampling are the least of all repeats.
"""
import importlib.util
import os
import sys
import time

import numpy as np

import tipp


def least(work, repeats):
    best = np.inf
    for _ in range(repeats):
        begin = time.perf_counter()
        result = work()
        best = min(best, time.perf_counter() - begin)
    return best, result


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    count, samples, repeats = (int(word) for word in (sys.argv[1:] + ["3"])[:3])
    points = np.random.default_rng(1).random((count, 2))
    values = np.stack((points[:, 0] - 2 * points[:, 1], np.sin(30 * points[:, 0]) * points[:, 1]), axis=1)
    bounds = (0.01, 0.99, 0.01, 0.99, 0.0, 0.0)
    data = {"height": values[:, 0].copy(), "wave": values[:, 1].copy()}
    making, mesh = least(lambda: tipp.delaunay_2d(points, point_data=data), repeats)
    seconds, image = least(lambda: tipp.resample(mesh, bounds, (samples, samples, 1)), repeats)
    threads = os.environ.get("OMP_NUM_THREADS", "all")
    print(f"{count} points, {samples} x {samples} samples, two arrays, threads: {threads}")
    print(f"tipp: triangulation {making:.3f} s, samples {seconds:.3f} s")
    if not importlib.util.find_spec("scipy"):
        print("scipy is not installed: no LinearNDInterpolator")
        return
    from scipy.interpolate import LinearNDInterpolator
    from scipy.spatial import Delaunay

    their_making, triangulation = least(lambda: Delaunay(points), 1)
    interpolator = LinearNDInterpolator(triangulation, values)
    axis = np.linspace(bounds[0], bounds[1], samples)
    theirs, grid = least(lambda: interpolator(*np.meshgrid(axis, axis)), 1)
    print(f"scipy: triangulation {their_making:.2f} s, {their_making / making:.0f} times ours; "
          f"samples {theirs:.2f} s, {theirs / seconds:.0f} times ours")
    apart = np.abs(np.stack([tipp.as_array(image, name) for name in data], axis=2) - grid).max()
    print(f"the two differ by {apart:.1e} at most")


main()
