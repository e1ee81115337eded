# SPDX-License-Identifier: BSD-3-Clause
"""Every command under mpirun, and signals to one rank: TestCommandsOnRanks.py MPIEXEC TIPP HANG_AT_CALL"""
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_HEXAHEDRON, VTK_TETRA, VTK_TRIANGLE, vtkUnstructuredGrid
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

MPIEXEC, TIPP, HANG_AT_CALL = sys.argv[1:4]


def on_ranks(ranks, *arguments):
    launcher = [MPIEXEC, "--oversubscribe", "--bind-to", "none", "-n", str(ranks)] if ranks > 1 else []
    return [*launcher, TIPP, *map(str, arguments)]


def rank_process(mpirun, rank):
    """The process of the given rank, a child of mpirun."""
    for entry in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            parent = int((entry / "stat").read_text().rpartition(")")[2].split()[1])
            environment = (entry / "environ").read_bytes().split(b"\0")
        except OSError:
            continue
        if parent == mpirun and f"OMPI_COMM_WORLD_RANK={rank}".encode() in environment:
            return int(entry.name)
    raise AssertionError(f"no rank {rank}")


class Commands(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_tipp(self, ranks, *arguments):
        return subprocess.run(on_ranks(ranks, *arguments), cwd=self.folder, capture_output=True, text=True,
                              timeout=250)

    def make(self, *arguments):
        run = self.run_tipp(1, *arguments)
        self.assertEqual(run.returncode, 0, run.stderr)

    def make_points(self, count=5000):
        self.make("points", "--distribution", "uniform", "--count", count, "-o", "points.npy")

    def make_surface(self):
        """Makes mesh.vtu with a point array and a cell array, mesh.tipp and a flat mesh."""
        rng = np.random.default_rng(3)
        points = rng.random((4000, 3)) * (1, 1, 0)
        np.save(self.folder / "points.npy", points[:, :2])
        self.make("delaunay", "points.npy", "-o", "triangles.npy")
        triangles = np.load(self.folder / "triangles.npy")
        flat = self.folder / "flat"
        for name in ("point_data", "cell_data"):
            (flat / name).mkdir(parents=True, exist_ok=True)
        np.save(flat / "points.npy", points[:, :2])
        np.save(flat / "cells.npy", triangles.astype(np.int32))
        np.save(flat / "point_data" / "height.npy", np.sin(7 * points[:, 0]) * points[:, 1])
        np.save(flat / "cell_data" / "number.npy", np.arange(len(triangles), dtype=np.int32))
        self.write_grid(points, [(VTK_TRIANGLE, triangle) for triangle in triangles])
        self.make("partition", "flat", "-o", "mesh.tipp")

    def write_grid(self, points, cells):
        grid = vtkUnstructuredGrid()
        at = vtkPoints()
        at.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=1))
        grid.SetPoints(at)
        for kind, corners in cells:
            grid.InsertNextCell(kind, len(corners), [int(corner) for corner in corners])
        for data, name, values in ((grid.GetPointData(), "height", np.sin(7 * points[:, 0]) * points[:, 1]),
                                   (grid.GetCellData(), "number", np.arange(len(cells), dtype=np.int32))):
            array = numpy_to_vtk(values, deep=1)
            array.SetName(name)
            data.AddArray(array)
        writer = vtkXMLUnstructuredGridWriter()
        writer.SetFileName(str(self.folder / "mesh.vtu"))
        writer.SetInputData(grid)
        writer.Write()


