# SPDX-License-Identifier: BSD-3-Clause
"""The wheel with PyVista, for both of its back ends: VTK and cvista."""
import importlib
import inspect
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import pyvista

import tipp
from tipp._vtkmodules import root, vtk_to_numpy, vtkCellArray, vtkPolyData, vtkUnstructuredGrid, vtkVersion


def terrain(count=2000):
    points = np.random.default_rng(2).random((count, 3))
    cloud = pyvista.PolyData(points)
    cloud["height"] = points[:, 0] + points[:, 1]
    return cloud


def implicit_array(count):
    """An array with the values 5, 7, 9 ... that VTK computes; None if this VTK has none."""
    try:
        array = getattr(importlib.import_module(f"{root()}.vtkCommonCore"), "vtkAffineTypeFloat64Array")()
        array.ConstructBackend(2.0, 5.0)
    except (AttributeError, TypeError):
        return None
    array.SetNumberOfTuples(count)
    array.SetName("implicit")
    return array


class PyVista(unittest.TestCase):
    def test_a_data_set_has_the_accessor_without_an_import_of_tipp(self):
        code = ("import numpy, pyvista; c = pyvista.PolyData(numpy.random.default_rng(1).random((500, 3)));"
                "print(c.tipp.delaunay_2d().n_cells > 900)")
        run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
        self.assertEqual("True", run.stdout.strip(), run.stderr)

    def test_a_call_on_arrays_imports_no_vtk(self):
        code = ("import numpy, sys, tipp; tipp.delaunay(numpy.random.default_rng(1).random((500, 2)));"
                "print([name for name in sys.modules if name.startswith(('vtk', 'cvista', 'pyvista'))])")
        run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
        self.assertEqual("[]", run.stdout.strip(), run.stderr)

    def test_a_pyvista_mesh_makes_a_pyvista_mesh_that_shares_its_points(self):
        cloud = terrain()
        mesh = cloud.tipp.delaunay_2d()
        self.assertIsInstance(mesh, pyvista.PolyData)
        self.assertTrue(np.shares_memory(cloud.points, mesh.points))
        np.testing.assert_array_equal(cloud["height"], mesh["height"])
        self.assertTrue(mesh.is_all_triangles)

    def test_triangles_are_those_of_pyvista_which_loses_some_at_the_hull(self):
        points = terrain(500).points
        points[:, 2] = 0
        cloud = pyvista.PolyData(points)
        mine, theirs = ({tuple(sorted(t)) for t in mesh.regular_faces.tolist()}
                        for mesh in (cloud.tipp.delaunay_2d(), cloud.delaunay_2d()))
        self.assertGreater(len(mine & theirs), 0.9 * len(mine))

    def test_inplace_changes_the_data_set(self):
        cloud = terrain()
        self.assertIs(cloud, cloud.tipp.delaunay_2d(inplace=True))
        self.assertGreater(cloud.n_cells, 3000)

    def test_methods_have_pyvistas_keywords_in_its_order(self):
        for name in ("delaunay_2d", "delaunay_3d"):
            mine, theirs = (list(inspect.signature(getattr(kind, name)).parameters) for kind in (
                type(terrain().tipp), pyvista.PolyData))
            self.assertEqual(theirs, mine[:len(theirs)])
        self.assertEqual(0, terrain(50).tipp.delaunay_2d(0, 0.01, offset=2).n_cells - terrain(50).tipp.delaunay_2d(
            tol=0, alpha=0.01).n_cells)

    def test_own_arrays_are_passed_on_request(self):
        mesh, asked = terrain().tipp.delaunay_2d(), terrain(20)
        asked["own"] = np.arange(20)
        self.assertIn("own", asked.tipp.sample(mesh).point_data)
        self.assertNotIn("own", asked.tipp.sample(mesh, pass_point_data=False).point_data)
        self.assertIn("own", asked.point_data)

    def test_edge_source_gives_edges(self):
        cloud = terrain(200)
        source = pyvista.PolyData(cloud.points, lines=[2, 3, 150, 3, 7, 8, 9])
        mesh = cloud.tipp.delaunay_2d(edge_source=source, marks="lines")
        ids = tipp.as_array(mesh, "ConstraintId")
        self.assertEqual({-1, 0, 1}, set(ids.tolist()))
        self.assertEqual(mesh.n_lines, int((ids >= 0).sum()))

    def test_an_edge_source_of_other_type_is_refused_in_one_sentence(self):
        with self.assertRaisesRegex(TypeError, "^edge_source is [^.]*[.]"):
            terrain().tipp.delaunay_2d(edge_source=[[0, 1]])

    def test_a_mesh_is_resampled_to_a_pyvista_image(self):
        image = terrain().tipp.delaunay_2d().tipp.resample_to_image(bounds=(0.2, 0.8, 0.2, 0.8), dimensions=(7, 7))
        self.assertIsInstance(image, pyvista.ImageData)
        x, y = np.meshgrid(np.linspace(0.2, 0.8, 7), np.linspace(0.2, 0.8, 7))
        np.testing.assert_allclose(tipp.as_array(image, "height"), x + y, atol=1e-12)

    def test_a_mesh_with_lines_and_vertices_is_used_as_its_triangles(self):
        points = np.c_[np.random.default_rng(2).random((2000, 2)), np.zeros(2000)]
        cloud = pyvista.PolyData(points)
        cloud["height"] = points[:, 0] + points[:, 1]
        asked = np.random.default_rng(3).random((50, 2)) * 0.8 + 0.1
        for options in ({"polygons": [[[0.1, 0.1], [0.9, 0.1], [0.5, 0.9]]], "marks": "lines"}, {"alpha": 0.05}):
            mesh = cloud.tipp.delaunay_2d(**options)
            self.assertGreater(mesh.n_lines, 0)
            mesh.cell_data["number"] = np.arange(mesh.n_cells)
            image = mesh.tipp.resample_to_image(bounds=(0.2, 0.8, 0.2, 0.8), dimensions=(7, 7))
            inside = tipp.as_array(image, "vtkValidPointMask") == 1
            x, y = np.meshgrid(np.linspace(0.2, 0.8, 7), np.linspace(0.2, 0.8, 7))
            np.testing.assert_allclose(tipp.as_array(image, "height")[inside], (x + y)[inside], atol=1e-12)
            with tipp.open(mesh) as opened:
                cells, values = opened.locate(asked)[0], opened.interpolate(asked, "number")
                found = cells >= 0
                self.assertTrue(found.any())
                np.testing.assert_array_equal(cells[found], values[found])  # ids are those of the data set's cells
                self.assertGreaterEqual(cells[found].min(), mesh.n_lines + mesh.n_verts)
                neighbors = opened.neighbors(cells[found])
                self.assertTrue(((neighbors == -1) | (neighbors >= mesh.n_lines + mesh.n_verts)).all())
            with tempfile.TemporaryDirectory() as folder:
                with self.assertWarnsRegex(RuntimeWarning, f"^{mesh.n_lines + mesh.n_verts} cells of fewer dimensions"):
                    mesh.tipp.save(f"{folder}/mesh.tipp")
                self.assertEqual(mesh.GetNumberOfPolys(), len(tipp.read(f"{folder}/mesh.tipp").cells))
            grid = mesh.cast_to_unstructured_grid()
            with tipp.open(grid) as opened:
                np.testing.assert_array_equal(cells, opened.locate(asked)[0])

    def test_ghost_cells_are_left_out_of_a_stored_mesh_with_a_warning(self):
        mesh = terrain().tipp.delaunay_2d()
        mesh.cell_data["vtkGhostType"] = (np.arange(mesh.n_cells) < 16).astype(np.uint8)
        with tempfile.TemporaryDirectory() as folder, self.assertWarnsRegex(RuntimeWarning, "^16 ghost cells are left out"):
            mesh.tipp.save(f"{folder}/mesh.tipp")

    @unittest.skipUnless(implicit_array(2), "this VTK has no implicit arrays")
    def test_arrays_that_compute_their_values_are_arrays_like_others(self):
        mesh = terrain(300).tipp.delaunay_2d()
        mesh.GetPointData().AddArray(implicit_array(300))
        image = tipp.resample(mesh, dimensions=(9, 9))
        np.testing.assert_allclose(tipp.as_array(mesh, "implicit"), 5 + 2 * np.arange(300))
        with tipp.open(mesh) as opened:
            at = np.asarray(mesh.points)[:20, :2]
            np.testing.assert_allclose(opened.interpolate(at, "implicit"), 5 + 2 * np.arange(20), atol=1e-9)
            np.testing.assert_allclose(opened.interpolate(at, "height"), mesh["height"][:20], atol=1e-9)
        self.assertIn("implicit", image.point_data)

    def test_a_data_set_samples_a_mesh_as_pyvista_does(self):
        points = terrain().points.copy()
        points[:, 2] = 0
        mesh = pyvista.PolyData(points).tipp.delaunay_2d()
        mesh["height"] = points[:, 0] + points[:, 1]
        asked = pyvista.Plane(center=(0.5, 0.5, 0), i_size=1.4, j_size=0.8, i_resolution=20, j_resolution=20)
        asked["own"] = np.arange(asked.n_points)
        mine, theirs = asked.tipp.sample(mesh), asked.sample(mesh)
        self.assertIsInstance(mine, pyvista.PolyData)
        self.assertIn("own", mine.point_data)
        self.assertNotIn("height", asked.point_data)
        inside = mine["vtkValidPointMask"] == 1
        self.assertTrue(inside.any() and not inside.all())
        both = inside & (theirs["vtkValidPointMask"] == 1)
        self.assertGreater(both.sum(), 0.95 * inside.sum())
        np.testing.assert_allclose(mine["height"][both], theirs["height"][both], atol=1e-6)
        np.testing.assert_array_equal(-7, asked.tipp.sample(mesh, arrays="height", null_value=-7)["height"][~inside])

    def test_every_storage_of_cells_is_sampled_alike(self):
        mesh = terrain(300).tipp.delaunay_2d()
        ids = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).astype(np.int64)
        expected = tipp.as_array(tipp.resample(mesh, dimensions=(9, 9)), "height")
        for convert in ("Use32BitStorage", "Use64BitStorage", "UseFixedSize32BitStorage", "UseFixedSize64BitStorage"):
            cells = vtkCellArray()
            if not hasattr(cells, convert):
                continue
            getattr(cells, convert)(*([3] if "Fixed" in convert else []))
            for triangle in ids.reshape(-1, 3).tolist():
                cells.InsertNextCell(3, triangle)
            copy = vtkPolyData()
            copy.SetPoints(mesh.GetPoints())
            copy.SetPolys(cells)
            copy.GetPointData().ShallowCopy(mesh.GetPointData())
            with self.subTest(convert, vtk=vtkVersion.GetVTKVersion()):
                np.testing.assert_array_equal(expected, tipp.as_array(tipp.resample(copy, dimensions=(9, 9)), "height"))

    def test_a_mesh_is_stored_and_read_again(self):
        with tempfile.TemporaryDirectory() as folder:
            mesh = terrain().tipp.delaunay_2d()
            mesh.tipp.save(f"{folder}/mesh.tipp")
            part = tipp.read(f"{folder}/mesh.tipp", bounds=(0, 0.5, 0, 0.5), return_type="vtk")
            self.assertIsInstance(part, vtkUnstructuredGrid)
            wrapped = pyvista.wrap(part)
            self.assertTrue(0 < wrapped.n_cells < mesh.n_cells)
            np.testing.assert_allclose(wrapped["height"], wrapped.points[:, :2].sum(axis=1), atol=1e-12)
            self.assertEqual(part.GetNumberOfCells(), tipp.as_array(part, "GlobalCellIds").size)

    def test_other_cells_are_refused_with_advice(self):
        with self.assertRaisesRegex(RuntimeError, "triangulate"):
            tipp.resample(pyvista.Plane(), dimensions=(3, 3))


if __name__ == "__main__":
    unittest.main()
