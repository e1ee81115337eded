# SPDX-License-Identifier: BSD-3-Clause
"""Constraints and rasters of the wheel, in an environment with only NumPy."""
import importlib.util
import os
import tempfile
import unittest
from fractions import Fraction

import numpy as np

import tipp

# A square, and inside it a smaller square with a point in the middle.
SQUARES = np.array([[0, 0], [8, 0], [8, 8], [0, 8], [3, 3], [5, 3], [5, 5], [3, 5], [4, 4.25]], float)
INNER = [4, 5, 6, 7]


def area(mesh):
    a, b, c = (mesh.points[corner] for corner in mesh.cells.T)
    return float(((b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])).sum() / 2)


def has_edge(mesh, a, b):
    return bool(((mesh.cells == a).any(axis=1) & (mesh.cells == b).any(axis=1)).any())


@unittest.skipIf(importlib.util.find_spec("vtkmodules"), "VTK is installed here")
class Constraints(unittest.TestCase):
    def test_edges_are_in_the_mesh(self):
        points = np.random.default_rng(3).random((300, 2))
        plain = tipp.delaunay_2d(points)
        b = next(i for i in range(1, 300) if not has_edge(plain, 0, i))
        mesh = tipp.delaunay_2d(points, edges=[[0, b]])
        self.assertTrue(has_edge(mesh, 0, b))
        self.assertEqual(len(plain.cells), len(mesh.cells))

    def test_a_crossing_is_a_new_point_with_values_between(self):
        mesh = tipp.delaunay_2d(SQUARES, edges=[[0, 2], [5, 7]],
                                point_data={"depth": np.arange(9.0), "class": np.arange(9) * 7})
        self.assertEqual((4, 4, 0), tuple(mesh.points[9]))
        # Points 4 and 6 are on the first edge, beside the crossing.
        self.assertEqual((5.0, 35), (mesh.point_data["depth"][9], mesh.point_data["class"][9]))

    def test_crossings_on_crossings_are_interpolated(self):
        rows = [[0, i] for i in range(1, 6)]
        points = np.array([[0, 0], [6, 6]] + rows + [[6, i] for i in range(1, 6)], float)
        edges = [[0, 1]] + [[2 + i, 7 + i] for i in range(5)]
        mesh = tipp.delaunay_2d(points, edges=edges, point_data={"sum": points.sum(axis=1)})
        np.testing.assert_allclose(mesh.point_data["sum"], mesh.points[:, :2].sum(axis=1), atol=1e-12)
        self.assertEqual(len(points) + 5, len(mesh.points))

    def test_crossings_are_refused(self):
        with self.assertRaisesRegex(RuntimeError, "constraint 0 .* crosses constraint 1"):
            tipp.delaunay_2d(SQUARES, edges=[[0, 2], [5, 7]], crossings="refuse")

    def test_constraints_of_files(self):
        with tempfile.TemporaryDirectory() as folder:
            points, lines, mesh = (os.path.join(folder, name) for name in ("points.npy", "lines.csv", "mesh.tipp"))
            np.save(points, SQUARES)
            with open(lines, "w", encoding="utf-8") as file:
                file.write("x1,y1,x2,y2\n0,0,8,8\n0,8,8,0\n")
            made = tipp.delaunay_file(points, mesh, constraints=lines, holes=[(4, 7)], mark_constraints=True)
            self.assertEqual((2, 1), (made["constraints"], made["crossing_points"]))
            self.assertAlmostEqual(48, area(tipp.read(mesh)))
            with self.assertRaisesRegex(RuntimeError, "crosses constraint"):
                tipp.delaunay_file(points, mesh, constraints=lines, crossings="refuse")

    def test_marks(self):
        lines = tipp.delaunay_2d(SQUARES, polygons=[INNER], marks="lines")
        self.assertEqual([0, 0, 0, 0], tipp.as_array(lines, "ConstraintId").tolist())
        self.assertEqual({(4, 5), (5, 6), (6, 7), (4, 7)}, {tuple(sorted(line)) for line in lines.lines.tolist()})
        self.assertEqual(4, tipp.delaunay_2d(SQUARES, polygons=[INNER], marks="flags").cell_data["ConstraintEdges"].sum())

    def test_polygons_keep_their_inside_or_are_holes(self):
        self.assertEqual(4, area(tipp.delaunay_2d(SQUARES, polygons=[INNER])))
        self.assertEqual(60, area(tipp.delaunay_2d(SQUARES, polygons=[INNER[::-1]])))

    def test_coordinates_are_existing_or_new_points(self):
        mesh = tipp.delaunay_2d(SQUARES, polygons=[SQUARES[INNER]])
        self.assertEqual((9, 4), (len(mesh.points), area(mesh)))
        with self.assertWarnsRegex(RuntimeWarning, "1 point arrays of the input are left out"):
            mesh = tipp.delaunay_2d(SQUARES, polygons=[[[1.0, 1.0], [7.0, 1.0], [7.0, 7.0], [1.0, 7.0]]],
                                    point_data={"depth": np.arange(9.0)})
        self.assertEqual((13, 36), (len(mesh.points), area(mesh)))

    def test_polygons_with_a_corner_that_is_not_finite_are_refused(self):
        points = SQUARES.copy()
        points[5, 0] = np.nan
        with self.assertRaisesRegex(RuntimeError, "a polygon, has the corner 5, which is NaN"):
            tipp.delaunay_2d(points, polygons=[INNER])

    def test_a_tolerance_is_refused_with_constraints(self):
        with self.assertRaisesRegex(RuntimeError, "tol does not go with constraints"):
            tipp.delaunay_2d(SQUARES, edges=[[0, 1]], tol=0.1)

    def test_a_circle_around_leaves_the_constraints(self):
        mesh = tipp.delaunay_2d(SQUARES, edges=[[0, 4]], bound=True)
        self.assertEqual(17, len(mesh.points))
        self.assertTrue(has_edge(mesh, 0, 4))

    def test_neighbors_representatives_and_statistics(self):
        mesh, statistics = tipp.delaunay_2d(np.vstack([SQUARES, SQUARES[:1]]), edges=[[0, 2]], neighbors=True,
                                            map_duplicates=True, return_statistics=True)
        self.assertEqual((len(mesh.cells), 3), mesh.cell_data["NeighborIds"].shape)
        self.assertEqual([*range(9), 0], mesh.point_data["RepresentativePointId"].tolist())
        self.assertEqual((10, 1, 1), tuple(statistics[n] for n in ("points", "duplicates", "constraints")))


