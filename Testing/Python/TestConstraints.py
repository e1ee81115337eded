# SPDX-License-Identifier: BSD-3-Clause
"""Constraints of tipp.delaunay_2d."""
import importlib.util
import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

import tipp

# A square, and inside it a smaller square with a point in the middle.
SQUARES = np.array([[0, 0], [8, 0], [8, 8], [0, 8], [3, 3], [5, 3], [5, 5], [3, 5], [4, 4.25]], float)
INNER = [4, 5, 6, 7]


def area(mesh):
    a, b, c = (mesh.points[corner, :2] for corner in mesh.cells.T)
    (px, py), (qx, qy) = (b - a).T, (c - a).T
    return float(np.sum(px * qy - py * qx) / 2)


def has_edge(mesh, a, b):
    return any(a in triangle and b in triangle for triangle in mesh.cells.tolist())


class Edges(unittest.TestCase):
    def test_edges_are_in_the_mesh(self):
        points = np.random.default_rng(3).random((300, 2))
        plain = tipp.delaunay_2d(points)
        a = 0
        b = next(i for i in range(1, 300) if not has_edge(plain, a, i))
        mesh = tipp.delaunay_2d(points, edges=[[a, b]])
        self.assertTrue(has_edge(mesh, a, b))
        self.assertEqual(len(plain.cells), len(mesh.cells))

    def test_edge_source_has_the_ids_of_the_points(self):
        source = tipp.delaunay_2d(SQUARES, polygons=[INNER], marks="lines", return_type="vtk")
        source.GetPointData().Initialize()
        lines = type(source)()
        lines.SetLines(source.GetLines())
        mesh = tipp.delaunay_2d(SQUARES, edge_source=lines)
        for i in range(4):
            self.assertTrue(has_edge(mesh, INNER[i], INNER[i - 1]))

    def test_crossing_is_a_new_point(self):
        mesh = tipp.delaunay_2d(SQUARES, edges=[[0, 2], [5, 7]], point_data={"depth": np.arange(9.0)})
        self.assertEqual(10, len(mesh.points))
        self.assertEqual([4, 4, 0], mesh.points[9].tolist())
        self.assertEqual(5, tipp.as_array(mesh, "depth")[9])  # between points 4 and 6, which are on the edge

    def test_crossing_is_refused(self):
        with self.assertRaisesRegex(RuntimeError, "constraint 0 .* crosses constraint 1"):
            tipp.delaunay_2d(SQUARES, edges=[[0, 2], [5, 7]], crossings="refuse")

    def test_marks(self):
        lines = tipp.delaunay_2d(SQUARES, polygons=[INNER], marks="lines", return_type="vtk")
        self.assertEqual([0, 0, 0, 0, -1, -1, -1, -1], tipp.as_array(lines, "ConstraintId").tolist())
        flags = tipp.as_array(tipp.delaunay_2d(SQUARES, polygons=[INNER], marks="flags"), "ConstraintEdges")
        self.assertEqual(4, flags.sum())


class Polygons(unittest.TestCase):
    def test_counter_clockwise_keeps_its_inside(self):
        self.assertEqual(4, area(tipp.delaunay_2d(SQUARES, polygons=[INNER])))

    def test_clockwise_is_a_hole(self):
        self.assertEqual(60, area(tipp.delaunay_2d(SQUARES, polygons=[INNER[::-1]])))

    def test_coordinates_of_points_refer_to_these_points(self):
        mesh = tipp.delaunay_2d(SQUARES, polygons=[SQUARES[INNER]])
        self.assertEqual(9, len(mesh.points))
        self.assertEqual(4, area(mesh))

    def test_other_coordinates_are_new_points(self):
        mesh = tipp.delaunay_2d(SQUARES, polygons=[[[1.0, 1.0], [7.0, 1.0], [7.0, 7.0], [1.0, 7.0]]], edges=[[4, 6]])
        self.assertEqual(13, len(mesh.points))
        self.assertEqual(36, area(mesh))
        self.assertTrue(has_edge(mesh, 4, 6) or has_edge(mesh, 4, 8))

    def test_new_points_keep_the_heights_of_a_polygon(self):
        corners = [[1.0, 1.0, 3.0], [7.0, 1.0, 4.0], [7.0, 7.0, 5.0], [1.0, 7.0, 6.0]]
        mesh = tipp.delaunay_2d(SQUARES, polygons=[corners])
        points = mesh.points
        self.assertEqual([3, 4, 5, 6], points[9:, 2].tolist())

