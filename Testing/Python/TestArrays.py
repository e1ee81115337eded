# SPDX-License-Identifier: BSD-3-Clause
"""Arrays of every type and layout are used with their values, or refused in one sentence."""
import importlib.util
import os
import tempfile
import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkPointData

import tipp

COUNT = 60


def random_points(columns=3):
    return np.random.default_rng(3).random((COUNT, columns))


def stored(values):
    """The values of a point array in the mesh."""
    mesh = tipp.delaunay_2d(random_points(), point_data={"v": values})
    return tipp.as_array(mesh, "v")


def coordinates(points):
    """The coordinates of the mesh that is made of these points."""
    return tipp.delaunay_2d(points).points


class Frame:
    """A table with the habits of pandas: a column by its name, and an array of all columns."""

    def __init__(self, columns):
        self._values = dict(columns)
        self.columns = list(self._values)

    def __getitem__(self, name):
        return self._values[name]

    def to_numpy(self):
        return np.column_stack(list(self._values.values()))

    def __array__(self, dtype=None, copy=None):
        return self.to_numpy().astype(dtype)


def frames():
    """The kinds of tables to test."""
    if importlib.util.find_spec("pandas"):
        import pandas

        return [Frame, pandas.DataFrame]
    return [Frame]


class Tables(unittest.TestCase):
    """Tables with named columns, such as pandas' DataFrame."""

    def setUp(self):
        self.x, self.y, self.z = random_points().T
        self.ids = np.arange(1, COUNT + 1)

    def assert_points(self, columns, z=None):
        expected = np.column_stack([self.x, self.y, np.zeros(COUNT) if z is None else z])
        for frame in frames():
            with self.subTest(list(columns), kind=frame.__module__):
                np.testing.assert_array_equal(coordinates(frame(columns)), expected)

    def assert_refused(self, columns, message):
        for frame in frames():
            with self.subTest(list(columns), kind=frame.__module__), self.assertRaisesRegex(ValueError, message):
                tipp.delaunay(frame(columns))

    def test_an_id_is_no_coordinate(self):
        self.assert_points({"id": self.ids, "x": self.x, "y": self.y})
        self.assert_points({"ID": self.ids, "X": self.x, "Y": self.y, "Z": self.z}, self.z)

    def test_coordinates_are_found_by_their_names_in_any_order(self):
        self.assert_points({"Elevation (m)": self.z, "POINT_Y": self.y, "POINT_X": self.x}, self.z)
        self.assert_points({"lat": self.y, "lon": self.x})

    def test_other_columns_are_no_heights(self):
        self.assert_points({"x": self.x, "y": self.y, "class": self.ids})
        self.assert_points({"x": self.x, "y": self.y, "name": np.full(COUNT, "a"), "h": self.z}, self.z)

    def test_two_columns_of_unknown_names_are_x_and_y(self):
        self.assert_points({"a": self.x, "b": self.y})

    def test_numbered_columns_are_taken_by_position(self):
        for names in ((0, 1, 2), (np.int64(1), np.int64(2), np.int64(3)), ("column_0", "column_1", "column_2")):
            self.assert_points(dict(zip(names, (self.x, self.y, self.z))), self.z)

    def test_names_that_do_not_tell_are_refused_with_all_of_them(self):
        message = (r"^points is a table that has the columns id, a, b, and their names do not tell x and y; give the "
                   r"columns of x and y \(and z\) as an array, such as df\[\['a', 'b'\]\]\.to_numpy\(\)\.$")
        self.assert_refused({"id": self.ids, "a": self.x, "b": self.y}, message)
        self.assert_refused({"a": self.x, "b": self.y, "c": self.z}, "the columns a, b, c, and their names")
        self.assert_refused({"id": self.ids, "a": self.x}, "the columns id, a, and their names")

    def test_names_that_tell_twice_are_refused_with_both(self):
        self.assert_refused({"POINT_X": self.x, "GPS_X": self.x, "POINT_Y": self.y},
                            "points is a table that has two columns that may be x, 'POINT_X' and 'GPS_X'; give the")

    def test_the_array_that_the_message_advises_is_accepted(self):
        table = Frame({"a": self.x, "b": self.y, "c": self.z}).to_numpy()
        np.testing.assert_array_equal(coordinates(table), random_points())

    def test_a_dem_has_the_named_heights(self):
        table = {"id": self.ids, "x": self.x, "y": self.y, "z": self.z}
        expected = tipp.dem(random_points(), 0.1).array
        for frame in frames():
            np.testing.assert_array_equal(tipp.dem(frame(table), 0.1).array, expected)

    def test_a_dem_does_not_take_an_unknown_column_as_the_height(self):
        for frame in frames():
            with self.assertRaisesRegex(ValueError, "^points have no elevation"):
                tipp.dem(frame({"x": self.x, "y": self.y, "code": self.ids}), 0.1)

    def test_corners_and_stations_are_found_by_name(self):
        corners = np.array([[0.1, 0.1], [0.9, 0.1], [0.5, 0.9]])
        named = Frame({"id": np.arange(3), "x": corners[:, 0], "y": corners[:, 1]})
        np.testing.assert_array_equal(coordinates_within(named), coordinates_within(corners))
        query = tipp.open(tipp.delaunay_2d(random_points()))
        np.testing.assert_array_equal(query.locate(named)[0], query.locate(corners)[0])

    def test_values_that_are_no_numbers_are_refused_with_the_column(self):
        with self.assertRaisesRegex(TypeError, r"^points\['x'\] is of type .*; give real numbers\.$"):
            tipp.delaunay(Frame({"id": self.ids, "x": np.full(COUNT, "a"), "y": self.y}))

    def test_integers_beside_other_numbers_are_not_rounded(self):
        large = self.ids + 2**53
        with self.assertRaisesRegex(ValueError, r"integers beyond 2\*\*53"):
            tipp.delaunay(Frame({"x": large, "y": self.y}))


