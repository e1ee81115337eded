# SPDX-License-Identifier: BSD-3-Clause
"""Triangulates points in a file out of core, with breaklines from another file."""
import numpy
import tipp

numpy.save("many.npy", numpy.random.default_rng(1).random((100_000, 2)))
with open("breaklines.csv", "w") as file:
    file.write("x1,y1,x2,y2\n0.1,0.2,0.9,0.7\n0.1,0.7,0.9,0.2\n")
figures = tipp.delaunay_file("many.npy", "many.tipp", memory="16M", constraints="breaklines.csv", mark_constraints=True)
print(figures["constraint_edges"], "segments,", figures["crossing_points"], "crossing")
