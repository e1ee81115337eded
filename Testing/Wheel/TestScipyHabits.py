# SPDX-License-Identifier: BSD-3-Clause
"""tipp.Delaunay, tipp.LinearNDInterpolator and tipp.griddata, compared with those of scipy."""
import itertools
import math
import pickle
import unittest

import numpy as np
from scipy.interpolate import CloughTocher2DInterpolator, griddata, LinearNDInterpolator
from scipy.spatial import ConvexHull, Delaunay

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

    def test_arguments_that_only_qhull_has_are_refused(self):
        with self.assertRaisesRegex(ValueError, "furthest_site is True"):
            tipp.Delaunay(self.points, True)
        with self.assertRaisesRegex(ValueError, "qhull_options are Qhull's"):
            tipp.Delaunay(self.points, qhull_options="QJ")


def cells_of(mesh):
    return {tuple(cell) for cell in np.sort(mesh.simplices, axis=1).tolist()}


def volumes(mesh):
    corners = mesh.points[mesh.simplices]
    return np.linalg.det(corners[:, 1:] - corners[:, :1])


def rows_of(mesh, rows):
    """The rows of an array of a mesh's cells, by the cells' sorted corners."""
    return {tuple(sorted(cell)): row for cell, row in zip(mesh.simplices.tolist(), rows)}


