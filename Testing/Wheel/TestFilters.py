# SPDX-License-Identifier: BSD-3-Clause
"""The wheel's VTK filters in pipelines of the installed VTK."""
import gc
import os
import tempfile
import unittest
import warnings

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIdList
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkFiltersSources import vtkPointSource

import tipp
import tipp._filters
from tipp._filter import Filter
from tipp._vtk import grid_of, point_cloud, triangles_of, vtk_array


def cloud(count=500):
    points = np.random.default_rng(8).random((count, 3))
    return point_cloud(points, {"height": points[:, 0] + points[:, 1]})


def kinds_of(mesh):
    return [mesh.GetCellType(i) for i in range(mesh.GetNumberOfCells())]


def polygon(ids, corners=None):
    cells = vtkCellArray()
    one = vtkIdList()
    for i in ids:
        one.InsertNextId(i)
    cells.InsertNextCell(one)
    source = point_cloud(corners) if corners is not None else vtkPolyData()
    source.SetPolys(cells)
    return source


class Delaunay2D(unittest.TestCase):
    def setUp(self):
        self.filter = tipp.vtkTIPPDelaunay2D()
        self.errors = []

        def on_error(_object, _event, text):
            self.errors.append(text)

        on_error.CallDataType = "string0"
        self.filter.AddObserver("ErrorEvent", on_error)

    def test_a_pipeline_updates_when_its_source_changes(self):
        source = vtkPointSource()
        source.SetNumberOfPoints(100)
        self.filter.SetInputConnection(source.GetOutputPort())
        self.filter.Update()
        self.assertEqual(100, self.filter.GetOutput().GetNumberOfPoints())
        source.SetNumberOfPoints(200)
        self.filter.Update()
        self.assertEqual(200, self.filter.GetOutput().GetNumberOfPoints())

    def test_properties_are_those_of_the_class(self):
        self.assertEqual((0.0, 1.0, (0, 0), 1), (self.filter.GetAlpha(), self.filter.GetOffset(),
                                                 self.filter.GetNumberOfPartitions(), self.filter.GetSchedule()))
        before = self.filter.GetMTime()
        self.filter.SetNumberOfPartitions(3, 2)
        self.filter.GenerateNeighborIdsOn()
        self.filter.SetTolerance(7.0)
        self.assertEqual(((3, 2), True, 1.0), (self.filter.GetNumberOfPartitions(), self.filter.GetGenerateNeighborIds(),
                                               self.filter.GetTolerance()))
        self.assertGreater(self.filter.GetMTime(), before)
        with self.assertRaisesRegex(TypeError, "NumberOfPartitions has 3 values; give 2"):
            self.filter.SetNumberOfPartitions(1, 2, 3)

    def test_the_mesh_is_that_of_the_function(self):
        points = cloud()
        self.filter.SetInputData(points)
        self.filter.SetGenerateNeighborIds(True)
        self.filter.Update()
        mesh = self.filter.GetOutput()
        expected = tipp.delaunay_2d(points, neighbors=True)
        np.testing.assert_array_equal(triangles_of(expected), triangles_of(mesh))
        np.testing.assert_array_equal(tipp.as_array(expected, "NeighborIds"), tipp.as_array(mesh, "NeighborIds"))
        totals = self.filter.GetStatistics().GetFieldData()
        self.assertEqual(mesh.GetNumberOfPolys(), totals.GetArray("Triangles").GetValue(0))
        self.assertEqual(0, self.filter.GetNumberOfDuplicatePoints())

    def test_a_source_adds_constraints(self):
        self.filter.SetInputData(cloud(100))
        self.filter.SetSourceData(polygon([3, 40, 70]))
        self.filter.SetConstraintMarks(tipp.vtkTIPPDelaunay2D.LINES)
        self.filter.Update()
        self.assertGreater(self.filter.GetOutput().GetNumberOfLines(), 2)
        self.assertEqual([], self.errors)

    def test_points_of_a_source_join_those_of_the_input(self):
        self.filter.SetInputData(cloud(100))
        corners = np.array([[-1.0, -1, 0], [2, -1, 0], [2, 2, 0], [-1, 2, 0]])
        self.filter.SetSourceData(polygon(range(4), corners))
        self.filter.MergeSourcePointsOn()
        self.filter.Update()
        self.assertEqual(104, self.filter.GetOutput().GetNumberOfPoints())
        a, b, c = vtk_to_numpy(self.filter.GetOutput().GetPoints().GetData())[triangles_of(self.filter.GetOutput()).T]
        areas = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
        self.assertAlmostEqual(9.0, areas.sum() / 2)

    def test_an_array_of_the_source_with_too_few_values_is_an_error_that_names_it(self):
        self.filter.SetInputData(cloud(100))
        source = polygon(range(4), np.array([[-1.0, -1, 0], [2, -1, 0], [2, 2, 0], [-1, 2, 0]]))
        source.GetPointData().AddArray(vtk_array("height", np.ones(2)))
        self.filter.SetSourceData(source)
        self.filter.MergeSourcePointsOn()
        self.filter.Update()
        self.assertRegex(self.errors[0], "array 'height' has 2 values for 4 points")

    def test_failures_are_errors_of_vtk_and_leave_no_exception(self):
        self.filter.SetInputData(cloud(100))
        self.filter.SetSourceData(polygon([3, 40, 700]))
        self.filter.Update()
        self.assertRegex(self.errors[0], "names point 700, but the input has 100 points")
        self.filter.SetSourceData(polygon([3, 40, 70]))
        self.filter.SetAlpha(float("nan"))
        self.filter.Update()
        self.assertRegex(self.errors[-1], "^Alpha is nan; give a finite number.$|returned failure")

    def test_progress_is_reported_and_abort_ends_the_run(self):
        self.filter.SetInputData(cloud(200_000))
        heard = []
        tag = self.filter.AddObserver("ProgressEvent", lambda *_: heard.append(self.filter.GetProgress()))
        self.filter.Update()
        self.assertGreater(len(heard), 2)
        self.filter.RemoveObserver(tag)
        self.filter.AddObserver("ProgressEvent", lambda *_: self.filter.SetAbortExecute(1))
        self.filter.Modified()
        self.filter.Update()
        self.assertEqual(([], 0), (self.errors, self.filter.GetOutput().GetNumberOfPolys()))


