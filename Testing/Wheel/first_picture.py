# SPDX-License-Identifier: BSD-3-Clause
import numpy, pyvista
cloud = pyvista.PolyData(numpy.random.default_rng(1).random((100_000, 3)) * [1, 1, 0.02])
mesh = cloud.tipp.delaunay_2d()
mesh.plot(scalars=mesh.points[:, 2], off_screen=True, screenshot="picture.png")