class PlaneAndSpace(unittest.TestCase):
    """Points in general position, whose cells are scipy's, in two and three dimensions."""

    def each(self):
        for dimension, count in ((2, 900), (3, 700)):
            with self.subTest(dimension=dimension):
                points = np.random.default_rng(dimension).normal(size=(count, dimension)) * [3, 1, 2][:dimension] + 4
                yield tipp.Delaunay(points), Delaunay(points)

    def test_cells_and_bounds_are_scipys(self):
        for mine, theirs in self.each():
            self.assertEqual(cells_of(theirs), cells_of(mine))
            self.assertGreater(volumes(mine).min(), 0)
            self.assertEqual((theirs.ndim, theirs.npoints, theirs.nsimplex), (mine.ndim, mine.npoints, mine.nsimplex))
            np.testing.assert_array_equal(theirs.min_bound, mine.min_bound)
            np.testing.assert_array_equal(theirs.max_bound, mine.max_bound)

    def test_neighbors_share_all_corners_but_one(self):
        for mine, theirs in self.each():
            expected = rows_of(theirs, theirs.neighbors)
            for cell, beside in zip(mine.simplices.tolist(), mine.neighbors.tolist()):
                for corner, other in zip(cell, beside):
                    if other >= 0:
                        self.assertEqual(set(cell) - {corner}, set(cell) & set(mine.simplices[other].tolist()))
                self.assertEqual((expected[tuple(sorted(cell))] == -1).sum(), beside.count(-1))

    def test_the_hull_is_scipys_and_faces_outward(self):
        for mine, theirs in self.each():
            self.assertEqual({tuple(sorted(facet)) for facet in theirs.convex_hull.tolist()},
                             {tuple(sorted(facet)) for facet in mine.convex_hull.tolist()})
            corners = mine.points[mine.convex_hull]
            inward = mine.points.mean(axis=0) - corners[:, 0]
            sides = np.linalg.det(np.concatenate([corners[:, 1:] - corners[:, :1], inward[:, np.newaxis]], axis=1))
            self.assertTrue((sides > 0).all() if mine.ndim == 2 else (sides < 0).all())

    def test_vertices_have_scipys_neighbors_and_one_of_their_cells(self):
        for mine, theirs in self.each():
            starts, ids = mine.vertex_neighbor_vertices
            expected = theirs.vertex_neighbor_vertices
            for k in range(mine.npoints):
                self.assertEqual(sorted(expected[1][expected[0][k]:expected[0][k + 1]]), ids[starts[k]:starts[k + 1]].tolist())
            self.assertTrue((mine.simplices[mine.vertex_to_simplex] == np.arange(mine.npoints)[:, None]).any(axis=1).all())

    def test_barycentric_coordinates_by_transform_reproduce_points(self):
        for mine, theirs in self.each():
            queries = np.random.default_rng(5).normal(size=(200, mine.ndim)) + 4
            cells = mine.find_simplex(queries)
            queries, cells = queries[cells >= 0], cells[cells >= 0]
            maps = mine.transform[cells]
            weights = np.einsum("ijk,ik->ij", maps[:, :-1], queries - maps[:, -1])
            weights = np.column_stack([weights, 1 - weights.sum(axis=1)])
            self.assertGreater(weights.min(), -1e-9)
            np.testing.assert_allclose(queries, np.einsum("ij,ijk->ik", weights, mine.points[mine.simplices[cells]]))
            self.assertEqual((theirs.transform.shape, theirs.transform.dtype), (mine.transform.shape, mine.transform.dtype))

    def test_planes_on_the_paraboloid_are_scipys(self):
        for mine, theirs in self.each():
            np.testing.assert_allclose([mine.paraboloid_scale, mine.paraboloid_shift],
                                       [theirs.paraboloid_scale, theirs.paraboloid_shift])
            np.testing.assert_allclose(mine.lift_points(mine.points), theirs.lift_points(theirs.points), atol=1e-12)
            queries = np.random.default_rng(6).normal(size=(5, mine.ndim)) + 4
            found, expected = mine.plane_distance(queries), theirs.plane_distance(queries)
            self.assertEqual(expected.shape, found.shape)
            found, expected = rows_of(mine, found.T), rows_of(theirs, expected.T)
            thick = [cell for cell, volume in rows_of(mine, volumes(mine)).items() if volume > 1e-3]
            np.testing.assert_allclose([found[cell] for cell in thick], [expected[cell] for cell in thick], atol=1e-9)

    def test_points_are_found_where_scipy_finds_them(self):
        for mine, theirs in self.each():
            queries = np.random.default_rng(7).normal(size=(10, 30, mine.ndim)) * 3 + 4
            found, expected = mine.find_simplex(queries), theirs.find_simplex(queries)
            self.assertEqual((expected.shape, expected.dtype), (found.shape, found.dtype))
            np.testing.assert_array_equal(expected < 0, found < 0)
            inside = found >= 0
            np.testing.assert_array_equal(np.sort(theirs.simplices[expected[inside]]), np.sort(mine.simplices[found[inside]]))
            self.assertEqual((), mine.find_simplex(mine.points[0]).shape)
            self.assertTrue((mine.simplices[mine.find_simplex(mine.points)] == np.arange(mine.npoints)[:, None]).any(axis=1).all())

    def test_interpolated_values_are_scipys(self):
        for mine, theirs in self.each():
            points = mine.points
            queries = np.random.default_rng(8).normal(size=(10, 12, mine.ndim)) * 3 + 4
            for values in (np.sin(points[:, 0]), points * 3, points[:, 0] + 1j * points[:, 1]):
                for rescale in (False, True):
                    found = tipp.LinearNDInterpolator(points, values, rescale=rescale)(queries)
                    expected = LinearNDInterpolator(points, values, rescale=rescale)(queries)
                    self.assertEqual((expected.shape, expected.dtype), (found.shape, found.dtype))
                    np.testing.assert_allclose(found, expected, atol=1e-10)

    def test_tuples_of_coordinates_are_points_as_in_scipy(self):
        for mine, theirs in self.each():
            points, values = tuple(mine.points.T), mine.points[:, 0]
            found, expected = tipp.LinearNDInterpolator(points, values), LinearNDInterpolator(points, values)
            grid = np.meshgrid(*[np.linspace(3, 5, n) for n in (4, 5, 6)[:mine.ndim]])
            axes = [np.linspace(3, 5, 4).reshape([-1] + [1] * i) for i in range(mine.ndim)]
            centre = [4.0] * mine.ndim
            for xi in ((tuple(grid),), tuple(grid), tuple(axes), (centre,), tuple(centre), (np.stack(grid, axis=-1),)):
                self.assertEqual(expected(*xi).shape, found(*xi).shape)
                np.testing.assert_allclose(found(*xi), expected(*xi), atol=1e-10)

    def test_griddata_of_each_method_is_scipys(self):
        for mine, theirs in self.each():
            points, values = mine.points, np.sin(mine.points).sum(axis=1)
            xi = tuple(np.meshgrid(*[np.linspace(0, 8, n) for n in (9, 8, 7)[:mine.ndim]]))
            for method, rescale in itertools.product(("linear", "nearest", "cubic")[:5 - mine.ndim], (False, True)):
                for xi in (xi, np.stack(xi, axis=-1), [4.0] * mine.ndim):
                    found = tipp.griddata(tuple(points.T), values, xi, method, fill_value=-9, rescale=rescale)
                    expected = griddata(points, values, xi, method, fill_value=-9, rescale=rescale)
                    self.assertEqual(expected.shape, found.shape)
                    np.testing.assert_allclose(found, expected, atol=1e-7)

    def test_pickled_copies_answer_the_same(self):
        for mine, theirs in self.each():
            queries = mine.points + 0.01
            found = mine.find_simplex(queries)
            copy = pickle.loads(pickle.dumps(mine))
            np.testing.assert_array_equal(found, copy.find_simplex(queries))
            np.testing.assert_array_equal(mine.convex_hull, copy.convex_hull)
            interpolator = tipp.LinearNDInterpolator(mine, mine.points[:, 0], rescale=False)
            np.testing.assert_array_equal(interpolator(queries), pickle.loads(pickle.dumps(interpolator))(queries))
            np.testing.assert_array_equal(mine.to_scipy().simplices, pickle.loads(pickle.dumps(mine.to_scipy())).simplices)

    def test_points_are_added_to_an_incremental_triangulation(self):
        for mine, theirs in self.each():
            grown = tipp.Delaunay(mine.points[:50], incremental=True)
            grown.find_simplex(mine.points)
            grown.add_points(mine.points[50:300])
            grown.add_points(mine.points[300:], restart=True)
            np.testing.assert_array_equal(mine.simplices, grown.simplices)
            np.testing.assert_array_equal(mine.find_simplex(mine.points), grown.find_simplex(mine.points))
            with self.assertRaisesRegex(ValueError, "NaN"):
                grown.add_points(np.full((1, mine.ndim), np.nan))
            self.assertEqual(mine.npoints, grown.npoints)
            grown.close()
            for closed in (grown, mine):
                with self.assertRaisesRegex(RuntimeError, "incremental=True"):
                    closed.add_points(mine.points)

    def test_scipys_functions_take_the_converted_object(self):
        for mine, theirs in self.each():
            converted = mine.to_scipy()
            self.assertIsInstance(converted, Delaunay)
            queries = np.random.default_rng(10).normal(size=(300, mine.ndim)) + 4
            np.testing.assert_allclose(LinearNDInterpolator(converted, mine.points[:, 0])(queries),
                                       LinearNDInterpolator(theirs, mine.points[:, 0])(queries), atol=1e-9)
            np.testing.assert_array_equal(mine.find_simplex(queries), converted.find_simplex(queries))
        mine, theirs = list(self.each())[0]
        values = np.sin(mine.points).sum(axis=1)
        np.testing.assert_allclose(CloughTocher2DInterpolator(mine.to_scipy(), values)(mine.points + 0.01),
                                   CloughTocher2DInterpolator(theirs, values)(mine.points + 0.01), atol=1e-6)

    def test_methods_and_values_that_do_not_exist_are_refused(self):
        points = np.random.default_rng(1).random((20, 3))
        for arguments, words in (((points, points[:, 0], points, "cubic"), "'cubic', which is for points in the plane"),
                                 ((points, points[:, 0], points, "spline"), "method is 'spline'"),
                                 ((points, points[:5, 0], points), "5 values for 20 points"),
                                 ((points, points[:, 0], points[:, :2]), r"xi has the shape \(20, 2\); give x, y and z"),
                                 ((points, points[:, 0], (points, points[:7])), "shapes .* and .*; give arrays that can be")):
            with self.assertRaisesRegex(ValueError, words):
                tipp.griddata(*arguments)
        with self.assertRaisesRegex(TypeError, "fill_value is of type complex128; give a real number"):
            tipp.griddata(points, points[:, 0], points, fill_value=1j)