class Overlap(unittest.TestCase):
    def setUp(self):
        self.mesh = tipp.delaunay_2d(cloud(100))
        self.target = tipp.delaunay_2d(cloud(30))

    def test_a_remapped_mesh_is_that_of_the_function(self):
        for target in (self.target, grid_of(tipp._vtk.from_vtk(self.target))):
            algorithm = tipp.vtkTIPPRemap(null_value=-1)
            algorithm.SetInputData(target)
            algorithm.SetSourceData(self.mesh)
            algorithm.AddArray("height")
            algorithm.Update()
            expected = tipp.remap(self.mesh, self.target, arrays="height", null_value=-1)
            self.assertEqual(target.GetClassName(), algorithm.GetOutput().GetClassName())
            np.testing.assert_array_equal(tipp.as_array(expected, "height"), tipp.as_array(algorithm.GetOutput(), "height"))

    def test_volumes_are_those_of_the_function(self):
        algorithm = tipp.vtkTIPPCutFill(use_bounds=True, bounds=(0.2, 0.7, 0.3, 0.6))
        algorithm.SetInputData(self.mesh)
        algorithm.SetSourceData(self.target)
        algorithm.Update()
        row = algorithm.GetOutput()
        found = [row.GetColumnByName(name).GetValue(0) for name in ("Cut", "Fill", "Net", "Area", "OnlyBefore", "OnlyAfter")]
        self.assertEqual(list(tipp.volume(self.mesh, self.target, bounds=(0.2, 0.7, 0.3, 0.6))), found)
        self.assertGreater(found[3], 0)

    def test_an_image_of_means_is_that_of_the_function(self):
        algorithm = tipp.vtkRangeResampleFilter(method=1, pass_covered_share=True, sampling_dimensions=(8, 6, 1))
        algorithm.SetInputData(self.mesh)
        algorithm.Update()
        expected = tipp.resample(self.mesh, dimensions=(8, 6, 1), method="conservative", covered_share=True)
        for name in ("height", "CoveredShare"):
            np.testing.assert_array_equal(tipp.as_array(expected, name), tipp.as_array(algorithm.GetOutput(), name))


def every_filter():
    return [getattr(tipp, name) for name in dir(tipp._filters) if name.startswith(("vtkTIPP", "vtkPartitioned", "vtkRange"))
            and issubclass(getattr(tipp._filters, name), Filter)]


