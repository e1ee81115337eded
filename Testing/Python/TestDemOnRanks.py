# SPDX-License-Identifier: BSD-3-Clause
"""The command `tipp dem` under mpirun: TestDemOnRanks.py MPIEXEC TIPP"""
import json
import os
import pathlib
import random
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

MPIEXEC, TIPP = sys.argv[1:3]


class DemOnRanks(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def make_points(self, count):
        numbers = random.Random(1)
        with open(self.folder / "points.csv", "w", encoding="ascii") as file:
            file.write("x,y,z,intensity\n")
            for i in range(count):
                # Some points have equal positions, and some are centres of pixels.
                x, y = (numbers.randrange(4000) / 40 for _ in range(2))
                file.write(f"{x},{y},{(x - y) ** 2 / 50},{i % 255}\n")

    @staticmethod
    def launcher(ranks):
        return [MPIEXEC, "--oversubscribe", "--bind-to", "none", "-n", str(ranks)] if ranks > 1 else []

    def command(self, ranks, output, *arguments):
        return [*self.launcher(ranks), TIPP, "dem", "points.csv", "-o", output, "--resolution", "0.25", "--threads", "1", "--attributes",
                "elevation,intensity,slope", "--duplicates", "mean", *arguments]

    def make(self, ranks, output, *arguments):
        run = subprocess.run(self.command(ranks, output, *arguments), cwd=self.folder, capture_output=True, text=True,
                             timeout=250)
        self.assertEqual(run.returncode, 0, run.stderr)
        return (self.folder / output).read_bytes()

    def test_every_number_of_ranks_gives_the_same_bytes(self):
        self.make_points(60000)
        alone = self.make(1, "alone.npy")
        for ranks in (2, 3):
            self.assertEqual(self.make(ranks, "shared.npy", "--memory", "2M", "--stats", "run.json"), alone)
            figures = json.loads((self.folder / "run.json").read_text())
            self.assertEqual(figures["ranks"], ranks)
        self.assertEqual(sorted(os.listdir(self.folder)), ["alone.npy", "points.csv", "run.json", "shared.npy"])

    def test_breaklines_and_a_boundary_give_the_same_bytes(self):
        self.make_points(60000)
        numbers = random.Random(2)
        with open(self.folder / "lines.csv", "w", encoding="ascii") as file:
            file.write("x1,y1,z1,x2,y2,z2\n")
            for i in range(30):
                corners = [f"{numbers.randrange(800) / 8},{numbers.randrange(800) / 8},{'' if i % 3 else i}" for _ in range(2)]
                file.write(",".join(corners) + "\n")
        (self.folder / "ring.csv").write_text("x1,y1,x2,y2\n3,4,93.5,5\n93.5,5,97,96\n97,96,3,4\n")
        constraints = ("--breaklines", "lines.csv", "--boundary", "ring.csv", "--max-edge", "30")
        alone = self.make(1, "alone.npy", *constraints)
        self.assertNotEqual(alone, self.make(1, "free.npy"))
        for ranks in (2, 3):
            self.assertEqual(self.make(ranks, "shared.npy", "--memory", "2M", *constraints), alone)

    def test_points_that_are_left_out_are_counted_over_all_ranks(self):
        header = bytearray(227)
        header[:4] = b"LASF"
        header[24:26] = 1, 2
        struct.pack_into("<HII", header, 94, 227, 227, 0)
        struct.pack_into("<BHI", header, 104, 0, 20, 50000)
        struct.pack_into("<3d", header, 131, 0.01, 0.01, 0.01)
        numbers = random.Random(3)
        with open(self.folder / "points.las", "wb") as file:
            file.write(header)
            for i in range(50000):
                place = [numbers.randrange(10000) for _ in range(3)]
                file.write(struct.pack("<3iHBBbBH", *place, i % 200, 9, 2 + i % 5, 0, 0, 0))
        alone = [TIPP, "dem", "points.las", "-o", "dem.npy", "--resolution", "1", "--class", "2,3"]
        outputs = []
        for command in (alone, [*alone, "--memory", "4M"], [*self.launcher(2), *alone, "--memory", "4M"]):
            run = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, timeout=250)
            self.assertEqual(run.returncode, 0, run.stderr)
            outputs.append([line for line in (run.stdout + run.stderr).splitlines() if "30000" in line])
        self.assertEqual(len(outputs[0]), 1)
        self.assertEqual(outputs, outputs[:1] * 3)

    def test_ranks_need_no_limit_of_memory(self):
        self.make_points(3000)
        self.assertEqual(self.make(2, "shared.npy"), self.make(1, "alone.npy"))

    def test_killed_runs_are_resumed(self):
        self.make_points(60000)
        (self.folder / "lines.csv").write_text("x1,y1,x2,y2\n5,5,90,93\n7,80,88.1,12\n")
        alone = self.make(1, "alone.npy", "--breaklines", "lines.csv")
        arguments = ("--memory", "2M", "--resume", "--breaklines", "lines.csv")
        for number in range(6):
            # The run has its own session, all processes of which are killed.
            run = subprocess.Popen(self.command(2 + number % 2, "shared.npy", *arguments), cwd=self.folder,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
            time.sleep(0.5 + 0.1 * number)
            try:
                os.killpg(run.pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
            run.wait()
        for _ in range(100):
            run = subprocess.run(self.command(3, "shared.npy", *arguments), cwd=self.folder, capture_output=True, text=True,
                                 timeout=250)
            if "another process" not in run.stderr:
                break
            time.sleep(0.1)  # mpirun's children notice its end a little later
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual((self.folder / "shared.npy").read_bytes(), alone)

    def test_a_failure_is_one_sentence(self):
        self.make_points(100)
        run = subprocess.run(self.command(2, "shared.npy", "--attributes", "colour"), cwd=self.folder, capture_output=True,
                             text=True, timeout=250)
        self.assertEqual(run.returncode, 1, run.stderr)
        complaints = [line for line in run.stderr.splitlines() if line.startswith("tipp:")]
        self.assertEqual(len(complaints), 1, run.stderr)
        self.assertIn("no column 'colour'", complaints[0])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
