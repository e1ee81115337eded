# SPDX-License-Identifier: BSD-3-Clause
"""tipp.check finds no error in correct meshes, and finds each error that a test inserts."""
import unittest

import numpy as np

import tipp
from tipp._check import in_circles, orientations

RANDOM = np.random.default_rng(6)


class Correct(unittest.TestCase):
    def test_triangulations_of_every_kind_have_no_faults(self):
        x, y = np.meshgrid(np.arange(30), np.arange(20))
        t = np.linspace(0, 2 * np.pi, 101)
        clouds = {
            "random": RANDOM.random((3000, 2)),
            "grid": np.c_[x.ravel(), y.ravel()].astype(float),
            "circle": np.c_[np.cos(t), np.sin(t)],
            "duplicates": RANDOM.integers(0, 20, (2000, 2)).astype(float),
            "tiny": RANDOM.random((300, 2)) * 1e-300,
            "far apart": np.r_[RANDOM.random((300, 2)), RANDOM.random((300, 2)) * 1e-200, [[1e150, 1]]],
            "line": np.c_[np.arange(9.0), np.arange(9.0) * 3],
        }
        for name, points in clouds.items():
            with self.subTest(name):
                report = tipp.check(points, _quietly(lambda: tipp.delaunay(points)), tie_rule=True)
                self.assertEqual({}, report.faults)
                self.assertTrue(report)
        self.assertEqual(19 * 29, tipp.check(clouds["grid"], tipp.delaunay(clouds["grid"])).ties)

    def test_points_and_neighbors_are_taken_from_a_mesh(self):
        mesh = tipp.delaunay_2d(RANDOM.random((500, 2)), neighbors=True)
        self.assertTrue(tipp.check(mesh))

    def test_constraints_need_not_be_delaunay(self):
        points = RANDOM.random((500, 2))
        edges = [[0, 1], [2, 3]]
        mesh = tipp.delaunay_2d(points, edges=edges, marks="lines")
        lines, triangles = (mesh.lines, mesh.cells)
        self.assertTrue(tipp.check(mesh.points, triangles, edges=lines))
        self.assertFalse(tipp.check(mesh.points, triangles))
        self.assertIn("constraints that are no edge", tipp.check(points, tipp.delaunay(points), edges=edges).faults)


class Faulty(unittest.TestCase):
    def setUp(self):
        self.points = RANDOM.random((300, 2))
        self.triangles = tipp.delaunay(self.points).astype(np.int64)

    def faults(self, triangles, points=None, **options):
        return tipp.check(self.points if points is None else points, triangles, **options).faults

    def test_a_lost_triangle(self):
        for t in (0, 100, len(self.triangles) - 1):
            self.assertTrue(self.faults(np.delete(self.triangles, t, axis=0)))

    def test_a_triangle_twice(self):
        faults = self.faults(np.vstack([self.triangles, self.triangles[:1]]))
        self.assertTrue({"edges in three or more triangles", "edges that two triangles have in one direction"} & set(faults))

    def test_a_clockwise_triangle(self):
        self.triangles[7] = self.triangles[7, ::-1]
        self.assertEqual(1, self.faults(self.triangles)["triangles that are clockwise or flat"])

    def test_invalid_ids_and_ids_of_points_that_are_not_finite(self):
        self.points[self.triangles[3, 0]] = np.nan
        self.assertIn("triangles that name no point, or one that is not finite", self.faults(self.triangles))
        self.triangles[3, 0] = 300
        self.assertIn("triangles that name no point, or one that is not finite", self.faults(self.triangles))

    def test_a_flipped_edge(self):
        edges = {}
        for t, corners in enumerate(self.triangles.tolist()):
            for i in range(3):
                edges.setdefault(frozenset((corners[i - 1], corners[i - 2])), []).append((t, corners[i]))
        flipped = 0
        for edge, sides in edges.items():
            if len(sides) == 2 and flipped < 20:
                (t, c), (u, d) = sides
                a, b = edge
                both = self.points[[c, d, c, d]], self.points[[d, c, d, c]]
                first, second = [c, a, d], [d, b, c]
                turns = orientations(*(self.points[[x[i] for x in (first, second)]] for i in range(3)))
                if (turns < 0).all():
                    first, second = first[::-1], second[::-1]
                elif not (turns > 0).all():
                    continue
                mesh = self.triangles.copy()
                mesh[t], mesh[u] = first, second
                self.assertEqual({"interior edges with a point inside the circle"}, set(self.faults(mesh)), both)
                flipped += 1
        self.assertEqual(20, flipped)

    def test_a_point_in_no_triangle(self):
        points = np.vstack([self.points, [[0.5, 0.5]]])
        self.assertEqual(1, self.faults(self.triangles, points)["distinct points in no triangle"])

    def test_ties_broken_the_other_way(self):
        square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], float)
        good, bad = [[0, 1, 3], [1, 2, 3]], [[0, 1, 2], [0, 2, 3]]
        self.assertEqual([{}, {}], [self.faults(t, square) for t in (good, bad)])
        self.assertEqual([0, 1], [len(self.faults(t, square, tie_rule=True)) for t in (good, bad)])

    def test_wrong_neighbors(self):
        mesh = tipp.delaunay_2d(self.points, neighbors=True)
        tipp.as_array(mesh, "NeighborIds")[5] = [1, 2, 3]
        self.assertIn("neighbours that are not those over the edge", tipp.check(mesh).faults)

    def test_a_boundary_that_is_not_convex(self):
        inside = (self.points[self.triangles].mean(axis=1)[:, 0] < 0.5)
        self.assertIn("boundary edges that are not in one convex closed chain", self.faults(self.triangles[inside]))
        self.assertEqual({}, self.faults(self.triangles[inside], boundary_free=True))

    def test_arguments_are_named(self):
        with self.assertRaisesRegex(ValueError, "triangles is None"):
            tipp.check(self.points)
        with self.assertRaisesRegex(ValueError, "triangles have the shape"):
            tipp.check(self.points, [[0, 1]])


class Exact(unittest.TestCase):
    def test_signs_are_those_of_rational_numbers(self):
        from fractions import Fraction

        base = RANDOM.integers(0, 4, (2000, 4, 2)) / 3.0 + RANDOM.integers(-1, 2, (2000, 4, 2)) * 2.0**-52
        a, b, c, d = base.transpose(1, 0, 2)

        def turn(p, q, r):
            (px, py), (qx, qy), (rx, ry) = ([Fraction(float(v)) for v in x] for x in (p, q, r))
            value = (qx - px) * (ry - py) - (qy - py) * (rx - px)
            return (value > 0) - (value < 0)

        self.assertEqual([turn(*rows) for rows in zip(a, b, c)], orientations(a, b, c).tolist())

        def inside(p, q, r, s):
            rows = [[Fraction(float(v)) - Fraction(float(w)) for v, w in zip(x, s)] for x in (p, q, r)]
            (ax, ay), (bx, by), (cx, cy) = rows
            value = ((ax**2 + ay**2) * (bx * cy - by * cx) + (bx**2 + by**2) * (cx * ay - cy * ax)
                     + (cx**2 + cy**2) * (ax * by - ay * bx))
            return (value > 0) - (value < 0)

        self.assertEqual([inside(*rows) for rows in zip(a, b, c, d)], in_circles(a, b, c, d).tolist())


def _quietly(work):
    import warnings

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return work()


if __name__ == "__main__":
    unittest.main()
