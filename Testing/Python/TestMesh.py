# SPDX-License-Identifier: BSD-3-Clause
"""tipp.mesh: meshes of bounded angles and sizes. Runs with and without VTK."""
import importlib.util
import math
import os
import tempfile
import unittest

import numpy as np

import tipp

HAS_VTK = importlib.util.find_spec("vtkmodules") is not None

# A square of side 8, and inside it a smaller one.
SQUARES = np.array([[0, 0], [8, 0], [8, 8], [0, 8], [3, 3], [5, 3], [5, 5], [3, 5]], float)
OUTER, INNER = [[0, 1], [1, 2], [2, 3], [3, 0]], [[4, 5], [5, 6], [6, 7], [7, 4]]


def areas(mesh):
    a, b, c = (mesh.points[corner, :2] for corner in mesh.cells.T)
    (px, py), (qx, qy) = (b - a).T, (c - a).T
    return (px * qy - py * qx) / 2


def angles(mesh):
    """Returns the smallest angle of each triangle, in degrees."""
    p = mesh.points[:, :2][mesh.cells]
    found = []
    for i in range(3):
        (ux, uy), (vx, vy) = (p[:, i - 2] - p[:, i]).T, (p[:, i - 1] - p[:, i]).T
        found.append(np.degrees(np.arctan2(ux * vy - uy * vx, ux * vx + uy * vy)))
    return np.min(found, axis=0)


def centroids(mesh):
    return mesh.points[:, :2][mesh.cells].mean(axis=1).T


def limit(side):
    """The area of the equilateral triangle with this side."""
    return math.sqrt(3) / 4 * np.square(side) * (1 + 1e-9)


def sides(mesh):
    """Returns the corners beside each edge, by the ids of its ends."""
    found = {}
    for a, b, c in mesh.cells.tolist():
        for start, end, corner in ((a, b, c), (b, c, a), (c, a, b)):
            found.setdefault((min(start, end), max(start, end)), []).append(corner)
    return found


def incircle(a, b, c, d):
    """Above 0 if d is inside the circle through a, b, c."""
    rows = np.array([a, b, c]) - d
    return float(np.linalg.det(np.column_stack([rows, (rows ** 2).sum(axis=1)])))