def coordinates_within(polygon):
    return tipp.delaunay_2d(random_points(), polygons=[polygon]).points


class PointData(unittest.TestCase):
    def test_every_type_of_number_keeps_its_values_in_either_byte_order(self):
        for kind in ("i1", "i2", "i4", "i8", "u1", "u2", "u4", "u8", "f2", "f4", "f8", "?"):
            values = (np.arange(COUNT) - (0 if kind[0] == "u" else 20)).astype(kind)
            for order in "<>":
                np.testing.assert_array_equal(stored(values.astype(values.dtype.newbyteorder(order))), values)

    def test_types_of_equal_size_keep_their_values(self):
        for kind in (np.longlong, np.ulonglong, np.intc, np.int_):
            np.testing.assert_array_equal(stored(np.arange(COUNT, dtype=kind)), np.arange(COUNT))

    def test_layouts_in_memory_keep_their_values(self):
        base = np.arange(4.0 * COUNT).reshape(COUNT, 4)
        for values in (base[:, 1], base[::-1], base[:, ::-1], base[:, 1:3], np.asfortranarray(base), base.tolist(),
                       np.broadcast_to(1.5, COUNT), base.astype(">f4")[::-1, ::2]):
            np.testing.assert_array_equal(stored(values), values)

    def test_memory_that_is_read_only_is_not_shared(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "v.npy")
            np.save(file, np.arange(COUNT))
            values = stored(np.load(file, mmap_mode="r"))
        values[0] = 7
        self.assertEqual(values[0], 7)

    def test_masked_floats_are_nan(self):
        for kind in ("f2", "f4", ">f8"):
            values = np.ma.masked_equal(np.arange(COUNT).astype(kind), 5)
            np.testing.assert_array_equal(np.flatnonzero(np.isnan(stored(values))), [5])

    def test_masked_integers_are_refused_and_unmasked_ones_accepted(self):
        values = np.ma.masked_equal(np.arange(COUNT), 5)
        with self.assertRaisesRegex(ValueError, r"^point_data\['v'\] has masked entries .* filled\(-1\)"):
            stored(values)
        np.testing.assert_array_equal(stored(np.ma.array(np.arange(COUNT))), np.arange(COUNT))

    def test_values_that_are_not_real_numbers_are_refused(self):
        for values in (np.zeros(COUNT, complex), np.zeros(COUNT, object), np.full(COUNT, "a"), np.full(COUNT, b"a"),
                       np.zeros(COUNT, "M8[s]"), np.zeros(COUNT, "m8[s]"), np.zeros(COUNT, [("a", "f8")]),
                       [None] * COUNT, "text"):
            with self.assertRaisesRegex(TypeError, r"^point_data\['v'\] is of type .*; give real numbers\.$"):
                stored(values)

    def test_a_long_double_is_refused(self):
        if np.dtype(np.longdouble).itemsize == 8:
            self.skipTest("a long double is a double here")
        with self.assertRaisesRegex(TypeError, r"^point_data\['v'\] is of type .*astype"):
            stored(np.zeros(COUNT, np.longdouble))

    def test_wrong_shapes_are_refused(self):
        for values in (np.float64(3), np.zeros((COUNT, 2, 2)), np.zeros((COUNT, 0)), np.zeros(0), [[1, 2], [3]]):
            with self.assertRaisesRegex(ValueError, r"^point_data\['v'\] "):
                stored(values)