class Resample(Commands):
    def expect_image_of_one_process(self, mesh, name, *options):
        self.make("resample", mesh, "-o", f"alone{name}", *options)
        alone = (self.folder / f"alone{name}").read_bytes()
        for ranks in (2, 3):
            run = self.run_tipp(ranks, "resample", mesh, "-o", f"shared{name}", *options)
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertEqual(len(run.stdout.splitlines()), 1, run.stdout)
            self.assertEqual((self.folder / f"shared{name}").read_bytes(), alone, f"{mesh} on {ranks} ranks")

    def test_surface_gives_the_image_of_one_process(self):
        self.make_surface()
        for mesh in ("mesh.vtu", "mesh.tipp", "flat"):
            self.expect_image_of_one_process(mesh, ".vti", "--dims", 60, 50, 1)
            self.expect_image_of_one_process(mesh, ".npy", "--dims", 40, 0, 0, "--arrays", "number")

    def test_range_in_one_ranks_pieces_gives_the_image_of_one_process(self):
        self.make_surface()
        for mesh in ("mesh.vtu", "mesh.tipp", "flat"):
            self.expect_image_of_one_process(mesh, ".npy", "--delta", 0.01, 0.01, 0, "--arrays", "height",
                                             "--bounds", 0.05, 0.2, 0.05, 0.2, 0, 0)

    def test_mixed_cells_give_the_image_of_one_process(self):
        """Two blocks of hexahedra, and a tetrahedron after triangles, which are ignored beside solid cells."""
        points = np.array([(x, y, z) for z in range(2) for y in range(2) for x in range(3)], dtype=float)
        cube = [0, 1, 4, 3, 6, 7, 10, 9]
        cells = [(VTK_TRIANGLE, (0, 1, 3))] * 9
        cells += [(VTK_HEXAHEDRON, cube), (VTK_TETRA, (1, 2, 4, 7))]
        self.write_grid(points, cells)
        self.expect_image_of_one_process("mesh.vtu", ".vti", "--dims", 9, 7, 5)

    def test_mesh_that_is_missing_is_one_sentence(self):
        run = self.run_tipp(3, "resample", "none.vtu", "-o", "out.vti", "--dims", 9, 9, 1)
        self.assertEqual(run.returncode, 1)
        self.assertEqual(len([line for line in run.stderr.splitlines() if line.startswith("tipp:")]), 1, run.stderr)
        self.assertEqual(os.listdir(self.folder), [])

    def test_array_that_is_missing_is_one_sentence(self):
        self.make_surface()
        for mesh in ("mesh.vtu", "mesh.tipp"):
            run = self.run_tipp(3, "resample", mesh, "-o", "out.vti", "--dims", 9, 9, 1, "--arrays", "none")
            self.assertEqual(run.returncode, 1)
            self.assertEqual(run.stderr.count("has no array 'none'"), 1, run.stderr)
            self.assertFalse((self.folder / "out.vti").exists())


class Remap(Commands):
    """tipp remap shares the cells of the result."""

    def setUp(self):
        super().setUp()
        self.make_surface()
        self.make("points", "--distribution", "uniform", "--count", 700, "--seed", 5, "-o", "few.npy")
        self.make("delaunay", "few.npy", "-o", "coarse.vtu")

    def test_file_is_that_of_one_process(self):
        for source in ("mesh.vtu", "mesh.tipp"):
            for target in ("coarse.vtu", "mesh.vtu"):
                self.make("remap", source, "--to", target, "-o", "one.vtu", "--memory", "100K")
                for ranks in (2, 3, 5):
                    run = self.run_tipp(ranks, "remap", source, "--to", target, "-o", "shared.vtu", "--memory", "100K")
                    self.assertEqual((run.returncode, len(run.stdout.splitlines())), (0, 1), run.stderr)
                    self.assertEqual((self.folder / "shared.vtu").read_bytes(), (self.folder / "one.vtu").read_bytes(),
                                     f"{source} to {target} on {ranks} ranks")

    def test_more_ranks_than_cells_work(self):
        self.write_grid(np.array([(0.2, 0.2, 0), (0.9, 0.2, 0), (0.2, 0.9, 0)]), [(VTK_TRIANGLE, (0, 1, 2))])
        (self.folder / "mesh.vtu").rename(self.folder / "one_cell.vtu")
        for ranks in (1, 3):
            run = self.run_tipp(ranks, "remap", "coarse.vtu", "--to", "one_cell.vtu", "-o", f"{ranks}.vtu")
            self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual((self.folder / "1.vtu").read_bytes(), (self.folder / "3.vtu").read_bytes())

    def test_array_that_is_missing_is_one_sentence(self):
        run = self.run_tipp(3, "remap", "mesh.vtu", "--to", "coarse.vtu", "-o", "out.vtu", "--arrays", "none")
        self.assertEqual(run.returncode, 1)
        self.assertEqual(run.stderr.count("has no array of numbers 'none'"), 1, run.stderr)
        self.assertFalse((self.folder / "out.vtu").exists())


