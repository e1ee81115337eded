# SPDX-License-Identifier: BSD-3-Clause
"""tipp.delaunay_3d and vtkTIPPDelaunay3D as Python programs use them."""
import unittest
import warnings

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

import tipp


def scattered(count, dtype=np.float64):
    return np.random.default_rng(1).random((count, 3)).astype(dtype)


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

    def test_wrong_arguments_are_refused(self):
        with self.assertRaises(ValueError):
            tipp.delaunay_3d(scattered(10), alpha=-1)
        with self.assertRaises(TypeError):
            tipp.delaunay_3d(scattered(10), partitions=2.5)


if __name__ == "__main__":
    unittest.main()
