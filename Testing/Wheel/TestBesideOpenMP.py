# SPDX-License-Identifier: BSD-3-Clause
"""The wheel's threads and the OpenMP library of scikit-learn in one process."""
import re
import threading
import unittest

import numpy as np
from sklearn.cluster import KMeans

import tipp


def runtimes():
    """The OpenMP libraries that this process has loaded."""
    with open("/proc/self/maps", encoding="ascii") as file:
        return set(re.findall(r"/\S*/lib(?:gomp|omp|iomp5)\S*", file.read()))


class BesideOpenMP(unittest.TestCase):
    def setUp(self):
        self.points = np.random.default_rng(3).random((20_000, 2))

    def cluster(self):
        return KMeans(8, n_init=1, random_state=0).fit(self.points).inertia_

    def test_they_work_in_turn(self):
        inertia, triangles = self.cluster(), tipp.delaunay(self.points)
        self.assertEqual([], [name for name in runtimes() if "/tipp" in name])
        self.assertGreaterEqual(len(runtimes()), 1)
        for _ in range(3):
            self.assertAlmostEqual(inertia, self.cluster(), places=9)
            np.testing.assert_array_equal(triangles, tipp.delaunay(self.points))

    def test_they_work_at_once(self):
        triangles = tipp.delaunay(self.points, threads=2)
        clusters = []
        thread = threading.Thread(target=lambda: clusters.extend(self.cluster() for _ in range(5)))
        thread.start()
        for _ in range(5):
            np.testing.assert_array_equal(triangles, tipp.delaunay(self.points, threads=2))
        thread.join()
        self.assertEqual(5, len(clusters))


if __name__ == "__main__":
    unittest.main()