class FirstRankAlone(Commands):
    """Commands that cannot be distributed run on one rank only."""

    def expect_once(self, *arguments):
        alone = self.run_tipp(1, *arguments)
        run = self.run_tipp(3, *arguments)
        self.assertEqual(run.returncode, alone.returncode, run.stderr)
        self.assertEqual(run.stdout, alone.stdout)
        return run

    def test_points_are_written_once(self):
        self.expect_once("points", "--distribution", "uniform", "--count", 1000, "-o", "points.npy")
        self.assertEqual(os.listdir(self.folder), ["points.npy"])

    def test_mesh_is_flattened_once(self):
        self.make_surface()
        run = self.run_tipp(3, "flatten", "mesh.vtu", "-o", "again")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(len(run.stdout.splitlines()), 1, run.stdout)

    def test_lines_are_meshed_once(self):
        (self.folder / "pond.poly").write_text("4 2 0 0\n1 0 0\n2 4 0\n3 4 4\n4 0 4\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n")
        self.make("mesh", "pond.poly", "-o", "one.vtu", "--max-area", "0.1")
        run = self.run_tipp(3, "mesh", "pond.poly", "-o", "pond.vtu", "--max-area", "0.1")
        self.assertEqual((run.returncode, run.stdout.count("triangles in")), (0, 1), run.stderr)
        self.assertEqual((self.folder / "pond.vtu").read_bytes(), (self.folder / "one.vtu").read_bytes())

    def test_mesh_is_checked_once(self):
        self.make_surface()
        self.expect_once("check", "points.npy", "triangles.npy")

    def test_points_are_described_once(self):
        self.make_surface()
        self.expect_once("info", "points.npy")

    def test_volumes_are_printed_once(self):
        self.make_surface()
        self.assertEqual(self.expect_once("volume", "mesh.vtu", "mesh.tipp").returncode, 0)

    def test_devices_are_listed_once(self):
        self.expect_once("devices")

    def test_wrong_usage_is_reported_once(self):
        run = self.run_tipp(3, "points", "--count", "many")
        self.assertEqual(run.returncode, 2)
        self.assertEqual(run.stderr.count("see 'tipp points --help'"), 1, run.stderr)


