# SPDX-License-Identifier: BSD-3-Clause
"""tipp.Delaunay and tipp.LinearNDInterpolator, compared with those of scipy."""
import unittest

import numpy as np
from scipy.interpolate import LinearNDInterpolator
from scipy.spatial import Delaunay

import tipp


def edges(triangles):
    pairs = np.concatenate([triangles[:, [i, (i + 1) % 3]] for i in range(3)])
    return {tuple(pair) for pair in np.sort(pairs, axis=1).tolist()}


class ScipyHabits(unittest.TestCase):
    def setUp(self):
        self.points = np.random.default_rng(3).random((5000, 2))
        self.mine = tipp.Delaunay(self.points)
        self.theirs = Delaunay(self.points)
        self.queries = np.random.default_rng(4).random((20_000, 2)) * 1.2 - 0.1

    def test_triangles_are_scipys(self):
        rows = [{tuple(sorted(t)) for t in mesh.simplices.tolist()} for mesh in (self.mine, self.theirs)]
        self.assertEqual(rows[1], rows[0])
        self.assertEqual(self.theirs.simplices.dtype, self.mine.simplices.dtype)
        self.assertEqual((self.theirs.npoints, self.theirs.nsimplex), (self.mine.npoints, self.mine.nsimplex))

    def test_neighbors_lie_over_the_opposite_edge(self):
        for triangle, beside in list(zip(self.mine.simplices, self.mine.neighbors))[::50]:
            for corner, other in enumerate(beside):
                if other >= 0:
                    shared = set(triangle.tolist()) & set(self.mine.simplices[other].tolist())
                    self.assertEqual(set(triangle.tolist()) - {triangle[corner]}, shared)

    def test_the_hull_is_scipys(self):
        self.assertEqual({tuple(sorted(e)) for e in self.theirs.convex_hull.tolist()},
                         {tuple(sorted(e)) for e in self.mine.convex_hull.tolist()})

    def test_neighbors_of_vertices_are_scipys(self):
        starts, indices = self.mine.vertex_neighbor_vertices
        theirs = self.theirs.vertex_neighbor_vertices
        for k in range(0, 5000, 97):
            self.assertEqual(set(theirs[1][theirs[0][k]:theirs[0][k + 1]].tolist()),
                             set(indices[starts[k]:starts[k + 1]].tolist()))

    def test_points_are_found_where_scipy_finds_them(self):
        mine, theirs = self.mine.find_simplex(self.queries), self.theirs.find_simplex(self.queries)
        np.testing.assert_array_equal(theirs < 0, mine < 0)
        inside = mine >= 0
        np.testing.assert_array_equal(np.sort(self.theirs.simplices[theirs[inside]], axis=1),
                                      np.sort(self.mine.simplices[mine[inside]], axis=1))
        self.assertEqual((4, 5), self.mine.find_simplex(self.queries[:20].reshape(4, 5, 2)).shape)

    def test_corners_and_centres_are_found_exactly(self):
        centres = self.points[self.mine.simplices].mean(axis=1)
        np.testing.assert_array_equal(np.arange(self.mine.nsimplex), self.mine.find_simplex(centres))
        found = self.mine.find_simplex(self.points)
        self.assertTrue((self.mine.simplices[found] == np.arange(5000)[:, None]).any(axis=1).all())

    def test_interpolated_values_are_scipys(self):
        for values in (np.sin(9 * self.points[:, 0]), self.points * [1, 2], self.points[:, 0] + 1j * self.points[:, 1]):
            mine = tipp.LinearNDInterpolator(self.points, values)(self.queries)
            theirs = LinearNDInterpolator(self.points, values)(self.queries)
            self.assertEqual((theirs.shape, theirs.dtype), (mine.shape, mine.dtype))
            np.testing.assert_allclose(mine, theirs, atol=1e-11)

    def test_x_and_y_are_broadcast_and_outside_is_filled(self):
        height = tipp.LinearNDInterpolator(self.points, self.points[:, 0], fill_value=-5.0)
        x, y = np.linspace(-0.5, 1.5, 9), np.linspace(0.3, 0.6, 4)[:, None]
        theirs = LinearNDInterpolator(self.points, self.points[:, 0], fill_value=-5.0)(x, y)
        np.testing.assert_allclose(height(x, y), theirs, atol=1e-12)

    def test_rescaling_is_scipys(self):
        points = self.points * [1, 1000]
        mine = tipp.LinearNDInterpolator(points, self.points[:, 0] ** 2, rescale=True)
        theirs = LinearNDInterpolator(points, self.points[:, 0] ** 2, rescale=True)
        np.testing.assert_allclose(mine(self.queries * [1, 1000]), theirs(self.queries * [1, 1000]), atol=1e-9)

    def test_a_triangulation_serves_several_interpolators(self):
        np.testing.assert_allclose(tipp.LinearNDInterpolator(self.mine, self.points[:, 1])(0.5, 0.25), 0.25)

    def test_duplicates_are_coplanar_points(self):
        mesh = tipp.Delaunay(np.vstack([self.points, self.points[:3]]))
        np.testing.assert_array_equal([[5000, 0], [5001, 1], [5002, 2]], mesh.coplanar[:, [0, 2]])

    def test_points_without_a_triangle_or_not_finite_are_refused(self):
        with self.assertRaisesRegex(RuntimeError, "No triangles"):
            tipp.Delaunay([[0, 0], [1, 1], [2, 2]])
        with self.assertRaisesRegex(ValueError, "NaN"):
            tipp.Delaunay([[0, 0], [1, 1], [2, np.nan]])
        with self.assertRaisesRegex(ValueError, r"4 values for 5000 points"):
            tipp.LinearNDInterpolator(self.points, np.zeros(4))


if __name__ == "__main__":
    unittest.main()
