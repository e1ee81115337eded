# SPDX-License-Identifier: BSD-3-Clause
"""tipp.delaunay_3d and vtkTIPPDelaunay3D as Python programs use them."""
import unittest
import warnings

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

import tipp


def scattered(count, dtype=np.float64):
    return np.random.default_rng(1).random((count, 3)).astype(dtype)


def tetrahedra(mesh):
    return vtk_to_numpy(mesh.GetCells().GetConnectivityArray()).reshape(-1, 4)


def volumes(points, cells):
    a, b, c, d = (points[column].astype(float) for column in cells.T)
    return np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6


class Delaunay3D(unittest.TestCase):
    def test_numpy_points_become_positive_tetrahedra(self):
        for dtype in (np.float64, np.float32):
            with self.subTest(dtype=dtype):
                points = scattered(1000, dtype)
                found = volumes(points, tetrahedra(tipp.delaunay_3d(points)))
                self.assertGreater(found.min(), 0)

    def test_a_lattice_is_filled(self):
        axis = np.arange(12.0)
        points = np.stack(np.meshgrid(axis, axis, axis), axis=-1).reshape(-1, 3)
        found = volumes(points, tetrahedra(tipp.delaunay_3d(points)))
        self.assertAlmostEqual(found.sum(), 11.0**3)
        self.assertGreater(found.min(), 0.1)

    def test_threads_and_partitions_do_not_change_the_cells(self):
        points = scattered(5000)
        one = tetrahedra(tipp.delaunay_3d(points, threads=1))
        other = tetrahedra(tipp.delaunay_3d(points, threads=2, partitions=20))
        self.assertTrue(np.array_equal(one, other))

    def test_spheres_are_empty(self):
        points = scattered(60)
        for cell in tetrahedra(tipp.delaunay_3d(points)):
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
        self.assertEqual(vtk_to_numpy(mesh.GetPointData().GetArray("depth"))[9], 9)
        self.assertEqual(vtk_to_numpy(mesh.GetPointData().GetArray("RepresentativePointId"))[7], 5)
        self.assertEqual(vtk_to_numpy(mesh.GetCellData().GetArray("NeighborIds")).shape, (mesh.GetNumberOfCells(), 4))
        self.assertEqual(statistics["tetrahedra"], mesh.GetNumberOfCells())
        self.assertEqual(statistics["duplicates"], 1)

    def test_alpha_leaves_large_tetrahedra_out(self):
        points = scattered(300)
        kinds = vtk_to_numpy(tipp.delaunay_3d(points, alpha=0.1).GetCellTypesArray())
        self.assertLess(np.count_nonzero(kinds == 10), len(tetrahedra(tipp.delaunay_3d(points))))
        self.assertGreater(np.count_nonzero(kinds == 5), 0)

    def test_a_plane_makes_triangles_and_a_warning(self):
        points = scattered(30)
        points[:, 2] = 1
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            mesh = tipp.delaunay_3d(points)
        self.assertEqual(set(vtk_to_numpy(mesh.GetCellTypesArray())), {5})
        self.assertGreater(mesh.GetNumberOfCells(), 30)
        self.assertIn("plane", str(caught[0].message))

    def test_wrong_arguments_are_refused(self):
        with self.assertRaises(ValueError):
            tipp.delaunay_3d(scattered(10), alpha=-1)
        with self.assertRaises(TypeError):
            tipp.delaunay_3d(scattered(10), partitions=2.5)


if __name__ == "__main__":
    unittest.main()
