# SPDX-License-Identifier: BSD-3-Clause
"""Triangulates points with a breakline of two edges, inside of a square."""
import numpy
import tipp

square = [[0.1, 0.1], [0.9, 0.1], [0.9, 0.9], [0.1, 0.9]]
points = numpy.random.default_rng(1).random((1000, 2))
mesh = tipp.delaunay_2d(points, edges=[[5, 6], [6, 7]], polygons=[square], marks="flags")
print(len(mesh.cells), "triangles,", tipp.as_array(mesh, "ConstraintEdges").sum(), "sides of them are constraints")
