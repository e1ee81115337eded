# SPDX-License-Identifier: BSD-3-Clause
"""Time steps of meshes: tipp.resample_series, tipp.times, and tipp.read of the output of models."""
import importlib.util
import json
import os
import sys
import tempfile
import unittest
from unittest import mock

import numpy as np

import tipp

UNITS = "seconds since 2018-09-01 00:00:00"


def needs(name):
    return unittest.skipUnless(importlib.util.find_spec(name), f"{name} is not installed")


class Series(unittest.TestCase):
    """A unit square whose level is x + 10 * step, dry at the corner (1, 1) in the last step, and whose depth is y."""

    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.surge = self.path("surge")
        os.makedirs(os.path.join(self.surge, "point_data"))
        self.save("cells", np.array([[0, 1, 3], [1, 2, 3]], np.int32))
        self.save("points", np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]]))
        self.save("time", np.array([0.0, 3600, 7200]))
        self.save("point_data/level", np.array([[0, 1, 1, 0], [10, 11, 11, 10], [20, 21, -99999, 20]], np.float32))
        self.save("point_data/depth", np.array([0.0, 0, 1, 1]))
        self.describe(time_units=UNITS, calendar="gregorian", crs="EPSG:32617",
                      point_data={"level": {"units": "m", "long_name": "water level", "missing_value": -99999}})

    def path(self, name):
        return os.path.join(self.temporary.name, name)

    def save(self, name, values):
        np.save(os.path.join(self.surge, name + ".npy"), values)

    def describe(self, **description):
        with open(os.path.join(self.surge, "description.json"), "w", encoding="utf-8") as file:
            json.dump(description, file)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)


class Maps(Series):
    def maps(self, **options):
        return tipp.resample_series(self.surge, **{"dimensions": (5, 3), "return_type": "tipp", **options})

    def test_are_arrays_of_the_steps(self):
        maps = self.maps()
        self.assertEqual((3, 3, 5), maps.arrays["level"].shape)
        self.assertEqual((3, 5), maps.arrays["depth"].shape)
        np.testing.assert_array_equal([0, 0.25, 0.5, 0.75, 1], maps.x)
        np.testing.assert_array_equal([0, 0.5, 1], maps.y)
        np.testing.assert_array_equal(np.broadcast_to(maps.x + 10, (3, 5)), maps.arrays["level"][1])
        np.testing.assert_array_equal(np.broadcast_to(maps.y[:, None], (3, 5)), maps.arrays["depth"])

    def test_are_nan_beside_missing_values(self):
        last = self.maps().arrays["level"][2]
        self.assertTrue(np.isnan(last[2, 4]))
        self.assertEqual(20.25, last[0, 1])

    def test_have_what_the_file_says(self):
        maps = self.maps()
        self.assertEqual((UNITS, "gregorian"), maps.times[1:])
        self.assertEqual({"units": "m", "long_name": "water level"}, maps.attributes["level"])
        self.assertRegex(maps.crs, "UTM|EPSG:32617")  # a code where GDAL is missing

    def test_are_of_the_chosen_steps(self):
        for step, steps in (("all", [0, 1, 2]), ("::2", [0, 2]), ("1:", [1, 2]), ("2:2", [2])):
            maps = self.maps(step=step, arrays="level")
            self.assertEqual(steps, maps.steps.tolist())
            np.testing.assert_array_equal(np.multiply(steps, 3600), maps.times.values)
            self.assertEqual(len(steps), len(maps.arrays["level"]))
            self.assertEqual(["level"], list(maps.arrays))

    def test_of_one_step_have_no_axis_of_steps(self):
        for step in (1, "1"):
            maps = self.maps(step=step)
            self.assertEqual((3, 5), maps.arrays["level"].shape)
            self.assertEqual([3600], maps.times.values.tolist())

    def test_are_reduced(self):
        maps = self.maps(reduce=["max", "above:5"])
        self.assertEqual(["level_max", "level_time_above_5"], list(maps.arrays))
        self.assertEqual(20.25, maps.arrays["level_max"][0, 1])
        self.assertEqual("m", maps.attributes["level_max"]["units"])

    def test_have_a_range_and_a_spacing(self):
        maps = self.maps(bounds=(0.25, 0.75, 0, 1), spacing=0.25, dimensions=None)
        np.testing.assert_array_equal([0.25, 0.5, 0.75], maps.x)
        self.assertEqual(5, len(maps.y))

    def test_take_another_reference_system(self):
        self.assertRegex(self.maps(crs="EPSG:4326").crs, "WGS 84|EPSG:4326")

    def test_of_a_partitioned_mesh_are_the_same(self):
        stored = self.path("surge.tipp")
        tipp.write(self.surge, stored)
        ours, theirs = self.maps(), tipp.resample_series(stored, dimensions=(5, 3), return_type="tipp")
        self.assertEqual(ours.times[1:], theirs.times[1:])
        self.assertEqual(ours.crs, theirs.crs)
        self.assertEqual(ours.attributes, theirs.attributes)
        np.testing.assert_array_equal(ours.arrays["level"], theirs.arrays["level"])

    def test_of_a_mesh_without_steps(self):
        for name in ("time", "point_data/level"):
            os.remove(os.path.join(self.surge, name + ".npy"))
        maps = self.maps()
        self.assertEqual((3, 5), maps.arrays["depth"].shape)
        self.assertEqual(0, len(maps.steps))

    def test_of_steps_that_there_are_not_are_refused(self):
        with self.assertRaisesRegex(RuntimeError, "has no time step 3; there are 3, counted from 0"):
            self.maps(step=3)

    def test_outside_of_the_mesh_are_refused_in_words_of_python(self):
        with self.assertRaisesRegex(RuntimeError, "has nothing in bounds: its nodes have x from 0 to 1"):
            self.maps(bounds=(5, 6, 5, 6))

    def test_warn_of_one_sample(self):
        with self.assertWarnsRegex(RuntimeWarning, "there is one sample, because the distance of samples, 5000"):
            self.maps(spacing=5000)

    def test_without_xarray_say_what_to_install(self):
        with mock.patch.dict(sys.modules, {"xarray": None}):
            with self.assertRaisesRegex(ModuleNotFoundError, "needs xarray, which is not installed; install it with pip"):
                self.maps(return_type="xarray")


