# SPDX-License-Identifier: BSD-3-Clause
"""Every argument of every public function gets invalid values: the error must be one sentence that names it."""
import importlib.util
import inspect
import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData, vtkTable

import tipp
import tipp._arguments

NAN, INF = float("nan"), float("inf")
POINTS = np.random.default_rng(2).random((40, 2))

# For each kind of argument: values of a wrong type, and wrong values of a right type.
NUMBER = ([None, "1", [1], {}, True, 1j], [NAN, INF, -INF, 10**400])
IS_WHEEL = importlib.util.find_spec("tipp._core") is not None
LENGTH = (NUMBER[0], NUMBER[1] + [-1])
ANY_NUMBER = (NUMBER[0], [])
THREADS = ([None, "2", 1.5, 2.0, True, {}, [1]], [-1, 10**9, 10**30])
BYTES = ([None, 1.5, True, {}, [1]], [0, -1, 1 << 70])
FLAG = ([None, "yes", 2, 1.0, [], {}], [])
TEXT = ([None, 3, 1.5, [], {}, b"auto"], [])
NAMES = ([3, 1.5, {}, {"f": 1}, [None], [["f"]], [1], True, b"f"], [])
RETURN_TYPE = (TEXT[0][1:], ["numpy", ""])
PATH = ([None, 3, 1.5, {}, True], ["a\0b"])
PATH_OR_NONE = (PATH[0][1:], PATH[1])
PATHS = (PATH[0] + [[None], {"a": 1}], PATH[1] + [["a\0b"]])
DATA = ([None, "text", 3, {}, [], np.zeros((3, 3)), vtkTable(), vtkPolyData], [])


def several(wrong_types, wrong_values, good, count, fewer=None):
    """A sequence of wrong length, and one with a wrong value."""
    fewer = count - 1 if fewer is None else fewer
    types = [3, 1.5, True, "abc"[:count], {1: 2}, {1, 2}] + [[good] * (count - 1) + [w] for w in wrong_types]
    values = [[], [good] * fewer, [good] * (count + 1)] + [[w] + [good] * (count - 1) for w in wrong_values]
    return types, values


COUNTS = several([None, "1", 1.5, True], [-1, 10**9 * 10**9], 2, 2)
DIMENSIONS = several([None, "1", 1.5, True], [-1, 1 << 31], 2, 3, fewer=1)
SPACING = several([None, "1", True], [NAN, INF, -0.5], 1.0, 3, fewer=1)
BOUNDS = several([None, "1", True], [NAN, INF], 1.0, 6)
OPEN_BOUNDS = several([None, "1", True], [NAN], 1.0, 6)
COLUMNS = several([None, 1.5, True], [-1], 1, 2)
POINT_DATA = ([3, "f", [1, 2], np.zeros(40), {3: np.zeros(40)}, {"f": None}, {"f": "text"}, {"f": {}}],
              [{"f": 3.0}, {"f": np.zeros(7)}])
ARRAY = ([None, "text", {}, np.zeros((3, 2), complex), vtkTable(), vtkImageData(), vtkPolyData],
         [3, [], [1, 2], np.zeros((3, 5))])