class Bounds(unittest.TestCase):
    def test_no_angle_is_below_the_bound(self):
        for bound in (20, 25, 30):
            mesh = tipp.mesh(np.random.default_rng(1).random((200, 2)), min_angle=bound)
            self.assertGreaterEqual(angles(mesh)[mesh.cell_data["OutsideBounds"] == 0].min(), bound - 1e-9)
            self.assertEqual(0, mesh.cell_data["OutsideBounds"].sum())

    def test_mesh_is_constrained_delaunay(self):
        mesh = tipp.mesh(SQUARES, OUTER + INNER + [[0, 4], [1, 6]], min_angle=28, marks="lines")
        segments = {tuple(sorted(line)) for line in mesh.lines.tolist()}
        xy = mesh.points[:, :2]
        for (a, b), corners in sides(mesh).items():
            if len(corners) == 2 and (a, b) not in segments:
                c, d = corners
                (px, py), (qx, qy) = xy[b] - xy[a], xy[c] - xy[a]
                a, b = (a, b) if px * qy > py * qx else (b, a)
                self.assertLess(incircle(xy[a], xy[b], xy[c], xy[d]), 1e-9)

    def test_segments_are_chains_of_edges(self):
        lines = OUTER + INNER + [[0, 4]]
        mesh = tipp.mesh(SQUARES, lines, max_area=0.3, marks="lines")
        edges = sides(mesh)
        for number, (a, b) in enumerate(lines):
            pieces = mesh.lines[mesh.line_data["ConstraintId"] == number]
            self.assertTrue(all(tuple(sorted(piece)) in edges for piece in pieces.tolist()))
            lengths = np.linalg.norm(mesh.points[pieces[:, 0]] - mesh.points[pieces[:, 1]], axis=1)
            self.assertAlmostEqual(np.linalg.norm(SQUARES[a] - SQUARES[b]), lengths.sum())

    def test_triangles_cover_the_domain(self):
        self.assertAlmostEqual(64, areas(tipp.mesh(SQUARES, OUTER + INNER)).sum())
        self.assertGreater(areas(tipp.mesh(SQUARES, OUTER)).min(), 0)

    def test_area(self):
        self.assertLessEqual(areas(tipp.mesh(SQUARES, OUTER, max_area=0.05)).max(), 0.05)

    def test_thin_input_is_listed(self):
        mesh = tipp.mesh([[0, 0], [8, 0], [8, 1]])
        thin = angles(mesh) < 30 - 1e-9
        np.testing.assert_array_equal(thin, mesh.cell_data["OutsideBounds"] == 1)
        self.assertTrue(thin.any())

    def test_kept_segments(self):
        mesh = tipp.mesh(SQUARES, OUTER, max_area=0.5, keep_segments=True, marks="lines")
        self.assertEqual(4, len(mesh.lines))
        self.assertEqual({0, 3}, set(mesh.cell_data["OutsideBounds"].tolist()))

    def test_a_memory_limit_does_not_matter(self):
        options = {"max_area": 0.001, "regions": [(1, 1, 0.01)], "smooth": 2, "point_data": {"level": SQUARES[:, 0]}}
        expected = tipp.mesh(SQUARES, OUTER, **options)
        with tempfile.TemporaryDirectory() as folder:
            found = tipp.mesh(SQUARES, OUTER, memory="1M", scratch=folder, **options)
            self.assertEqual([], os.listdir(folder))
        np.testing.assert_array_equal(expected.points, found.points)
        np.testing.assert_array_equal(expected.cells, found.cells)
        np.testing.assert_array_equal(expected.point_data["level"], found.point_data["level"])
        np.testing.assert_array_equal(expected.cell_data["Region"], found.cell_data["Region"])

    def test_most_points(self):
        mesh = tipp.mesh(SQUARES, OUTER, max_area=0.01, most_points=10)
        self.assertEqual(18, len(mesh.points))
        self.assertIn(4, mesh.cell_data["OutsideBounds"])

    def test_without_bounds_no_points_are_added(self):
        points = np.random.default_rng(3).random((60, 2))
        self.assertEqual(60, len(tipp.mesh(points, min_angle=0).points))

    def test_smoothing_makes_angles_grow(self):
        plain, smooth = (tipp.mesh(SQUARES, OUTER, max_area=0.05, smooth=rounds) for rounds in (0, 5))
        self.assertGreater(angles(smooth).mean(), angles(plain).mean() + 1)
        self.assertGreaterEqual(angles(smooth).min(), 30 - 1e-9)
        self.assertLessEqual(areas(smooth).max(), 0.05)
        np.testing.assert_array_equal(plain.cells, smooth.cells)

    def test_threads_do_not_matter(self):
        points = np.random.default_rng(2).random((1000, 2))
        one, four = (tipp.mesh(points, size=lambda x, y: 0.005 + 0.03 * x, threads=count) for count in (1, 4))
        self.assertEqual(one, four)


class Sizes(unittest.TestCase):
    def test_number(self):
        self.assertLessEqual(areas(tipp.mesh(SQUARES, OUTER, size=0.4)).max(), limit(0.4))

    def test_array(self):
        mesh = tipp.mesh(SQUARES, OUTER, size=0.2 + 0.1 * SQUARES[:, 0])
        x, _ = centroids(mesh)
        self.assertTrue((areas(mesh) <= limit(0.2 + 0.1 * x)).all())
        self.assertEqual({}, mesh.point_data)

    def test_function(self):
        calls = []

        def size(x, y):
            calls.append(x.shape)
            return 0.2 + 0.1 * x + 0.05 * y

        mesh = tipp.mesh(SQUARES, OUTER, size=size)
        x, y = centroids(mesh)
        self.assertTrue((areas(mesh) <= limit(0.2 + 0.1 * x + 0.05 * y)).all())
        self.assertEqual([(513 * 513,)], calls)

    def test_function_of_one_number(self):
        self.assertLessEqual(areas(tipp.mesh(SQUARES, OUTER, size=lambda x, y: 0.5)).max(), limit(0.5))


