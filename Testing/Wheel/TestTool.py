# SPDX-License-Identifier: BSD-3-Clause
"""The command `tipp` of the wheel. If the variable TIPP_CXX names the C++ tool, the two are compared.

Usage: TestTool.py TIPP [unittest arguments]
"""
import importlib.util
import os
import pathlib
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

import numpy as np

TIPP = os.path.abspath(sys.argv.pop(1))
CXX = os.environ.get("TIPP_CXX")
RANDOM = np.random.default_rng(3)


def fields_of(path):
    """The fields of each directory of a TIFF file: the numbers of each tag, and the bytes of texts."""
    data = pathlib.Path(path).read_bytes()
    directories, (at,) = [], struct.unpack_from("<I", data, 4)
    while at:
        (count,) = struct.unpack_from("<H", data, at)
        fields = {}
        for entry in range(at + 2, at + 2 + 12 * count, 12):
            tag, kind, number = struct.unpack_from("<HHI", data, entry)
            code = f"<{number}{ {2: 's', 3: 'H', 4: 'I', 12: 'd'}[kind]}"
            where = entry + 8 if struct.calcsize(code) <= 4 else struct.unpack_from("<I", data, entry + 8)[0]
            values = struct.unpack_from(code, data, where)
            fields[tag] = values[0] if kind == 2 else values
        directories.append(fields)
        (at,) = struct.unpack_from("<I", data, at + 2 + 12 * count)
    return directories


def geo_keys(path):
    keys = fields_of(path)[0].get(34735, ())
    return {keys[i]: keys[i + 3] for i in range(4, len(keys), 4)}


def las_records(records):
    """The variable length records of a LAS file: pairs of a record id of LASF_Projection and its data."""
    return b"".join(struct.pack("<H16sHH32s", 0, b"LASF_Projection", number, len(data), b"") + data for number, data in records)


def las_file(points, records):
    """A LAS 1.2 file of point format 0."""
    extra = las_records(records)
    whole = np.round(points / 0.001).astype("<i4")
    head = b"LASF" + struct.pack("<HHI", 0, 0, 0) + bytes(12) + bytes([1, 2]) + bytes(64) + struct.pack(
        "<HHHIIBHI5I", 1, 2024, 227, 227 + len(extra), len(records), 0, 20, len(points), len(points), 0, 0, 0, 0)
    bounds = [value for axis in range(3) for value in (whole[:, axis].max() * 0.001, whole[:, axis].min() * 0.001)]
    head += struct.pack("<3d3d6d", 0.001, 0.001, 0.001, 0, 0, 0, *bounds)
    body = np.zeros(len(points), [("xyz", "<i4", 3), ("rest", "V8")])
    body["xyz"] = whole
    return head + extra + body.tobytes()


def image_file(extent, point_data, cell_data, spacing="0.25 2 0.5"):
    """A .vti file with appended raw data."""
    sections, data = "", b""
    for section, arrays in (("PointData", point_data), ("CellData", cell_data)):
        elements = ""
        for name, values in arrays.items():
            kind = {"f": "Float", "i": "Int", "u": "UInt"}[values.dtype.kind] + str(8 * values.itemsize)
            columns = values.shape[1] if values.ndim > 1 else 1
            elements += f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{columns}" format="appended" offset="{len(data)}"/>'
            data += struct.pack("<Q", values.nbytes) + values.tobytes()
        sections += f"<{section}>{elements}</{section}>"
    head = ('<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian" header_type="UInt64">'
            f'<ImageData WholeExtent="{extent}" Origin="0.5 -1 3" Spacing="{spacing}"><Piece Extent="{extent}">{sections}</Piece></ImageData>'
            '<AppendedData encoding="raw">_')
    return head.encode() + data + b"</AppendedData></VTKFile>"


