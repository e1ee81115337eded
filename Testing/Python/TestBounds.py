# SPDX-License-Identifier: BSD-3-Clause
"""Ranges have one order everywhere, and those that are probably in another one are refused."""
import os
import tempfile
import types
import unittest
from collections import namedtuple

import numpy as np

import tipp

# Heights on a rectangle, whose sides are far from each other so that no order of numbers can be mistaken.
RNG = np.random.default_rng(4)
POINTS = np.column_stack([500_000 + 100 * RNG.random(3000), 4_900_000 + 200 * RNG.random(3000), RNG.random(3000)])
PART = (500_020, 500_040, 4_900_050, 4_900_090)
GDAL = (500_020, 4_900_050, 500_040, 4_900_090)


def library(name, **members):
    """An object of a class of another library."""
    return type("Thing", (), {"__module__": f"{name}.part", **members})()


def same_ranges():
    """PART in every form that functions accept."""
    west, east, south, north = PART
    box = namedtuple("BoundingBox", "left bottom right top")(west, south, east, north)
    image = tipp.Image((west, south, 0), (east - west, north - south, 1), (2, 2, 1))
    return {
        "tuple": PART, "list": list(PART), "array": np.array(PART), "six": (*PART, 0, 1), "named": named(PART),
        "rasterio's box": box, "rasterio's raster": library("rasterio", bounds=box),
        "Shapely": library("shapely", bounds=(west, south, east, north)),
        "GeoPandas": library("geopandas", total_bounds=np.array([west, south, east, north])),
        "rioxarray": library("xarray", rio=types.SimpleNamespace(bounds=lambda: (west, south, east, north))),
        "image": image,
    }


def named(bounds):
    west, east, south, north = bounds
    return tipp.Bounds(west=west, south=south, east=east, north=north)


class Bounds(unittest.TestCase):
    def test_sides_are_named(self):
        box = tipp.Bounds(west=0, south=10, east=5, north=20)
        self.assertEqual((0, 5, 10, 20), box.bounds)
        self.assertEqual((0, 10, 5, 20), box.extent)
        self.assertEqual(box, tipp.Bounds(north=20, east=5, south=10, west=0))
        with self.assertRaises(TypeError):
            tipp.Bounds(0, 10, 5, 20)
        with self.assertRaises(AttributeError):
            box.west = 3

    def test_sides_in_the_wrong_order_or_no_numbers_are_refused(self):
        with self.assertRaisesRegex(ValueError, "^the range is from west 5 to east 0 "):
            tipp.Bounds(west=5, south=0, east=0, north=1)
        with self.assertRaisesRegex(ValueError, "^north is nan"):
            tipp.Bounds(west=0, south=0, east=1, north=float("nan"))
        with self.assertRaisesRegex(TypeError, "^south is '0'"):
            tipp.Bounds(west=0, south="0", east=1, north=1)