class Domains(unittest.TestCase):
    def test_points_alone_are_meshed_to_their_hull(self):
        self.assertAlmostEqual(64, areas(tipp.mesh(SQUARES)).sum())

    def test_lines_enclose_the_domain(self):
        self.assertAlmostEqual(4, areas(tipp.mesh(SQUARES, INNER)).sum())

    def test_hole_outside(self):
        with self.assertRaisesRegex(RuntimeError, r"the hole at \(9, 9\) is in no triangle"):
            tipp.mesh(SQUARES, OUTER, holes=[(9, 9)])

    def test_convex(self):
        self.assertAlmostEqual(64, areas(tipp.mesh(SQUARES, INNER, convex=True)).sum())

    def test_holes(self):
        self.assertAlmostEqual(60, areas(tipp.mesh(SQUARES, OUTER + INNER, holes=[(4, 4)])).sum())

    def test_polygons(self):
        mesh = tipp.mesh(SQUARES, polygons=[[0, 1, 2, 3], [7, 6, 5, 4]])
        self.assertAlmostEqual(60, areas(mesh).sum())

    def test_polygons_with_corners_of_their_own(self):
        mesh = tipp.mesh(polygons=[SQUARES[:4], SQUARES[:3:-1]])
        self.assertAlmostEqual(60, areas(mesh).sum())
        np.testing.assert_array_equal(SQUARES[:4], mesh.points[:4, :2])

    def test_geometries(self):
        square = {"type": "Polygon", "coordinates": [[*map(tuple, SQUARES[[0, 3, 2, 1, 0]])],
                                                     [*map(tuple, SQUARES[[4, 5, 6, 7, 4]])]]}
        line = {"type": "LineString", "coordinates": [(1, 1), (7, 1)]}
        mesh = tipp.mesh(None, [line], polygons=[square], marks="lines")
        self.assertAlmostEqual(60, areas(mesh).sum())
        self.assertEqual({0, 1, 2}, set(mesh.line_data["ConstraintId"].tolist()))

    def test_corners_are_shared_with_points(self):
        mesh = tipp.mesh(SQUARES, [SQUARES[[0, 1, 2, 3, 0]]], min_angle=0)
        self.assertEqual(8, len(mesh.points))

    def test_regions(self):
        mesh = tipp.mesh(SQUARES, OUTER + INNER, regions=[(4, 4, 0.02), (1, 1)])
        regions = mesh.cell_data["Region"]
        self.assertEqual({0, 1}, set(regions.tolist()))
        self.assertAlmostEqual(4, areas(mesh)[regions == 0].sum())
        self.assertLessEqual(areas(mesh)[regions == 0].max(), 0.02)
        self.assertGreater(areas(mesh)[regions == 1].max(), 0.02)

    def test_open_lines_enclose_nothing(self):
        with self.assertWarnsRegex(RuntimeWarning, "the lines enclose nothing"):
            self.assertEqual(0, len(tipp.mesh(SQUARES, OUTER[:3]).cells))


class Values(unittest.TestCase):
    def test_points_come_first_and_values_are_linear(self):
        points = np.column_stack([SQUARES, SQUARES.sum(axis=1)])
        mesh = tipp.mesh(points, OUTER + INNER, max_area=0.1,
                         point_data={"twice": 2 * points[:, 2], "rows": points[:, :2], "same": np.full(8, 7)})
        np.testing.assert_array_equal(points, mesh.points[:8])
        total = mesh.points[:, :2].sum(axis=1)
        np.testing.assert_allclose(mesh.points[:, 2], total, atol=1e-12)
        np.testing.assert_allclose(mesh.point_data["twice"], 2 * total, atol=1e-12)
        np.testing.assert_allclose(mesh.point_data["rows"], mesh.points[:, :2], atol=1e-12)
        self.assertEqual({7}, set(mesh.point_data["same"].tolist()))

    def test_values_at_crossings(self):
        mesh = tipp.mesh(SQUARES, [[0, 2], [1, 3]], convex=True, min_angle=0, point_data={"x": SQUARES[:, 0]})
        np.testing.assert_array_equal(mesh.points[:, 0], mesh.point_data["x"])

    def test_types(self):
        mesh = tipp.mesh(SQUARES.astype(np.float32), OUTER, max_area=1, regions=[(1, 1)], marks="lines",
                         point_data={"class": np.arange(8, dtype=np.uint8)})
        self.assertEqual(["f8", "i4", "u1", "i4", "u1", "i4", "i8"], [
            array.dtype.str[1:] for array in (
                mesh.points, mesh.cells, mesh.point_data["class"], mesh.cell_data["Region"],
                mesh.cell_data["OutsideBounds"], mesh.lines, mesh.line_data["ConstraintId"])])

    def test_coincident_points_are_merged(self):
        mesh = tipp.mesh(np.concatenate([SQUARES[:4], SQUARES[:4]]), OUTER, min_angle=0)
        self.assertEqual((8, {0, 1, 2, 3}), (len(mesh.points), set(mesh.cells.ravel().tolist())))


