# SPDX-License-Identifier: BSD-3-Clause
"""The command `tipp` of the wheel reads the output of models in NetCDF by netCDF4 or h5netcdf, where one is installed, and
writes NetCDF files by them. If the variable TIPP_CXX names the C++ tool, the two are compared.

Usage: TestNetcdf.py TIPP [unittest arguments]
"""
import importlib.util
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import numpy as np

TIPP = os.path.abspath(sys.argv.pop(1))
CXX = os.environ.get("TIPP_CXX")
HAS_NETCDF4 = importlib.util.find_spec("netCDF4") is not None
HAS_H5NETCDF = all(importlib.util.find_spec(name) for name in ("h5netcdf", "h5py"))
HAS_ANY = HAS_NETCDF4 or HAS_H5NETCDF
HAS_PYPROJ = importlib.util.find_spec("pyproj") is not None
WITHOUT = "import sys; sys.modules[{!r}] = None; from tipp.__main__ import main; sys.exit(main())"  # without a package
SHARED = pathlib.Path(__file__).resolve().parents[2].parent / "shared" / "data" / "netcdf"


def write_ugrid(path, form="NETCDF4"):
    """A mesh of triangles and a quadrilateral with depths, and levels and means at three times, one value missing."""
    import netCDF4

    with netCDF4.Dataset(path, "w", format=form) as file:
        for name, size in (("time", None), ("node", 9), ("face", 7), ("corner", 4)):
            file.createDimension(name, size)
        file.createVariable("mesh", "i4").setncatts({
            "cf_role": "mesh_topology", "topology_dimension": np.int32(2), "node_coordinates": "x y", "face_node_connectivity": "corners"})
        x, y = np.meshgrid(np.arange(3.0), np.arange(3.0))
        for name, values in (("x", x), ("y", y)):
            variable = file.createVariable(name, "f8", ("node",))
            variable.setncatts({"standard_name": f"projection_{name}_coordinate", "units": "m"})
            variable[:] = values.ravel()
        corners = file.createVariable("corners", "i4", ("face", "corner"), fill_value=-1)
        corners.start_index = np.int32(1)
        corners[:] = np.ma.masked_equal([[1, 2, 4, 0], [2, 5, 4, 0], [2, 3, 5, 0], [3, 6, 5, 0], [4, 5, 7, 0], [5, 8, 7, 0], [5, 6, 9, 8]], 0)
        time = file.createVariable("time", "f8", ("time",))
        time.units = "hours since 2020-01-01 00:00:00"
        time[:] = [0, 1, 2.5]
        depth = file.createVariable("depth", "f4", ("node",))
        depth.setncatts({"mesh": "mesh", "location": "node", "units": "m"})
        depth[:] = np.arange(9)
        level = file.createVariable("zeta", "i2", ("time", "node"), fill_value=-99)
        level.setncatts({"mesh": "mesh", "location": "node", "scale_factor": 0.5, "add_offset": np.float64(10)})
        level.set_auto_maskandscale(False)
        level[:] = np.arange(27).reshape(3, 9)
        level[1, 4] = -99
        mean = file.createVariable("flow", "f8", ("time", "face"))
        mean.setncatts({"mesh": "mesh", "location": "face"})
        mean[:] = np.arange(21).reshape(3, 7)


def content_of(path):
    """All that a file has: kind, dimensions, attributes with their types; types, storage and values of variables."""
    import netCDF4

    def attributes(of):
        return {name: (of.getncattr(name), getattr(of.getncattr(name), "dtype", str)) for name in of.ncattrs()}

    with netCDF4.Dataset(path) as file:
        file.set_auto_maskandscale(False)
        variables = {name: (variable.dtype, variable.dimensions, repr(attributes(variable)), variable.filters(),
                            variable.chunking() if variable.filters()["zlib"] else None, variable[...].tobytes()) for name, variable in file.variables.items()}
        dimensions = {name: (len(dimension), dimension.isunlimited()) for name, dimension in file.dimensions.items()}
        return file.data_model, list(dimensions.items()), list(variables.items()), list(attributes(file).items())