class TooFewValues(unittest.TestCase):
    """Arrays of data sets, which are not checked when they are added."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.output = os.path.join(folder.name, "mesh.tipp")
        self.corners = np.array([[0.2, 0.2], [0.8, 0.3], [0.5, 0.7]])

    def mesh(self, of_cells=False, name="short"):
        mesh = tipp.delaunay_2d(random_points(), return_type="vtk")
        array = vtkUnsignedCharArray()
        array.SetName(name)
        array.SetNumberOfTuples(2)
        (mesh.GetCellData() if of_cells else mesh.GetPointData()).AddArray(array)
        return mesh

    def test_are_refused_by_every_function_with_the_name(self):
        functions = {"open": tipp.open, "resample": tipp.resample, "write": lambda mesh: tipp.write(mesh, self.output)}
        of_points = {"delaunay_2d": lambda mesh: tipp.delaunay_2d(mesh, polygons=[self.corners]),
                     "dem": lambda mesh: tipp.dem(mesh, 0.1, attributes="short"),
                     "crossings": lambda mesh: tipp.delaunay_2d(mesh, edges=[[0, 1], [2, 3], [4, 5], [6, 7], [8, 9]])}
        for of_cells in (False, True):
            for name, function in {**functions, **({} if of_cells else of_points)}.items():
                with self.subTest(name, of_cells=of_cells), self.assertRaisesRegex(
                        RuntimeError, f"array 'short' has 2 values for [0-9]+ {'cells' if of_cells else 'points'}"):
                    function(self.mesh(of_cells))

    def test_are_refused_in_marks_of_ghosts(self):
        for function in (tipp.open, tipp.resample):
            with self.assertRaisesRegex(RuntimeError, "array 'vtkGhostType' has 2 values"):
                function(self.mesh(True, "vtkGhostType"))

    def test_are_refused_in_polygons_of_a_query(self):
        if not hasattr(tipp.vtkPartitionedMeshQuery, "ZoneStatistics"):
            self.skipTest("the wheel's class has no ZoneStatistics")
        query = tipp.vtkPartitionedMeshQuery()
        query.SetSourceData(tipp.delaunay_2d(random_points(), return_type="vtk"))
        errors = []

        def on_error(_object, _event, text):
            errors.append(text)

        on_error.CallDataType = "string0"
        query.AddObserver("ErrorEvent", on_error)
        self.assertEqual(0, query.ZoneStatistics(self.mesh(True, "IsHole"), "elevation", 0, 0.0, vtkPointData()))
        self.assertIn("'IsHole' has 2 values", errors[0])


class Points(unittest.TestCase):
    def test_every_type_of_number_keeps_its_values_in_either_byte_order(self):
        p = np.random.default_rng(3).integers(0, 100, (COUNT, 3))
        for kind in ("i1", "i2", "i4", "i8", "u1", "u2", "u4", "u8", "f2", "f4", "f8"):
            for order in "<>":
                np.testing.assert_array_equal(coordinates(p.astype(np.dtype(kind).newbyteorder(order))), p)

    def test_a_masked_coordinate_rejects_its_point(self):
        p = np.ma.array(random_points(2))
        p[7, 1] = np.ma.masked
        whole = np.ma.array(np.arange(2 * COUNT).reshape(COUNT, 2) ** 2 % 97)
        whole[7] = np.ma.masked
        for points in (p, whole):
            with self.assertWarnsRegex(RuntimeWarning, "1 of 60 points .* the first is point 7"):
                triangles = tipp.delaunay(points)
            self.assertFalse((triangles == 7).any())

    def test_a_masked_height_is_nan(self):
        p = np.ma.array(random_points())
        p[7, 2] = np.ma.masked
        self.assertTrue(np.isnan(coordinates(p)[7, 2]))

    def test_integers_that_a_double_cannot_hold_are_refused(self):
        for kind in (np.int64, np.uint64):
            p = np.random.default_rng(3).integers(0, 100, (COUNT, 2)).astype(kind)
            p[3, 0] = 2**53
            np.testing.assert_array_equal(coordinates(p)[:, :2], p)
            p[3, 0] = 2**53 + 1
            p[4, 1] = np.iinfo(kind).max
            with self.assertRaisesRegex(ValueError, r"^points have 2 integers beyond 2\*\*53 .* subtract an offset"):
                tipp.delaunay(p)

    def test_memory_that_is_read_only_is_not_shared(self):
        p = random_points()
        p.flags.writeable = False
        np.testing.assert_array_equal(coordinates(p), p)
        self.assertNotEqual(coordinates(p).__array_interface__["data"][0], p.__array_interface__["data"][0])

    def test_values_that_are_not_real_numbers_are_refused(self):
        for kind in (complex, object, "U3", "S3", "M8[s]", [("a", "f8")], bool, np.longdouble):
            if np.dtype(kind) != np.float64:
                with self.assertRaisesRegex(TypeError, "^points (is|are) of type"):
                    tipp.delaunay(np.zeros((COUNT, 2), kind))

    def test_wrong_shapes_are_refused(self):
        for points in (3.5, np.zeros(4), np.zeros((4, 1)), np.zeros((4, 4)), np.zeros((2, 2, 2)), [[1, 2], [3]], []):
            with self.assertRaisesRegex(ValueError, "^points "):
                tipp.delaunay(points)

    def test_no_points_have_no_triangles(self):
        with self.assertWarnsRegex(RuntimeWarning, "No triangles"):
            self.assertEqual(tipp.delaunay(np.zeros((0, 2))).shape, (0, 3))


if __name__ == "__main__":
    unittest.main()
