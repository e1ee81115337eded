# SPDX-License-Identifier: BSD-3-Clause
"""The command `tipp delaunay` under mpirun: TestTippOnRanks.py MPIEXEC TIPP"""
import json
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

import numpy as np

MPIEXEC, TIPP = sys.argv[1:3]


def canonical(triangles):
    """The triangles as a sorted list, each starting with its lowest id."""
    first = np.argmin(triangles, axis=1)
    turned = np.stack([np.roll(t, -f) for t, f in zip(triangles, first)])
    return turned[np.lexsort(turned.T[::-1])]


class TippOnRanks(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        rng = np.random.default_rng(7)
        np.save(self.folder / "points.npy", rng.random((20000, 2)))

    def run_tipp(self, ranks, *arguments):
        launcher = [MPIEXEC, "--oversubscribe", "--bind-to", "none", "-n", str(ranks)] if ranks > 1 else []
        return subprocess.run([*launcher, TIPP, "delaunay", *arguments], cwd=self.folder,
                              capture_output=True, text=True, timeout=120)

    def triangles(self, ranks, *arguments):
        run = self.run_tipp(ranks, "points.npy", "-o", "out.npy", *arguments)
        self.assertEqual(run.returncode, 0, run.stderr)
        return canonical(np.load(self.folder / "out.npy"))

    def test_every_number_of_ranks_gives_the_same_triangles(self):
        alone = self.triangles(1)
        for ranks in (2, 3):
            np.testing.assert_array_equal(self.triangles(ranks), alone)
        multi = self.triangles(3, "--masters", "multi", "--major", "2x2", "--minor", "3x3")
        np.testing.assert_array_equal(multi, alone)

    def test_long_edges_are_left_out_on_any_number_of_ranks(self):
        longest = ["--max-edge", "0.01"]
        alone = self.triangles(1, *longest)
        self.assertTrue(0 < len(alone) < len(self.triangles(1)))
        for ranks in (2, 5):
            np.testing.assert_array_equal(self.triangles(ranks, *longest, "--stats", "run.json"), alone)
            statistics = json.loads((self.folder / "run.json").read_text())
            self.assertEqual(statistics["triangles"], len(alone))
            self.assertEqual(sum(rank["triangles"] for rank in statistics["ranks"]), len(alone))

    def test_las_files_are_shared_among_ranks(self):
        shared = np.random.default_rng(3).integers(0, 100000, (9000, 3))
        for name, part in (("a.las", shared[:4000]), ("b.las", shared[4000:])):
            self.write_las(name, part)
        for output in ("out.npy", "mesh.tipp"):
            more = ["--sink", "count"] if output == "mesh.tipp" else []
            runs = [self.run_tipp(ranks, "a.las", "b.las", "-o", output, "--class", "2", *more) for ranks in (1, 3)]
            self.assertEqual([run.returncode for run in runs], [0, 0], runs[1].stderr)
            counts = [run.stdout.split(", ")[:3] for run in runs]
            self.assertEqual(counts[0], counts[1])
            self.assertTrue(counts[0][0].startswith("5999 points"), counts)
            for run in runs:
                self.assertIn("tipp: 3001 points of LAS files are not used", run.stderr)

    def write_las(self, name, points):
        """Version 1.2, format 0. Every third point has class 1, the others class 2."""
        header = bytearray(227)
        header[:4] = b"LASF"
        struct.pack_into("<BB", header, 24, 1, 2)
        struct.pack_into("<HIIBHI", header, 94, 227, 227, 0, 0, 20, len(points))
        struct.pack_into("<6d", header, 131, 0.01, 0.01, 0.01, 0, 0, 0)
        body = b"".join(struct.pack("<3iHBBbBH", *map(int, p), 0, 9, 1 if i % 3 == 0 else 2, 0, 0, 0)
                        for i, p in enumerate(points))
        (self.folder / name).write_bytes(bytes(header) + body)

    def test_statistics_have_every_rank(self):
        self.triangles(3, "--stats", "run.json", "--masters", "multi", "--major", "2x2", "--minor", "3x3")
        statistics = json.loads((self.folder / "run.json").read_text())
        self.assertEqual(len(statistics["ranks"]), 3)
        self.assertEqual(statistics["major_partitions"], 4)
        self.assertEqual(statistics["partitions"], 36)

    def test_the_longest_path_is_between_the_longest_rank_and_all_together(self):
        for schedule in ("stages", "producer-consumer", "dynamic"):
            self.triangles(3, "--stats", "run.json", "--masters", "multi", "--major", "2x2",
                           "--minor", "3x3", "--schedule", schedule)
            statistics = json.loads((self.folder / "run.json").read_text())
            computing = [rank["compute_seconds"] for rank in statistics["ranks"]]
            path = statistics["masters"][0]["path_seconds"]
            self.assertGreater(path, 0.999 * max(computing))
            self.assertLess(path, 1.001 * sum(computing))

    def test_a_mesh_file_has_the_points_too(self):
        run = self.run_tipp(2, "points.npy", "-o", "mesh.vtp")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn(b'NumberOfPoints="20000"', (self.folder / "mesh.vtp").read_bytes()[:4000])

    def test_bad_input_is_one_sentence_and_no_output(self):
        (self.folder / "points.npy").write_bytes(b"not an array")
        run = self.run_tipp(3, "points.npy", "-o", "out.npy")
        self.assertNotEqual(run.returncode, 0)
        complaints = [line for line in run.stderr.splitlines() if line.startswith("tipp:")]
        self.assertEqual(len(complaints), 1, run.stderr)
        self.assertIn("points.npy", complaints[0])
        self.assertFalse((self.folder / "out.npy").exists())

    def test_too_many_partitions_end_all_ranks(self):
        run = self.run_tipp(2, "points.npy", "-o", "out.npy", "--masters", "multi", "--major", "4000x5000")
        self.assertNotEqual(run.returncode, 0)
        self.assertIn("partitions are too many", run.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