@unittest.skipUnless(HAS_VTK, "without VTK there are no data sets")
class DataSets(unittest.TestCase):
    def test_lines_of_a_data_set_are_segments(self):
        data = tipp.mesh(SQUARES, OUTER + INNER, min_angle=0, marks="lines").to_vtk()
        data.SetPolys(None)
        found = tipp.mesh(data, max_area=0.1)
        self.assertEqual("vtkPolyData", found.GetClassName())
        mesh = tipp.mesh(data, max_area=0.1, return_type="tipp")
        self.assertAlmostEqual(64, areas(mesh).sum())
        self.assertEqual(len(mesh.cells), found.GetNumberOfPolys())

    def test_filter_gives_the_same(self):
        made = tipp.vtkTIPPRefine2D()
        data = tipp.mesh(SQUARES, OUTER, min_angle=0, marks="lines").to_vtk()
        data.SetPolys(None)
        data.GetPointData().Initialize()
        made.SetInputData(data)
        made.SetMaximumArea(0.1)
        made.AddRegion(1, 1, 0.05)
        made.Update()
        mesh = tipp.mesh(SQUARES, OUTER, max_area=0.1, regions=[(1, 1, 0.05)])
        np.testing.assert_array_equal(mesh.cell_data["Region"], tipp.as_array(made.GetOutput(), "Region"))
        self.assertEqual(len(mesh.points), made.GetOutput().GetNumberOfPoints())


class Misuse(unittest.TestCase):
    def assert_refused(self, kind, message, *arguments, **keywords):
        with self.assertRaisesRegex(kind, message):
            tipp.mesh(*arguments, **keywords)

    def test_a_scratch_folder_needs_a_memory_limit(self):
        self.assert_refused(ValueError, "scratch has no effect without memory", SQUARES, scratch=".")

    def test_arguments(self):
        self.assert_refused(ValueError, "min_angle is 40; give at most 34 degrees", SQUARES, min_angle=40)
        self.assert_refused(ValueError, "min_angle is -1; give 0 or more", SQUARES, min_angle=-1)
        self.assert_refused(ValueError, "max_area is 0; give a number above 0", SQUARES, max_area=0)
        self.assert_refused(ValueError, "most_points is 0; give a whole number from 1", SQUARES, most_points=0)
        self.assert_refused(ValueError, "smooth is -1; give a whole number from 0", SQUARES, smooth=-1)
        self.assert_refused(TypeError, "convex is 1; give True or False", SQUARES, convex=1)
        self.assert_refused(ValueError, "marks is 'flags'; it is one of none, lines", SQUARES, marks="flags")
        self.assert_refused(ValueError, "neither points nor segments nor polygons")

    def test_segments(self):
        self.assert_refused(ValueError, "segments: there is no point 8, because there are 8 points", SQUARES, [[0, 8]])
        self.assert_refused(ValueError, r"segments have the shape \(1, 3\)", SQUARES, np.array([[0, 1, 2]]))
        self.assert_refused(RuntimeError, "constraint 0 .* crosses constraint 1", SQUARES, [[0, 2], [1, 3]],
                            crossings="refuse")

    def test_regions(self):
        self.assert_refused(ValueError, r"regions\[0\] has 1 values; give x and y, or x, y and the largest area", SQUARES,
                            regions=[(1,)])
        self.assert_refused(ValueError, r"regions\[0\]\[2\] is 0; give a number above 0", SQUARES, regions=[(1, 1, 0)])
        self.assert_refused(RuntimeError, r"The point \(9, 9\) of region 0 is in no triangle", SQUARES, regions=[(9, 9)])

    def test_sizes(self):
        self.assert_refused(ValueError, "size is -1; give a number above 0", SQUARES, size=-1)
        self.assert_refused(ValueError, r"size\[2\] is 0.0; give numbers above 0", SQUARES, size=[1, 1, 0, 1, 1, 1, 1, 1])
        self.assert_refused(ValueError, r"size has the shape \(2,\); give one value for each of the 8 points", SQUARES,
                            size=[1, 1])
        self.assert_refused(ValueError, "segments or polygons have corners of their own", SQUARES,
                            [SQUARES[:2] + 1], size=np.ones(8))
        self.assert_refused(ValueError, r"size\(0.0, 0.0\) is 0.0; give numbers above 0", SQUARES, size=lambda x, y: x)
        self.assert_refused(ValueError, r"size returns the shape \(2,\)", SQUARES, size=lambda x, y: [1, 2])

    def test_progress_can_stop(self):
        self.assert_refused(RuntimeError, "the progress callback stopped the run", SQUARES, max_area=1e-4,
                            progress_bar=lambda fraction: False)


if __name__ == "__main__":
    unittest.main()