class Functions(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = os.path.join(cls.folder.name, "mesh.tipp")
        cls.mesh = tipp.delaunay_2d(POINTS, point_data={"height": POINTS[:, 2]})
        tipp.write(cls.mesh, cls.path, tiling="grid:3x3")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def results(self, bounds):
        """What each function makes of a range, as arrays."""
        with tipp.open(self.mesh) as opened:
            found = [opened.cells_in(box=bounds), opened.points_in(box=bounds)]
        return [*found, tipp.dem(POINTS, 1.0, bounds=bounds).array, tipp.read(self.path, bounds).points,
                tipp.resample(self.mesh, bounds, (20, 40))["height"]]

    def test_every_form_of_a_range_means_the_same(self):
        expected = self.results(PART)
        self.assertTrue(all(part.size for part in expected))
        for name, bounds in same_ranges().items():
            with self.subTest(name):
                for part, due in zip(self.results(bounds), expected):
                    np.testing.assert_array_equal(part, due)

    def test_a_range_in_the_order_of_gdal_is_refused_with_both_boxes(self):
        for function in (lambda: tipp.dem(POINTS, 1.0, bounds=GDAL), lambda: tipp.read(self.path, GDAL),
                         lambda: tipp.resample(self.mesh, GDAL, (20, 40))):
            with self.assertRaisesRegex(RuntimeError, "the bounds, x from 500020 to 4900050 and y from 500040 to 4900090, "
                                        "are more than ten times as long along x as those of the points, x from 50000.*; "
                                        "give bounds in the order xmin xmax ymin ymax"):
                function()

    def test_a_range_that_does_not_meet_the_points_is_refused_with_both_boxes(self):
        beside = (0, 50, 4_900_000, 4_900_200)
        for function in (lambda: tipp.dem(POINTS, 1.0, bounds=beside), lambda: tipp.read(self.path, beside),
                         lambda: tipp.resample(self.mesh, beside, (20, 40))):
            with self.assertRaisesRegex(RuntimeError, "the bounds, x from 0 to 50 .* do not meet those of the points, x from 5"):
                function()

    def test_a_range_up_to_ten_times_as_long_is_filled(self):
        larger = (499_900, 500_200, 4_899_500, 4_900_500)
        self.assertEqual((1000, 300), tipp.dem(POINTS, 1.0, bounds=larger).array.shape)
        self.assertEqual(len(self.mesh.cells), len(tipp.read(self.path, larger).cells))
        self.assertTrue(tipp.resample(self.mesh, larger, (300, 1000))["vtkValidPointMask"].any())

    def test_another_number_of_bounds_is_refused(self):
        for bounds in ((), PART[:3], (*PART, 0), (*PART, 0, 1, 2)):
            for function in (lambda: tipp.dem(POINTS, 1.0, bounds=bounds), lambda: tipp.read(self.path, bounds),
                             lambda: tipp.resample(self.mesh, bounds)):
                with self.assertRaisesRegex(ValueError, rf"^bounds has {len(bounds)} bounds; give 4 or 6: \(xmin, xmax, ymin"):
                    function()

    def test_objects_whose_order_is_unknown_are_refused(self):
        for thing in (library("mylib", bounds=PART), types.SimpleNamespace(bounds=PART), object()):
            with self.assertRaisesRegex(TypeError, "^bounds is of type .*; give .*a tipp.Bounds, or a data set"):
                tipp.read(self.path, thing)

    def test_an_xarray_object_without_rioxarray_is_refused_with_advice(self):
        with self.assertRaisesRegex(TypeError, "^bounds is an xarray object, .* import rioxarray"):
            tipp.read(self.path, library("xarray"))

    def test_a_range_from_high_to_low_is_refused(self):
        for bounds, axis in (((1, 0, 0, 1), "x"), ((0, 1, 1, 0), "y")):
            with self.assertRaisesRegex(ValueError, f"^bounds are from 1 to 0 along {axis}; give the lower one first"):
                tipp.read(self.path, bounds)

    def test_a_range_may_be_open_when_reading(self):
        self.assertEqual(len(self.mesh.cells), len(tipp.read(self.path, (-np.inf, np.inf, 0, np.inf)).cells))


class Tetrahedra(unittest.TestCase):
    """Meshes whose cells are located by z, too."""

    def setUp(self):
        corners = np.array([[0.0, 0, 5], [1, 0, 5], [0, 1, 5], [0, 0, 6], [1, 1, 6]])
        self.mesh = tipp.Mesh(corners, np.array([[0, 1, 2, 3], [1, 2, 3, 4]]), {"x": corners[:, 0]})

    def test_a_range_without_z_has_that_of_the_mesh(self):
        image = tipp.resample(self.mesh, (0, 1, 0, 1), (5, 5, 3))
        self.assertEqual((0, 1, 0, 1, 5, 6), image.bounds)
        with tipp.open(self.mesh) as opened:
            self.assertEqual([0, 1], opened.cells_in(box=(0, 1, 0, 1)).tolist())
            self.assertEqual([], opened.cells_in(box=(0, 1, 0, 1, 0, 1)).tolist())

    def test_a_range_without_z_reads_every_z(self):
        with tempfile.TemporaryDirectory() as folder:
            tipp.write(self.mesh, f"{folder}/mesh.tipp", tiling="grid:1x1x1")
            self.assertEqual(2, len(tipp.read(f"{folder}/mesh.tipp", (0, 1, 0, 1)).cells))

    def test_a_range_above_the_mesh_is_refused(self):
        with self.assertRaisesRegex(RuntimeError, "z from 7 to 8, do not meet .* z from 5 to 6; .* zmin zmax"):
            tipp.resample(self.mesh, (0, 1, 0, 1, 7, 8), (5, 5, 3))


if __name__ == "__main__":
    unittest.main()