class Netcdf(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_words(self, *words, tool=TIPP):
        return subprocess.run([tool, *map(str, words)], cwd=self.folder, capture_output=True, text=True)

    def run_tipp(self, *words, tool=TIPP):
        run = self.run_words(*words, tool=tool)
        self.assertEqual(run.returncode, 0, run.stderr)
        return run.stdout

    def run_without(self, package, *words):
        run = subprocess.run([sys.executable, "-c", WITHOUT.format(package), *map(str, words)], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stderr)

    def write_commands(self):
        """Writes inputs, and returns commands whose output is b.nc: rasters and meshes, with and without steps."""
        write_ugrid(self.folder / "a.nc")
        points = np.random.default_rng(1).random((400, 3))
        table = np.c_[points, points[:, 0] * 7, np.arange(400)]
        np.savetxt(self.folder / "data.csv", table, "%.17g", ",", header="x,y,z,\u00e9 height,id", comments="", encoding="utf-8")
        (self.folder / "box.csv").write_text("x1,y1,x2,y2\n0,0,9,0\n9,0,9,8\n9,8,0,8\n0,8,0,0\n")
        self.run_tipp("delaunay", "data.csv", "-o", "m.tipp", "--memory", "8M")
        grid = ["--dims", 21, 17]
        commands = [["resample", "a.nc", *grid, "--step", "all"], ["resample", "a.nc", *grid, "--reduce", "max", "--arrays", "zeta"],
                    ["resample", "a.nc", *grid, "--step", "all", "--arrays", "zeta", "depth"], ["resample", "a.nc", "--dims", 700, 600, "--step", 1],
                    ["flatten", "a.nc"], ["flatten", "m.tipp"], ["delaunay", "data.csv"],
                    ["mesh", "box.csv", "--min-angle", 25, "--max-area", 1]]
        if HAS_PYPROJ:
            commands += [["flatten", "m.tipp", "--crs", crs] for crs in ("EPSG:32617", "EPSG:4326", "EPSG:25832+7837")]
            commands += [["resample", "a.nc", *grid, "--step", "all", "--crs", "EPSG:25832"]]
        return [[*words, "-o", "b.nc"] for words in commands]

    @unittest.skipUnless(HAS_NETCDF4 and CXX, "netCDF4 is not installed, or TIPP_CXX does not name the C++ tool")
    def test_written_files_are_those_of_the_cxx_tool(self):
        for words in self.write_commands():
            with self.subTest(words):
                results = []
                for tool in (TIPP, CXX):
                    run = self.run_words(*words, tool=tool)
                    results.append((run.returncode, re.sub(r"[0-9.]+ s.*", "", run.stdout), run.stderr))
                    results.append(content_of(self.folder / "b.nc") if run.returncode == 0 else None)
                    (self.folder / "b.nc").unlink(missing_ok=True)
                self.assertEqual(results[:2], results[2:])

    @unittest.skipUnless(HAS_NETCDF4 and HAS_H5NETCDF, "netCDF4, h5netcdf or h5py is not installed")
    def test_h5netcdf_writes_the_same(self):
        def comparable(content):
            _, dimensions, variables, attributes = content
            return dict(dimensions), dict(variables), attributes

        for words in self.write_commands():
            with self.subTest(words):
                self.run_tipp(*words)
                expected = comparable(content_of(self.folder / "b.nc"))
                (self.folder / "b.nc").unlink()
                self.run_without("netCDF4", *words)
                self.assertEqual(comparable(content_of(self.folder / "b.nc")), expected)
                (self.folder / "b.nc").unlink()

    @unittest.skipUnless(HAS_ANY, "neither netCDF4 nor h5netcdf is installed")
    def test_names_that_netcdf_forbids_are_refused(self):
        (self.folder / "a.2dm").write_text("MESH2D\nE3T 1 1 2 3 1\nND 1 0 0 1\nND 2 1 0 2\nND 3 0 1 3\n")
        (self.folder / "a.dat").write_text("DATASET\nOBJTYPE \"mesh2d\"\nBEGSCL\nND 3\nNC 1\nNAME \"a/b\"\nTS 0 0\n1\n2\n3\nENDDS\n")
        words = ["resample", "a.2dm", "--values", "a.dat", "--dims", 3, 3, "-o", "b.nc"]
        results = [self.run_words(*words, tool=tool) for tool in (TIPP, CXX) if tool]
        self.assertEqual(results[0].returncode, 1, results[0].stdout)
        self.assertIn("at 'a/b': NetCDF: Name contains illegal characters", results[0].stderr)
        self.assertEqual({run.stderr for run in results}, {results[0].stderr})
        self.assertEqual(sorted(file.name for file in self.folder.iterdir()), ["a.2dm", "a.dat"])

    @unittest.skipUnless(HAS_ANY, "neither netCDF4 nor h5netcdf is installed")
    def test_a_file_that_cannot_be_written_is_reported_and_removed(self):
        np.save(self.folder / "points.npy", np.random.default_rng(1).random((200_000, 3)))
        code = "import resource, sys; resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 20, 1 << 20)); " + WITHOUT.format("nothing")
        for package in ("netCDF4", "h5netcdf"):
            run = subprocess.run([sys.executable, "-c", code.replace("'nothing'", repr(package)), "delaunay", "points.npy", "-o", "b.nc"],
                                 cwd=self.folder, capture_output=True, text=True)
            if "pip install" not in run.stderr:  # the other package may not be installed
                self.assertEqual((run.returncode, run.stderr.count("\n")), (1, 1), run.stderr)
                self.assertIn("is the disk full?", run.stderr)
            self.assertEqual(sorted(file.name for file in self.folder.iterdir()), ["points.npy"])

    @unittest.skipIf(HAS_PYPROJ or not HAS_ANY or importlib.util.find_spec("rasterio"), "pyproj or rasterio is installed, or no package that writes")
    def test_the_package_that_translates_a_system_is_named(self):
        write_ugrid(self.folder / "a.nc")
        run = self.run_words("flatten", "a.nc", "-o", "b.nc", "--crs", "EPSG:32617")
        self.assertEqual((run.returncode, run.stderr.count("\n")), (1, 1), run.stderr)
        self.assertIn("pip install pyproj", run.stderr)

    @unittest.skipIf(HAS_ANY, "netCDF4 or h5netcdf is installed")
    def test_the_package_to_install_is_named(self):
        (self.folder / "a.nc").write_bytes(b"CDF\1")
        run = self.run_words("resample", "a.nc", "-o", "b.npy", "--dims", 3, 3)
        self.assertEqual((run.returncode, run.stderr.count("\n")), (1, 1), run.stderr)
        self.assertIn("pip install netCDF4", run.stderr)

    @unittest.skipIf(HAS_ANY, "netCDF4 or h5netcdf is installed")
    def test_the_package_that_writes_is_named_before_the_run(self):
        np.save(self.folder / "points.npy", np.random.default_rng(1).random((9, 3)))
        self.run_tipp("delaunay", "points.npy", "-o", "a.14")
        for words in (["delaunay", "points.npy"], ["flatten", "a.14"], ["resample", "a.14", "--dims", 3, 3], ["mesh", "a.14", "--min-angle", 20]):
            run = self.run_words(*words, "-o", "b.nc")
            self.assertEqual((run.returncode, run.stderr.count("\n")), (1, 1), run.stderr)
            self.assertIn("that writes it: pip install netCDF4", run.stderr)
        self.assertEqual(sorted(file.name for file in self.folder.iterdir()), ["a.14", "points.npy"])

    @unittest.skipUnless(HAS_NETCDF4, "netCDF4 is not installed")
    def test_steps_are_sampled(self):
        for form in ("NETCDF4", "NETCDF3_CLASSIC"):
            write_ugrid(self.folder / "a.nc", form)
            self.run_tipp("resample", "a.nc", "-o", "b.npy", "--arrays", "zeta", "--step", 2, "--dims", 3, 3)
            np.testing.assert_allclose(np.load(self.folder / "b.npy"), 10 + 0.5 * np.arange(18.0, 27).reshape(3, 3), err_msg=form)

    @unittest.skipUnless(HAS_NETCDF4 and HAS_H5NETCDF, "netCDF4, h5netcdf or h5py is not installed")
    def test_h5netcdf_reads_the_same(self):
        write_ugrid(self.folder / "a.nc")
        words = ["resample", "a.nc", "-o", "b.npy", "--arrays", "zeta", "--step", 1, "--dims", 9, 9]
        self.run_tipp(*words)
        expected = (self.folder / "b.npy").read_bytes()
        (self.folder / "b.npy").unlink()
        self.run_without("netCDF4", *words)
        self.assertEqual((self.folder / "b.npy").read_bytes(), expected)

    @unittest.skipUnless(HAS_NETCDF4, "netCDF4 is not installed")
    def test_damaged_files_are_refused_with_one_sentence(self):
        write_ugrid(self.folder / "a.nc")
        whole = (self.folder / "a.nc").read_bytes()
        for content in (b"", b"CDF\1", whole[:100], whole[:len(whole) // 2], b"x" * 5000, whole[:600] + b"\xff" * 400 + whole[1000:]):
            (self.folder / "b.nc").write_bytes(content)
            run = self.run_words("resample", "b.nc", "-o", "b.npy", "--dims", 3, 3)
            self.assertLessEqual(run.stderr.count("\n"), 2, run.stderr)
            self.assertIn(run.returncode, (0, 1), run.stderr)
            self.assertNotIn("Traceback", run.stderr)

    @unittest.skipUnless(HAS_NETCDF4 and CXX, "netCDF4 is not installed, or TIPP_CXX does not name the C++ tool")
    def test_results_are_those_of_the_cxx_tool(self):
        write_ugrid(self.folder / "a.nc")
        write_ugrid(self.folder / "c.nc", "NETCDF3_64BIT_OFFSET")
        grid = ["--dims", 21, 17]
        runs = [(path, [*grid, *options], name) for path in ("a.nc", "c.nc")
                for name, options in (("b.npy", ["--step", 1, "--arrays", "zeta"]), ("b.tif", ["--step", "all", "--arrays", "flow"]),
                                      ("b.npy", ["--reduce", "max", "--arrays", "zeta"]), ("b.vti", ["--step", 0]))]
        runs += [(SHARED / name, [*grid, "--step", 0, "--arrays", array], "b.npy")
                 for name, array in (("adcirc_1t.nc", "ssh"), ("dflow_simplebox_hex7_map.nc", "Mesh2D_s1")) if (SHARED / name).exists()]
        if not SHARED.exists():
            print("../shared/data is not there: no output of real models is read")
        for path, options, name in runs:
            with self.subTest(f"{path} {options}"):
                contents = []
                for tool in (TIPP, CXX):
                    run = self.run_words("resample", path, "-o", name, *options, tool=tool)
                    found = sorted(file for file in self.folder.iterdir() if file.name.startswith("b"))
                    contents.append((run.returncode, run.stderr, [(file.name, file.read_bytes()) for file in found]))
                    for file in found:
                        file.unlink()
                self.assertEqual(contents[0][:2], contents[1][:2])
                self.assertTrue(contents[0] == contents[1], "the files differ")

    @unittest.skipUnless(HAS_NETCDF4 and CXX, "netCDF4 is not installed, or TIPP_CXX does not name the C++ tool")
    def test_descriptions_are_those_of_the_cxx_tool(self):
        write_ugrid(self.folder / "a.nc")
        for words in (["info", "a.nc"], ["info", "absent.nc"]):
            first, second = (self.run_words(*words, tool=tool) for tool in (TIPP, CXX))
            self.assertEqual((first.returncode, first.stdout, first.stderr), (second.returncode, second.stdout, second.stderr))


if __name__ == "__main__":
    unittest.main()