class SignalToOneRank(Commands):
    """A rank hangs in a call that reads or writes a file, so that only the signal can end the run."""

    def hang(self, call, rank, *arguments):
        """Starts the run and waits until it hangs. Returns None if it ended before that call."""
        mark = self.folder / "mark"
        mark.unlink(missing_ok=True)
        environment = dict(os.environ, TIPP_HANG_AT=str(call), TIPP_HANG_MARK=str(mark), TIPP_HANG_RANK=str(rank))
        command = on_ranks(2, *arguments)
        at = command.index(TIPP)
        # Only the rank must hang, not mpirun.
        command = [*command[:at], "env", f"LD_PRELOAD={HANG_AT_CALL}", *command[at:]]
        run = subprocess.Popen(command, cwd=self.folder, env=environment, text=True, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE)
        while run.poll() is None and not mark.exists():
            time.sleep(0.01)
        hangs = mark.exists()
        mark.unlink(missing_ok=True)
        if not hangs:
            run.communicate()
            return None
        return run

    def end(self, run, rank, number):
        os.kill(rank_process(run.pid, rank), number)
        try:
            return run.communicate(timeout=100)
        except subprocess.TimeoutExpired:
            run.kill()
            raise

    def hidden(self):
        return sorted(name for name in os.listdir(self.folder) if name.startswith("."))

    def expect_clear_ends(self, *arguments, keeps=()):
        output = arguments[arguments.index("-o") + 1]
        run = self.run_tipp(1, *arguments)
        self.assertEqual(run.returncode, 0, run.stderr)
        subprocess.run(["mv", output, "expected"], cwd=self.folder, check=True)
        ended = 0
        for call in (1, 4, 12, 40):
            for hung, told, number in ((0, 1, signal.SIGINT), (1, 0, signal.SIGINT), (1, 1, signal.SIGKILL)):
                run = self.hang(call, hung, *arguments)
                if run is None:
                    continue
                ended += 1
                out, err = self.end(run, told, number)
                what = f"call {call}, rank {hung} hung, {number.name} to rank {told}: {err}"
                self.assertEqual(run.returncode, {signal.SIGINT: 130, signal.SIGKILL: 137}[number], what)
                self.assertIn(self.hidden(), ([], list(keeps)), what)
                self.assertLessEqual(len([line for line in err.splitlines() if line.startswith("tipp:")]), 1, what)
        self.assertGreater(ended, 3)
        more = ["--resume"] if keeps else []
        subprocess.run(["rm", "-rf", output], cwd=self.folder, check=True)
        run = subprocess.run(on_ranks(2, *arguments, *more), cwd=self.folder, capture_output=True, text=True,
                             timeout=250)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(subprocess.run(["diff", "-r", output, "expected"], cwd=self.folder).returncode, 0)
        self.assertEqual(self.hidden(), [])

    def test_ends_partition_on_all(self):
        self.make_surface()
        self.expect_clear_ends("partition", "flat", "-o", "out.tipp", "--tiling", "grid:2x2")

    def test_ends_resample_on_all(self):
        self.make_surface()
        self.expect_clear_ends("resample", "mesh.tipp", "-o", "out.vti", "--dims", 30, 30, 1)

    def test_ends_delaunay_out_of_core_on_all(self):
        self.make_points(30000)
        self.expect_clear_ends("delaunay", "points.npy", "-o", "out.tipp", "--partitions", "2x2",
                               keeps=[".out.tipp.part"])

    def test_ends_delaunay_on_all(self):
        self.make_points()
        for call in (1, 4):
            for number, code in ((signal.SIGINT, 130), (signal.SIGKILL, 137)):
                run = self.hang(call, 0, "delaunay", "points.npy", "-o", "out.npy")
                if run is not None:
                    _, err = self.end(run, 1, number)
                    self.assertEqual(run.returncode, code, err)
                    self.assertEqual(sorted(os.listdir(self.folder)), ["points.npy"], err)


class Launcher(Commands):
    def test_rank_ends_when_its_launcher_is_killed(self):
        # The rank waits for input that is never written. MPI cannot notice anything there.
        read, write = os.pipe()
        launcher = subprocess.Popen(
            ["sh", "-c", f'"$0" delaunay - -o "$1" <&{read} & echo $!; exec sleep 1000', TIPP, str(self.folder / "t.npy")],
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, pass_fds=[read], env=dict(os.environ, PMI_RANK="0"),
            text=True)
        rank = pathlib.Path("/proc") / launcher.stdout.readline().strip()
        while len(list((rank / "task").iterdir())) < 2:  # signals are handled by a second thread
            time.sleep(0.01)
        launcher.kill()
        launcher.wait()

        def has_ended():
            try:
                return (rank / "stat").read_text().rpartition(")")[2].split()[0] == "Z"
            except OSError:
                return True

        limit = time.monotonic() + 60
        while not has_ended() and time.monotonic() < limit:
            time.sleep(0.05)
        ended = has_ended()
        if not ended:
            os.kill(int(rank.name), signal.SIGKILL)
        launcher.stdout.close()
        os.close(read)
        os.close(write)
        self.assertTrue(ended)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[4:])
