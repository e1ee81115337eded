# SPDX-License-Identifier: BSD-3-Clause
"""The functions of the package tipp on NumPy arrays."""
import inspect
import os
import pathlib
import pydoc
import subprocess
import sys
import tempfile
import textwrap
import unittest
import warnings

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

import tipp
import tipp._vtk


def random_points(count, columns=3, kind=np.float64):
    return np.random.default_rng(5).random((count, columns)).astype(kind)


def edges_of(triangles):
    return {tuple(sorted((t[i], t[i - 1]))) for t in triangles.tolist() for i in range(3)}


def address(array):
    return array.__array_interface__["data"][0]


def public():
    """What users see of the package."""
    things = {name: getattr(tipp, name) for name in dir(tipp) if not name.startswith("_")}
    return [(name, thing) for name, thing in things.items() if not inspect.ismodule(thing)]


def memory_of(kind):
    """Bytes of memory of this process, by the name that Linux gives the figure."""
    with open("/proc/self/status", encoding="ascii") as file:
        return next(int(line.split()[1]) * 1024 for line in file if line.startswith(kind + ":"))


class Delaunay(unittest.TestCase):
    def test_triangles_are_counter_clockwise_and_cover_the_hull(self):
        p = np.vstack([random_points(1000, 2), [[0, 0], [1, 0], [1, 1], [0, 1]]])
        a, b, c = p[tipp.delaunay(p)].transpose(1, 0, 2)
        areas = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
        self.assertTrue((areas > 0).all())
        self.assertAlmostEqual(areas.sum() / 2, 1.0, places=12)

    def test_two_and_three_columns_give_the_same_triangles(self):
        p = random_points(500)
        np.testing.assert_array_equal(tipp.delaunay(p), tipp.delaunay(p[:, :2]))

    def test_integers_and_other_memory_layouts_are_accepted(self):
        p = np.random.default_rng(1).integers(0, 1000, (300, 2))
        expected = edges_of(tipp.delaunay(p.astype(float)))
        self.assertEqual(edges_of(tipp.delaunay(p)), expected)
        self.assertEqual(edges_of(tipp.delaunay(np.asfortranarray(p.astype(float)))), expected)
        self.assertEqual(edges_of(tipp.delaunay(p.astype(">f8"))), expected)

    def test_partitions_schedule_and_threads_change_nothing(self):
        p = random_points(20000, 2)
        expected = np.sort(np.sort(tipp.delaunay(p), axis=1), axis=0)
        for options in ({"partitions": (3, 2)}, {"schedule": "stages"}, {"threads": 1}):
            got = tipp.delaunay(p, **options)
            np.testing.assert_array_equal(np.sort(np.sort(got, axis=1), axis=0), expected)

    def test_points_of_three_columns_are_not_copied(self):
        for kind in (np.float32, np.float64):
            p = random_points(100, 3, kind)
            mesh = tipp.delaunay_2d(p)
            self.assertEqual(address(mesh.points), address(p))

    def test_other_points_are_copied_whole(self):
        from tipp._vtk import vtk_points

        base = random_points(600_000, 3)
        for p in (base[:, :2], base[::2], base[:, :2].astype(np.float32), (base * 1000).astype(np.int32),
                  base.astype(">f8"), base[:0, :2]):
            got = vtk_to_numpy(vtk_points(p).GetData()) if len(p) else np.empty((0, 3))
            self.assertEqual(got.shape, (len(p), 3))
            np.testing.assert_array_equal(got[:, :p.shape[1]], p)
            self.assertFalse(got[:, p.shape[1]:].any())

    def test_other_points_are_copied_once(self):
        from tipp._vtk import vtk_points

        p = random_points(2_000_000, 2)
        once = len(p) * 24
        with open("/proc/self/clear_refs", "w", encoding="ascii") as file:
            file.write("5")  # resets the peak
        before = memory_of("VmRSS")
        points = vtk_points(p)
        self.assertLess(memory_of("VmHWM") - before, 1.2 * once)
        self.assertGreater(memory_of("VmRSS") - before, 0.8 * once)
        self.assertEqual(points.GetNumberOfPoints(), len(p))

    def test_a_mesh_keeps_the_memory_of_its_points(self):
        mesh = tipp.delaunay_2d(random_points(100000, 3), point_data={"v": np.arange(100000.0)})
        trash = [np.full((100000, 3), -1.0) for _ in range(5)]
        self.assertGreaterEqual(mesh.bounds[0], 0)
        self.assertEqual(tipp.as_array(mesh, "v")[99999], 99999)
        del trash

    def test_triangles_outlive_the_mesh(self):
        triangles = tipp.delaunay(random_points(50000, 2))
        trash = [np.full(len(triangles) * 3, -1, triangles.dtype) for _ in range(5)]
        self.assertEqual((triangles.min(), triangles.max()), (0, 49999))
        del trash

    def test_rejected_points_give_a_warning(self):
        p = random_points(100, 2)
        p[7] = np.nan
        with self.assertWarnsRegex(RuntimeWarning, "the first is point 7"):
            triangles = tipp.delaunay(p)
        self.assertFalse((triangles == 7).any())

    def test_an_array_of_another_shape_or_type_is_refused(self):
        with self.assertRaisesRegex(ValueError, "shape"):
            tipp.delaunay(np.zeros(5))
        with self.assertRaisesRegex(ValueError, "shape"):
            tipp.delaunay(np.zeros((5, 4)))
        with self.assertRaisesRegex(TypeError, "real numbers"):
            tipp.delaunay(np.zeros((5, 2), complex))
        with self.assertRaisesRegex(ValueError, "2 values for 5 points"):
            tipp.delaunay_2d(random_points(5), point_data={"v": [1.0, 2.0]})
        with self.assertRaisesRegex(ValueError, "dynamic, producer-consumer|stages, dynamic"):
            tipp.delaunay(random_points(5), schedule="random")

    def test_alpha_leaves_long_triangles_out(self):
        p = random_points(1000)
        p[:, 2] = 0
        self.assertLess(len(tipp.delaunay_2d(p, alpha=0.02).cells), len(tipp.delaunay_2d(p).cells))

    def test_the_data_of_a_data_set_are_kept(self):
        mesh = tipp.delaunay_2d(random_points(50), point_data={"v": np.arange(50)}, return_type="vtk")
        again = tipp.delaunay_2d(mesh)
        np.testing.assert_array_equal(tipp.as_array(again, "v"), np.arange(50))
        with self.assertRaisesRegex(ValueError, "has its own"):
            tipp.delaunay_2d(mesh, point_data={"w": np.arange(50)})


