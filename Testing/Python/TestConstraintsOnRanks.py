# SPDX-License-Identifier: BSD-3-Clause
"""Constraints of tipp.delaunay_2d on the ranks of an MPI run: TestConstraintsOnRanks.py MPIEXEC"""
import subprocess
import sys
import unittest

import numpy as np

import tipp
import tipp._vtk

MPIEXEC = sys.argv.pop(1) if len(sys.argv) > 1 else ""
RING = np.array([[0.2, 0.2], [0.8, 0.2], [0.8, 0.8], [-0.2, 1.8]])
LINE = np.array([[0.3, 0.3], [0.5, 0.51], [0.6, 0.4]])
POINTS = np.random.default_rng(1).random((3000, 3)) + [0, 0, 400]
DATA = {"wave": np.sin(9 * POINTS[:, 0]), "kind": (np.arange(3000) % 7).astype(np.int16)}


def values_at_corners(mesh):
    """The exact height and values of each corner that the mesh has."""
    xyz = mesh.points
    found = {}
    for corner in [*RING, *LINE]:
        for i in np.flatnonzero((xyz[:, :2] == corner).all(axis=1))[:1]:
            values = (tipp.as_array(mesh, name)[i] for name in DATA)
            found[tuple(corner)] = [float(value).hex() for value in (xyz[i, 2], *values)]
    return found


def main():
    """The program of a rank: the first has the ring, the second the line."""
    with tipp.ranks() as world:
        own = slice(world.rank, None, world.size)
        mesh = tipp.delaunay_2d(
            POINTS[own].copy(), point_data={name: values[own].copy() for name, values in DATA.items()},
            polygons=[RING] if world.rank == 0 else None, edges=[LINE] if world.rank == 1 else None)
        together = {}
        for found in world.allgather(values_at_corners(mesh)):
            together.update(found)
        del mesh
        if world.rank == 0:
            print(sorted(together.items()), flush=True)


class OnRanks(unittest.TestCase):
    def test_new_corners_have_the_values_of_one_rank(self):
        alone = values_at_corners(tipp.delaunay_2d(POINTS, point_data=DATA, polygons=[RING], edges=[LINE]))
        self.assertEqual(7, len(alone))
        for ranks in ("2", "3"):
            run = subprocess.run([MPIEXEC, "--oversubscribe", "--bind-to", "none", "-n", ranks, sys.executable, __file__],
                                 capture_output=True, text=True, timeout=200)
            self.assertEqual(str(sorted(alone.items())), run.stdout.strip(), run.stderr)


if __name__ == "__main__":
    unittest.main() if MPIEXEC else main()