TABLE = {
    "delaunay": {"points": ARRAY, "tol": LENGTH, "max_edge": LENGTH, "partitions": COUNTS, "schedule": (TEXT[0], ["random", ""]),
                 "threads": THREADS, "progress_bar": FLAG},
    "delaunay_2d": {"points": ARRAY, "tol": LENGTH, "max_edge": LENGTH, "alpha": LENGTH, "offset": LENGTH, "bound": FLAG,
                    "point_data": POINT_DATA,
                    "edges": (["text", {}], [3, [1, 2], np.zeros((3, 3), int), np.zeros((3, 2)), [[0, 10**9]], [[0, -1]]]),
                    "polygons": (["text", 3], [[[0.5, 1.5]], [np.zeros((3, 5))], [[0, 1, 10**9]]]),
                    "edge_source": (["text", 3, {}, [], np.zeros((3, 3)), vtkTable(), vtkPolyData], []),
                    "crossings": (TEXT[0], ["join"]), "marks": (TEXT[0], ["points"]),
                    "map_duplicates": FLAG, "neighbors": FLAG, "return_statistics": FLAG, "return_type": RETURN_TYPE,
                    "partitions": COUNTS, "schedule": (TEXT[0], ["random"]), "threads": THREADS, "progress_bar": FLAG},
    "delaunay_3d": {"points": (ARRAY[0], [3, [], [1, 2], np.zeros((3, 2)), np.zeros((3, 5))]),
                    "alpha": LENGTH, "tol": LENGTH, "offset": LENGTH, "bound": FLAG, "point_data": POINT_DATA,
                    "map_duplicates": FLAG, "neighbors": FLAG, "return_statistics": FLAG, "return_type": RETURN_TYPE,
                    "partitions": (THREADS[0], [-1, 513]), "threads": THREADS, "progress_bar": FLAG},
    "delaunay_file": {"points": (PATH[0] + [[None], {"a": 1}], PATH[1]), "output": PATH,
                      "dimension": (THREADS[0], [0, 1, 4]), "memory": (BYTES[0], BYTES[1] + ["", "2X", "1.5G", "9" * 40]), "partitions": COUNTS,
                      "columns": COLUMNS, "max_edge": LENGTH, "map_duplicates": FLAG, "neighbors": FLAG,
                      "constraints": PATH_OR_NONE, "boundary": PATH_OR_NONE,
                      "holes": ([3, 1.5, True, "ab", [None], [[None, 1]]], [[[1]], [[1, NAN]]]),
                      "crossings": (TEXT[0], ["join"]), "mark_constraints": FLAG, "count_only": FLAG,
                      "resume": FLAG, "scratch": PATH, "threads": THREADS, "progress_bar": FLAG},
    "dem": {"points": ([None, {}, np.zeros((3, 2), complex), vtkTable(), vtkImageData(), vtkPolyData, [None]],
                       [3, [1, 2], np.zeros((3, 5)), np.zeros((4, 2))]),
            "resolution": (NUMBER[0], NUMBER[1] + [0, -1]), "bounds": several([None, "1", True], [NAN, INF], 1.0, 4),
            "align": FLAG, "attributes": NAMES, "point_data": POINT_DATA, "max_edge": LENGTH,
            "duplicates": (TEXT[0], ["second"]), "thin": ([3, "2", [None, "min"], [1.5, 2]], [[0, "min"], [1], [1, "good"]]),
            "classes": ([3, "2", [None], [1.5]], [[256], [-1]]), "returns": (TEXT[0], ["second"]),
            "keep": ([3, 1.5, {"f": 1}, [None], [1]], [["good"]]), "breaklines": PATH_OR_NONE, "boundary": PATH_OR_NONE,
            "soft": FLAG, "memory": (BYTES[0][1:], BYTES[1] + ["", "2X", "1.5G"]), "threads": THREADS, "progress_bar": FLAG,
            "z": (TEXT[0], []), "layer": (TEXT[0], []), "crs": (TEXT[0], [])},
    "mesh": {"points": ARRAY,
             "segments": (["text", {}], [3, [1, 2], np.zeros((3, 3), int), np.zeros((3, 2)), [[0, 10**9]], [[0, -1]]]),
             "polygons": (["text", 3], [[[0.5, 1.5]], [np.zeros((3, 5))], [[0, 1, 10**9]]]),
             "min_angle": (NUMBER[0], NUMBER[1] + [-1, 35]), "max_area": (NUMBER[0], NUMBER[1] + [0, -1]),
             "size": (["text", {}, True, 1j, [None]], [NAN, INF, 0, -1, [1, 2], np.zeros(40), lambda x, y: 0]),
             "holes": ([3, 1.5, True, "ab", [None], [[None, 1]]], [[[1]], [[1, NAN]]]),
             "regions": ([3, 1.5, True, "ab", [None], [[None, 1]]], [[[1]], [[1, NAN]], [[1, 1, 0]]]),
             "convex": FLAG, "keep_border": FLAG, "keep_segments": FLAG, "shortest_edge": LENGTH,
             "most_points": (THREADS[0], [0, -1, 10**30]), "smooth": (THREADS[0], [-1, 10**30]),
             "crossings": (TEXT[0], ["join"]), "marks": (TEXT[0], ["flags"]),
             "point_data": POINT_DATA, "memory": (BYTES[0][1:], BYTES[1] + ["", "2X"]), "scratch": PATH_OR_NONE,
             "return_type": RETURN_TYPE, "threads": THREADS, "progress_bar": FLAG},
    "triangulate": {"tri": ([None, 3, "text", [], POINTS], [{}, {"vertices": np.zeros((3, 3))}, {"vertices": POINTS, "points": 1}]),
                    "opts": (TEXT[0], ["pD", "q35", "a0", "q.", "r"]), "threads": THREADS},
    "resample": {"mesh": DATA, "bounds": BOUNDS, "dimensions": DIMENSIONS, "spacing": SPACING,
                 "null_value": ANY_NUMBER, "no_data": ANY_NUMBER, "arrays": NAMES, "method": (TEXT[0], ["mean", ""]),
                 "covered_share": (FLAG[0], [True]), "device": TEXT, "return_type": RETURN_TYPE, "threads": THREADS, "progress_bar": FLAG},
    "remap": {"source": DATA, "target": DATA, "arrays": NAMES, "null_value": ANY_NUMBER, "return_type": RETURN_TYPE,
              "threads": THREADS, "progress_bar": FLAG},
    "volume": {"before": DATA, "after": DATA, "bounds": (BOUNDS[0], BOUNDS[1] + [(0, 0, 0, 1), (1, 0, 0, 1)]),
               "threads": THREADS, "progress_bar": FLAG},
    "resample_series": {
        "path": PATH, "bounds": (BOUNDS[0], BOUNDS[1]), "dimensions": COUNTS,
        "spacing": ([None, "1", True, [True, 1.0]], [NAN, INF, -0.5, 0, [1.0], [1.0, 0.0], [1.0] * 3]),
        "step": ([None, 1.5, True, [1], b"all"], [-1, "first", "0:1:0", "-1", " 1", "1:2:3:4"]), "arrays": NAMES,
        "reduce": NAMES, "with_steps": (FLAG[0], [True]), "waterline": TEXT, "no_data": NUMBER, "values": PATHS, "wrap": FLAG,
        "crs": TEXT, "return_type": (TEXT[0], ["numpy", ""]), "threads": THREADS, "progress_bar": FLAG},
    "times": {"path": PATH, "values": PATHS, "wrap": FLAG},
    "read": {"path": PATH, "bounds": OPEN_BOUNDS, "time": NUMBER, "values": PATHS, "wrap": FLAG, "point_arrays": NAMES,
             "cell_arrays": NAMES,
             "borrowed": FLAG, "merge": FLAG, "tiling": TEXT, "memory_limit": BYTES, "return_type": RETURN_TYPE,
             "progress_bar": FLAG},
    "write": {"mesh": ([None, 3, {}, [], np.zeros((3, 3)), vtkPolyData], ["a\0b"]), "path": PATH, "tiling": TEXT,
              "duplicate_borrowers": FLAG, "memory_limit": BYTES, "threads": THREADS, "progress_bar": FLAG},
    "as_array": {"data": DATA, "name": ([None, 3, [], {}, b"f"], [])},
    "check": {"points": ([None, "text", {}, np.zeros((3, 2), complex), vtkTable(), vtkImageData()], [3, [1, 2], np.zeros((3, 5))]),
              "triangles": (["text", {}, vtkTable()], [3, [1, 2], np.zeros((3, 3)), np.zeros((3, 5), int)]),
              "edges": (["text", {}], [3, [1, 2], np.zeros((3, 3), int), np.zeros((3, 2))]),
              "tie_rule": FLAG, "boundary_free": FLAG},
    "open": {"mesh": ([None, 3, {}, [], np.zeros((3, 3)), vtkPolyData], ["a\0b"]),
             "memory": (BYTES[0], BYTES[1] + ["", "2X", "1.5G"]), "step": ([None, "1", 1.5, True, [1]], [-1]), "threads": THREADS},
    "ranks": {},
}
if IS_WHEEL:
    TABLE["griddata"] = {
        "points": ([None, "text", {}, np.zeros((3, 2), complex)], [3, [], [1, 2], np.zeros((3, 5)), ([1, 2], [1, 2, 3])]),
        "values": (["text", {}, None], [np.zeros(7), [1]]),
        "xi": ([None, "text", {}, np.zeros((3, 2), complex)], [3, [], [1], np.zeros((3, 5)), ([1, 2], [1, 2, 3])]),
        "method": (TEXT[0], ["spline"]), "fill_value": (["text", [], {}], []), "rescale": FLAG, "threads": THREADS}