class NewCorners(unittest.TestCase):
    def setUp(self):
        xy = np.random.default_rng(6).random((400, 2))
        self.points = np.c_[xy, 400 + 3 * xy[:, 0] - 2 * xy[:, 1]]
        self.data = {"depth": xy @ [5.0, 1.0], "kind": np.full(400, 7, np.int16), "pair": xy}
        self.inside = np.array([[0.2, 0.2], [0.8, 0.25], [0.7, 0.8], [0.3, 0.7]])

    def added(self, **constraints):
        """The points and the arrays of the corners that are new."""
        mesh = tipp.delaunay_2d(self.points, point_data=self.data, **constraints)
        return (mesh.points[400:],
                {name: tipp.as_array(mesh, name)[400:] for name in self.data})

    def test_have_the_height_and_the_values_of_the_surface(self):
        for corners in (self.inside, np.c_[self.inside, np.zeros(4)], np.c_[self.inside, np.full(4, np.nan)]):
            for constraints in ({"polygons": [corners]}, {"edges": [corners]}):
                points, values = self.added(**constraints)
                x, y = self.inside.T
                np.testing.assert_array_equal(self.inside, points[:, :2])
                np.testing.assert_allclose(points[:, 2], 400 + 3 * x - 2 * y, rtol=1e-12)
                np.testing.assert_allclose(values["depth"], 5 * x + y, rtol=1e-12)
                np.testing.assert_allclose(values["pair"], self.inside, rtol=1e-12)
                self.assertEqual(([7] * 4, np.int16), (values["kind"].tolist(), values["kind"].dtype))

    def test_keep_their_own_heights_and_have_the_values_of_the_surface(self):
        points, values = self.added(polygons=[np.c_[self.inside, [1, 0, 2, 3]]])
        self.assertEqual([1, 0, 2, 3], points[:, 2].tolist())
        np.testing.assert_allclose(values["depth"], self.inside @ [5.0, 1.0], rtol=1e-12)

    def test_outside_of_the_surface_have_those_of_its_nearest_location(self):
        self.points[:4] = [[0, 0, 1], [1, 0, 1], [1, 1, 3], [0, 1, 3]]
        self.data["depth"][:4] = [1, 2, 3, 4]
        points, values = self.added(polygons=[[[-1, -1], [2, -1], [2, 0.5], [0.5, 2], [-1, 2]]])
        self.assertEqual([1, 1, 2, 3, 3], points[:, 2].tolist())
        self.assertEqual([1, 2, 2.5, 3.5, 4], values["depth"].tolist())

    def test_beside_points_on_a_line_have_the_values_of_the_nearest(self):
        points = np.array([[0.0, 0, 5], [1, 0, 6], [2, 0, 7]])
        mesh = tipp.delaunay_2d(points, polygons=[[[0.1, -1], [1.9, -1], [1.1, 1]]])
        self.assertEqual([5, 7, 6], mesh.points[3:, 2].tolist())

    def test_beside_points_that_are_not_finite_have_those_of_the_others(self):
        self.points[:5, 0] = np.nan
        with self.assertWarns(RuntimeWarning):
            points, _ = self.added(polygons=[self.inside])
        x, y = self.inside.T
        np.testing.assert_allclose(points[:, 2], 400 + 3 * x - 2 * y, rtol=1e-12)

    def test_over_points_without_heights_have_none(self):
        mesh = tipp.delaunay_2d(SQUARES, polygons=[[[1.0, 1.0], [7.0, 1.0], [7.0, 7.0]]])
        self.assertEqual([0, 0, 0], mesh.points[9:, 2].tolist())


class Shape:
    """A geometry as of Shapely."""

    def __init__(self, kind, coordinates):
        self.__geo_interface__ = {"type": kind, "coordinates": coordinates}


class Line:
    """A geometry with coordinates only."""

    def __init__(self, coords):
        self.coords = coords


class Column:
    """A GeoSeries: it is iterable, and is a collection of features, whose geometry may be None."""

    def __init__(self, shapes):
        self.shapes = shapes
        self.geometry = self

    def __iter__(self):
        return iter(self.shapes)

    @property
    def __geo_interface__(self):
        return {"type": "FeatureCollection", "features": [
            {"type": "Feature", "geometry": s and s.__geo_interface__, "properties": {}} for s in self.shapes]}


class Table:
    """A GeoDataFrame, as far as it has a column of geometries."""

    def __init__(self, shapes):
        self.geometry = Column(shapes)