class MeshOptions(unittest.TestCase):
    def setUp(self):
        self.points = np.vstack([random_points(400, 2), random_points(400, 2)[:3], [[np.nan, 0]]])

    def mesh(self, **options):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return tipp.delaunay_2d(self.points, **options)

    def test_representatives_are_the_lowest_of_equal_points(self):
        ids = tipp.as_array(self.mesh(map_duplicates=True), "RepresentativePointId")
        self.assertEqual([*range(400), 0, 1, 2, -1], ids.tolist())

    def test_neighbors_are_mutual(self):
        mesh = self.mesh(neighbors=True)
        neighbors = tipp.as_array(mesh, "NeighborIds")
        triangles = mesh.cells
        for triangle, beside in enumerate(neighbors):
            for corner, other in enumerate(beside):
                if other >= 0:
                    self.assertIn(triangle, neighbors[other])
                    self.assertNotIn(triangles[triangle][corner], triangles[other])
        self.assertEqual(len(edges_of(triangles)), (neighbors >= 0).sum() // 2 + (neighbors < 0).sum())

    def test_statistics_count_points_and_triangles(self):
        mesh, statistics = self.mesh(return_statistics=True)
        expected = {"points": 404, "triangles": len(mesh.cells), "duplicates": 3, "rejected": 1}
        self.assertEqual(expected, {name: statistics[name] for name in expected})
        self.assertGreater(statistics["partitions"], 0)
        self.assertGreater(statistics["default_threads"], 0)
        self.assertIn(statistics["default_threads_from"],
                      ("processors", "affinity", "control group", "ranks on this node", "OMP_NUM_THREADS"))
        self.assertTrue(all(seconds >= 0 for seconds in statistics["seconds"].values()))

    def test_statistics_count_constraints(self):
        square = [[0, 0], [4, 0], [4, 4], [0, 4]]
        _, statistics = tipp.delaunay_2d(square, edges=[[0, 2], [1, 3]], return_statistics=True)
        self.assertEqual((2, 4, 1), tuple(statistics[n] for n in ("constraints", "constraint_edges", "crossing_points")))


class Resample(unittest.TestCase):
    def setUp(self):
        p = np.vstack([random_points(2000), [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]])
        self.mesh = tipp.delaunay_2d(p, point_data={"f": 2 * p[:, 0] + p[:, 1], "g": p[:, 0]})

    def test_three_lines_lead_from_an_array_to_an_image(self):
        grid = tipp.as_array(tipp.resample(self.mesh, dimensions=(5, 3, 1)), "f")
        x, y = np.meshgrid(np.linspace(0, 1, 5), np.linspace(0, 1, 3))
        np.testing.assert_allclose(grid, 2 * x + y, atol=1e-12)

    def test_samples_are_square_by_default(self):
        image = tipp.resample(self.mesh, bounds=(0, 1, 0, 0.5, -1, 1))
        self.assertEqual(image.dimensions, (256, 129, 1))

    def test_spacing_begins_at_the_lower_bound(self):
        image = tipp.resample(self.mesh, bounds=(0.125, 0.65, 0.25, 0.75, 0, 0),
                              spacing=(0.125, 0.25, 0))
        self.assertEqual(image.dimensions, (5, 3, 1))
        np.testing.assert_allclose(tipp.as_array(image, "g")[0], 0.125 * np.arange(1, 6), atol=1e-12)

    def test_arrays_can_be_chosen(self):
        image = tipp.resample(self.mesh, dimensions=(4, 4, 1), arrays=["g"])
        self.assertIn("g", image.point_data)
        self.assertNotIn("f", image.point_data)

    def test_null_value_and_no_data_mask(self):
        values = tipp.as_array(self.mesh, "f")
        values[values > 2] = -99999
        image = tipp.resample(self.mesh, dimensions=(20, 20, 1), null_value=-1, no_data=-99999)
        grid = tipp.as_array(image, "f")
        self.assertEqual(grid[-1, -1], -1)
        self.assertGreaterEqual(grid.min(), -1)
        self.assertEqual(tipp.as_array(image, "vtkValidPointMask")[-1, -1], 0)

    def test_errors_are_exceptions(self):
        with self.assertRaisesRegex(RuntimeError, "lower one first"):
            tipp.resample(self.mesh, bounds=(1, 0, 0, 1, 0, 0), dimensions=(4, 4, 1))
        with self.assertRaisesRegex(RuntimeError, "not 'cuda'"):
            tipp.resample(self.mesh, device="cuda")

    def test_an_unknown_array_is_named(self):
        with self.assertRaisesRegex(KeyError, "no array 'h'.*'f', 'g'"):
            tipp.as_array(self.mesh, "h")


class Meshes(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = os.path.join(self.folder.name, "mesh.tipp")
        p = random_points(5000)
        p[:, 2] = 0
        self.mesh = tipp.delaunay_2d(p, point_data={"f": p[:, 0], "g": p[:, 1]})
        tipp.write(self.mesh, self.path, tiling="grid:3x3")

    def tearDown(self):
        self.folder.cleanup()

    def test_a_mesh_is_read_as_written(self):
        back = tipp.read(self.path)
        self.assertEqual(len(back.cells), len(self.mesh.cells))

    def test_bounds_read_a_part(self):
        part = tipp.read(self.path, bounds=(0.1, 0.2, 0.1, 0.2, 0, 0))
        self.assertGreater(len(part.cells), 50)
        self.assertLess(len(part.cells), 300)

    def test_arrays_can_be_chosen(self):
        back = tipp.read(self.path, point_arrays=["g"])
        self.assertIn("g", back.point_data)
        self.assertNotIn("f", back.point_data)
        with self.assertRaisesRegex(KeyError, "no point array 'h'"):
            tipp.read(self.path, point_arrays=["h"])

    def test_pieces_can_be_read_separately(self):
        self.assertEqual(len(tipp.read(self.path, merge=False)), 9)

    def test_a_mesh_that_was_read_can_be_written_again(self):
        other = os.path.join(self.folder.name, "other.tipp")
        tipp.write(tipp.read(self.path), other, tiling="grid:2x2")
        self.assertEqual(len(tipp.read(other).cells), len(self.mesh.cells))

    def test_a_file_is_partitioned_without_being_loaded(self):
        writer = vtkXMLUnstructuredGridWriter()
        mesh = tipp.read(self.path, return_type="vtk")
        for data, ids in ((mesh.GetPointData(), "GlobalPointIds"), (mesh.GetCellData(), "GlobalCellIds")):
            data.RemoveArray(ids)
            data.RemoveArray("vtkGhostType")
        writer.SetInputData(mesh)
        flat, other = (os.path.join(self.folder.name, name) for name in ("flat.vtu", "other.tipp"))
        writer.SetFileName(flat)
        writer.SetEncodeAppendedData(False)
        writer.SetCompressorTypeToNone()
        writer.Write()
        tipp.write(flat, other, tiling="grid:2x2")
        self.assertEqual(len(tipp.read(other).cells), len(self.mesh.cells))

    def test_errors_are_exceptions(self):
        with self.assertRaisesRegex(RuntimeError, "neither a partitioned mesh"):
            tipp.read(os.path.join(self.folder.name, "nothing"))
        with self.assertRaisesRegex(RuntimeError, "Tiling is 'hexagons'"):
            tipp.write(self.mesh, self.path, tiling="hexagons")


class Files(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.points = random_points(60_000, 2)
        self.input = self.path("points.npy")
        np.save(self.input, self.points)
        self.output = self.path("mesh.tipp")

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def test_a_file_becomes_the_mesh_of_its_points(self):
        made = tipp.delaunay_file(pathlib.Path(self.input), pathlib.Path(self.output), memory="2M")
        self.assertEqual((made["points"], made["duplicates"], made["resumed"]), (60_000, 0, 0))
        self.assertGreater(made["pieces"], 4)
        mesh = tipp.read(self.output)
        self.assertEqual(len(mesh.cells), made["triangles"])
        ids = tipp.as_array(mesh, "GlobalPointIds")
        corners = mesh.cells
        self.assertEqual(edges_of(ids[corners]), edges_of(tipp.delaunay(self.points)))

    def test_several_files_and_columns_by_name(self):
        for name in ("a.csv", "b.csv"):
            np.savetxt(self.path(name), random_points(500, 3) + ord(name[0]), delimiter=",", comments="",
                       header="height,south,west")
        made = tipp.delaunay_file([self.path("a.csv"), self.path("b.csv")], self.output,
                                  columns=("west", "south"), partitions=(3, 2), map_duplicates=True)
        self.assertEqual((made["points"], made["pieces"]), (1000, 6))
        mesh = tipp.read(self.output)
        self.assertIn("height", mesh.point_data)
        self.assertIn("RepresentativePointId", mesh.point_data)

    def test_neighbors_are_mutual(self):
        tipp.delaunay_file(self.input, self.output, memory="1M", neighbors=True)
        mesh = tipp.read(self.output)
        cells = tipp.as_array(mesh, "GlobalCellIds")
        neighbors = np.empty((len(cells), 3), dtype=np.int64)
        neighbors[cells] = tipp.as_array(mesh, "NeighborIds")
        cell, corner = np.nonzero(neighbors >= 0)
        self.assertTrue((neighbors[neighbors[cell, corner]] == cell[:, None]).any(axis=1).all())

    def test_constraints_come_from_files(self):
        with open(self.path("lines.csv"), "w", encoding="utf-8") as file:
            file.write("x1,y1,x2,y2\n0.1,0.1,0.9,0.9\n0.1,0.9,0.9,0.1\n")
        with open(self.path("square.csv"), "w", encoding="utf-8") as file:
            corners = [(0.2, 0.2), (0.8, 0.2), (0.8, 0.8), (0.2, 0.8)]
            file.write("x1,y1,x2,y2\n")
            file.writelines(f"{a[0]},{a[1]},{b[0]},{b[1]}\n" for a, b in zip(corners, corners[1:] + corners[:1]))
        made = tipp.delaunay_file(self.input, self.output, constraints=self.path("lines.csv"),
                                  boundary=self.path("square.csv"), holes=[(0.5, 0.3)], mark_constraints=True)
        self.assertEqual((6, 1), (made["constraints"], made["crossing_points"]))
        mesh = tipp.read(self.output)
        xy = mesh.points[:, :2]
        a, b, c = xy[mesh.cells].transpose(1, 0, 2)
        u, v = b - a, c - a
        area = (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]).sum() / 2
        self.assertAlmostEqual(0.75 * 0.36, area)
        self.assertGreater(tipp.as_array(mesh, "ConstraintEdges").sum(), 0)
        with self.assertRaisesRegex(RuntimeError, "crosses constraint"):
            tipp.delaunay_file(self.input, self.output, constraints=self.path("lines.csv"), crossings="refuse")

    def test_counted_triangles_are_not_written(self):
        made = tipp.delaunay_file(self.input, self.output, count_only=True, threads=1)
        self.assertEqual(made["triangles"], len(tipp.delaunay(self.points)))
        self.assertGreater(made["triangle_sum"], 0)
        self.assertEqual(os.listdir(self.folder.name), ["points.npy"])

    def test_misuse_is_reported(self):
        for memory in (0, -5, "2P", "", "1.5G", 1 << 70):
            with self.assertRaisesRegex(ValueError, "memory is"):
                tipp.delaunay_file(self.input, self.output, memory=memory)
        with self.assertRaisesRegex(RuntimeError, "nothing.npy: cannot be opened"):
            tipp.delaunay_file(self.path("nothing.npy"), self.output)
        with self.assertRaisesRegex(RuntimeError, "no files of points"):
            tipp.delaunay_file([], self.output)
        with self.assertRaisesRegex(RuntimeError, "FileName is not set"):
            tipp.delaunay_file(self.input, "")
        with self.assertRaisesRegex(RuntimeError, "points.npy: is also an input"):
            tipp.delaunay_file(self.input, self.input)
        pathlib.Path(self.output).write_text("the user's", encoding="utf-8")
        with self.assertRaisesRegex(RuntimeError, "mesh.tipp: exists already"):
            tipp.delaunay_file(self.input, self.output)


class Package(unittest.TestCase):
    def test_every_public_function_is_documented_and_has_type_hints(self):
        for name, thing in public():
            self.assertTrue(inspect.getdoc(thing), name)
            if inspect.isfunction(thing):
                parameters = inspect.signature(thing).parameters
                missing = [p for p in parameters if p not in thing.__annotations__]
                self.assertEqual(missing, [], name)
                undocumented = [p for p in parameters if p not in inspect.getdoc(thing)]
                self.assertEqual(undocumented, [], name)

    def test_help_is_an_overview(self):
        text = pydoc.render_doc(tipp, renderer=pydoc.plaintext)
        self.assertLess(text.count("\n"), 300)
        for name, thing in public():
            if inspect.isfunction(thing):
                self.assertIn(f"{name}(", text)

    def run_python(self, program, **files):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                with open(os.path.join(folder, name + ".py"), "w", encoding="utf-8") as file:
                    file.write(textwrap.dedent(text))
            path = os.pathsep.join([folder, os.environ.get("PYTHONPATH", "")])
            return subprocess.run([sys.executable, "-c", textwrap.dedent(program)], text=True, check=True,
                                  env={**os.environ, "PYTHONPATH": path}, capture_output=True).stdout.strip()

    # The functions with which packages like this one register in PyVista, before and since version 0.48.
    OLD = """
        class DataObject: pass
        class DataSet(DataObject): pass
        """
    NEW = OLD + """
        def register_dataset_accessor(name, cls):
            def register(accessor):
                setattr(cls, name, property(accessor))
                return accessor
            return register
        """

    def test_importing_it_imports_no_pyvista(self):
        program = "import sys, tipp; print('pyvista' in sys.modules)"
        self.assertEqual(self.run_python(program, pyvista=self.OLD), "False")

    def test_pyvista_gets_the_accessor_in_any_order_of_imports(self):
        for first, second in (("tipp", "pyvista"), ("pyvista", "tipp")):
            for release in (self.OLD, self.NEW):
                program = f"import {first}, {second}; print(type(pyvista.DataSet().tipp).__name__)"
                self.assertEqual(self.run_python(program, pyvista=release), "Accessor")

    def test_looking_for_pyvista_does_not_keep_the_accessor_from_it(self):
        program = ("import importlib.util, tipp; importlib.util.find_spec('pyvista'); import pyvista;"
                   "print(type(pyvista.DataSet().tipp).__name__)")
        self.assertEqual(self.run_python(program, pyvista=self.NEW), "Accessor")

    @unittest.skipIf("site-packages" in tipp.__file__, "the package lies where PyVista does")
    def test_a_missing_pyvista_is_still_an_import_error(self):
        program = """
            import sys
            sys.path = [p for p in sys.path if "site-packages" not in p]
            import tipp
            try:
                import pyvista
            except ModuleNotFoundError as error:
                print(error.name)
            else:
                print("pyvista")  # Debian's own is there
            """
        self.assertEqual(self.run_python(program), "pyvista")


if __name__ == "__main__":
    warnings.simplefilter("error", DeprecationWarning)
    unittest.main()
