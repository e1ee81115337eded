# SPDX-License-Identifier: BSD-3-Clause
"""`tipp delaunay3d` and tipp.delaunay_3d under mpirun: TestDelaunay3DOnRanks.py MPIEXEC TIPP"""
import importlib.util
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

MPIEXEC, TIPP = sys.argv[1:3]

PROGRAM = """
import numpy as np
import tipp
with tipp.ranks() as world:
    points = np.load("points.npy")[world.rank::world.size]
    mesh = tipp.delaunay_3d(points, point_data={"x": points[:, 0]})
    assert np.array_equal(mesh.point_data["x"], mesh.points[:, 0])
    total = world.allreduce(len(mesh.cells))
    if world.rank == 0:
        print(total, flush=True)
"""


class Delaunay3DOnRanks(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        points = np.random.default_rng(7).random((40000, 3))
        points[100:120] = points[30000:30020]
        np.save(self.folder / "points.npy", points)

    def launch(self, ranks, *command):
        launcher = [MPIEXEC, "--oversubscribe", "--bind-to", "none", "-n", str(ranks)] if ranks > 1 else []
        return subprocess.run([*launcher, *command], cwd=self.folder, capture_output=True, text=True, timeout=200)

    def run_tipp(self, ranks, *arguments):
        return self.launch(ranks, TIPP, "delaunay3d", *arguments)

    def output(self, ranks, name, *arguments):
        run = self.run_tipp(ranks, "points.npy", "-o", name, *arguments)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(len(run.stdout.splitlines()), 1, run.stdout)
        return (self.folder / name).read_bytes()

    def test_every_number_of_ranks_and_threads_gives_the_same_file(self):
        alone = self.output(1, "out.npy")
        for ranks, threads in ((2, 1), (3, 2), (5, 1)):
            self.assertEqual(self.output(ranks, "out.npy", "--threads", str(threads)), alone, f"{ranks} ranks")
        self.assertEqual(self.output(2, "out.npy", "--partitions", "40"), alone)
        options = ("--neighbors", "--map-duplicates")
        self.assertEqual(self.output(3, "out.vtu", *options), self.output(1, "out.vtu", *options))

    def test_statistics_have_every_rank(self):
        self.output(3, "out.npy", "--stats", "run.json")
        statistics = json.loads((self.folder / "run.json").read_text())
        self.assertEqual(statistics["points"], 40000)
        self.assertEqual(statistics["duplicates"], 20)
        self.assertEqual(len(statistics["ranks"]), 3)
        self.assertEqual(sum(rank["tetrahedra"] for rank in statistics["ranks"]), statistics["tetrahedra"])

    def test_bad_input_is_one_sentence_and_no_output(self):
        (self.folder / "points.npy").write_bytes(b"not an array")
        run = self.run_tipp(3, "points.npy", "-o", "out.npy")
        self.assertNotEqual(run.returncode, 0)
        complaints = [line for line in run.stderr.splitlines() if line.startswith("tipp:")]
        self.assertEqual(len(complaints), 1, run.stderr)
        self.assertIn("points.npy", complaints[0])
        self.assertFalse((self.folder / "out.npy").exists())

    def test_points_without_third_coordinate_are_one_sentence(self):
        np.save(self.folder / "points.npy", np.zeros((10, 2)))
        run = self.run_tipp(2, "points.npy", "-o", "out.npy")
        self.assertNotEqual(run.returncode, 0)
        self.assertEqual(run.stderr.count("column z"), 1, run.stderr)

    def test_points_in_a_plane_make_the_triangles_of_one_process_and_one_warning(self):
        points = np.random.default_rng(1).random((1000, 3)) * (1, 0, 1)
        points[900:] = points[:100]
        np.save(self.folder / "points.npy", points)
        for name in ("out.npy", "out.vtu"):
            alone = self.output(1, name)
            for ranks in (2, 3, 5):
                run = self.run_tipp(ranks, "points.npy", "-o", name, "--stats", "run.json")
                self.assertEqual(run.returncode, 0, run.stderr)
                self.assertEqual(run.stderr.count("in one plane"), 1, run.stderr)
                self.assertEqual((self.folder / name).read_bytes(), alone, f"{name} of {ranks} ranks")
                self.assertGreater(json.loads((self.folder / "run.json").read_text())["triangles"], 1700)

    @unittest.skipUnless(importlib.util.find_spec("mpi4py"), "no mpi4py")
    def test_python_ranks_make_one_mesh(self):
        self.output(1, "out.npy")
        alone = len(np.load(self.folder / "out.npy"))
        run = self.launch(3, sys.executable, "-c", PROGRAM)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(int(run.stdout), alone)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
