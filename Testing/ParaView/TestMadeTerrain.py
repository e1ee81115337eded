# SPDX-License-Identifier: BSD-3-Clause
"""Examples/pvbatch/made_terrain.py must give the same image on any number of ranks, and the picture of the baseline."""
import numpy as np

from run_paraview import Session, expect, expect_picture, parallel_image

session = Session(__doc__)
output = session.pvbatch(session.source / "Examples/pvbatch/made_terrain.py", session.scratch)
expect("triangles" in output, "the script told of no triangles")
image, arrays = parallel_image(session.scratch / "terrain.pvti")
expect(image.GetDimensions() == (301, 201, 1), f"the image has {image.GetDimensions()} samples")
expect((arrays["vtkValidPointMask"] == 1).all(), "samples in the mesh were not found")

# For comparison, the same points are triangulated and sampled in this process with the other VTK.
import tipp

xy = np.random.default_rng(3).random((20000, 2))
height = np.sin(9 * xy[:, 0]) * np.cos(7 * xy[:, 1]) + 0.3 * np.sin(40 * xy[:, 0] * xy[:, 1])
mesh = tipp.delaunay_2d(xy, point_data={"height": height})
expected = tipp.as_array(tipp.resample(mesh, (0.2, 0.8, 0.2, 0.6, 0, 0), (301, 201, 1)), "height")
np.testing.assert_array_equal(arrays["height"].reshape(201, 301), expected)

# The stored mesh must have each triangle once, however many ranks wrote it.
stored = len(tipp.read(session.scratch / "terrain.tipp").cells)
expect(stored == len(mesh.cells), f"{stored} triangles were stored, {len(mesh.cells)} were made")

expect_picture(session.scratch / "terrain.png", session.source / "Data/Baselines/PvbatchTerrain.png")
