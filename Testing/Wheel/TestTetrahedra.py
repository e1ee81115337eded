# SPDX-License-Identifier: BSD-3-Clause
"""Tetrahedra in the wheel without VTK: in memory, out of core, stored, queried and sampled."""
import importlib.util
import os
import signal
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import tipp


def volumes(points, cells):
    corners = points[cells]
    return np.linalg.det(corners[:, 1:] - corners[:, :1]) / 6


def sorted_rows(cells):
    rows = np.sort(cells, axis=1)
    return rows[np.lexsort(rows.T)]


class Tetrahedra(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if importlib.util.find_spec("vtkmodules"):
            raise unittest.SkipTest("VTK is installed here")
        corners = np.stack(np.meshgrid([0.0, 1], [0.0, 1], [0.0, 1]), axis=-1).reshape(-1, 3)
        cls.points = np.vstack([np.random.default_rng(3).random((3000, 3)), corners])
        cls.values = cls.points @ [1.0, 2, 3]
        cls.mesh = tipp.delaunay_3d(cls.points, point_data={"v": cls.values}, neighbors=True)

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def test_they_fill_the_hull(self):
        found = volumes(self.points, self.mesh.cells)
        self.assertGreater(found.min(), 0)
        self.assertAlmostEqual(1, found.sum())

    def test_neighbours_share_three_corners(self):
        neighbors = self.mesh.cell_data["NeighborIds"]
        for cell in range(0, len(neighbors), 97):
            for corner, other in zip(self.mesh.cells[cell], neighbors[cell]):
                if other >= 0:
                    self.assertEqual(set(self.mesh.cells[cell]) - {corner},
                                     set(self.mesh.cells[cell]) & set(self.mesh.cells[other]))

    def test_an_alpha_shape_has_cells_of_every_kind(self):
        shape = tipp.delaunay_3d(self.points[:300], alpha=0.1)
        self.assertEqual((4, 3, 2, 1), tuple(c.shape[1] for c in (shape.cells, shape.triangles, shape.lines, shape.vertices)))
        used = np.unique(np.concatenate([c.ravel() for c in (shape.cells, shape.triangles, shape.lines, shape.vertices)]))
        np.testing.assert_array_equal(np.arange(300), used)

    def test_storing_an_alpha_shape_warns_of_its_other_cells(self):
        shape = tipp.delaunay_3d(self.points[:300], alpha=0.1)
        count = len(shape.triangles) + len(shape.lines) + len(shape.vertices)
        with self.assertWarnsRegex(RuntimeWarning, f"{count} cells of fewer dimensions are left out"):
            tipp.write(shape, self.path("mesh.tipp"))
        self.assertEqual(len(shape.cells), len(tipp.read(self.path("mesh.tipp")).cells))

    def test_a_plane_makes_triangles_and_a_warning(self):
        with self.assertWarnsRegex(RuntimeWarning, "in one plane, so the cells are triangles"):
            mesh = tipp.delaunay_3d(self.points[:40] * [1, 1, 0])
        self.assertEqual(3, mesh.cells.shape[1])

    def test_points_of_a_mesh_keep_their_data(self):
        again = tipp.delaunay_3d(tipp.Mesh(self.points, np.zeros((0, 4), int), {"v": self.values}))
        np.testing.assert_array_equal(self.mesh.cells, again.cells)
        np.testing.assert_array_equal(self.values, again.point_data["v"])

    def test_a_progress_function_can_stop_the_run(self):
        with self.assertRaisesRegex(RuntimeError, "progress callback stopped the run"):
            tipp.delaunay_3d(np.random.default_rng(1).random((100_000, 3)), progress_bar=lambda done: False)

    def test_queries_find_cells_and_linear_values(self):
        queries = np.random.default_rng(4).random((500, 3))
        with tipp.open(self.mesh) as opened:
            np.testing.assert_allclose(opened.interpolate(queries, "v"), queries @ [1.0, 2, 3])
            cells = opened.locate(queries)
        self.assertEqual(500, len(np.asarray(cells[0] if isinstance(cells, tuple) else cells)))

    def test_resampling_reproduces_linear_values(self):
        image = tipp.resample(self.mesh, (0.1, 0.9, 0.1, 0.9, 0.1, 0.9), (5, 4, 3))
        z, y, x = np.meshgrid(*[np.linspace(0.1, 0.9, n) for n in (3, 4, 5)], indexing="ij")
        np.testing.assert_allclose(tipp.as_array(image, "v"), x + 2 * y + 3 * z)

    def test_a_stored_mesh_is_read_whole_and_by_ranges(self):
        path = self.path("mesh.tipp")
        tipp.write(self.mesh, path, tiling="octree:2000")
        whole = tipp.read(path)
        self.assertEqual(self.mesh.cells.shape, whole.cells.shape)
        order = whole.point_data["GlobalPointIds"]
        np.testing.assert_array_equal(sorted_rows(self.mesh.cells), sorted_rows(order[whole.cells]))
        part = tipp.read(path, bounds=(0, 0.2, 0, 0.2, 0, 0.2))
        self.assertTrue(0 < len(part.cells) < len(whole.cells) / 10)
        with tipp.open(path) as stored, tipp.open(self.mesh) as memory:
            queries = self.points * 0.9
            np.testing.assert_array_equal(memory.interpolate(queries, "v"), stored.interpolate(queries, "v"))

    def test_out_of_core_they_are_those_in_memory(self):
        np.save(self.path("points.npy"), self.points)
        figures = tipp.delaunay_file(self.path("points.npy"), self.path("mesh.tipp"), dimension=3, memory="16M", neighbors=True)
        self.assertEqual((len(self.points), len(self.mesh.cells), 0, 0),
                         tuple(figures[name] for name in ("points", "tetrahedra", "duplicates", "rejected")))
        mesh = tipp.read(self.path("mesh.tipp"))
        np.testing.assert_array_equal(sorted_rows(self.mesh.cells), sorted_rows(mesh.point_data["GlobalPointIds"][mesh.cells]))
        self.assertEqual((len(mesh.cells), 4), mesh.cell_data["NeighborIds"].shape)

    def test_columns_name_the_three_coordinates(self):
        np.savetxt(self.path("points.csv"), self.points[:, [2, 0, 1]], delimiter=",", header="c,a,b", comments="", fmt="%.17g")
        tipp.delaunay_file(self.path("points.csv"), self.path("mesh.tipp"), dimension=3, columns=("a", "b", "c"))
        mesh = tipp.read(self.path("mesh.tipp"))
        np.testing.assert_array_equal(sorted_rows(self.mesh.cells), sorted_rows(mesh.point_data["GlobalPointIds"][mesh.cells]))

    def test_points_that_are_not_finite_are_left_out_of_files_and_counted(self):
        points = self.points.copy()
        points[7] = np.nan
        np.save(self.path("points.npy"), points)
        with self.assertWarnsRegex(RuntimeWarning, "left out"):
            figures = tipp.delaunay_file(self.path("points.npy"), self.path("mesh.tipp"), dimension=3)
        self.assertEqual(1, figures["rejected"])

    def test_a_stopped_run_out_of_core_is_resumed(self):
        np.save(self.path("points.npy"), np.random.default_rng(5).random((60_000, 3)))
        arguments = (self.path("points.npy"), self.path("mesh.tipp"))
        with self.assertRaisesRegex(RuntimeError, "progress callback stopped the run"):
            tipp.delaunay_file(*arguments, dimension=3, memory="16M", progress_bar=lambda done: done < 0.5)
        self.assertFalse(os.path.exists(arguments[1]))
        figures = tipp.delaunay_file(*arguments, dimension=3, memory="16M", resume=True)
        self.assertEqual((1, 60_000), (figures["resumed"], figures["points"]))
        self.assertEqual(len(tipp.delaunay_3d(np.load(arguments[0])).cells), figures["tetrahedra"])

    def test_ctrl_c_stops_a_run_out_of_core(self):
        code = ("import numpy, os, signal, sys, tipp\n"
                "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
                "numpy.save(sys.argv[1] + '/p.npy', numpy.random.default_rng(1).random((100_000, 3)))\n"
                "def send(done):\n    os.kill(os.getpid(), signal.SIGINT)\n"
                "tipp.delaunay_file(sys.argv[1] + '/p.npy', sys.argv[1] + '/m.tipp', dimension=3, progress_bar=send)\n")
        run = subprocess.run([sys.executable, "-c", code, self.folder.name], capture_output=True, text=True, timeout=120)
        self.assertEqual(("KeyboardInterrupt", -signal.SIGINT), (run.stderr.splitlines()[-1], run.returncode))

    def test_points_without_a_third_coordinate_and_options_of_the_plane_are_refused(self):
        np.save(self.path("points.npy"), self.points[:, :2])
        with self.assertRaisesRegex(RuntimeError, "no column z"):
            tipp.delaunay_file(self.path("points.npy"), self.path("mesh.tipp"), dimension=3)
        for name, value in (("max_edge", 1.0), ("partitions", (2, 2)), ("boundary", "x.csv"), ("count_only", True)):
            with self.assertRaisesRegex(ValueError, f"{name} needs dimension=2"):
                tipp.delaunay_file(self.path("points.npy"), self.path("mesh.tipp"), dimension=3, **{name: value})


if __name__ == "__main__":
    unittest.main()
