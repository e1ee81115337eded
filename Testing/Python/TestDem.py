# SPDX-License-Identifier: BSD-3-Clause
"""Compares tipp.dem and `tipp dem` with exact arithmetic, with GDAL and with each other.

Usage: TestDem.py TIPP [unittest arguments]
"""
import json
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
from fractions import Fraction

import numpy as np

import tipp

TIPP = os.path.abspath(sys.argv.pop(1))
with open(TIPP, "rb") as tool:
    IS_WHEEL = tool.read(4) != b"\x7fELF"  # a script


def exact_height(corners, x, y):
    """The height at (x, y) of the plane through three points, in rational numbers; None outside their triangle."""
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = [[Fraction(float(v)) for v in p] for p in corners]
    x, y = Fraction(x), Fraction(y)
    area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    u = ((x - ax) * (cy - ay) - (y - ay) * (cx - ax)) / area
    v = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / area
    return az + u * (bz - az) + v * (cz - az) if u >= 0 and v >= 0 and u + v <= 1 else None


def tiff_levels(path):
    """Reads an uncompressed GeoTIFF of float32: for the raster and each overview an array (bands, rows, columns)."""
    with open(path, "rb") as file:
        data = file.read()
    levels, (at,) = [], struct.unpack_from("<I", data, 4)
    while at:
        (count,) = struct.unpack_from("<H", data, at)
        fields = {}
        for entry in range(at + 2, at + 2 + 12 * count, 12):
            tag, kind, number = struct.unpack_from("<HHI", data, entry)
            if kind in (3, 4):
                code = f"<{number}{'HI'[kind - 3]}"
                where = entry + 8 if struct.calcsize(code) <= 4 else struct.unpack_from("<I", data, entry + 8)[0]
                fields[tag] = struct.unpack_from(code, data, where)
        (columns,), (rows,), (side,), (bands,) = (fields[tag] for tag in (256, 257, 322, 277))
        across, down = -(-columns // side), -(-rows // side)
        apart = fields.get(284, (1,))[0] == 2  # bands
        tiles = np.stack([np.frombuffer(data, "<f4", side * side * (1 if apart else bands), offset) for offset in fields[324]])
        tiles = (tiles.reshape(bands, down, across, side, side) if apart
                 else np.moveaxis(tiles.reshape(down, across, side, side, bands), 4, 0))
        levels.append(tiles.transpose(0, 1, 3, 2, 4).reshape(bands, down * side, across * side)[:, :rows, :columns])
        (at,) = struct.unpack_from("<I", data, at + 2 + 12 * count)
    return levels


def thinness(corners):
    """The square of the longest edge, divided by the area."""
    edges = corners - np.roll(corners, 1, axis=0)
    return (edges ** 2).sum(axis=1).max() / abs(np.cross(edges[0], edges[1]) / 2)


class Dem(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.random = np.random.default_rng(4)
        xy = self.random.random((4000, 2)) * 100
        self.points = np.c_[xy, 5 * np.sin(xy[:, 0] / 9) + xy[:, 1] / 7]
        np.save(self.path("points.npy"), self.points)

    def path(self, name):
        return os.path.join(self.folder, name)

    def run_tipp(self, *words):
        run = subprocess.run([TIPP, *map(str, words)], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stderr)
        return run

    def test_pixels_are_those_of_exact_arithmetic(self):
        grid, transform, _ = tipp.dem(self.points, 0.7)
        triangles = tipp.delaunay(self.points)
        corners = self.points[triangles]
        low, high = corners[:, :, :2].min(axis=1), corners[:, :, :2].max(axis=1)
        width, _, west, _, height, north = transform
        checked = 0
        for row, column in self.random.integers(0, grid.shape, (400, 2)):
            x, y = west + 0.5 * width + column * width, north + height * (row + 0.5)
            near = np.flatnonzero((low <= [x + 1e-9, y + 1e-9]).all(axis=1) & (high >= [x - 1e-9, y - 1e-9]).all(axis=1))
            found = [(h, t) for h, t in ((exact_height(corners[t], x, y), t) for t in near) if h is not None]
            self.assertEqual(not found, bool(np.isnan(grid[row, column])))
            if found:
                exact, triangle = found[0]
                # Rounding errors grow as triangles become thinner.
                bound = 1e-14 * (100 + thinness(corners[triangle][:, :2]))
                self.assertLess(abs(Fraction(float(grid[row, column])) - exact), bound)
                checked += 1
        self.assertGreater(checked, 300)

    def test_tool_and_package_make_the_same_pixels(self):
        for options, keywords in (([], {}), (["--bounds", 10, 60, 20, 50], {"bounds": (10, 60, 20, 50)}),
                                  (["--align", "bounds"], {"align": False}), (["--max-edge", 2], {"max_edge": 2})):
            self.run_tipp("dem", "points.npy", "-o", "dem.npy", "--resolution", 0.3, *options)
            for points in (self.points, tipp.delaunay_2d(self.points), self.path("points.npy"), [self.path("points.npy")]):
                grid = tipp.dem(points, 0.3, **keywords).array
                np.testing.assert_array_equal(np.load(self.path("dem.npy"))[::-1], grid, str(options))

    def test_bands_of_triangles_are_those_of_the_tool(self):
        names = ["slope", "aspect", "hillshade", "void", "elevation", "density"]
        bands = tipp.dem(self.points, 0.5, attributes=names, max_edge=4).array
        self.run_tipp("dem", "points.npy", "-o", "dem.npy", "--resolution", 0.5, "--attributes", ",".join(names), "--max-edge", 4)
        np.testing.assert_allclose(bands, np.load(self.path("dem.npy"))[:, ::-1], rtol=1e-12)
        self.assertEqual(set(np.unique(bands[3])), {0.0, 1.0})

    def test_duplicates_and_thinning_are_those_of_the_tool(self):
        self.points[:, :2] = np.round(self.points[:, :2])
        np.save(self.path("points.npy"), self.points)
        grids = []
        for options, keywords in ([(["--duplicates", rule], {"duplicates": rule}) for rule in ("first", "min", "max", "mean")] +
                                  [(["--thin", f"2.5:{rule}"], {"thin": (2.5, rule)}) for rule in ("min", "max", "nearest")]):
            self.run_tipp("dem", "points.npy", "-o", "dem.npy", "--resolution", 0.7, *options)
            for points in (self.points, self.path("points.npy")):
                grids.append(tipp.dem(points, 0.7, **keywords).array)
                np.testing.assert_array_equal(np.load(self.path("dem.npy"))[::-1], grids[-1], str(options))
        self.assertEqual(len({grid.tobytes() for grid in grids}), 7)

    def test_memory_limits_change_nothing(self):
        expected = tipp.dem(self.points, 0.3, attributes=["elevation", "slope"], max_edge=5, thin=(0.5, "max"))
        for points in (self.points, self.path("points.npy")):
            limited = tipp.dem(points, 0.3, attributes=["elevation", "slope"], max_edge=5, thin=(0.5, "max"), memory="1M")
            np.testing.assert_array_equal(expected.array, limited.array)
            self.assertEqual(expected.transform, limited.transform)

    def test_breaklines_and_boundary_are_those_of_the_tool(self):
        line = np.array([[5.0, 5, 3], [50, 60, 3.5], [95, 70, 2]])
        ring = np.array([[10.0, 10], [90, 15], [80, 90], [15, 80]])
        ends = np.c_[line[:-1], line[1:]], np.c_[ring, np.roll(ring, -1, axis=0)]
        for name, header, rows in (("lines.csv", "x1,y1,z1,x2,y2,z2", ends[0]), ("plain.csv", "x1,y1,x2,y2", ends[0][:, [0, 1, 3, 4]]),
                                   ("ring.csv", "x1,y1,x2,y2", ends[1])):
            np.savetxt(self.path(name), rows, "%.17g", ",", header=header, comments="")
        for file, lines in (("lines.csv", line), ("plain.csv", line[:, :2])):
            self.run_tipp("dem", "points.npy", "-o", "dem.npy", "--resolution", 0.5, "--breaklines", file, "--boundary", "ring.csv")
            expected = np.load(self.path("dem.npy"))[::-1]
            for given in ({"breaklines": [lines], "boundary": [ring]},
                          {"breaklines": self.path(file), "boundary": self.path("ring.csv")}):
                np.testing.assert_array_equal(expected, tipp.dem(self.points, 0.5, **given).array)
                np.testing.assert_array_equal(expected, tipp.dem(self.points, 0.5, memory="1M", **given).array)
        shapes = [{"type": kind, "coordinates": at} for kind, at in (
            ("LineString", line.tolist()), ("Polygon", [[*ring.tolist(), ring[0].tolist()]]))]
        for given in ({"breaklines": [shapes[0]], "boundary": [shapes[1]]},
                      {"breaklines": {"type": "GeometryCollection", "geometries": shapes[:1]}, "boundary": shapes[1]}):
            self.assertTrue(np.array_equal(tipp.dem(self.points, 0.5, breaklines=[line], boundary=[ring]).array,
                                           tipp.dem(self.points, 0.5, **given).array, equal_nan=True))
        soft = tipp.dem(self.points, 0.5, breaklines=[line[:, :2]]).array
        for given in ([line], self.path("lines.csv")):
            np.testing.assert_array_equal(soft, tipp.dem(self.points, 0.5, breaklines=given, soft=True).array)
        with self.assertRaisesRegex(ValueError, r"boundary\[0\] has the shape"):
            tipp.dem(self.points, 1, boundary=[ring[:, 0]])

    def write_las(self, name, integers):
        """Writes LAS 1.2 of format 0, with a scale of 0.01."""
        header = bytearray(227)
        struct.pack_into("<4s", header, 0, b"LASF")
        struct.pack_into("<BB", header, 24, 1, 2)
        struct.pack_into("<HIIBHI", header, 94, 227, 227, 0, 0, 20, len(integers))
        struct.pack_into("<6d", header, 131, 0.01, 0.01, 0.01, 1000, 2000, 0)
        bounds = np.stack([integers.max(axis=0), integers.min(axis=0)], axis=1) * 0.01 + [[1000], [2000], [0]]
        struct.pack_into("<6d", header, 179, *bounds.ravel())
        records = np.zeros(len(integers), [("xyz", "<i4", 3), ("intensity", "<u2"), ("bytes", "u1", 6)])
        records["xyz"] = integers
        records["bytes"][:, 1] = 2  # the class
        with open(self.path(name), "wb") as file:
            file.write(header + records.tobytes())

    def test_tiles_share_the_points_on_their_borders(self):
        places = self.random.integers(0, 4000, (20000, 2))
        places[:200, 0] = 2000
        integers = np.c_[places, (places[:, 0] * 7 + places[:, 1] ** 2 // 900) % 3000]
        self.write_las("whole.las", integers)
        self.write_las("west.las", integers[integers[:, 0] <= 2000])
        self.write_las("east.las", integers[integers[:, 0] >= 2000])
        for memory in ([], ["--memory", "2M"]):
            for files in (["whole.las"], ["west.las", "east.las"], ["east.las", "west.las"]):
                self.run_tipp("dem", *files, "-o", files[0] + ".npy", "--resolution", 0.15, "--duplicates", "max", *memory)
                np.testing.assert_array_equal(np.load(self.path("whole.las.npy")), np.load(self.path(files[0] + ".npy")))

    def test_bounds_of_files_have_the_pixels_of_all_points(self):
        integers = self.random.integers(0, 8000, (30000, 3))
        self.write_las("west.las", integers[integers[:, 0] < 2000])
        self.write_las("east.las", integers[integers[:, 0] >= 2000])
        files = [self.path("west.las"), self.path("east.las")]
        points = integers * 0.01 + [1000, 2000, 0]
        for west, south in ((1030, 2040), (1000, 2000), (1022, 2010)):
            bounds = (west, west + 7, south, south + 5)
            np.testing.assert_array_equal(tipp.dem(files, 0.25, bounds=bounds).array, tipp.dem(points, 0.25, bounds=bounds).array)

    def test_attributes_are_bands(self):
        data = {"a": self.points[:, 0] * 2, "b": np.arange(len(self.points)).astype(float)}
        bands = tipp.dem(self.points, 2, attributes=["elevation", "a"], point_data=data)
        self.assertEqual(bands.array.shape, (2, 50, 50))
        x = bands.transform[2] + 2 * (np.arange(50) + 0.5)
        inside = ~np.isnan(bands.array[1])
        np.testing.assert_allclose(bands.array[1][inside], np.broadcast_to(2 * x, (50, 50))[inside], rtol=1e-12)
        with self.assertRaisesRegex(KeyError, "no attribute 'c'"):
            tipp.dem(self.points, 2, attributes="c", point_data=data)

    def test_failures_are_exceptions(self):
        with self.assertRaisesRegex(RuntimeError, "cannot be opened"):
            tipp.dem(self.path("none.las"), 1)
        with self.assertRaisesRegex(ValueError, "no elevation"):
            tipp.dem(self.points[:, :2], 1)

    def test_columns_that_files_lack_are_named_with_those_they_have(self):
        np.savetxt(self.path("named.csv"), self.points, "%.17g", ",", header="x,y,soil", comments="")
        np.savetxt(self.path("heights.csv"), self.points, "%.17g", ",", header="x,y,z", comments="")
        with self.assertRaisesRegex(KeyError, r"no column 'z'; there are \['soil'\]"):
            tipp.dem(self.path("named.csv"), 2)
        with self.assertRaisesRegex(KeyError, r"no column 'Soil'; there are \['soil'\]"):
            tipp.dem(self.path("named.csv"), 2, attributes="Soil")
        with self.assertRaisesRegex(KeyError, r"no column 'soil'; there are \['z'\]"):
            tipp.dem(self.path("heights.csv"), 2, attributes="soil")
        self.assertTrue(np.isfinite(tipp.dem(self.path("named.csv"), 2, attributes="soil").array).any())

    def test_overviews_of_a_cog_have_values_of_their_bands(self):
        names = ["elevation", "aspect", "density", "void"]
        for options in ([], ["--memory", "64M"]):
            words = ["dem", "points.npy", "--resolution", 0.08, "--cog", "--max-edge", 3, "--attributes", ",".join(names),
                     *options]
            self.run_tipp(*words, "-o", "packed.tif")
            with open(self.path("packed.tif"), "rb") as file:
                self.assertIn(b"LAYOUT=IFDS_BEFORE_DATA", file.read(1000))  # GDAL tells this of compressed files only
            self.run_tipp(*words, "-o", "cog.tif", "--compress", "none")
            base, *overviews = tiff_levels(self.path("cog.tif"))
            self.assertEqual([level.shape for level in overviews], [(4, 625, 625), (4, 313, 313)])
            void = base[names.index("void")]
            self.assertTrue(0 < void.mean() < 1)
            for number, overview in enumerate(overviews, 1):
                side = 2 ** number
                padded = np.full((4, side * overview.shape[1], side * overview.shape[2]), np.nan)
                padded[:, :base.shape[1], :base.shape[2]] = np.where(base == -9999, np.nan, base)
                blocks = padded.reshape(4, overview.shape[1], side, overview.shape[2], side).transpose(0, 1, 3, 2, 4)
                blocks = blocks.reshape(*overview.shape, side * side)
                empty = np.isnan(blocks).all(axis=3)
                for band in (0, 2):
                    values = blocks[band][~empty[band]]
                    np.testing.assert_array_equal(overview[band] == -9999, empty[band])
                    np.testing.assert_allclose(overview[band][~empty[band]], np.nanmean(values, axis=1), rtol=1e-6)
                np.testing.assert_array_equal(overview[3], void[::side, ::side])
                angles = np.radians(blocks[1])
                mean = np.degrees(np.arctan2(np.nansum(np.sin(angles), axis=2), np.nansum(np.cos(angles), axis=2)))
                difference = (overview[1] - mean + 180) % 360 - 180
                self.assertLess(np.abs(difference[~empty[1]]).max(), 0.01)
                self.assertTrue((overview[1][empty[1]] == -9999).all())
                self.assertTrue(((overview[1] >= 0) & (overview[1] <= 360))[~empty[1]].all())

    def test_large_values_need_64_bits(self):
        points = self.points.copy()
        points[7, 2] = 1e300
        np.save(self.path("large.npy"), points)
        for options in ([], ["--memory", "64M"], ["--cog"]):
            run = subprocess.run([TIPP, "dem", "large.npy", "-o", "a.tif", "--resolution", "1", *options],
                                 cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(run.returncode, 1)
            self.assertIn("of the band 'elevation' is too large for 32 bits; give --type float64.", run.stderr)
            self.assertFalse(os.path.exists(self.path("a.tif")))
            self.run_tipp("dem", "large.npy", "-o", "b.tif", "--resolution", 1, "--type", "float64", *options)

    def test_rasters_of_their_pixels_are_the_same(self):
        for size, low in ((0.1, 0), (0.05, 500000), (0.333333, 5000000), (0.7, -3)):
            points = self.points + [low, 2 * low, 0]
            grid, transform, _ = tipp.dem(points, size, bounds=(low + 10, low + 14, 2 * low + 20, 2 * low + 23))
            rows, columns = np.indices(grid.shape)
            width, _, west, _, height, north = transform
            centres = np.c_[(west + (columns + 0.5) * width).ravel(), (north + (rows + 0.5) * height).ravel(), grid.ravel()]
            again, other, _ = tipp.dem(centres, size)
            self.assertEqual(other, transform)
            np.testing.assert_allclose(again, grid, atol=1e-6)

    @unittest.skipIf(shutil.which("gdalinfo") is None, "no gdalinfo")
    def test_gdal_reads_what_was_written(self):
        self.run_tipp("dem", "points.npy", "-o", "dem.npy", "--resolution", 0.5)
        self.run_tipp("dem", "points.npy", "-o", "dem.tif", "--resolution", 0.5, "--crs", "EPSG:25832+7837",
                      "--type", "float64", "--nodata", -1)
        info = json.loads(subprocess.run(["gdalinfo", "-json", self.path("dem.tif")], capture_output=True, text=True).stdout)
        self.assertEqual(info["size"], [200, 200])
        self.assertEqual(info["geoTransform"], [0, 0.5, 0, 100, 0, -0.5])
        self.assertIn("COMPOUNDCRS", info["coordinateSystem"]["wkt"])
        band = info["bands"][0]
        self.assertEqual((band["type"], band["noDataValue"], band["description"]), ("Float64", -1, "elevation"))
        subprocess.run(["gdal_translate", "-q", "-of", "ENVI", self.path("dem.tif"), self.path("raw")], check=True)
        raw = np.fromfile(self.path("raw")).reshape(200, 200)
        expected = np.load(self.path("dem.npy"))[::-1]
        np.testing.assert_array_equal(raw, np.where(np.isnan(expected), -1, expected))
        self.assertAlmostEqual(float(band["metadata"][""]["STATISTICS_MINIMUM"]), np.nanmin(expected), 12)
        self.assertAlmostEqual(float(band["metadata"][""]["STATISTICS_STDDEV"]), np.nanstd(expected), 9)

    @unittest.skipIf(IS_WHEEL, "the wheel's tool does not resample")
    @unittest.skipIf(shutil.which("gdalinfo") is None, "no gdalinfo")
    def test_resample_writes_the_same_geotiff(self):
        self.run_tipp("dem", "points.npy", "-o", "dem.tif", "--resolution", 0.5, "--crs", "EPSG:25832")
        self.run_tipp("delaunay", "points.npy", "-o", "mesh.vtu")
        self.run_tipp("resample", "mesh.vtu", "-o", "steps.tif", "--bounds", 0.25, 99.75, 0.25, 99.75, 0, 0, "--delta", 0.5,
                      0.5, 0, "--crs", "EPSG:25832")
        with open(self.path("dem.tif"), "rb") as a, open(self.path("steps.tif"), "rb") as b:
            self.assertEqual(a.read(), b.read())

    def test_long_edges_are_left_out(self):
        xy = self.points[:, :2]
        triangles = tipp.delaunay(xy)
        edges = np.linalg.norm(xy[triangles] - xy[np.roll(triangles, 1, axis=1)], axis=2)
        kept = triangles[(edges <= 2).all(axis=1)]
        self.assertTrue(0 < len(kept) < len(triangles))
        np.testing.assert_array_equal(tipp.delaunay(xy, max_edge=2), kept)
        self.run_tipp("delaunay", "points.npy", "-o", "kept.npy", "--max-edge", 2)
        np.testing.assert_array_equal(np.load(self.path("kept.npy")), kept)
        counted = tipp.delaunay_file(self.path("points.npy"), self.path("mesh.tipp"), memory="1M", max_edge=2)
        self.assertEqual(counted["triangles"], len(kept))
        self.assertEqual(len(tipp.read(self.path("mesh.tipp")).cells), len(kept))

    @unittest.skipIf(shutil.which("gdalinfo") is None, "no gdalinfo")
    def test_pixels_can_be_those_of_another_raster(self):
        self.run_tipp("dem", "points.npy", "-o", "a.tif", "--resolution", 0.5, "--bounds", 3, 40, 5, 30)
        self.run_tipp("dem", "points.npy", "-o", "b.tif", "--like", "a.tif")
        self.run_tipp("dem", "points.npy", "-o", "cog.tif", "--like", "a.tif", "--cog")
        with open(self.path("a.tif"), "rb") as a, open(self.path("b.tif"), "rb") as b:
            self.assertEqual(a.read(), b.read())
        info = json.loads(subprocess.run(["gdalinfo", "-json", self.path("cog.tif")], capture_output=True, text=True).stdout)
        self.assertEqual(info["metadata"]["IMAGE_STRUCTURE"]["LAYOUT"], "COG")


if __name__ == "__main__":
    unittest.main()