class Tool(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        xy = RANDOM.random((3000, 2)) * 100
        self.points = np.c_[xy, 5 * np.sin(xy[:, 0] / 9) + xy[:, 1] / 7]
        np.save(self.folder / "points.npy", self.points)

    def run_words(self, *words, tool=(TIPP,), **more):
        return subprocess.run([*tool, *map(str, words)], cwd=self.folder, capture_output=True, text=True, **more)

    def run_tipp(self, *words, **more):
        run = self.run_words(*words, **more)
        self.assertEqual(run.returncode, 0, run.stderr)
        return run

    def refused(self, *words, code=1, **more):
        """The sentence of a run that fails."""
        run = self.run_words(*words, **more)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
        return run.stderr

    def dem(self, *words):
        return self.run_tipp("dem", "points.npy", "--resolution", 1, *words)

    def test_the_package_runs_the_same_command(self):
        module = (sys.executable, "-m", "tipp")
        for words in (["--version"], ["dem", "--help"], ["dem"], ["nothing"]):
            first, second = self.run_words(*words), self.run_words(*words, tool=module)
            self.assertEqual((first.returncode, first.stdout, first.stderr), (second.returncode, second.stdout, second.stderr))

    def test_the_command_does_not_import_numpy(self):
        code = "import sys, tipp.__main__; sys.argv[1:] = ['--version']; tipp.__main__.main(); assert 'numpy' not in sys.modules"
        subprocess.run([sys.executable, "-c", code], check=True, capture_output=True)

    def test_usage_errors_and_failures_have_their_codes(self):
        self.assertIn("tipp: there is no command 'nothing'", self.refused("nothing", code=2))
        self.assertIn("--resolution: or --like is required", self.refused("dem", "points.npy", "-o", "a.npy", code=2))
        self.assertIn("tipp: absent.npy: ", self.refused("info", "absent.npy"))

    def test_names_of_files_need_not_be_text(self):
        path = os.fsencode(self.folder) + b"/\xff.npy"
        with open(path, "wb") as file:
            np.save(file, self.points)
        run = subprocess.run([os.fsencode(TIPP), b"delaunay", path, b"-o", path + b".npy"], capture_output=True)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertTrue(os.path.exists(path + b".npy"))

    def test_ctrl_c_ends_a_run_without_an_output(self):
        np.save(self.folder / "many.npy", RANDOM.random((10_000_000, 3)))
        with subprocess.Popen([TIPP, "dem", "many.npy", "-o", "a.npy", "--resolution", "0.001"], cwd=self.folder,
                              stderr=subprocess.PIPE, text=True) as run:
            time.sleep(0.7)
            run.send_signal(signal.SIGINT)
            _, said = run.communicate(timeout=60)
        self.assertEqual((run.returncode, said), (130, "tipp: interrupted; nothing was written.\n"))
        self.assertEqual(sorted(os.listdir(self.folder)), ["many.npy", "points.npy"])

    def test_a_reader_that_ends_early_ends_the_command(self):
        run = subprocess.run(f"{TIPP} dem --help | true; echo ${{PIPESTATUS[0]}}", shell=True, executable="/bin/bash",
                             capture_output=True, text=True)
        self.assertIn(run.stdout, ("0\n", f"{128 + signal.SIGPIPE}\n"))
        self.assertEqual(run.stderr, "")

    def test_ranks_are_refused_once(self):
        said = [self.run_words("delaunay", "points.npy", "-o", "a.npy", env={**os.environ, "OMPI_COMM_WORLD_RANK": rank})
                for rank in "01"]
        self.assertIn("works on one rank", said[0].stderr)
        self.assertEqual([run.stderr.count("\n") for run in said], [1, 0])

    def test_files_of_vtk_are_refused_with_what_reads_them(self):
        (self.folder / "a.vtk").write_text("# vtk DataFile Version 3.0\n")
        for words in (["delaunay", "a.vtk", "-o", "a.npy"], ["flatten", "a.vtk", "-o", "b"],
                      ["partition", "a.vtk", "-o", "b.tipp"], ["query", "points.npy", "a.vtk", "-o", "b.csv"]):
            self.assertIn("pyvista.read('a.vtk')", self.refused(*words), words)

    def test_lines_beside_triangles_are_named_where_numbers_of_cells_matter(self):
        lines = self.folder / "lines.csv"
        lines.write_text("x1,y1,x2,y2\n10,10,80,80\n")
        self.run_tipp("delaunay", "points.npy", "-o", "c.vtp", "--constraints", lines)
        content = (self.folder / "c.vtp").read_bytes()
        line = content.replace(b'NumberOfVerts="0"', b'NumberOfVerts="1"')
        (self.folder / "c.vtp").write_bytes(line)
        for words in (["query", "points.npy", "c.vtp", "-o", "b.csv"], ["partition", "c.vtp", "-o", "b.tipp"], ["flatten", "c.vtp", "-o", "b"]):
            self.assertIn("c.vtp", self.refused(*words), words)

    def test_a_mesh_that_is_not_there_is_reported_as_such(self):
        for words in (["flatten", "a.vtu", "-o", "b"], ["query", "points.npy", "a.vtu", "-o", "b.csv"], ["delaunay", "a.vtp", "-o", "b.npy"]):
            self.assertNotIn("VTK", self.refused(*words), words)

    def test_a_device_is_replaced_with_one_sentence(self):
        self.run_tipp("delaunay", "points.npy", "-o", "a.vtu")
        run = self.run_tipp("resample", "a.vtu", "-o", "a.npy", "--dims", 8, 8, "--device", "opencl")
        self.assertIn("built without OpenCL", run.stderr)
        self.assertEqual(run.stderr.count("\n"), 1)

    def test_samples_are_the_same_in_parts(self):
        self.run_tipp("delaunay", "points.npy", "-o", "m.tipp", "--memory", "8M")
        images = []
        for number, options in enumerate(([], ["--memory", "100K"], ["--memory", "1K", "--threads", 1])):
            self.run_tipp("resample", "m.tipp", "-o", f"{number}.vti", "--dims", 60, 50, *options)
            images.append((self.folder / f"{number}.vti").read_bytes())
        self.assertEqual(images, [images[0]] * 3)

    def test_samples_of_a_plane_are_its_heights(self):
        points = self.points.copy()
        points[:, 2] = 2 * points[:, 0] - points[:, 1]
        np.save(self.folder / "plane.npy", points)
        self.run_tipp("delaunay", "plane.npy", "-o", "plane.vtu")
        self.run_tipp("resample", "plane.vtu", "-o", "a.npy", "--bounds", 40, 60, 40, 60, "--dims", 21, 11)
        x, y = np.meshgrid(np.linspace(40, 60, 21), np.linspace(40, 60, 11))
        np.testing.assert_allclose(np.load(self.folder / "a.npy"), 2 * x - y, atol=1e-12)

    def test_faults_of_a_mesh_are_found(self):
        self.run_tipp("delaunay", "points.npy", "-o", "a.npy")
        self.assertIn("correct", self.run_tipp("check", "points.npy", "a.npy", "--tie-rule").stdout)
        triangles = np.load(self.folder / "a.npy")
        for name, content in (("lost.npy", triangles[1:]), ("turned.npy", np.r_[triangles[:1, ::-1], triangles[1:]])):
            np.save(self.folder / name, content)
            run = self.run_words("check", "points.npy", name)
            self.assertEqual(run.returncode, 1)
            self.assertIn("FAULTY", run.stdout)

    def test_points_on_circles_are_checked_exactly(self):
        x, y = np.meshgrid(np.arange(30), np.arange(30))
        np.save(self.folder / "grid.npy", np.c_[x.ravel(), y.ravel(), np.zeros(900)] * 0.1)
        self.run_tipp("delaunay", "grid.npy", "-o", "a.npy")
        self.assertIn("co-circular ties: correct", self.run_tipp("check", "grid.npy", "a.npy", "--tie-rule").stdout)

    def test_codes_of_epsg_need_no_other_package(self):
        for crs, keys in (("EPSG:25832", {1024: 1, 1025: 1, 3072: 25832}), ("EPSG:4326", {1024: 2, 1025: 1, 2048: 4326}),
                          ("EPSG:25832+7837", {1024: 1, 1025: 1, 3072: 25832, 4096: 7837}),
                          ("EPSG:4979", {1024: 2, 1025: 1, 2048: 4979}), ("EPSG:2056+5728", {1024: 1, 1025: 1, 3072: 2056, 4096: 5728})):
            self.dem("-o", "a.tif", "--crs", crs)
            self.assertEqual(geo_keys(self.folder / "a.tif"), keys, crs)

    def test_wkt_of_a_user_gives_its_code(self):
        wkt = 'PROJCS["x", GEOGCS["y", AUTHORITY["EPSG","4258"]], PARAMETER["a",1], AUTHORITY["EPSG","25833"]]'
        self.dem("-o", "a.tif", "--crs", wkt)
        self.assertEqual(geo_keys(self.folder / "a.tif")[3072], 25833)

    def test_systems_without_code_are_translated_or_refused_before_the_run(self):
        albers = "+proj=aea +lat_0=40 +lon_0=-96 +lat_1=20 +lat_2=60 +datum=NAD83 +units=m"
        words = ["dem", "points.npy", "--resolution", 1, "-o", "a.tif", "--crs"]
        if importlib.util.find_spec("rasterio"):
            self.run_tipp(*words, "OGC:CRS84")
            self.run_tipp(*words, albers)
            self.assertEqual(geo_keys(self.folder / "a.tif")[3072], 32767)  # defined by the user
        else:
            self.assertIn("pip install pyproj rasterio", self.refused(*words, albers))
            self.assertFalse((self.folder / "a.tif").exists())
        if importlib.util.find_spec("pyproj"):
            self.run_tipp(*words, "EPSG:7415")  # compound: 28992 and 5709
            self.assertEqual(geo_keys(self.folder / "a.tif"), {1024: 1, 1025: 1, 3072: 28992, 4096: 5709})
            self.assertIn("is no coordinate reference system", self.refused(*words, "nonsense"))
        self.assertRegex(self.refused(*words, "EPSG:99999"), "EPSG:99999")

    def test_the_system_of_a_las_file_is_that_of_the_raster(self):
        keys = struct.pack("<12H", 1, 1, 0, 2, 1024, 0, 1, 1, 3072, 0, 1, 32633)
        wkt = b'COMPD_CS["x",PROJCS["p",AUTHORITY["EPSG","25832"]],VERT_CS["h",AUTHORITY["EPSG","7837"]]]\0'
        for record, expected in (((34735, keys), {1024: 1, 1025: 1, 3072: 32633}),
                                 ((2112, wkt), {1024: 1, 1025: 1, 3072: 25832, 4096: 7837})):
            content = bytearray(las_file(self.points, [record]))
            content[6] = 16 if record[0] == 2112 else 0
            if record[0] == 2112:
                content[25] = 2
            (self.folder / "a.las").write_bytes(content)
            self.run_tipp("dem", "a.las", "-o", "a.tif", "--resolution", 1)
            self.assertEqual(geo_keys(self.folder / "a.tif"), expected)

    def test_pixels_and_system_are_those_of_another_raster(self):
        self.dem("-o", "a.tif", "--bounds", 3, 40, 5, 30, "--crs", "EPSG:25832")
        self.run_tipp("dem", "points.npy", "-o", "b.tif", "--like", "a.tif")
        self.assertEqual((self.folder / "a.tif").read_bytes(), (self.folder / "b.tif").read_bytes())

    def test_a_damaged_raster_is_refused(self):
        self.dem("-o", "a.tif")
        whole = (self.folder / "a.tif").read_bytes()
        for content in (b"", b"II*\0", whole[:100], whole[:len(whole) // 2], b"MM" + whole[2:], b"II*\0\xff\xff\xff\xff" + whole[8:]):
            (self.folder / "b.tif").write_bytes(content)
            self.assertIn("b.tif", self.refused("dem", "points.npy", "-o", "c.tif", "--like", "b.tif"))

    def test_compression_that_needs_gdal_is_refused_before_the_run(self):
        for name in ("lzw", "zstd"):
            sentence = self.refused("dem", "points.npy", "-o", "a.tif", "--resolution", 1, "--compress", name)
            self.assertIn(f"the compression {name}", sentence)

    def test_a_cloud_optimized_raster_has_its_directories_first(self):
        self.run_tipp("dem", "points.npy", "-o", "a.tif", "--resolution", 0.05, "--cog")
        content = (self.folder / "a.tif").read_bytes()
        self.assertIn(b"LAYOUT=IFDS_BEFORE_DATA", content[:100])
        levels = fields_of(self.folder / "a.tif")
        self.assertEqual([level[256] for level in levels], [(2000,), (1000,), (500,)])
        starts = [min(level[324]) for level in levels]
        self.assertEqual(starts, sorted(starts, reverse=True))
        self.assertEqual(max(offset + size for level in levels for offset, size in zip(level[324], level[325])), len(content) - 4)

    @unittest.skipIf(importlib.util.find_spec("rasterio") is None, "rasterio is not installed")
    def test_rasterio_reads_a_cloud_optimized_raster(self):
        import rasterio

        names = "elevation,slope,void"
        self.run_tipp("dem", "points.npy", "-o", "a.npy", "--resolution", 0.05, "--attributes", names)
        expected = np.load(self.folder / "a.npy")[:, ::-1].astype(np.float32)
        for options in ([], ["--compress", "none"], ["--type", "float64"]):
            self.run_tipp("dem", "points.npy", "-o", "a.tif", "--resolution", 0.05, "--attributes", names, "--cog",
                          "--crs", "EPSG:25832", *options)
            with rasterio.open(self.folder / "a.tif") as raster:
                pixels = raster.read().astype(np.float32)
                np.testing.assert_array_equal(np.where(pixels == -9999, np.nan, pixels), expected)
                self.assertEqual([raster.overviews(band) for band in (1, 2, 3)], [[2, 4]] * 3)
                if "none" not in options:  # GDAL tells this of compressed files only
                    self.assertEqual(raster.tags(ns="IMAGE_STRUCTURE")["LAYOUT"], "COG")
                self.assertEqual(raster.crs.to_epsg(), 25832)

    def hidden_mesh(self, name, points, changed):
        """Writes a triangulation of points with other coordinates instead."""
        np.save(self.folder / "h.npy", points)
        self.run_tipp("delaunay", "h.npy", "-o", name)
        content = (self.folder / name).read_bytes()
        self.assertEqual(content.count(points.tobytes()), 1)
        (self.folder / name).write_bytes(content.replace(points.tobytes(), changed.tobytes()))

    @unittest.skipIf(CXX is None, "TIPP_CXX does not name the C++ tool")
    def test_files_are_those_of_the_cxx_tool(self):
        np.save(self.folder / "places.npy", RANDOM.random((50, 2)) * 100)
        (self.folder / "lines.csv").write_text("x1,y1,x2,y2\n10,10,80,80\n10,80,80,10\n")
        commands = [
            (["dem", "points.npy", "-o", name, "--resolution", 0.3, *options], name)
            for name, options in (("a.tif", []), ("a.npy", []), ("a.vti", []), ("b.tif", ["--attributes", "elevation,slope,void"]),
                                  ("c.tif", ["--cog"]), ("d.tif", ["--memory", "2M"]), ("e.tif", ["--type", "float64"]))]
        commands += [(["delaunay", "points.npy", "-o", name, *options], name)
                     for name, options in (("a.vtu", []), ("a.vtp", ["--neighbors", "--map-duplicates"]), ("t.npy", []), ("a.14", []),
                                           ("c.vtu", ["--constraints", "lines.csv"]), ("m.tipp", ["--memory", "8M"]))]
        some = self.points[:1000].copy()
        some[5] = np.nan  # a corner that is not finite hides cells
        self.hidden_mesh("n.vtp", self.points[:1000], some)
        self.run_tipp("delaunay", "points.npy", "-o", "cells.npy")
        (self.folder / "narrow").mkdir()
        (self.folder / "cells.npy").rename(self.folder / "narrow" / "cells.npy")
        np.save(self.folder / "narrow" / "points.npy", self.points.astype(np.float32))
        np.savetxt(self.folder / "data.csv", np.c_[self.points, self.points[:, 0] % 7], "%.17g", ",", header="x,y,z,h", comments="")
        commands += [(["delaunay", *words], words[2]) for words in (
            ("places.npy", "-o", "p.vtu"), ("places.npy", "-o", "p.vtp"), ("data.csv", "-o", "d.vtp"), ("data.csv", "-o", "d.tipp", "--memory", "8M"))]
        commands += [(["delaunay", "points.npy", "-o", "n.vtu", "--neighbors"], "n.vtu")]
        commands += [
            (["delaunay3d", "points.npy", "-o", "s.vtu"], "s.vtu"), (["points", "points.npy", "-o", "a.laz"], "a.laz"),
            (["contour", "m.tipp", "-o", "l.vtp", "--interval", 2], "l.vtp"),
            (["query", "places.npy", "m.tipp", "-o", "q.csv"], "q.csv"),
            (["query", "places.npy", "m.tipp", "-o", "r.vtp", "--descend", "elevation"], "r.vtp"),
            (["flatten", "a.14", "-o", "flat"], "flat"), (["partition", "flat", "-o", "p.tipp"], "p.tipp")]
        grid, box = ["--dims", 41, 37], ["--bounds", 20, 61, 30, 70]
        commands += [(["resample", mesh, "-o", name, *options], name)
                     for mesh, name, options in (
                         ("a.vtu", "ra.npy", grid), ("a.vtu", "rb.vti", [*grid, *box]), ("m.tipp", "rc.vti", [*grid, "--memory", "100K"]),
                         ("m.tipp", "rd.tif", ["--resolution", 0.7, *box]), ("flat", "re.vti", grid),
                         ("a.vtu", "rf.vti", [*grid, "--method", "conservative", "--covered-share"]),
                         ("m.tipp", "rg.npy", [*grid, "--method", "conservative"]), ("flat", "rh.npy", [*grid, *box, "--arrays", "depth", "--null", -1]),
                         ("s.vtu", "ri.vti", ["--dims", 9, 8, 7]), ("a.14", "rj.tif", ["--resolution", 1]),
                         ("a.14", "rk.npy", grid), ("a.14", "rl.pvd", grid), ("a.vtp", "rm.vti", grid), ("narrow", "ro.vti", grid),
                         ("narrow", "rp.npy", [*grid, *box, "--method", "conservative"]))]
        commands += [(["remap", source, "--to", target, "-o", name, *options], name)
                     for source, target, name, options in (
                         ("a.vtu", "p.vtu", "ma.vtu", []), ("d.tipp", "p.vtp", "mb.vtp", ["--arrays", "h", "--null", -5]),
                         ("d.tipp", "p.vtu", "mc.vtu", ["--memory", "100K", "--threads", 2]), ("d.vtp", "p.vtu", "mf.vtu", []), ("a.vtp", "p.vtp", "md.vtp", []),
                         ("n.vtp", "p.vtu", "me.vtu", []))]
        commands += [(["delaunay", "a.vtp", "-o", "va.vtu"], "va.vtu"), (["delaunay", "rb.vti", "-o", "vb.vtu"], "vb.vtu"),
                     (["delaunay", "s.vtu", "-o", "vc.vtu"], "vc.vtu"), (["dem", "a.vtp", "-o", "vd.tif", "--resolution", 1], "vd.tif"),
                     (["delaunay", "points.npy", "-o", "ve.vtu", "--constraints", "l.vtp"], "ve.vtu"),
                     (["query", "places.npy", "a.vtp", "-o", "vf.csv"], "vf.csv"), (["query", "places.npy", "n.vtu", "-o", "vg.csv"], "vg.csv"),
                     (["partition", "a.vtp", "-o", "vh.tipp"], "vh.tipp"), (["contour", "a.vtp", "-o", "vi.vtp", "--interval", 2], "vi.vtp"),
                     (["flatten", "d.vtp", "-o", "flat2"], "flat2")]
        for words, name in commands:
            with self.subTest(" ".join(map(str, words))):
                contents = []
                for number, tool in enumerate((TIPP, CXX)):
                    self.run_tipp(*words, tool=(tool,))
                    path = self.folder / name
                    files = sorted(path.rglob("*")) if path.is_dir() else [path]
                    contents.append([(file.name, file.read_bytes()) for file in files if file.is_file()])
                    if name in ("flat", "flat2") and number == 0:  # it must not exist yet
                        path.rename(self.folder / f"first of {name}")
                self.assertTrue(contents[0] == contents[1], "the files differ")

    def both(self, words, name):
        """Runs a command with both tools. Returns of each the exit code, what it said, and the files that it wrote as `name`."""
        results = []
        for tool in (TIPP, CXX):
            run = self.run_words(*words, tool=(tool,))
            path = self.folder / name
            files = sorted(path.rglob("*")) if path.is_dir() else [path] if path.exists() else []
            said = re.sub(r"[0-9.]+ s, peak memory.*", "", run.stdout)
            results.append((run.returncode, said, run.stderr, [(file.name, file.read_bytes()) for file in files if file.is_file()]))
            if path.is_dir():
                shutil.rmtree(path)
        return results

    @unittest.skipIf(CXX is None, "TIPP_CXX does not name the C++ tool")
    def test_meshes_of_images_are_those_of_the_cxx_tool(self):
        def marks(count, *marked):
            array = np.zeros(count, np.uint8)
            for index, mark in marked:
                array[index] = mark
            return {"vtkGhostType": array}

        values = {"h": np.arange(12.0), "flow": np.arange(24, dtype=np.float32).reshape(12, 2)}
        cells = {"c": np.arange(6, dtype=np.int32)}
        solid = {"h": np.arange(60.0)}
        images = {
            "xy": image_file("2 5 0 2 0 0", values, cells), "xz": image_file("2 5 1 1 -1 1", values, cells),
            "yz": image_file("7 7 0 3 0 2", values, {"vtkOriginalCellIds": np.arange(6)}),
            "cells hidden": image_file("2 5 0 2 0 0", values, {**marks(6, (0, 1), (2, 32), (5, 4)), **cells}),
            "all hidden": image_file("2 5 0 2 0 0", values, marks(6, (slice(None), 32))),
            "all elsewhere": image_file("2 5 0 2 0 0", values, marks(6, (slice(None), 1))),
            "solid": image_file("0 4 0 2 -2 1", solid, {"c": np.arange(24.0)}),
            "backwards": image_file("0 4 0 2 -2 1", {**solid, **marks(60, (33, 1))}, {}, "0.25 -2 0.5"),
            "row": image_file("0 11 0 0 0 0", values, {}), "empty": image_file("0 -1 0 -1 0 -1", {}, {})}
        for name, content in images.items():
            (self.folder / "a.vti").write_bytes(content)
            for words, output in ((["flatten", "a.vti", "-o", "f"], "f"), (["partition", "a.vti", "-o", "p.tipp", "--tiling", "quadtree:4"], "p.tipp")):
                with self.subTest(f"{name}: {words[0]}"):
                    first, second = self.both(words, output)
                    self.assertEqual(first[:3], second[:3])
                    self.assertTrue(first[3] == second[3], "the files differ")

    def test_a_damaged_image_is_refused(self):
        whole = image_file("0 3 0 2 0 0", {"h": np.arange(12.0)}, {"c": np.arange(6.0)})
        for content in (whole.replace(b"0 3 0 2 0 0", b"0 30000000 0 20000 0 0"), whole.replace(b"0 3 0 2 0 0", b"0 3 0 3 0 0"), whole[:-60],
                        image_file("0 999999 0 999999 0 0", {}, {}), whole.replace(b"UInt64", b"UInt16")):
            (self.folder / "a.vti").write_bytes(content)
            for words in (["flatten", "a.vti", "-o", "f"], ["partition", "a.vti", "-o", "p.tipp"]):
                self.assertIn("a.vti", self.refused(*words))

    @unittest.skipIf(CXX is None, "TIPP_CXX does not name the C++ tool")
    def test_messages_are_those_of_the_cxx_tool(self):
        self.run_tipp("delaunay", "points.npy", "-o", "b.vtu")
        self.run_tipp("resample", "b.vtu", "-o", "b.vti", "--dims", 5, 5)
        np.save(self.folder / "other.npy", self.points[:2000] + [3, 0, 1])
        self.run_tipp("delaunay", "other.npy", "-o", "c.vtp")
        self.run_tipp("delaunay", "points.npy", "-o", "m.tipp", "--memory", "8M")
        self.run_tipp("delaunay3d", "other.npy", "-o", "s.vtu")
        np.save(self.folder / "far.npy", self.points[:100] + 1000)
        self.run_tipp("delaunay", "far.npy", "-o", "far.vtu")
        for words in (["volume", "b.vtu", "c.vtp"], ["volume", "m.tipp", "c.vtp"], ["volume", "c.vtp", "m.tipp", "--memory", "50K"],
                      ["volume", "b.vtu", "c.vtp", "--bounds", 20, 70, 30, 80], ["volume", "b.vtu", "far.vtu"], ["volume", "--help"],
                      ["volume", "b.vtu", "c.vtp", "--bounds", 500, 600, 0, 1], ["volume", "b.vtu", "s.vtu"], ["volume", "b.vtu", "absent.vtu"],
                      ["remap", "--help"], ["remap", "b.vtu", "--to", "c.vtp", "-o", "r.vtu"], ["remap", "b.vtu", "--to", "absent.vtp", "-o", "r.vtp"],
                      ["remap", "b.vtu", "--to", "c.vtp", "-o", "r.vtp", "--arrays", "nothing"], ["remap", "s.vtu", "--to", "c.vtp", "-o", "r.vtp"],
                      ["remap", "b.vtu", "--to", "s.vtu", "-o", "r.vtu"], ["remap", "b.vtu", "--to", "points.npy", "-o", "r.vtu"],
                      ["info", "c.vtp"], ["info", "b.vti"], ["--help"], ["volume", "b.vtu", "b.vti"],
                      ["resample", "b.vti", "-o", "r.npy", "--dims", 3, 3],
                      ["info", "points.npy"], ["dem", "--help"], ["delaunay", "--help"], ["query", "--help"], ["--version"],
                      ["resample", "--help"], ["check", "--help"], ["resample", "a.vtu", "-o", "a.npy"],
                      ["resample", "absent.vtu", "-o", "a.npy", "--dims", 2, 2],
                      ["dem", "points.npy", "-o", "a.tif"], ["dem", "points.npy", "-o", "a.xyz", "--resolution", 1],
                      ["dem", "absent.npy", "-o", "a.tif", "--resolution", 1]):
            first, second = self.run_words(*words), self.run_words(*words, tool=(CXX,))
            self.assertEqual((first.returncode, first.stdout, first.stderr), (second.returncode, second.stdout, second.stderr))

    @unittest.skipIf(CXX is None, "TIPP_CXX does not name the C++ tool")
    def test_checks_are_those_of_the_cxx_tool(self):
        (self.folder / "lines.csv").write_text("x1,y1,x2,y2\n10,10,80,80\n10,80,80,10\n")
        self.run_tipp("delaunay", "points.npy", "-o", "a.npy")
        self.run_tipp("delaunay", "points.npy", "-o", "m.tipp", "--memory", "8M")
        self.run_tipp("delaunay", "points.npy", "-o", "c.vtu", "--constraints", "lines.csv")
        self.run_tipp("delaunay3d", "points.npy", "-o", "s.npy")
        self.run_tipp("delaunay3d", "points.npy", "-o", "s.vtu", "--neighbors")
        self.run_tipp("delaunay", "points.npy", "-o", "n.vtu", "--neighbors")
        self.run_tipp("delaunay", "points.npy", "-o", "p.vtp")
        (self.folder / "box.csv").write_text("x1,y1,x2,y2\n0,0,90,0\n90,0,90,80\n90,80,0,80\n0,80,0,0\n0,0,90,80\n")
        self.run_tipp("mesh", "box.csv", "-o", "q.14", "--min-angle", 25.5, "--max-area", 20)
        np.save(self.folder / "cut.npy", np.load(self.folder / "a.npy")[5:])
        np.save(self.folder / "hole.npy", np.load(self.folder / "s.npy")[5:])
        for words in (["points.npy", "a.npy"], ["points.npy", "m.tipp", "--tie-rule"], ["points.npy", "s.npy"], ["points.npy", "cut.npy"],
                      ["points.npy", "hole.npy"], ["points.npy", "cut.npy", "--boundary-free"], ["points.npy", "c.vtu", "--constraints", "lines.csv"],
                      ["points.npy", "c.vtu"], ["points.npy", "s.vtu"], ["points.npy", "n.vtu"], ["points.npy", "p.vtp"], ["p.vtp", "p.vtp"],
                      ["q.14", "--quality", "25.5", "--constraints", "box.csv"], ["q.14", "--quality", "33.3", "--constraints", "box.csv"],
                      ["q.14", "--quality", "25.5", "--max-area", 20, "--constraints", "box.csv"], ["points.npy", "a.npy", "--quality", "61"], ["points.npy"],
                      ["points.npy", "a.npy", "--quality", "x"], ["points.npy", "a.npy", "--quality", "0.1", "--max-area", 1e-3]):
            with self.subTest(" ".join(map(str, words))):
                first, second = (self.run_words("check", *words, tool=(tool,)) for tool in (TIPP, CXX))
                self.assertEqual((first.returncode, first.stdout, first.stderr), (second.returncode, second.stdout, second.stderr))


if __name__ == "__main__":
    unittest.main()
