# SPDX-License-Identifier: BSD-3-Clause
"""Compares tipp.open with scipy's LinearNDInterpolator, which uses one thread.

Usage: query_scipy.py POINTS QUERIES      (set OMP_NUM_THREADS=1 to have one thread here too)

Interpolates two values of uniform points at scattered points. The time of scipy's triangulation is not counted. scipy
gets a hundredth of the points, in random order, and its time is multiplied by a hundred.
"""
import importlib.util
import sys
import time

import numpy as np

import tipp


def timed(work):
    begin = time.perf_counter()
    return work(), time.perf_counter() - begin


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    count, queries = (int(word) for word in sys.argv[1:])
    rng = np.random.default_rng(1)
    points = rng.random((count, 2))
    values = np.stack((points[:, 0] - 2 * points[:, 1], np.sin(30 * points[:, 0]) * points[:, 1]), axis=1)
    asked = 0.01 + 0.98 * rng.random((queries, 2))
    mesh = tipp.delaunay_2d(points, point_data={"height": values[:, 0].copy(), "wave": values[:, 1].copy()})
    ours, seconds = timed(lambda: tipp.open(mesh).interpolate(asked, ["height", "wave"]))
    print(f"{count} points, {queries} scattered points, two arrays")
    print(f"tipp: {seconds:.2f} s for the first time")
    if not importlib.util.find_spec("scipy"):
        print("scipy is not installed: no LinearNDInterpolator")
        return
    from scipy.interpolate import LinearNDInterpolator
    from scipy.spatial import Delaunay

    interpolator = LinearNDInterpolator(Delaunay(points), values)
    some = asked[::100]
    theirs, their_seconds = timed(lambda: interpolator(some))
    ratio = their_seconds / seconds * queries / len(some)
    print(f"scipy, a hundredth of the points: {their_seconds:.2f} s; for all {ratio:.1f} times ours")
    apart = np.nanmax(np.abs(np.stack([ours["height"], ours["wave"]], axis=1)[::100] - theirs))
    print(f"the two differ by {apart:.1e} at most")


main()