@needs("xarray")
class Datasets(Series):
    def dataset(self, **options):
        return tipp.resample_series(self.surge, **{"dimensions": (5, 3), **options})

    def test_have_dates_and_coordinates(self):
        dataset = self.dataset()
        self.assertEqual(("time", "y", "x"), dataset["level"].dims)
        self.assertEqual(("y", "x"), dataset["depth"].dims)
        np.testing.assert_array_equal(
            np.array(["2018-09-01T00", "2018-09-01T01", "2018-09-01T02"], "datetime64[ns]"), dataset["time"].values)
        self.assertEqual("m", dataset["level"].attrs["units"])
        self.assertEqual(10.25, dataset["level"].sel(time="2018-09-01T01:00").sel(x=0.25, y=0))

    def test_of_one_step_have_its_date(self):
        dataset = self.dataset(step=1)
        self.assertEqual(("y", "x"), dataset["level"].dims)
        self.assertEqual(np.datetime64("2018-09-01T01", "ns"), dataset["time"].values)

    def test_describe_times_without_an_origin(self):
        self.describe(time_units="seconds")
        time = self.dataset()["time"]
        np.testing.assert_array_equal([0, 3600, 7200], time.values)
        self.assertEqual("seconds", time.attrs["units"])

    def test_keep_units_of_time_that_are_not_understood(self):
        self.describe(time_units="fortnights since the flood")
        time = self.dataset()["time"]
        np.testing.assert_array_equal([0, 3600, 7200], time.values)
        self.assertEqual("fortnights since the flood", time.attrs["units"])

    def test_refuse_an_array_with_the_name_of_a_coordinate(self):
        self.save("point_data/x", np.zeros(4))
        with self.assertRaisesRegex(RuntimeError, "has an array called 'x'"):
            self.dataset()

    @needs("rioxarray")
    def test_have_a_reference_system_for_rioxarray(self):
        import rioxarray  # noqa: F401  pylint: disable=unused-import

        dataset = self.dataset()
        self.assertEqual(32617, dataset.rio.crs.to_epsg())
        self.assertEqual(32617, dataset["level"].rio.crs.to_epsg())
        np.testing.assert_allclose((-0.125, -0.25, 1.125, 1.25), dataset.rio.bounds())
        self.assertTrue(np.isnan(dataset["level"].rio.nodata))

    @needs("netCDF4")
    def test_are_the_same_from_a_file(self):
        import xarray

        dataset = self.dataset()
        dataset.to_netcdf(self.path("maps.nc"))
        with xarray.open_dataset(self.path("maps.nc"), decode_coords="all") as again:
            np.testing.assert_array_equal(dataset["time"].values, again["time"].values)
            np.testing.assert_array_equal(dataset["level"].values, again["level"].values)


class Steps(Series):
    def test_are_listed_with_their_unit(self):
        times = tipp.times(self.surge)
        np.testing.assert_array_equal([0, 3600, 7200], times.values)
        self.assertEqual((UNITS, "gregorian"), times[1:])

    def test_are_read_by_their_times(self):
        for i, time in enumerate(tipp.times(self.surge).values):
            self.assertEqual(10 * i + 1, tipp.read(self.surge, time=time)["level"].max())

    def test_of_a_mesh_without_steps_are_none(self):
        stored = self.path("points.tipp")
        tipp.write(tipp.delaunay_2d(np.random.default_rng(1).random((20, 2))), stored)
        times = tipp.times(stored)
        self.assertEqual((0, "", ""), (len(times.values), times.units, times.calendar))


class Models(Series):
    def setUp(self):
        super().setUp()
        self.grid = self.write("fort.14", "title\n1 3\n1 178 0 1\n2 -179 0 2\n3 178 5 3\n1 3 1 2 3\n")
        self.level = self.write("fort.63", "title\n2 3 60 1 1\n60 1\n1 1\n2 2\n3 3\n120 2\n1 4\n2 -99999\n3 6\n")

    def test_that_cross_the_meridian_need_wrap(self):
        with self.assertRaisesRegex(RuntimeError, "jump by 360; give wrap=True"):
            tipp.read(self.grid)
        self.assertEqual(2, len(tipp.read(self.grid, wrap=True).cells))

    def test_have_values_in_other_files(self):
        times = tipp.times(self.grid, values=self.level, wrap=True)
        self.assertEqual(([60, 120], "seconds"), (times.values.tolist(), times.units))
        values = tipp.read(self.grid, values=[self.level], wrap=True, time=120)["fort.63"]
        self.assertEqual(4, np.nanmin(values))
        self.assertTrue(np.isnan(values).any())

    def test_alone_take_values_and_wrap(self):
        for options in ({"wrap": True}, {"values": self.level}):
            with self.assertRaisesRegex(RuntimeError, f"which alone takes {next(iter(options))}; leave it out"):
                tipp.read(self.surge, **options)
            with self.assertRaisesRegex(RuntimeError, f"leave out {next(iter(options))}"):
                tipp.resample_series(self.surge, return_type="tipp", **options)


if __name__ == "__main__":
    unittest.main()