class Delaunay3D(unittest.TestCase):
    def test_the_mesh_is_that_of_the_function(self):
        algorithm = tipp.vtkTIPPDelaunay3D(generate_neighbor_ids=True)
        algorithm.SetInputData(cloud())
        algorithm.Update()
        expected = tipp.delaunay_3d(cloud(), neighbors=True)
        np.testing.assert_array_equal(tipp.as_array(expected, "NeighborIds"), tipp.as_array(algorithm.GetOutput(), "NeighborIds"))
        totals = algorithm.GetStatistics().GetFieldData()
        self.assertEqual(expected.GetNumberOfCells(), totals.GetArray("Tetrahedra").GetValue(0))
        self.assertEqual(0, algorithm.GetNumberOfDuplicatePoints())

    def test_each_kind_of_cell_of_an_alpha_shape_can_be_left_out(self):
        algorithm = tipp.vtkTIPPDelaunay3D(alpha=0.1)
        algorithm.SetInputData(cloud())
        algorithm.Update()
        kinds = kinds_of(algorithm.GetOutput())
        self.assertLessEqual({3, 5, 10}, set(kinds))
        for name, kind in (("Tets", 10), ("Tris", 5), ("Lines", 3), ("Verts", 1)):
            getattr(algorithm, f"SetAlpha{name}")(False)
            algorithm.Update()
            self.assertEqual([each for each in kinds if each != kind], kinds_of(algorithm.GetOutput()))
            getattr(algorithm, f"SetAlpha{name}")(True)


class Properties(unittest.TestCase):
    def test_have_the_names_of_python(self):
        made = tipp.vtkTIPPDelaunay2D(alpha=0.02)
        made.maximum_edge_length = 3
        made.number_of_partitions = (3, 2)
        made.generate_neighbor_ids = True
        self.assertEqual((0.02, 3.0, (3, 2), True), (made.GetAlpha(), made.GetMaximumEdgeLength(),
                                                     made.GetNumberOfPartitions(), made.GetGenerateNeighborIds()))
        self.assertEqual((0.02, 1.0), (made.alpha, made.offset))
        before = made.GetMTime()
        made.alpha = 0.03
        self.assertGreater(made.GetMTime(), before)

    def test_of_every_filter_have_both_names(self):
        for kind in every_filter():
            made = kind()
            for name in kind.PROPERTIES:
                # NaN equals NaN here
                np.testing.assert_equal(getattr(made, tipp._filter._in_python(name)), getattr(made, f"Get{name}")(), name)

    def test_that_are_unknown_raise(self):
        for kind in every_filter():
            with self.assertRaisesRegex(AttributeError, f"{kind.__name__} has no property 'alpah'"):
                kind().alpah = 0.02
            with self.assertRaisesRegex(AttributeError, "has no property 'alpah'"):
                kind(alpah=0.02)

    def test_inputs_are_properties(self):
        made = tipp.vtkTIPPDelaunay2D()
        made.source_data = polygon([3, 40, 70])
        self.assertEqual(1, made.source.GetNumberOfPolys())


class Memory(unittest.TestCase):
    def test_of_every_filter_is_freed(self):
        for kind in every_filter():
            made = kind()
            freed = []
            made.AddObserver("DeleteEvent", lambda *_: freed.append(True))
            del made
            gc.collect()
            self.assertEqual([True], freed, kind.__name__)

    def test_a_selection_of_arrays_modifies_its_filter(self):
        made = tipp.vtkRangeResampleFilter()
        before = made.GetMTime()
        made.GetPointDataArraySelection().DisableArray("height")
        self.assertGreater(made.GetMTime(), before)


class Warnings(unittest.TestCase):
    def test_of_the_package_are_events_and_others_are_left_to_python(self):
        points = cloud(50)
        points.GetPoints().SetPoint(7, float("nan"), 0, 0)
        made = tipp.vtkTIPPDelaunay2D()
        made.SetInputData(points)
        told = []

        def on_warning(_object, _event, text):
            told.append(text)

        on_warning.CallDataType = "string0"
        made.AddObserver("WarningEvent", on_warning)
        made.AddObserver("ProgressEvent", lambda *_: warnings.warn("of another package", DeprecationWarning))
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            made.Update()
        self.assertRegex(told[0], "the first is point 7")
        self.assertEqual(1, len(told))
        self.assertIn("of another package", {str(w.message) for w in caught})


