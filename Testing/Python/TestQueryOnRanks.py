# SPDX-License-Identifier: BSD-3-Clause
"""The command `tipp query` under mpirun: TestQueryOnRanks.py MPIEXEC TIPP"""
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

import numpy as np

MPIEXEC, TIPP = sys.argv[1:3]
del sys.argv[1:3]


class QueryOnRanks(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        rng = np.random.default_rng(7)
        np.save(self.folder / "points.npy", rng.random((5000, 2)))
        np.save(self.folder / "asked.npy", rng.random((2000, 2)) * 1.2 - 0.1)
        self.run_tipp(1, "delaunay", "points.npy", "-o", "mesh.vtu")
        self.run_tipp(1, "partition", "mesh.vtu", "-o", "mesh.tipp", "--tiling", "grid:3x3")

    def run_tipp(self, ranks, *arguments):
        launcher = [MPIEXEC, "--oversubscribe", "--bind-to", "none", "-n", str(ranks)] if ranks > 1 else []
        return subprocess.run([*launcher, TIPP, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=120)

    def test_every_number_of_ranks_writes_the_same_file(self):
        for output in ("out.csv", "out.npy"):
            files = []
            for ranks in (1, 2, 3):
                run = self.run_tipp(ranks, "query", "asked.npy", "mesh.tipp", "-o", output)
                self.assertEqual(run.returncode, 0, run.stderr)
                self.assertIn("2000 points, ", run.stdout)
                files.append((self.folder / output).read_bytes())
            self.assertEqual(files[0], files[1])
            self.assertEqual(files[0], files[2])

    def test_points_that_are_left_out_are_reported_once(self):
        header = bytearray(227)
        header[:4] = b"LASF"
        header[24:26] = 1, 2
        struct.pack_into("<HII", header, 94, 227, 227, 0)
        struct.pack_into("<BHI", header, 104, 0, 20, 10)
        struct.pack_into("<3d", header, 131, 0.1, 0.1, 0.1)
        records = [struct.pack("<3iHBBbBH", i, i, 0, 0, 9, 2 + i % 2, 0, 0, 0) for i in range(10)]
        (self.folder / "asked.las").write_bytes(header + b"".join(records))
        run = self.run_tipp(2, "query", "asked.las", "mesh.tipp", "-o", "out.csv", "--class", "2")
        self.assertIn("5 points, ", run.stdout)
        self.assertEqual(run.stderr.count("5 points of LAS files are not used"), 1, run.stderr)

    def make_hills(self):
        points = np.load(self.folder / "points.npy")
        np.savetxt(self.folder / "hills.csv", np.column_stack([points, np.sin(9 * points[:, 0]) * points[:, 1]]),
                   delimiter=",", header="x,y,z", comments="")
        self.run_tipp(1, "delaunay", "hills.csv", "-o", "hills.vtu")
        self.run_tipp(1, "partition", "hills.vtu", "-o", "hills.tipp", "--tiling", "grid:3x3")

    def test_descents_are_the_same_on_any_ranks(self):
        self.make_hills()
        for mesh in ("hills.tipp", "hills.vtu"):
            files = []
            for ranks in (1, 2, 3):
                run = self.run_tipp(ranks, "query", "asked.npy", mesh, "-o", "out.vtp", "--descend", "elevation")
                self.assertEqual(run.returncode, 0, run.stderr)
                self.assertRegex(run.stdout, "^2000 lines of [0-9]{4,} points, in out.vtp\n$")
                files.append((self.folder / "out.vtp").read_bytes())
            self.assertEqual(files[0], files[1])
            self.assertEqual(files[0], files[2])

    def test_every_number_of_ranks_writes_the_same_contours(self):
        self.make_hills()
        for mesh in ("hills.tipp", "hills.vtu"):
            files = []
            for ranks in (1, 2, 3):
                run = self.run_tipp(ranks, "contour", mesh, "-o", "out.vtp", "--interval", "0.1")
                self.assertEqual(run.returncode, 0, run.stderr)
                self.assertRegex(run.stdout, "^[0-9]+ lines of [0-9]{3,} points, in out.vtp\n$")
                files.append((self.folder / "out.vtp").read_bytes())
            self.assertEqual(files[0], files[1])
            self.assertEqual(files[0], files[2])

    def test_nearest_locations_and_zones_are_the_same_on_any_ranks(self):
        (self.folder / "zones.csv").write_text('id,WKT\n1,"POLYGON ((0.1 0.1,0.9 0.2,0.4 0.8,0.1 0.1))"\n')
        for arguments in (["asked.npy", "mesh.tipp", "--closest"], ["mesh.tipp", "--zones", "zones.csv"],
                          ["mesh.vtu", "--zones", "zones.csv"],
                          ["mesh.tipp", "--ids", "cells", "--polygons", "zones.csv"],
                          ["mesh.tipp", "--ids", "points", "--bounds", "0.2", "0.6", "0.1", "0.5"]):
            files = []
            for ranks in (1, 3):
                run = self.run_tipp(ranks, "query", *arguments, "-o", "out.csv")
                self.assertEqual(run.returncode, 0, run.stderr)
                files.append((self.folder / "out.csv").read_bytes())
            self.assertEqual(files[0], files[1])

    def test_a_damaged_piece_ends_all_ranks_with_one_sentence(self):
        piece = self.folder / "mesh.tipp/pieces/000008.vtu"
        content = bytearray(piece.read_bytes())
        content[len(content) // 2] ^= 1
        piece.write_bytes(content)
        run = self.run_tipp(3, "query", "asked.npy", "mesh.tipp", "-o", "out.csv")
        self.assertNotEqual(run.returncode, 0)
        self.assertEqual(run.stderr.count("tipp: "), 1, run.stderr)
        self.assertIn("000008.vtu", run.stderr)
        self.assertFalse((self.folder / "out.csv").exists())


unittest.main()
