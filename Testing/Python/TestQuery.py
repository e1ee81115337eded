# SPDX-License-Identifier: BSD-3-Clause
"""tipp.open: meshes that answer queries."""
import importlib.util
import pathlib
import tempfile
import threading
import unittest

import numpy as np

import tipp


class Query(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        rng = np.random.default_rng(5)
        self.points = rng.random((3000, 2))
        self.height = self.points[:, 0] - 2 * self.points[:, 1]
        self.mesh = tipp.delaunay_2d(self.points, point_data={"height": self.height})
        self.path = str(self.folder / "mesh.tipp")
        tipp.write(self.mesh, self.path, tiling="grid:3x3")
        self.asked = np.concatenate([rng.random((2000, 2)) * 1.2 - 0.1, self.points[:100]])

    def test_a_stored_mesh_answers_as_the_one_in_memory(self):
        with tipp.open(self.mesh) as whole, tipp.open(self.path) as stored:
            cells, weights = stored.locate(self.asked)
            expected = whole.locate(self.asked)
            np.testing.assert_array_equal(cells, expected[0])
            np.testing.assert_array_equal(weights, expected[1])
            self.assertTrue((cells == -1).any() and (cells >= 0).any())
            np.testing.assert_allclose(weights[cells >= 0].sum(axis=1), 1)

    def test_linear_fields_are_interpolated(self):
        with tipp.open(self.path) as mesh:
            self.assertEqual(mesh.array_names, ["elevation", "height"])
            values = mesh.interpolate(self.asked, "height")
            inside = mesh.locate(self.asked)[0] >= 0
            np.testing.assert_allclose(values[inside], (self.asked[:, 0] - 2 * self.asked[:, 1])[inside], atol=1e-12)
            self.assertTrue(np.isnan(values[~inside]).all())
            self.assertEqual(set(mesh.interpolate(self.asked)), {"elevation", "height"})

    def test_scipy_gives_the_same_values(self):
        if not importlib.util.find_spec("scipy"):
            self.skipTest("scipy is not installed")
        from scipy.interpolate import LinearNDInterpolator

        wave = np.sin(20 * self.points[:, 0]) * self.points[:, 1]
        mesh = tipp.delaunay_2d(self.points, point_data={"wave": wave})
        ours = tipp.open(mesh).interpolate(self.asked, "wave")
        theirs = LinearNDInterpolator(self.points, wave)(self.asked)
        both = ~np.isnan(ours) & ~np.isnan(theirs)
        self.assertGreater(both.sum(), 1000)
        np.testing.assert_allclose(ours[both], theirs[both], atol=1e-9)

    def test_sixteen_threads_share_a_mesh(self):
        with tipp.open(self.path, memory="64K", threads=1) as mesh, tipp.open(self.mesh) as whole:
            expected = whole.interpolate(self.asked, "height")
            found = [None] * 16

            def work(i):
                for _ in range(3):
                    found[i] = mesh.interpolate(self.asked, "height")

            threads = [threading.Thread(target=work, args=(i,)) for i in range(16)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            for values in found:
                np.testing.assert_array_equal(values, expected)

    def test_what_lies_around(self):
        triangles = tipp.delaunay(self.points)
        with tipp.open(self.path) as mesh:
            cells = np.arange(len(triangles))
            neighbors = mesh.neighbors(cells)
            self.assertEqual(neighbors.shape, triangles.shape)
            for cell in range(0, len(triangles), 37):
                for i, other in enumerate(neighbors[cell]):
                    edge = set(np.delete(triangles[cell], i))
                    if other >= 0:
                        self.assertEqual(len(edge & set(triangles[other])), 2)
            star = mesh.star([7, 8])
            for point, found in zip([7, 8], star):
                np.testing.assert_array_equal(found, np.flatnonzero((triangles == point).any(axis=1)))
            ring = mesh.ring(points=[7])[0]
            np.testing.assert_array_equal(ring, np.setdiff1d(triangles[star[0]], [7]))
            around = mesh.ring(cells=[0], k=1)[0]
            shared = np.isin(triangles, triangles[0]).any(axis=1)
            np.testing.assert_array_equal(around, np.setdiff1d(np.flatnonzero(shared), [0]))
            loops = mesh.boundary()
            self.assertEqual(len(loops), 1)
            self.assertEqual((neighbors < 0).sum(), len(loops[0]))
            labels, sizes = mesh.components()
            np.testing.assert_array_equal(labels, 0)
            np.testing.assert_array_equal(sizes, [len(triangles)])

    def test_the_filter_takes_the_place_of_vtk_probe_filter(self):
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkFiltersCore import vtkProbeFilter

        cloud = tipp.delaunay_2d(self.asked, point_data={"own": np.arange(len(self.asked), dtype=np.float64)})
        for source in ({"FileName": self.path}, {"SourceData": self.mesh}):
            query = tipp.vtkPartitionedMeshQuery()
            query.SetInputData(cloud)
            for name, value in source.items():
                getattr(query, "Set" + name)(value)
            query.SetPassPointArrays(True)
            query.Update()
            probe = vtkProbeFilter()
            probe.SetInputData(cloud)
            probe.SetSourceData(self.mesh)
            probe.Update()
            ours, theirs = query.GetOutput().GetPointData(), probe.GetOutput().GetPointData()
            self.assertEqual(query.GetOutput().GetNumberOfCells(), cloud.GetNumberOfCells())
            self.assertIsNotNone(ours.GetArray("own"))
            mask = vtk_to_numpy(ours.GetArray("vtkValidPointMask"))
            same = mask == vtk_to_numpy(theirs.GetArray("vtkValidPointMask"))
            self.assertGreater(same.mean(), 0.99)  # vtkProbeFilter has a tolerance
            np.testing.assert_allclose(vtk_to_numpy(ours.GetArray("height"))[same],
                                       vtk_to_numpy(theirs.GetArray("height"))[same], atol=1e-6)
            cells = vtk_to_numpy(ours.GetArray("CellId"))
            np.testing.assert_array_equal(cells >= 0, mask != 0)
            self.assertEqual(np.abs(vtk_to_numpy(ours.GetArray("height"))[mask == 0]).max(), 0)

    def test_direct_questions_update_the_source(self):
        from vtkmodules.vtkCommonCore import vtkIdTypeArray
        from vtkmodules.vtkFiltersGeneral import vtkShrinkFilter

        shrink = vtkShrinkFilter()
        shrink.SetInputData(self.mesh)
        query = tipp.vtkPartitionedMeshQuery()
        query.SetSourceConnection(shrink.GetOutputPort())
        cells, sizes = vtkIdTypeArray(), vtkIdTypeArray()
        self.assertEqual(query.Components(cells, sizes), 1)
        self.assertEqual(sizes.GetNumberOfValues(), self.mesh.GetNumberOfCells())  # each cell by itself

    def test_contours_of_a_plane_are_straight(self):
        with tipp.open(self.path) as mesh, tipp.open(self.mesh) as whole:
            lines = mesh.contours([-0.5, 0.25, 7], "height")
            self.assertEqual([level for level, _ in lines], [-0.5, 0.25])
            for level, points in lines:
                np.testing.assert_allclose(points[:, 0] - 2 * points[:, 1], level, atol=1e-12)
            for (_, ours), (_, theirs) in zip(lines, whole.contours([-0.5, 0.25], "height")):
                np.testing.assert_array_equal(ours, theirs)
            self.assertEqual(mesh.contours([7], "height"), [])

    def test_profiles_cross_pieces(self):
        with tipp.open(self.path) as mesh, tipp.open(self.mesh) as whole:
            corners = [(0.2, 0.3), (0.7, 0.6), (0.7, 0.9)]
            for spacing in (0, 0.01):
                ours, theirs = mesh.profile(corners, spacing, "height"), whole.profile(corners, spacing, "height")
                np.testing.assert_array_equal(ours.points, theirs.points)
                np.testing.assert_array_equal(ours.cells, theirs.cells)
                np.testing.assert_allclose(ours.values["height"], ours.points[:, 0] - 2 * ours.points[:, 1], atol=1e-12)
                self.assertAlmostEqual(ours.distances[-1], np.hypot(0.5, 0.3) + 0.3)
                self.assertTrue((np.diff(ours.distances) > 0).all())

    def test_errors_are_one_sentence(self):
        with self.assertRaisesRegex(RuntimeError, "nowhere"):
            tipp.open(str(self.folder / "nowhere"))
        with tipp.open(self.path) as mesh:
            with self.assertRaisesRegex(KeyError, "depth"):
                mesh.interpolate(self.asked, "depth")
            with self.assertRaisesRegex(RuntimeError, "no cell 1000000"):
                mesh.neighbors([1000000])
            with self.assertRaises(TypeError):
                mesh.star([0.5])
            with self.assertRaises(ValueError):
                mesh.ring(k=2)
        with self.assertRaisesRegex(ValueError, "closed"):
            mesh.locate(self.asked)

    def test_no_points_and_no_ids(self):
        with tipp.open(self.path) as mesh:
            cells, weights = mesh.locate(np.zeros((0, 2)))
            self.assertEqual((cells.shape, weights.shape), ((0,), (0, 3)))
            self.assertEqual(mesh.neighbors([]).shape, (0, 3))
            self.assertEqual(mesh.star([]), [])


unittest.main()
