# SPDX-License-Identifier: BSD-3-Clause
"""The command `tipp delaunay` with a .tipp output under mpirun: TestTippOutOfCoreOnRanks.py MPIEXEC TIPP"""
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

MPIEXEC, TIPP = sys.argv[1:3]


class OutOfCoreOnRanks(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.made = self.folder / "mesh.tipp"

    def command(self, ranks, *arguments):
        launcher = [MPIEXEC, "--oversubscribe", "--bind-to", "none", "-n", str(ranks)] if ranks > 1 else []
        return [*launcher, TIPP, "delaunay", *arguments, "-o", "mesh.tipp", "--threads", "1"]

    def run_tipp(self, ranks, *arguments):
        return subprocess.run(self.command(ranks, *arguments), cwd=self.folder, capture_output=True, text=True,
                              timeout=250)

    def files(self):
        return {str(f.relative_to(self.made)): f.read_bytes() for f in self.made.rglob("*") if f.is_file()}

    def make(self, ranks, *arguments):
        run = self.run_tipp(ranks, *arguments)
        self.assertEqual(run.returncode, 0, run.stderr)
        files = self.files()
        subprocess.run(["rm", "-r", "mesh.tipp"], cwd=self.folder, check=True)
        return files

    def make_points(self, distribution, count):
        subprocess.run([TIPP, "points", "--distribution", distribution, "--count", str(count), "--seed", "5",
                        "-o", "points.npy"], cwd=self.folder, check=True, capture_output=True)

    def test_every_number_of_ranks_gives_the_same_bytes(self):
        self.make_points("coast", 60000)
        alone = self.make(1, "points.npy", "--memory", "1M")
        self.assertGreater(len(alone), 10)
        for ranks in (2, 3):
            self.assertEqual(self.make(ranks, "points.npy", "--memory", "1M"), alone)

    def test_any_number_of_ranks_resumes_a_killed_run(self):
        self.make_points("coast", 200000)
        arguments = ("points.npy", "--memory", "2M", "--resume")
        alone = self.make(1, *arguments)
        kills = 0
        for number in range(12):
            # The run has its own session, all processes of which are killed.
            run = subprocess.Popen(self.command(1 + number % 3, *arguments), cwd=self.folder,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                   start_new_session=True)
            time.sleep(0.25 + 0.05 * number)
            kills += run.poll() is None
            try:
                os.killpg(run.pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
            run.wait()
        self.assertGreater(kills, 3)
        self.wait_for_the_ranks()
        self.assertEqual(self.make(2, *arguments), alone)
        self.assertEqual(sorted(os.listdir(self.folder)), ["points.npy"])

    def wait_for_the_ranks(self):
        """Waits, since mpirun's children notice its end a little later."""
        for _ in range(1000):
            run = self.run_tipp(1, "points.npy", "--memory", "2M")
            if "another process" not in run.stderr:
                return
            time.sleep(0.1)

    def test_each_process_keeps_to_the_memory_limit(self):
        run = self.run_tipp(3, "uniform:3000000", "--memory", "32M", "--sink", "count", "--stats", "run.json")
        self.assertEqual(run.returncode, 0, run.stderr)
        memory = json.loads((self.folder / "run.json").read_text())["rank_memory_bytes"]
        self.assertEqual(len(memory), 3)
        # The limit for one process, plus what MPI needs.
        self.assertLess(max(memory), (32 << 20) + 70e6)

    def test_a_full_disk_is_one_sentence_and_the_run_is_resumed(self):
        self.make_points("uniform", 400000)
        arguments = ("points.npy", "--partitions", "2x1")
        alone = self.make(1, *arguments)
        # A limit on the size of files simulates a full disk: spilled points fit, but no piece.
        small = ["sh", "-c", 'trap "" XFSZ; ulimit -f 28000; exec "$@"', "sh"]
        command = self.command(2, *arguments)
        at = command.index(TIPP)
        # Open MPI's shared memory is a file too, and would exceed the limit.
        network = {**os.environ, "OMPI_MCA_btl": "self,tcp", "OMPI_MCA_btl_tcp_if_include": "lo"}
        run = subprocess.run([*command[:at], *small, *command[at:]], cwd=self.folder, capture_output=True, text=True,
                             timeout=250, env=network)
        self.assertEqual(run.returncode, 1, run.stderr)
        complaints = [line for line in run.stderr.splitlines() if line.startswith("tipp:")]
        self.assertEqual(len(complaints), 1, run.stderr)
        self.assertRegex(complaints[0], "^tipp: rank [01]: .*cannot be written")
        self.assertFalse(self.made.exists())
        self.assertEqual(self.make(3, *arguments, "--resume"), alone)

    def test_an_interrupted_run_is_resumed(self):
        arguments = ("uniform:3000000", "--memory", "16M", "--sink", "count")
        alone = self.run_tipp(1, *arguments)
        run = subprocess.Popen(self.command(2, *arguments), cwd=self.folder, stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
        while run.poll() is None and not (self.folder / ".mesh.tipp.part" / ".plan").exists():
            time.sleep(0.01)
        run.send_signal(signal.SIGINT)
        run.wait()
        resumed = self.run_tipp(3, *arguments, "--resume")
        self.assertEqual(resumed.returncode, 0, resumed.stderr)
        self.assertEqual(resumed.stdout.split("checksum")[1], alone.stdout.split("checksum")[1])

    def test_options_of_runs_in_memory_are_refused(self):
        run = self.run_tipp(1, "uniform:1000", "--masters", "multi")
        self.assertEqual(run.returncode, 2)
        self.assertIn("cannot be combined with an output named .tipp", run.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
