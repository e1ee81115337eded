# SPDX-License-Identifier: BSD-3-Clause
"""The wheel in an environment with only NumPy."""
import importlib.util
import pathlib
import tempfile
import unittest

import numpy as np

import tipp


def random_points(count, columns=2, kind=np.float64):
    return np.random.default_rng(7).random((count, columns)).astype(kind)


class WithoutVtk(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if importlib.util.find_spec("vtkmodules"):
            raise unittest.SkipTest("VTK is installed here")

    def setUp(self):
        self.points = np.vstack([random_points(3000), [[0, 0], [1, 0], [0, 1], [1, 1]]])
        self.height = 2 * self.points[:, 0] - self.points[:, 1]
        self.mesh = tipp.delaunay_2d(self.points, point_data={"h": self.height})

    def test_triangles_cover_the_hull(self):
        a, b, c = self.points[tipp.delaunay(self.points)].transpose(1, 0, 2)
        areas = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
        self.assertTrue((areas > 0).all())
        self.assertAlmostEqual(1.0, areas.sum() / 2, places=12)

    def test_columns_of_a_table_are_found_by_name(self):
        class Frame(dict):
            columns = property(list)

        x, y = self.points.T
        ids = np.arange(len(x))
        for table in (Frame(id=ids, X=x, Y=y), Frame(name=ids, lat=y, lon=x)):
            np.testing.assert_array_equal(self.points, tipp.delaunay_2d(table).points[:, :2])
            np.testing.assert_array_equal(tipp.Delaunay(self.points).find_simplex(self.points),
                                          tipp.Delaunay(table).find_simplex(table))
        with self.assertRaisesRegex(ValueError, "has the columns id, a, b, and their names do not tell x and y; give"):
            tipp.delaunay(Frame(id=ids, a=x, b=y))

    def test_a_mesh_has_the_points_and_their_data(self):
        self.assertIsInstance(self.mesh, tipp.Mesh)
        np.testing.assert_array_equal(self.points, self.mesh.points[:, :2])
        np.testing.assert_array_equal(self.height, tipp.as_array(self.mesh, "h"))

    def test_a_mesh_is_resampled(self):
        image = tipp.resample(self.mesh, dimensions=(5, 4))
        x, y = np.meshgrid(np.linspace(0, 1, 5), np.linspace(0, 1, 4))
        np.testing.assert_allclose(tipp.as_array(image, "h"), 2 * x - y, atol=1e-12)
        self.assertTrue(tipp.as_array(image, "vtkValidPointMask").all())

    def test_bounds_of_four_are_those_of_the_plane(self):
        image = tipp.resample(self.mesh, (0.25, 0.75, 0.5, 1.0), (3, 3))
        self.assertEqual((0.25, 0.5, 0.0), image.origin)
        self.assertEqual((3, 3), tipp.as_array(image, "h").shape)

    def test_a_mesh_is_written_and_a_range_of_it_read(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "mesh.tipp")
            tipp.write(self.mesh, path, tiling="grid:2x2")
            whole = tipp.read(path)
            self.assertEqual(len(self.mesh.cells), len(whole.cells))
            np.testing.assert_array_equal(self.height, tipp.as_array(whole, "h")[
                np.argsort(tipp.as_array(whole, "GlobalPointIds"))])
            part = tipp.read(path, bounds=(0, 0.2, 0, 0.2, 0, 0), point_arrays=[])
            self.assertTrue(0 < len(part.cells) < len(whole.cells) / 10)
            self.assertNotIn("h", part.point_data)
            with self.assertRaisesRegex(KeyError, "no point array 'w'"):
                tipp.read(path, point_arrays="w")

    def test_points_in_files_are_triangulated_out_of_core(self):
        with tempfile.TemporaryDirectory() as folder:
            name = pathlib.Path(folder, "points.npy")
            np.save(name, self.points)
            figures = tipp.delaunay_file(name, pathlib.Path(folder, "mesh.tipp"), memory="64M", neighbors=True)
            self.assertEqual(len(self.mesh.cells), figures["triangles"])
            mesh = tipp.read(pathlib.Path(folder, "mesh.tipp"))
            self.assertEqual((figures["triangles"], 3), mesh.cell_data["NeighborIds"].shape)

    def test_files_that_vtk_reads_are_refused_with_advice(self):
        with tempfile.TemporaryDirectory() as folder:
            name = pathlib.Path(folder, "points.ply")
            name.write_text("ply")
            with self.assertRaisesRegex(RuntimeError, "points.ply.*without VTK.*PyVista"):
                tipp.delaunay_file(name, pathlib.Path(folder, "mesh.tipp"))

    def test_alpha_leaves_lines_and_vertices(self):
        mesh = tipp.delaunay_2d(self.points[:200], alpha=0.05)
        self.assertTrue(0 < len(mesh.cells) < 390)
        self.assertEqual((2, 1), (mesh.lines.shape[1], mesh.vertices.shape[1]))

    def test_a_bounding_circle_adds_eight_points(self):
        self.assertEqual(len(self.points) + 8, len(tipp.delaunay_2d(self.points, bound=True).points))

    def test_the_warning_of_rejected_points_names_the_callers_file(self):
        points = self.points.copy()
        points[7] = np.nan
        with self.assertWarnsRegex(RuntimeWarning, "the first is point 7") as caught:
            tipp.delaunay(points)
        self.assertEqual(pathlib.Path(__file__).name, pathlib.Path(caught.filename).name)

    def test_cells_that_refer_to_no_point_are_refused(self):
        with self.assertRaisesRegex(RuntimeError, "refer to points from 0 to 9, but there are 3 points"):
            tipp.resample(tipp.Mesh(np.zeros((3, 3)), np.array([[0, 1, 9]])), dimensions=(2, 2))

    def test_arrays_of_too_few_values_are_refused_by_name(self):
        points, cells = self.mesh.points, self.mesh.cells
        for of_points, of_cells, words in (({"q": np.ones(2)}, {}, "2 values for 3004 points"),
                                           ({}, {"q": np.ones(5, np.uint8)}, f"5 values for {len(cells)} cells"),
                                           ({}, {"vtkGhostType": np.zeros(1, np.uint8)}, f"1 values for {len(cells)} cells")):
            mesh = tipp.Mesh(points, cells, of_points, of_cells)
            with tempfile.TemporaryDirectory() as folder:
                for use in (tipp.open, tipp.resample, lambda m: tipp.write(m, f"{folder}/mesh.tipp")):
                    with self.assertRaisesRegex(RuntimeError, f"array '(q|vtkGhostType)' has {words}"):
                        use(mesh)

    def test_arrays_of_every_type_and_byte_order_keep_their_values(self):
        numbers = np.arange(len(self.points)) % 100
        for kind in ("f2", "f4", ">f8", "i1", "u2", ">i2", "i4", ">u8", "?"):
            mesh = tipp.Mesh(self.mesh.points, self.mesh.cells, {"q": (numbers % (2 if kind == "?" else 100)).astype(kind)})
            with tipp.open(mesh) as opened:
                np.testing.assert_allclose(opened.interpolate(self.points[:50], "q"), mesh.point_data["q"][:50], atol=1e-9)

    def test_equal_meshes_are_equal(self):
        copy = tipp.Mesh(self.mesh.points.copy(), self.mesh.cells.copy(), {"h": self.height.copy()})
        self.assertTrue(self.mesh == copy)
        copy.point_data["h"][3] = np.nan
        self.assertTrue(self.mesh != copy)
        self.assertTrue(copy == tipp.Mesh(self.mesh.points, self.mesh.cells, {"h": copy.point_data["h"].copy()}))
        self.assertFalse(self.mesh == tipp.Mesh(self.mesh.points, self.mesh.cells))
        self.assertFalse(self.mesh == 3)
        self.assertTrue(tipp.resample(self.mesh, dimensions=(3, 3)) == tipp.resample(self.mesh, dimensions=(3, 3)))

    def test_a_device_that_no_name_matches_is_an_error(self):
        with self.assertRaisesRegex(RuntimeError, "no OpenCL device named 'intel'. TIPP was built without OpenCL"):
            tipp.resample(self.mesh, dimensions=(5, 4), device="opencl:intel")

    def test_the_warning_of_a_missing_device_names_the_build(self):
        with self.assertWarnsRegex(RuntimeWarning, "built without OpenCL.*OpenMP does it instead"):
            tipp.resample(self.mesh, dimensions=(5, 4), device="opencl")

    def test_several_ranks_are_refused(self):
        with self.assertRaisesRegex(RuntimeError, "built with MPI"):
            with tipp.ranks():
                pass

    def test_no_vtk_is_imported(self):
        import sys

        self.assertFalse([name for name in sys.modules if name.startswith("vtk")])


if __name__ == "__main__":
    unittest.main()
