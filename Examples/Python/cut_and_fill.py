# SPDX-License-Identifier: BSD-3-Clause
"""Computes the volumes between two surfaces of scattered points."""
import numpy as np

import tipp

random = np.random.default_rng(1)
before = tipp.delaunay_2d(random.random((5_000, 3)) * (100, 100, 0))
points = random.random((4_000, 3)) * (100, 100, 1)
points[:, 2] += np.where(points[:, 0] < 50, -3, 1)
after = tipp.delaunay_2d(points)

result = tipp.volume(before, after, bounds=(10, 90, 10, 90))
print("cut", round(result.cut), "fill", round(result.fill), "net", round(result.net), "over", result.area)