class DegeneratePoints(unittest.TestCase):
    """Points on common circles and spheres, duplicates and thin cells: no facts depend on the choice of cells."""

    def inputs(self):
        """Points, their triangulation and the volume of their hull."""
        lattice = np.stack(np.meshgrid(*[np.arange(6.0)] * 3), axis=-1).reshape(-1, 3)
        sphere = np.random.default_rng(9).normal(size=(200, 3))
        sphere /= np.linalg.norm(sphere, axis=1)[:, np.newaxis]
        circle = sphere[:, :2] / np.linalg.norm(sphere[:, :2], axis=1)[:, np.newaxis]
        for name, points, volume in (
                ("lattice", lattice, 125), ("decimals", lattice * 0.1, 0.125), ("far", lattice + 1e7, 125),
                ("duplicates", np.vstack([lattice, lattice[::7]]), 125), ("thin", lattice * [1, 1, 1e-9], 1.25e-7),
                ("square", lattice[lattice[:, 2] == 0][:, :2], 25), ("sphere", sphere, ConvexHull(sphere).volume),
                ("circle", circle, ConvexHull(circle).volume)):
            with self.subTest(points=name):
                yield points, tipp.Delaunay(points), volume

    def test_cells_fill_the_hull(self):
        for _, mesh, volume in self.inputs():
            self.assertAlmostEqual(1, volumes(mesh).sum() / (math.factorial(mesh.ndim) * volume), places=6)

    def test_every_point_is_in_one_of_its_cells(self):
        for points, mesh, _ in self.inputs():
            corners = points[mesh.simplices[mesh.find_simplex(points)]]
            self.assertTrue((corners == points[:, np.newaxis]).all(axis=2).any(axis=1).all())

    def test_linear_values_are_reproduced(self):
        for points, mesh, _ in self.inputs():
            slope = np.arange(1, mesh.ndim + 1)
            interpolator = tipp.LinearNDInterpolator(mesh, points @ slope)
            for corners in (1, 2, 3, mesh.ndim + 1):  # in corners, edges, facets and cells
                queries = points[mesh.simplices][:, :corners].mean(axis=1)
                found = interpolator(queries)
                inside = ~np.isnan(found)
                self.assertGreater(inside.mean(), 0.5)  # the others are outside of the hull by rounding
                np.testing.assert_allclose(found[inside], (queries @ slope)[inside], rtol=1e-9, atol=1e-9)

    def test_duplicates_are_coplanar_points(self):
        points = np.random.default_rng(1).random((100, 3))
        mesh = tipp.Delaunay(np.vstack([points, points[:3]]))
        np.testing.assert_array_equal([[100, 0], [101, 1], [102, 2]], mesh.coplanar[:, [0, 2]])
        self.assertTrue((mesh.simplices[mesh.coplanar[:, 1]] == mesh.coplanar[:, 2:]).any(axis=1).all())
        np.testing.assert_array_equal([-1] * 3, mesh.vertex_to_simplex[100:])

    def test_points_in_one_plane_have_no_tetrahedra(self):
        for flat, words in (([1, 1, 0], "in one plane; give"), ([1, 0, 0], "on one line"), ([0, 0, 0], "coincide")):
            with self.assertRaisesRegex(RuntimeError, "No tetrahedra: all .*" + words):
                tipp.Delaunay(np.random.default_rng(1).random((30, 3)) * flat)


if __name__ == "__main__":
    unittest.main()
