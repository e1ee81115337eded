# SPDX-License-Identifier: BSD-3-Clause
"""Averages rain, given in each cell of a fine mesh, over the cells of a coarse mesh and over pixels."""
import numpy as np

import tipp

random = np.random.default_rng(1)
fine = tipp.delaunay_2d(random.random((20_000, 2)))
fine.cell_data["rain"] = random.random(len(fine.cells))
coarse = tipp.delaunay_2d(random.random((500, 2)))

means = tipp.remap(fine, coarse, arrays="rain")
print(means.cell_data["rain"].shape, "means, covered shares up to", means.cell_data["CoveredShare"].max())

image = tipp.resample(fine, (0, 1, 0, 1), (64, 64), arrays="rain", method="conservative", covered_share=True)
rain, share = tipp.as_array(image, "rain"), tipp.as_array(image, "CoveredShare")
print("rain on the pixels:", (rain * share).sum() * image.spacing[0] * image.spacing[1])
