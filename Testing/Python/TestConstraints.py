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


def triangles(mesh):
    return vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def area(mesh):
    a, b, c = (vtk_to_numpy(mesh.GetPoints().GetData())[corner, :2] for corner in triangles(mesh).T)
    (px, py), (qx, qy) = (b - a).T, (c - a).T
    return float(np.sum(px * qy - py * qx) / 2)


def has_edge(mesh, a, b):
    return any(a in triangle and b in triangle for triangle in triangles(mesh).tolist())


class Edges(unittest.TestCase):
    def test_edges_are_in_the_mesh(self):
        points = np.random.default_rng(3).random((300, 2))
        plain = tipp.delaunay_2d(points)
        a = 0
        b = next(i for i in range(1, 300) if not has_edge(plain, a, i))
        mesh = tipp.delaunay_2d(points, edges=[[a, b]])
        self.assertTrue(has_edge(mesh, a, b))
        self.assertEqual(plain.GetNumberOfPolys(), mesh.GetNumberOfPolys())

    def test_edge_source_has_the_ids_of_the_points(self):
        source = tipp.delaunay_2d(SQUARES, polygons=[INNER], marks="lines")
        source.GetPointData().Initialize()
        lines = type(source)()
        lines.SetLines(source.GetLines())
        mesh = tipp.delaunay_2d(SQUARES, edge_source=lines)
        for i in range(4):
            self.assertTrue(has_edge(mesh, INNER[i], INNER[i - 1]))

    def test_crossing_is_a_new_point(self):
        mesh = tipp.delaunay_2d(SQUARES, edges=[[0, 2], [5, 7]], point_data={"depth": np.arange(9.0)})
        self.assertEqual(10, mesh.GetNumberOfPoints())
        self.assertEqual((4, 4, 0), mesh.GetPoint(9))
        self.assertEqual(5, tipp.as_array(mesh, "depth")[9])  # between points 4 and 6, which are on the edge

    def test_crossing_is_refused(self):
        with self.assertRaisesRegex(RuntimeError, "constraint 0 .* crosses constraint 1"):
            tipp.delaunay_2d(SQUARES, edges=[[0, 2], [5, 7]], crossings="refuse")

    def test_marks(self):
        lines = tipp.delaunay_2d(SQUARES, polygons=[INNER], marks="lines")
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
        self.assertEqual(9, mesh.GetNumberOfPoints())
        self.assertEqual(4, area(mesh))

    def test_other_coordinates_are_new_points(self):
        mesh = tipp.delaunay_2d(SQUARES, polygons=[[[1.0, 1.0], [7.0, 1.0], [7.0, 7.0], [1.0, 7.0]]], edges=[[4, 6]])
        self.assertEqual(13, mesh.GetNumberOfPoints())
        self.assertEqual(36, area(mesh))
        self.assertTrue(has_edge(mesh, 4, 6) or has_edge(mesh, 4, 8))

    def test_new_points_keep_the_heights_of_a_polygon(self):
        corners = [[1.0, 1.0, 3.0], [7.0, 1.0, 4.0], [7.0, 7.0, 5.0], [1.0, 7.0, 6.0]]
        mesh = tipp.delaunay_2d(SQUARES, polygons=[corners])
        points = vtk_to_numpy(mesh.GetPoints().GetData())
        self.assertEqual([3, 4, 5, 6], points[9:, 2].tolist())

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