class Meshes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = os.path.join(folder.name, "mesh.tipp")
        self.points = os.path.join(folder.name, "points.npy")
        self.triangulation = tipp.vtkTIPPDelaunay2D()
        self.triangulation.SetInputData(cloud())

    def test_an_image_is_the_functions(self):
        sampler = tipp.vtkRangeResampleFilter()
        sampler.SetInputConnection(self.triangulation.GetOutputPort())
        sampler.SetSamplingDimensions(9, 7, 1)
        sampler.UpdateInformation()
        self.assertEqual((0, 8, 0, 6, 0, 0), sampler.GetOutputInformation(0).Get(
            tipp._filters.vtkStreamingDemandDrivenPipeline.WHOLE_EXTENT()))
        sampler.Update()
        expected = tipp.resample(self.triangulation.GetOutput(), dimensions=(9, 7, 1))
        np.testing.assert_array_equal(tipp.as_array(expected, "height"), tipp.as_array(sampler.GetOutput(), "height"))

    def test_a_mesh_is_written_and_a_part_of_it_read(self):
        writer = tipp.vtkPartitionedUnstructuredWriter()
        writer.SetInputConnection(self.triangulation.GetOutputPort())
        writer.SetFileName(self.path)
        self.assertEqual(1, writer.Write())
        reader = tipp.vtkPartitionedUnstructuredReader()
        self.assertEqual((1, 0), (reader.CanReadFile(self.path), reader.CanReadFile(self.path + "x")))
        reader.SetFileName(self.path)
        reader.UpdateInformation()
        self.assertEqual("height", reader.GetPointDataArraySelection().GetArrayName(0))
        reader.Update()
        whole = reader.GetOutput()
        self.assertIsInstance(whole, vtkUnstructuredGrid)
        count = whole.GetNumberOfCells()
        self.assertEqual(self.triangulation.GetOutput().GetNumberOfPolys(), count)
        reader.SetBounds(0, 0.2, 0, 0.2, 0, 0)
        reader.GetPointDataArraySelection().DisableArray("height")
        reader.Update()
        self.assertLess(reader.GetOutput().GetNumberOfCells(), count / 3)
        self.assertFalse(reader.GetOutput().GetPointData().HasArray("height"))

    def test_a_query_answers_in_memory_and_from_the_disk(self):
        writer = tipp.vtkPartitionedUnstructuredWriter()
        writer.SetInputConnection(self.triangulation.GetOutputPort())
        writer.SetFileName(self.path)
        self.assertEqual(1, writer.Write())
        asked = point_cloud(np.random.default_rng(4).random((200, 3)) * 1.4 - 0.2, {"own": np.arange(200.0)})
        query = tipp.vtkPartitionedMeshQuery()
        query.SetInputData(asked)
        query.SetSourceConnection(self.triangulation.GetOutputPort())
        query.SetNullValue(-3)
        query.PassPointArraysOn()
        query.Update()
        of_memory = query.GetOutput()
        self.assertIsInstance(of_memory, vtkPolyData)
        query.SetFileName(self.path)
        query.AddArray("height")
        query.Update()
        of_disk = query.GetOutput().GetPointData()
        self.assertFalse(of_disk.HasArray("elevation"))
        for name in ("height", "CellId", "vtkValidPointMask", "own"):
            np.testing.assert_array_equal(vtk_to_numpy(of_memory.GetPointData().GetArray(name)),
                                          vtk_to_numpy(of_disk.GetArray(name)))
        outside = vtk_to_numpy(of_disk.GetArray("CellId")) < 0
        self.assertTrue(outside.any() and not outside.all())
        np.testing.assert_array_equal(-3, vtk_to_numpy(of_disk.GetArray("height"))[outside])
        np.testing.assert_array_equal(outside, vtk_to_numpy(of_disk.GetArray("vtkValidPointMask")) == 0)

    def test_points_in_files_are_read_and_triangulated_out_of_core(self):
        np.save(self.points, np.random.default_rng(1).random((3000, 3)))
        reader = tipp.vtkTIPPPointReader()
        reader.SetFileName(self.points)
        reader.Update()
        self.assertEqual(3000, reader.GetOutput().GetNumberOfPoints())
        outside = tipp.vtkTIPPOutOfCoreDelaunay2D()
        outside.AddInputFileName(self.points)
        outside.SetFileName(self.path)
        outside.SetMemoryLimit(64 << 20)
        outside.Update()
        count = outside.GetStatistics().GetFieldData().GetArray("Triangles").GetValue(0)
        self.triangulation.SetInputConnection(reader.GetOutputPort())
        self.triangulation.Update()
        self.assertEqual(self.triangulation.GetOutput().GetNumberOfPolys(), count)


if __name__ == "__main__":
    unittest.main()