class Arguments(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.points = os.path.join(self.folder.name, "points.npy")
        np.save(self.points, POINTS)
        self.mesh = tipp.delaunay_2d(POINTS, point_data={"f": POINTS[:, 0]})
        self.stored = os.path.join(self.folder.name, "mesh.tipp")
        tipp.write(self.mesh, self.stored)
        self.output = os.path.join(self.folder.name, "out.tipp")

    def good(self, function):
        """The arguments that a function requires."""
        return {
            "delaunay": {"points": POINTS}, "delaunay_2d": {"points": POINTS},
            "delaunay_3d": {"points": np.c_[POINTS, POINTS[:, 0] * POINTS[:, 1]]},
            "delaunay_file": {"points": self.points, "output": self.output}, "resample": {"mesh": self.mesh},
            "remap": {"source": self.mesh, "target": self.mesh}, "volume": {"before": self.mesh, "after": self.mesh},
            "dem": {"points": np.c_[POINTS, POINTS[:, 0]], "resolution": 0.1},
            "read": {"path": self.stored}, "open": {"mesh": self.stored}, "write": {"mesh": self.mesh, "path": self.output},
            "as_array": {"data": self.mesh, "name": "f"}, "check": {"points": POINTS, "triangles": tipp.delaunay(POINTS)},
            "mesh": {"points": POINTS}, "triangulate": {"tri": {"vertices": POINTS}},
            "griddata": {"points": POINTS, "values": POINTS[:, 0], "xi": POINTS},
            "resample_series": {"path": self.stored, "return_type": "tipp"}, "times": {"path": self.stored},
        }[function]

    def test_every_argument_of_every_function_is_in_the_table(self):
        functions = [name for name in dir(tipp) if not name.startswith("_") and inspect.isfunction(getattr(tipp, name))]
        self.assertEqual(sorted(functions), sorted(TABLE))
        for name in functions:
            self.assertEqual(list(inspect.signature(getattr(tipp, name)).parameters), list(TABLE[name]), name)

    def test_wrong_types_and_values_are_refused_in_one_sentence_that_names_the_argument(self):
        for function, arguments in TABLE.items():
            for argument, (types, values) in arguments.items():
                default = inspect.signature(getattr(tipp, function)).parameters[argument].default
                wrong = [(TypeError, value) for value in types if value is not None or default is not None]
                for error, value in wrong + [(ValueError, value) for value in values]:
                    with self.subTest(function=function, argument=argument, value=repr(value)):
                        self.refuses(error, function, argument, value)

    def refuses(self, error, function, argument, value):
        with self.assertRaises(error) as raised:
            getattr(tipp, function)(**{**self.good(function), argument: value})
        message = str(raised.exception)
        self.assertRegex(message, rf"^{argument}\b")
        self.assertNotIn("\n", message)
        self.assertNotRegex(message, r"0x[0-9a-f]{4}|\.cxx|\.py\b")
        self.assertTrue(message.endswith("."), message)
        self.assertLess(len(message), 300)
        self.assertFalse(os.path.exists(self.output))

    def test_one_name_is_a_list_of_one(self):
        both = tipp.delaunay_2d(POINTS, point_data={"f": POINTS[:, 0], "depth": POINTS[:, 1]})
        tipp.write(both, self.output)
        part = tipp.read(self.output, point_arrays="depth", cell_arrays=[])
        self.assertIn("depth", part.point_data)
        self.assertNotIn("f", part.point_data)
        image = tipp.resample(both, dimensions=(3, 3, 1), arrays="depth")
        self.assertIn("depth", image.point_data)
        self.assertNotIn("f", image.point_data)

    def test_numbers_of_numpy_are_numbers(self):
        options = {"tol": np.float32(0), "threads": np.int8(2), "partitions": np.array([2, 2]), "bound": np.bool_(False)}
        self.assertEqual(len(tipp.delaunay_2d(POINTS, **options).cells), len(self.mesh.cells))
        bounds, dimensions = np.array([0, 1, 0, 1, 0, 0]), np.array([3, 3, 1])
        self.assertEqual(tipp.resample(self.mesh, bounds, dimensions).dimensions, (3, 3, 1))

    def test_memory_has_any_unit_in_any_case(self):
        for text, size in (("1 GB", 1 << 30), ("512M", 1 << 29), ("64 MiB", 1 << 26), ("64mb", 1 << 26), ("7 kB", 7 << 10),
                           ("7K", 7 << 10), ("100 B", 100), ("100b", 100), ("2  gib", 1 << 31), ("1T", 1 << 40)):
            self.assertEqual(size, tipp._arguments.memory(text, "memory"), text)
        for text in ("1 G B", "GB", "1 XB", "1e9", "-1 GB", "0 GB", "5iB", "1 GB GB"):
            with self.assertRaisesRegex(ValueError, "^memory is"):
                tipp._arguments.memory(text, "memory")

    def test_an_array_is_bounds_and_dimensions(self):
        expected = tipp.resample(self.mesh, (0.2, 0.8, 0.1, 0.9), (5, 4), arrays="f")
        for bounds, dimensions in ((np.array([0.2, 0.8, 0.1, 0.9]), np.array([5, 4])),
                                   (np.array([0.2, 0.8, 0.1, 0.9, 0, 0]), np.array([5, 4, 1], np.int32))):
            image = tipp.resample(self.mesh, bounds, dimensions, arrays="f")
            np.testing.assert_array_equal(tipp.as_array(expected, "f"), tipp.as_array(image, "f"))
        heights = np.c_[POINTS, POINTS[:, 0]]
        np.testing.assert_array_equal(tipp.dem(heights, 0.1, bounds=(0.2, 0.8, 0.1, 0.9)).array,
                                      tipp.dem(heights, 0.1, bounds=np.array([0.2, 0.8, 0.1, 0.9])).array)

    def test_an_array_that_the_mesh_does_not_have_is_a_key_error(self):
        for arrays in ("q", ["f", "q"]):
            with self.assertRaisesRegex(KeyError, r"no array 'q'; it has \['f'"):
                tipp.resample(self.mesh, dimensions=(3, 3), arrays=arrays)

    def test_points_of_laspy_are_points(self):
        class LasData:
            xyz = np.c_[POINTS, POINTS[:, 0]]
            x, y, z = xyz.T

            def __len__(self):
                return len(POINTS)

        class Columns:
            x, y, z = LasData.xyz.T

        np.testing.assert_array_equal(tipp.delaunay(POINTS), tipp.delaunay(LasData()))
        np.testing.assert_array_equal(tipp.delaunay(POINTS), tipp.delaunay(Columns()))
        self.assertEqual(POINTS[3, 0], tipp.delaunay_2d(LasData()).points[3, 2])
        np.testing.assert_array_equal(tipp.dem(LasData.xyz, 0.1).array, tipp.dem(LasData(), 0.1).array)

    def test_an_output_folder_is_not_named_like_a_file(self):
        folder = os.path.join(self.folder.name, "mesh.vtu")
        for write in (lambda: tipp.write(self.mesh, folder), lambda: tipp.delaunay_file(self.points, folder)):
            with self.assertRaisesRegex(RuntimeError, "mesh.vtu: would be a folder, though its name ends like a file's"):
                write()
        self.assertFalse(os.path.exists(folder))

    def test_an_open_range_is_read(self):
        self.assertEqual(len(tipp.read(self.stored, (-INF, INF) * 3).cells), len(self.mesh.cells))

    @unittest.skipIf(IS_WHEEL, "the wheel makes tetrahedra of points in files")
    def test_tetrahedra_of_points_in_files_name_what_makes_them(self):
        with self.assertRaisesRegex(RuntimeError, "dimension=3 needs the wheel of tipp, or the command 'tipp delaunay3d'"):
            tipp.delaunay_file(self.points, self.output, dimension=3)

    def test_options_of_the_plane_are_refused_for_tetrahedra(self):
        for name, value in (("max_edge", 1.0), ("partitions", (2, 2)), ("holes", [(0, 0)]), ("mark_constraints", True)):
            with self.assertRaisesRegex(ValueError, f"^{name} needs dimension=2; leave it out"):
                tipp.delaunay_file(self.points, self.output, dimension=3, **{name: value})


class Messages(unittest.TestCase):
    """Errors of VTK become exceptions of one sentence."""

    @unittest.skipIf(IS_WHEEL, "the wheel takes no sentences from VTK")
    def test_source_positions_and_addresses_are_left_out(self):
        told = "ERROR: In /build/Filters/vtkThing.cxx, line 57\nvtkThing (0x55d0c8a0): the mesh\n has no cells.\n\n"
        self.assertEqual(tipp._run._first_sentence(told), "the mesh has no cells.")
        told = "vtkCompositeDataPipeline (0x1f): Input for algorithm vtkThing(0x55d0c8a0) is missing."
        self.assertEqual(tipp._run._first_sentence(told), "Input for algorithm vtkThing is missing.")
        told = ("Algorithm vtkThing(0x55d0) returned failure for request: vtkInformation (0x77d0)\n  Debug: Off\n"
                "  Modified Time: 117\n")
        self.assertEqual(tipp._run._first_sentence(told), "Algorithm vtkThing returned failure.")

    def test_messages_name_the_output_and_not_its_temporary_file(self):
        program = (
            "import resource, signal, numpy as np, tipp\n"
            "mesh = tipp.delaunay_2d(np.random.default_rng(1).random((3000, 2)))\n"
            "signal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
            "resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))\n"
            "try:\n"
            "    tipp.write(mesh, 'mesh.tipp')\n"
            "except RuntimeError as error:\n"
            "    print(error)\n")
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([sys.executable, "-c", program], text=True, capture_output=True, cwd=folder)
        self.assertRegex(done.stdout, r"^(.*/)?mesh\.tipp: cannot be written \(File too large\)")

    @unittest.skipIf(IS_WHEEL, "the wheel takes no sentences from VTK")
    def test_a_sentence_with_parentheses_is_kept_whole(self):
        told = "points.npy: holds 3 (of 4): copy it again."
        self.assertEqual(tipp._run._first_sentence(told), told)


class Limits(unittest.TestCase):
    """Requests that are too large become exceptions, and Python continues."""

    def run_python(self, program):
        program = "import numpy as np, tipp\np = np.random.default_rng(1).random((3000, 2))\n" + program
        return subprocess.run([sys.executable, "-c", program], text=True, capture_output=True, timeout=250)

    def test_an_image_larger_than_memory_reports_its_bytes(self):
        for dimensions in ("(100000, 100000, 100)", "(10**9, 10**9, 1)"):
            done = self.run_python(f"tipp.resample(tipp.delaunay_2d(p), dimensions={dimensions})")
            self.assertRegex(done.stderr.splitlines()[-1], "^(RuntimeError|MemoryError): .* GB of memory, and this")

    def test_too_many_partitions_are_refused(self):
        done = self.run_python("tipp.delaunay(p, partitions=(10**9, 10**9))")
        self.assertRegex(done.stderr.splitlines()[-1], "^RuntimeError: .*partitions are too many")

    def test_too_many_threads_change_nothing(self):
        done = self.run_python(
            "a = tipp.delaunay(p, threads=4096)\n"
            "assert (np.sort(a, axis=None) == np.sort(tipp.delaunay(p), axis=None)).all()\n"
            "print(tipp.resample(tipp.delaunay_2d(p), dimensions=(300, 300), threads=4096)['vtkValidPointMask'].size)\n")
        self.assertEqual((done.stdout.strip(), done.returncode), ("90000", 0), done.stderr)

    @unittest.skipIf(IS_WHEEL, "the wheel has no VTK classes")
    def test_too_many_threads_of_the_class_change_nothing(self):
        done = self.run_python(
            "f = tipp.vtkRangeResampleFilter()\n"
            "f.SetInputDataObject(tipp.delaunay_2d(p, return_type='vtk'))\n"
            "f.SetNumberOfThreads(10**9)\n"
            "f.SetSamplingDimensions(300, 300, 1)\n"
            "f.Update()\n"
            "print(f.GetOutput().GetNumberOfPoints())\n")
        self.assertEqual((done.stdout.strip(), done.returncode), ("90000", 0), done.stderr)

    @unittest.skipIf(IS_WHEEL, "the wheel has no VTK classes")
    def test_nan_is_refused_by_the_class_too(self):
        for name, value in (("Alpha", "nan"), ("Offset", "nan"), ("Tolerance", "nan")):
            f = tipp.vtkTIPPDelaunay2D()
            f.SetInputData(tipp.delaunay_2d(POINTS, return_type="vtk"))
            getattr(f, "Set" + name)(float(value))
            with self.assertRaisesRegex(RuntimeError, f"{name} is nan: give a finite number"):
                tipp._run.run(f)


if __name__ == "__main__":
    unittest.main()
