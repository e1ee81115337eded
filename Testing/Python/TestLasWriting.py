# SPDX-License-Identifier: BSD-3-Clause
"""Tests LAS and LAZ files of `tipp points` with laspy and both of its decompressors, lazrs and LASzip.

Usage: TestLasWriting.py TIPP [unittest arguments]
"""
import importlib.util
import os
import struct
import subprocess
import sys
import tempfile
import unittest

import numpy as np

TIPP = os.path.abspath(sys.argv.pop(1))
RANDOM = np.random.default_rng(11)


def missing(*names):
    return [name for name in names if importlib.util.find_spec(name) is None]


def compressed(path):
    """The chunks and their table in a LAZ file, from its points on, without where the table is."""
    with open(path, "rb") as file:
        content = file.read()
    begin = struct.unpack_from("<I", content, 96)[0]
    table = struct.unpack_from("<Q", content, begin)[0]
    return content[begin + 8:table], content[table:]


@unittest.skipIf(missing("laspy"), "laspy is not installed")
class LasWriting(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def copy(self, *words):
        run = subprocess.run([TIPP, "points", *map(str, words), "--keep", "withheld,synthetic,overlap"],
                             cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stderr)
        return run

    def make(self, form, count, extra=True):
        """Points as a scanner gives them: pulses of a constant rate, several returns, two channels."""
        import laspy

        header = laspy.LasHeader(point_format=form, version="1.4")
        header.scales, header.offsets = [0.01, 0.02, 0.001], [500000, 4000000, -10]
        if extra:
            header.add_extra_dim(laspy.ExtraBytesParams("width", np.uint16))
            header.add_extra_dim(laspy.ExtraBytesParams("reflectance", np.float64))
        las = laspy.LasData(header)
        walk = np.cumsum(RANDOM.integers(-40, 50, (3, count), np.int32), axis=1)
        las.X, las.Y, las.Z = walk
        las.intensity = RANDOM.integers(0, 3000, count)
        las.number_of_returns = RANDOM.integers(1, 6, count)
        las.return_number = np.minimum(RANDOM.integers(1, 6, count), np.asarray(las.number_of_returns))
        las.classification = RANDOM.choice([1, 2, 5, 200], count)
        las.scanner_channel = RANDOM.choice([0, 0, 0, 0, 2], count)
        las.scan_direction_flag = np.arange(count) // 100 % 2
        las.overlap = np.arange(count) % 97 == 0
        las.user_data = RANDOM.integers(0, 3, count)
        las.scan_angle = np.arange(count) // 7 % 5000 - 2500
        las.point_source_id = np.arange(count) // 1000
        las.gps_time = 1e8 + np.cumsum(RANDOM.choice([0, 1e-5, 1e-5, 4e-5], count))
        if form >= 7:
            las.red, las.green, las.blue = RANDOM.integers(0, 65536, (3, count))
        if form == 8:
            las.nir = RANDOM.integers(0, 4000, count)
        if extra:
            las["width"] = RANDOM.integers(0, 90, count)
            las["reflectance"] = RANDOM.random(count)
        return las

    def expect_same(self, expected, path, backend=None):
        import laspy

        las = laspy.read(path, laz_backend=backend) if backend else laspy.read(path)
        self.assertEqual(list(las.point_format.dimension_names), list(expected.point_format.dimension_names))
        for name in expected.point_format.dimension_names:
            np.testing.assert_array_equal(las[name], expected[name], name)
        np.testing.assert_array_equal(las.header.scales, expected.header.scales)
        np.testing.assert_array_equal(las.header.offsets, expected.header.offsets)
        if len(las):
            np.testing.assert_allclose(las.header.mins, las.xyz.min(axis=0), rtol=0, atol=1e-9)
            np.testing.assert_allclose(las.header.maxs, las.xyz.max(axis=0), rtol=0, atol=1e-9)
            counts = np.bincount(las.return_number, minlength=16)[1:16]
            np.testing.assert_array_equal(las.header.number_of_points_by_return, counts)

    def test_laspy_reads_what_is_written(self):
        for form in (6, 7, 8):
            for count in (1, 1000):
                with self.subTest(form=form, count=count):
                    las = self.make(form, count)
                    las.write(self.path("a.las"))
                    self.copy("a.las", "-o", "b.las")
                    self.expect_same(las, self.path("b.las"))

    @unittest.skipIf(missing("lazrs"), "lazrs is not installed")
    def test_lazrs_decompresses_what_is_written(self):
        import laspy

        for form in (6, 7, 8):
            for count in (1, 49999, 50001):
                with self.subTest(form=form, count=count):
                    las = self.make(form, count, extra=count != 49999)
                    las.write(self.path("a.las"))
                    self.copy("a.las", "-o", "b.laz")
                    self.expect_same(las, self.path("b.laz"), laspy.LazBackend.Lazrs)

    @unittest.skipIf(missing("laszip"), "laszip is not installed")
    def test_laszip_decompresses_what_is_written(self):
        import laspy

        for form in (6, 7, 8):
            for count in (1, 50001):
                with self.subTest(form=form, count=count):
                    las = self.make(form, count)
                    las.write(self.path("a.las"))
                    self.copy("a.las", "-o", "b.laz")
                    self.expect_same(las, self.path("b.laz"), laspy.LazBackend.Laszip)

    @unittest.skipIf(missing("lazrs"), "lazrs is not installed")
    def test_chunks_are_those_of_lazrs(self):
        import laspy

        for form in (6, 7, 8):
            with self.subTest(form=form):
                self.make(form, 120000).write(self.path("a.laz"), laz_backend=laspy.LazBackend.Lazrs)
                self.copy("a.laz", "-o", "b.laz")
                chunks, table = compressed(self.path("b.laz"))
                expected, their_table = compressed(self.path("a.laz"))
                self.assertEqual(chunks, expected)
                self.assertEqual(table, their_table[:len(table)])

    @unittest.skipIf(missing("lazrs", "pyproj"), "lazrs or pyproj is not installed")
    def test_reference_system_is_read_by_others(self):
        np.save(self.path("points.npy"), RANDOM.random((100, 3)))
        run = subprocess.run([TIPP, "points", "points.npy", "-o", "a.laz", "--crs", "EPSG:25832"], cwd=self.folder,
                             capture_output=True, text=True)
        if "cannot be expressed" in run.stderr:
            self.skipTest("tipp was built without GDAL")
        import laspy

        self.assertEqual(laspy.read(self.path("a.laz")).header.parse_crs().to_epsg(), 25832)


if __name__ == "__main__":
    unittest.main()