class Rasters(unittest.TestCase):
    def setUp(self):
        xy = np.random.default_rng(4).random((4000, 2)) * 100
        self.points = np.c_[xy, 5 * np.sin(xy[:, 0] / 9) + xy[:, 1] / 7]

    def test_pixels_are_those_of_exact_arithmetic(self):
        grid, transform, _ = tipp.dem(self.points, 0.7)
        corners = self.points[tipp.delaunay(self.points)]
        low, high = corners[:, :, :2].min(axis=1), corners[:, :, :2].max(axis=1)
        width, _, west, _, height, north = transform
        checked = 0
        for row, column in np.random.default_rng(5).integers(0, grid.shape, (100, 2)):
            x, y = west + 0.5 * width + column * width, north + height * (row + 0.5)
            near = np.flatnonzero((low <= [x, y]).all(axis=1) & (high >= [x, y]).all(axis=1))
            heights = [h for h in (exact_height(corners[t], x, y) for t in near) if h is not None]
            self.assertEqual(not heights, bool(np.isnan(grid[row, column])))
            if heights:
                self.assertLess(abs(Fraction(float(grid[row, column])) - heights[0]), 1e-12)
                checked += 1
        self.assertGreater(checked, 60)

    def test_files_and_arrays_make_the_same_pixels(self):
        with tempfile.TemporaryDirectory() as folder:
            name = os.path.join(folder, "points.csv")
            np.savetxt(name, np.c_[self.points, self.points[:, 0] * 2], "%.17g", ",", header="x,y,z,a", comments="")
            for attributes in ("elevation", ["elevation", "a"]):
                grid, transform, crs = tipp.dem(name, 2.0, attributes=attributes)
                expected = tipp.dem(self.points, 2.0, attributes=attributes, point_data={"a": self.points[:, 0] * 2})
                np.testing.assert_array_equal(expected.array, grid)
                self.assertEqual((expected.transform, None), (transform, crs))
            with self.assertRaisesRegex(KeyError, "no column 'c'"):
                tipp.dem(name, 2.0, attributes="c")

    def test_bounds_alignment_and_long_edges(self):
        inside = tipp.dem(self.points, 2.0, bounds=(10, 60, 20, 50))
        self.assertEqual(((15, 25), (2.0, 0.0, 10.0, 0.0, -2.0, 50.0)), (inside.array.shape, inside.transform))
        unaligned = tipp.dem(self.points, 2.0, align=False)
        self.assertEqual(self.points[:, 0].min(), unaligned.transform[2])
        cut = tipp.dem(self.points, 0.5, max_edge=1.5).array
        self.assertGreater(np.isnan(cut).sum(), np.isnan(tipp.dem(self.points, 0.5).array).sum() + 1000)

    def test_failures_are_exceptions(self):
        with self.assertRaisesRegex(RuntimeError, "cannot be opened"):
            tipp.dem("none.las", 1)
        with self.assertRaisesRegex(ValueError, "no elevation"):
            tipp.dem(self.points[:, :2], 1)
        with self.assertRaisesRegex(RuntimeError, "no points"):
            tipp.dem(np.empty((0, 3)), 1)


def exact_height(corners, x, y):
    """The height at (x, y) of the plane through three points, in rational numbers; None outside their triangle."""
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = [[Fraction(float(v)) for v in p] for p in corners]
    x, y = Fraction(x), Fraction(y)
    whole = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    u = ((x - ax) * (cy - ay) - (y - ay) * (cx - ax)) / whole
    v = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / whole
    return az + u * (bz - az) + v * (cz - az) if u >= 0 and v >= 0 and u + v <= 1 else None


if __name__ == "__main__":
    unittest.main()
