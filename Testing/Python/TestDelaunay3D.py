# SPDX-License-Identifier: BSD-3-Clause
"""tipp.delaunay_3d and vtkTIPPDelaunay3D as Python programs use them."""
import unittest
import warnings

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData

import tipp


def scattered(count, dtype=np.float64):
    return np.random.default_rng(1).random((count, 3)).astype(dtype)


def tetrahedra(mesh):
    return vtk_to_numpy(mesh.GetCells().GetConnectivityArray()).reshape(-1, 4)


def kinds_of(mesh):
    return [mesh.GetCellType(i) for i in range(mesh.GetNumberOfCells())]


def volumes(points, cells):
    a, b, c, d = (points[column].astype(float) for column in cells.T)
    return np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6


class Delaunay3D(unittest.TestCase):
    def test_numpy_points_become_positive_tetrahedra(self):
        for dtype in (np.float64, np.float32):
            with self.subTest(dtype=dtype):
                points = scattered(1000, dtype)
                found = volumes(points, tipp.delaunay_3d(points).cells)
                self.assertGreater(found.min(), 0)

    def test_a_lattice_is_filled(self):
        axis = np.arange(12.0)
        points = np.stack(np.meshgrid(axis, axis, axis), axis=-1).reshape(-1, 3)
        found = volumes(points, tipp.delaunay_3d(points).cells)
        self.assertAlmostEqual(found.sum(), 11.0**3)
        self.assertGreater(found.min(), 0.1)

    def test_threads_and_partitions_do_not_change_the_cells(self):
        points = scattered(5000)
        one = tipp.delaunay_3d(points, threads=1).cells
        other = tipp.delaunay_3d(points, threads=2, partitions=20).cells
        self.assertTrue(np.array_equal(one, other))

    def test_spheres_are_empty(self):
        points = scattered(60)
        for cell in tipp.delaunay_3d(points).cells:
            corners = points[cell]
            centre = np.linalg.solve(2 * (corners[1:] - corners[0]),
                                     (corners[1:] ** 2).sum(axis=1) - (corners[0] ** 2).sum())
            radius = np.linalg.norm(corners[0] - centre)
            self.assertGreaterEqual(np.linalg.norm(points - centre, axis=1).min(), radius * (1 - 1e-9))

    def test_point_data_duplicates_neighbours_and_statistics(self):
        points = scattered(300)
        points[7] = points[5]
        mesh, statistics = tipp.delaunay_3d(
            points, point_data={"depth": np.arange(300.0)}, neighbors=True, return_statistics=True)
        self.assertEqual(mesh.point_data["depth"][9], 9)
        self.assertEqual(mesh.point_data["RepresentativePointId"][7], 5)
        self.assertEqual(mesh.cell_data["NeighborIds"].shape, (len(mesh.cells), 4))
        self.assertEqual(statistics["tetrahedra"], len(mesh.cells))
        self.assertEqual(statistics["duplicates"], 1)

    def test_alpha_leaves_large_tetrahedra_out(self):
        points = scattered(300)
        mesh = tipp.delaunay_3d(points, alpha=0.1)
        self.assertLess(len(mesh.cells), len(tipp.delaunay_3d(points).cells))
        self.assertGreater(len(mesh.triangles), 0)
        kinds = vtk_to_numpy(tipp.delaunay_3d(points, alpha=0.1, return_type="vtk").GetCellTypesArray())
        self.assertEqual((np.count_nonzero(kinds == 10), np.count_nonzero(kinds == 5)), (len(mesh.cells), len(mesh.triangles)))

    def test_a_plane_makes_triangles_and_a_warning(self):
        points = scattered(30)
        points[:, 2] = 1
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            mesh = tipp.delaunay_3d(points)
        self.assertEqual(mesh.cells.shape[1], 3)
        self.assertGreater(len(mesh.cells), 30)
        self.assertIn("plane", str(caught[0].message))

    def test_alpha_keeps_small_triangles_of_a_plane_and_points_of_nothing(self):
        points = np.vstack([scattered(30) * [1, 1, 0], [[9, 9, 0]]])
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", RuntimeWarning)
            mesh = tipp.delaunay_3d(points, alpha=0.2, return_type="vtk")
        kinds = kinds_of(mesh)
        self.assertEqual({1, 3, 5}, set(kinds))
        self.assertEqual((1, 30), (kinds[-1], mesh.GetCell(mesh.GetNumberOfCells() - 1).GetPointId(0)))

    def test_neighbours_are_left_out_with_alpha_and_a_warning_says_so(self):
        with self.assertWarnsRegex(RuntimeWarning, "No NeighborIds: with [aA]lpha not all tetrahedra are output"):
            mesh = tipp.delaunay_3d(scattered(50), alpha=0.2, neighbors=True)
        self.assertNotIn("NeighborIds", mesh.cell_data)

    def test_bound_adds_the_corners_of_an_octahedron(self):
        points = scattered(50, np.float32)
        for offset, times in ((3.0, 3.0), (1.0, 2.5)):
            found = tipp.delaunay_3d(points, bound=True, offset=offset).points
            low, high = points.min(axis=0).astype(float), points.max(axis=0).astype(float)
            distance = times * np.linalg.norm(high - low)
            corners = [(low + high) / 2 + distance * sign * axis for axis in np.eye(3) for sign in (-1, 1)]
            np.testing.assert_array_equal(points, found[:50])
            np.testing.assert_allclose(found[50:], corners, rtol=1e-12)

    def test_a_tolerance_merges_close_points(self):
        points = scattered(100)
        points[40] = points[3] + 1e-7
        mesh, statistics = tipp.delaunay_3d(points, tol=1e-5, return_statistics=True)
        self.assertEqual(1, statistics["duplicates"])
        self.assertNotIn(40, mesh.cells)
        self.assertEqual(3, mesh.point_data["RepresentativePointId"][40])

    def test_points_that_are_not_finite_are_in_no_cell_and_named(self):
        points = scattered(100)
        points[7] = np.nan
        with self.assertWarnsRegex(RuntimeWarning, "in no tetrahedron.*the first is point 7"):
            mesh = tipp.delaunay_3d(points)
        self.assertNotIn(7, mesh.cells)
        self.assertEqual(-1, mesh.point_data["RepresentativePointId"][7])

    def test_a_data_set_keeps_its_points_and_arrays(self):
        cloud = vtkPolyData()
        cloud.SetPoints(vtkPoints())
        cloud.GetPoints().SetData(numpy_to_vtk(scattered(80, np.float32), deep=True))
        depth = numpy_to_vtk(np.arange(80.0), deep=True)
        depth.SetName("depth")
        cloud.GetPointData().AddArray(depth)
        mesh = tipp.delaunay_3d(cloud)
        self.assertTrue(mesh.IsA("vtkUnstructuredGrid"))
        np.testing.assert_array_equal(vtk_to_numpy(cloud.GetPoints().GetData()), vtk_to_numpy(mesh.GetPoints().GetData()))
        self.assertEqual(79, vtk_to_numpy(mesh.GetPointData().GetArray("depth"))[79])
        np.testing.assert_array_equal(tipp.delaunay_3d(scattered(80, np.float32)).cells, tetrahedra(mesh))

    def test_fewer_than_four_points_make_no_tetrahedra_and_a_warning(self):
        for count, words in ((0, "there is no finite point"), (1, "coincide"), (2, "on one line"), (3, "in one plane")):
            with self.assertWarnsRegex(RuntimeWarning, "No tetrahedra: .*" + words):
                mesh = tipp.delaunay_3d(scattered(count))
            self.assertEqual((count, count // 3), (len(mesh.points), len(mesh.cells)))

    def test_wrong_arguments_are_refused(self):
        with self.assertRaises(ValueError):
            tipp.delaunay_3d(scattered(10), alpha=-1)
        with self.assertRaises(TypeError):
            tipp.delaunay_3d(scattered(10), partitions=2.5)


if __name__ == "__main__":
    unittest.main()
