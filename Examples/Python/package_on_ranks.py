# SPDX-License-Identifier: BSD-3-Clause
"""Calls the package's functions on the ranks of an MPI run, which share one mesh.

Usage: mpirun -np 2 python3 package_on_ranks.py [POINTS_PER_RANK]
"""
import sys

import numpy as np

import tipp

count = int(sys.argv[1]) if len(sys.argv) > 1 else 50_000
with tipp.ranks() as world:
    points = np.random.default_rng(world.rank).random((count, 2))
    piece = tipp.delaunay_2d(points, point_data={"x": points[:, 0]})
    total = world.allreduce(len(piece.cells))
    tipp.write(piece, "ranks.tipp")
    part = tipp.read("ranks.tipp", bounds=(0.4, 0.6, 0.4, 0.6))
    read = world.allreduce(len(part.cells))
    if world.rank == 0:
        print(f"{total} triangles of {world.size} ranks, {read} of them in the range", flush=True)