class Geometries(unittest.TestCase):
    RING = [*SQUARES[INNER].tolist(), SQUARES[4].tolist()]
    OUTER = [[0, 0], [0, 8], [8, 8], [8, 0], [0, 0]]

    def test_are_polygons_of_any_kind_and_orientation(self):
        ring, hole = self.RING, self.RING[::-1]
        donut, inner = Shape("Polygon", [self.OUTER, ring]), Shape("Polygon", [hole])
        cases = [([donut], 60), (donut, 60), ([inner], 4), (Shape("MultiPolygon", [[self.OUTER, hole]]), 60),
                 (Column([donut, None]), 60), (Table([inner]), 4), (donut.__geo_interface__, 60),
                 ([Shape("LinearRing", hole)], 4), ([Line(ring)], 4),
                 ({"type": "GeometryCollection", "geometries": [inner.__geo_interface__]}, 4),
                 ([Shape("Polygon", ()), inner], 4), (np.array([inner, None], object), 4)]
        for polygons, expected in cases:
            with self.subTest(polygons=polygons):
                self.assertEqual(expected, area(tipp.delaunay_2d(SQUARES, polygons=polygons)))

    def test_are_edges(self):
        line = [[0, 0], [4, 4.25], [8, 8]]
        for edges in ([Shape("LineString", line)], Shape("LineString", line), Line(line), Column([Shape("LineString", line)]),
                      Table([None, Shape("MultiLineString", [line])]), [np.array(line)], Line(np.c_[line, [1, 2, 3]])):
            mesh = tipp.delaunay_2d(SQUARES, edges=edges, marks="lines")
            self.assertEqual(9, len(mesh.points))
            self.assertTrue(has_edge(mesh, 8, 2) and has_edge(mesh, 8, 4) and has_edge(mesh, 4, 0))
        closed = tipp.delaunay_2d(SQUARES, edges=[Shape("Polygon", [self.RING])], marks="lines")
        self.assertEqual((64, 4), (area(closed), len(closed.lines)))

    def test_of_another_kind_are_refused_by_name(self):
        for arguments, text in (({"polygons": [Shape("LineString", [[0, 0], [1, 1]])]}, r"polygons\[0\] is a LineString that is not"),
                                ({"polygons": [Shape("Point", [0, 0])]}, r"polygons\[0\] is a Point;"),
                                ({"edges": [Shape("Point", [0, 0])]}, r"edges\[0\] is a Point;"),
                                ({"edges": [Shape("Circle", [0, 0])]}, r"edges\[0\] is a Circle;")):
            with self.assertRaisesRegex(TypeError, text):
                tipp.delaunay_2d(SQUARES, **arguments)
        with self.assertRaisesRegex(ValueError, r"polygons\[0\] has corners that are not all"):
            tipp.delaunay_2d(SQUARES, polygons=[Shape("Polygon", [[[0, 0], [1, 0, 3], [1, 1]]])])

    @unittest.skipUnless(importlib.util.find_spec("geopandas"), "GeoPandas is not installed")
    def test_of_geopandas(self):
        import geopandas
        from shapely.geometry import LineString, Polygon

        frame = geopandas.GeoDataFrame({"name": ["donut", "none"]}, geometry=[Polygon(self.OUTER, [self.RING]), None])
        self.assertEqual(60, area(tipp.delaunay_2d(SQUARES, polygons=frame)))
        self.assertEqual(60, area(tipp.delaunay_2d(SQUARES, polygons=frame.geometry)))
        lines = geopandas.GeoSeries([LineString([[0, 0], [8, 8]])])
        self.assertTrue(has_edge(tipp.delaunay_2d(SQUARES, edges=lines), 6, 2))
        points = geopandas.GeoSeries.from_xy(*SQUARES.T)
        self.assertEqual(len(tipp.delaunay(SQUARES)), len(tipp.delaunay(points)))
        self.assertEqual(len(tipp.delaunay(SQUARES)), len(tipp.delaunay(geopandas.GeoDataFrame(geometry=points))))

    @unittest.skipUnless(importlib.util.find_spec("shapely"), "Shapely is not installed")
    def test_shapely_polygons_bring_their_holes(self):
        from shapely.geometry import Polygon

        clockwise = [(0, 0), (0, 8), (8, 8), (8, 0)]
        polygon = Polygon(clockwise, [SQUARES[INNER]])
        self.assertEqual(60, area(tipp.delaunay_2d(SQUARES, polygons=[polygon])))
        self.assertEqual(60, area(tipp.delaunay_2d(SQUARES, polygons=polygon)))


class Arguments(unittest.TestCase):
    def test_wrong_arguments_are_named(self):
        cases = [
            ({"edges": [[0, 1, 2]]}, ValueError, "edges have the shape"),
            ({"edges": [[0.5, 1.5]]}, ValueError, "edges have the shape"),
            ({"polygons": 5}, TypeError, "polygons is not a list"),
            ({"polygons": [[0.5, 1.5]]}, ValueError, r"polygons\[0\] has the shape"),
            ({"edge_source": SQUARES}, TypeError, "edge_source is"),
            ({"edge_source": tipp.delaunay_2d(SQUARES), "edges": [[0, 1]]}, ValueError, "edge_source cannot be combined"),
            ({"crossings": "keep"}, ValueError, "crossings is 'keep'"),
            ({"marks": "dots"}, ValueError, "marks is 'dots'"),
            ({"edges": [[0, 9]]}, ValueError, "edges: there is no point 9, because there are 9 points"),
        ]
        for arguments, error, text in cases:
            with self.subTest(text=text), self.assertRaisesRegex(error, text):
                tipp.delaunay_2d(SQUARES, **arguments)


@unittest.skipUnless(importlib.util.find_spec("pyvista"), "PyVista is not installed")
class PyVista(unittest.TestCase):
    def test_accessor_takes_constraints(self):
        import pyvista

        cloud = pyvista.PolyData(np.c_[SQUARES, np.zeros(9)])
        mesh = cloud.tipp.delaunay_2d(polygons=[INNER])
        self.assertIsInstance(mesh, pyvista.PolyData)
        self.assertEqual(4, mesh.n_cells)


if __name__ == "__main__":
    unittest.main()
