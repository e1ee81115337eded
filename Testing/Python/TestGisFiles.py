# SPDX-License-Identifier: BSD-3-Clause
"""Points of GIS files, and reference systems of files, in Python."""
import json
import os
import struct
import tempfile
import unittest
import warnings

import numpy as np

import tipp


def las(code, count=None):
    """A LAS 1.2 file of 25 points, with the EPSG code of a projected system; `count`: that of its header."""
    keys = struct.pack("<8H", 1, 1, 0, 1, 3072, 0, 1, code)
    record = b"\0\0" + b"LASF_Projection\0" + struct.pack("<HH", 34735, len(keys)) + bytes(32) + keys
    header = bytearray(227)
    header[:4] = b"LASF"
    header[24:26] = b"\1\2"
    struct.pack_into("<HII", header, 94, 227, 227 + len(record), 1)
    struct.pack_into("<BHI", header, 104, 0, 20, 25 if count is None else count)
    for axis in range(3):
        struct.pack_into("<d", header, 131 + 8 * axis, 1.0)
    points = [struct.pack("<iiiHBBBBH", i % 5, i // 5, i, 0, 9, 2, 0, 0, 0) for i in range(25)]
    return bytes(header) + record + b"".join(points)


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def write(self, name, content):
        path = os.path.join(self.folder, name)
        with open(path, "wb") as file:
            file.write(content)
        return path


class GisPoints(Files):
    def setUp(self):
        super().setUp()
        features = [{"type": "Feature", "properties": {"level": 3 * x + y},
                     "geometry": {"type": "Point", "coordinates": [x, y, 7]}} for x in range(4) for y in range(4)]
        self.path = self.write("wells.geojson",
                               json.dumps({"type": "FeatureCollection", "features": features}).encode())
        try:
            tipp.dem(self.path, 1)
        except RuntimeError as error:
            if "GDAL" not in str(error):
                raise
            self.skipTest(str(error))

    def test_heights_are_z_of_the_points(self):
        dem = tipp.dem(self.path, 1)
        self.assertTrue((dem.array == 7).all())
        self.assertEqual("EPSG:4326", dem.crs)

    def test_heights_are_those_of_an_attribute(self):
        array = tipp.dem(self.path, 1, z="level").array
        self.assertAlmostEqual(3 * 0.5 + 2.5, array[0, 0])

    def test_reference_system_is_named(self):
        self.assertEqual("EPSG:25832", tipp.dem(self.path, 1, crs="EPSG:25832").crs)


class LasFiles(Files):
    def test_files_in_different_systems_need_one_that_is_named(self):
        paths = [self.write("a.las", las(26910)), self.write("b.las", las(26911))]
        with self.assertRaisesRegex(RuntimeError, "another coordinate reference system"):
            tipp.dem(paths, 1)
        self.assertEqual("EPSG:26911", tipp.dem(paths, 1, crs="EPSG:26911").crs)

    def test_points_beyond_the_count_give_a_warning(self):
        path = self.write("a.las", las(26910, 20))
        with self.assertWarnsRegex(RuntimeWarning, "announces 20 points and has room for 25"):
            few = tipp.dem(path, 1)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            all_points = tipp.dem(path, 1, keep=["uncounted"])
        self.assertEqual(((3, 4), (4, 4)), (few.array.shape, all_points.array.shape))

    def test_file_that_ends_early_is_read_on_request(self):
        path = self.write("a.las", las(26910)[:-60])
        with self.assertRaisesRegex(RuntimeError, "keep truncated"):
            tipp.dem(path, 1)
        with self.assertWarnsRegex(RuntimeWarning, "ends after 22"):
            self.assertTrue(np.isfinite(tipp.dem(path, 1, keep=["truncated"]).array).any())


if __name__ == "__main__":
    unittest.main()
