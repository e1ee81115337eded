# SPDX-License-Identifier: BSD-3-Clause
"""Tests files of `tipp dem` with the libraries that users read and write them with: laspy and rasterio.

Usage: TestDemFiles.py TIPP [unittest arguments]
"""
import importlib.util
import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np

TIPP = os.path.abspath(sys.argv.pop(1))
with open(TIPP, "rb") as tool:
    IS_WHEEL = tool.read(4) != b"\x7fELF"  # a script, whose tool has no GDAL
RANDOM = np.random.default_rng(7)

VERSIONS = {"1.1": (0, 1), "1.2": (0, 1, 2, 3), "1.3": (0, 1, 2, 3, 4, 5), "1.4": tuple(range(11))}


def needs(name):
    return unittest.skipIf(importlib.util.find_spec(name) is None, f"{name} is not installed")


class DemFiles(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def run_tipp(self, *words):
        return subprocess.run([TIPP, *map(str, words)], cwd=self.folder, capture_output=True, text=True)

    def dem(self, *words):
        run = self.run_tipp("dem", *words)
        self.assertEqual(run.returncode, 0, run.stderr)

    def save_points(self, count=3000, low=(0, 0), side=100):
        xy = np.asarray(low) + RANDOM.random((count, 2)) * side
        points = np.c_[xy, 5 * np.sin(xy[:, 0] / 9) + xy[:, 1] / 7]
        np.save(self.path("points.npy"), points)
        return points

    @needs("laspy")
    def test_las_files_that_laspy_writes_are_read(self):
        import laspy

        for version, formats in VERSIONS.items():
            for form in formats:
                with self.subTest(version=version, format=form):
                    header = laspy.LasHeader(point_format=form, version=version)
                    header.scales, header.offsets = [0.01, 0.02, 0.001], [500000, 4000000, -10]
                    las = laspy.LasData(header)
                    las.X, las.Y = RANDOM.integers(-5000, 5000, (2, 2000), np.int32)
                    las.Z = RANDOM.integers(-9000, 9000, 2000, np.int32)
                    las.intensity = RANDOM.integers(0, 65536, 2000, np.uint16)
                    las.classification = np.where(np.arange(2000) % 3, 2, 6).astype(np.uint8)
                    las.write(self.path("points.las"))
                    ground = np.arange(2000) % 3 > 0
                    np.save(self.path("ground.npy"), np.c_[las.x, las.y, las.z][ground])
                    self.dem("points.las", "-o", "las.npy", "--resolution", 3, "--class", 2)
                    self.dem("ground.npy", "-o", "npy.npy", "--resolution", 3)
                    if importlib.util.find_spec("lazrs"):
                        las.write(self.path("points.laz"))
                        self.dem("points.laz", "-o", "laz.npy", "--resolution", 3, "--class", 2)
                        np.testing.assert_array_equal(np.load(self.path("laz.npy")), np.load(self.path("las.npy")))
                    np.testing.assert_array_equal(np.load(self.path("las.npy")), np.load(self.path("npy.npy")))
                    self.dem("points.las", "-o", "las.npy", "--resolution", 3, "--attributes", "intensity")
                    self.assertLess(np.nanmax(np.load(self.path("las.npy"))), 65536)

    @needs("rasterio")
    def test_rasterio_reads_what_is_written(self):
        import rasterio

        self.save_points()
        grid = ["--resolution", 0.25, "--attributes", "elevation,slope,void"]
        self.dem("points.npy", "-o", "dem.npy", *grid)
        expected = np.load(self.path("dem.npy"))[:, ::-1]
        for number, options in enumerate((
                [], ["--type", "float64"], ["--compress", "none"], ["--compress", "lzw"], ["--compress", "zstd"], ["--cog"],
                ["--memory", "64M"], ["--memory", "64M", "--type", "float64"], ["--memory", "64M", "--threads", 3])):
            with self.subTest(options=options):
                if IS_WHEEL and options[-1:] in (["lzw"], ["zstd"]):
                    self.skipTest("the wheel has no GDAL")
                path = self.path(f"dem-{number}.tif")
                self.dem("points.npy", "-o", path, *grid, *options, "--crs", "EPSG:25832+7837", "--nodata", -1)
                kind = "float64" if "float64" in options else "float32"
                values = np.where(np.isnan(expected), -1, expected).astype(kind)
                with rasterio.open(path) as raster:
                    np.testing.assert_array_equal(raster.read(), values)
                    self.assertEqual(raster.dtypes, (kind,) * 3)
                    self.assertEqual(raster.nodata, -1)
                    self.assertEqual(raster.descriptions, ("elevation", "slope", "void"))
                    self.assertEqual(tuple(raster.transform)[:6], (0.25, 0, 0, 0, -0.25, 100))
                    self.assertEqual(raster.crs, rasterio.crs.CRS.from_user_input("EPSG:25832+7837"))
                    self.assertEqual(raster.tags()["AREA_OR_POINT"], "Area")
                    tags = raster.tags(1)
                    inside = values[0][values[0] != -1].astype(float)
                    self.assertAlmostEqual(float(tags["STATISTICS_MEAN"]), inside.mean(), 3)
                    self.assertAlmostEqual(float(tags["STATISTICS_STDDEV"]), inside.std(), 3)

    def pixels_beside_others(self):
        """The points, our pixels, and the centres of the pixels."""
        points = self.save_points(5000, (637000, 849000))
        self.dem("points.npy", "-o", "dem.npy", "--resolution", 0.5, "--bounds", 637000, 637100, 849000, 849100)
        x, y = np.meshgrid(637000.25 + 0.5 * np.arange(200), 849000.25 + 0.5 * np.arange(200))
        return points, np.load(self.path("dem.npy")), np.c_[x.ravel(), y.ravel()]

    def expect_near(self, expected, pixels):
        expected = np.reshape(expected, pixels.shape)
        both = ~np.isnan(expected) & ~np.isnan(pixels)
        self.assertGreater(both.mean(), 0.97)
        self.assertLess((np.isnan(expected) != np.isnan(pixels)).mean(), 1e-4)  # pixels at the border may differ
        np.testing.assert_allclose(pixels[both], expected[both], atol=1e-6)

    @needs("scipy")
    def test_pixels_are_those_of_scipy(self):
        from scipy.interpolate import LinearNDInterpolator

        points, pixels, centres = self.pixels_beside_others()
        middle = points[:, :2].mean(axis=0)  # Qhull is not exact
        self.expect_near(LinearNDInterpolator(points[:, :2] - middle, points[:, 2])(centres - middle), pixels)

    @needs("startinpy")
    def test_pixels_are_those_of_startinpy(self):
        import startinpy

        points, pixels, centres = self.pixels_beside_others()
        triangulation = startinpy.DT()
        triangulation.insert(points)
        self.expect_near(triangulation.interpolate({"method": "TIN"}, centres, strict=False), pixels)

    @needs("rasterio")
    def test_a_raster_without_reference_system_keeps_its_position(self):
        import rasterio

        self.save_points(low=(-30, 1000))
        self.dem("points.npy", "-o", "dem.tif", "--resolution", 1)
        with rasterio.open(self.path("dem.tif")) as raster:
            self.assertIsNone(raster.crs)
            self.assertEqual(tuple(raster.transform)[:6], (1, 0, -30, 0, -1, 1100))
            self.assertEqual(raster.shape, (100, 100))

    @needs("rasterio")
    def test_like_uses_exactly_the_transform_of_another_raster(self):
        import rasterio

        points = self.save_points(low=(636000.1, -50), side=80)
        other = np.zeros((100, 197), np.float32)
        transform = rasterio.Affine(0.1, 0, 636010.7, 0, -0.7, 24.37)  # 24.37 - 100 * 0.7 + 100 * 0.7 is less
        with rasterio.open(self.path("other.tif"), "w", driver="GTiff", width=197, height=100, count=1, dtype="float32",
                           crs="EPSG:2992", transform=transform) as raster:
            raster.write(other, 1)
        for options in ([], ["--memory", "8M"]):
            self.dem("points.npy", "-o", "dem.tif", "--like", "other.tif", *options)
            with rasterio.open(self.path("dem.tif")) as raster:
                self.assertEqual(raster.transform, transform)
                self.assertEqual(raster.shape, other.shape)
                self.assertEqual(raster.crs, rasterio.crs.CRS.from_epsg(2992))
                x, y = raster.xy(60, 70)
                self.assertAlmostEqual(raster.read(1)[60, 70], 5 * np.sin(x / 9) + y / 7, delta=0.2)
        self.assertEqual(len(points), 3000)

    def test_files_are_equal_for_any_threads_and_memory(self):
        self.save_points(20000)
        contents = set()
        for options in (["--threads", 1], ["--threads", 4], ["--memory", "2M", "--threads", 1], ["--memory", "4M", "--threads", 4]):
            self.dem("points.npy", "-o", "dem.tif", "--resolution", 0.15, "--attributes", "elevation,density", *options)
            with open(self.path("dem.tif"), "rb") as file:
                contents.add(file.read())
        self.assertEqual(len(contents), 1)

    @needs("rasterio")
    def test_points_across_the_antimeridian_stay_together(self):
        import rasterio

        self.save_points(low=(179.5, -17), side=1)
        self.dem("points.npy", "-o", "dem.tif", "--resolution", 0.01, "--crs", "EPSG:4326")
        with rasterio.open(self.path("dem.tif")) as raster:
            self.assertEqual(raster.bounds.left, 179.5)
            self.assertAlmostEqual(raster.bounds.right, 180.5)

    def test_files_without_points_are_refused(self):
        header = bytearray(227)
        header[:4] = b"LASF"
        header[24:26] = 1, 2
        header[94:96] = header[96:98] = (227).to_bytes(2, "little")
        header[105] = 20
        header[131:155] = np.full(3, 0.01).tobytes()
        with open(self.path("none.las"), "wb") as file:
            file.write(header)
        with open(self.path("none.csv"), "w") as file:
            file.write("x,y,z\n")
        for name in ("none.las", "none.csv"):
            for memory in ([], ["--memory", "8M"]):
                with self.subTest(name=name, memory=memory):
                    run = self.run_tipp("dem", name, "-o", "dem.tif", "--resolution", 1, *memory)
                    self.assertEqual(run.returncode, 1)
                    self.assertRegex(run.stderr, "no point|cannot be made a raster")
                    self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
                    self.assertFalse(os.path.exists(self.path("dem.tif")))


if __name__ == "__main__":
    unittest.main()
