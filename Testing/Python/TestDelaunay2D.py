# SPDX-License-Identifier: BSD-3-Clause
"""vtkTIPPDelaunay2D as Python programs use it."""
import importlib.util
import unittest

import numpy as np
from vtkmodules.numpy_interface.dataset_adapter import WrapDataObject
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkCommonTransforms import vtkTransform

from tipp import vtkTIPPDelaunay2D


def dataset(coordinates):
    points = vtkPoints()
    points.SetData(numpy_to_vtk(coordinates))
    data = vtkPolyData()
    data.SetPoints(points)
    return data


def triangles(output):
    return vtk_to_numpy(output.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def scattered(count, dtype=np.float64):
    return np.random.default_rng(1).random((count, 3)).astype(dtype)


class Import(unittest.TestCase):
    def test_class_is_the_same_from_package_and_module(self):
        from tipp.vtkTIPPFilters import vtkTIPPDelaunay2D as from_module

        self.assertIs(from_module, vtkTIPPDelaunay2D)

    def test_projection_plane_modes_have_vtk_values(self):
        import tipp
        from vtkmodules import vtkFiltersCore as vtk

        for name in ("VTK_DELAUNAY_XY_PLANE", "VTK_SET_TRANSFORM_PLANE", "VTK_BEST_FITTING_PLANE"):
            self.assertEqual(getattr(tipp, name), getattr(vtk, name))


class Triangulate(unittest.TestCase):
    def run_filter(self, coordinates, **properties):
        self.filter = vtkTIPPDelaunay2D()
        self.filter.SetInputData(dataset(coordinates))
        for name, value in properties.items():
            getattr(self.filter, "Set" + name)(value)
        self.filter.Update()
        return self.filter.GetOutput()

    def test_numpy_points_become_counter_clockwise_triangles(self):
        for dtype in (np.float64, np.float32):
            with self.subTest(dtype=dtype):
                p = scattered(1000, dtype)
                a, b, c = (p[column, :2].astype(float) for column in triangles(self.run_filter(p)).T)
                double_areas = np.cross(b - a, c - a)
                self.assertGreater(double_areas.min(), 0)
                self.assertLessEqual(double_areas.sum(), 2)
                self.assertGreater(double_areas.sum(), 1.9)

    def test_output_points_share_memory_with_the_numpy_array(self):
        p = scattered(100)
        output = self.run_filter(p)
        self.assertTrue(np.shares_memory(p, vtk_to_numpy(output.GetPoints().GetData())))

    def test_duplicates_and_rejected_points_are_named(self):
        p = scattered(100)
        p[40] = p[7]
        p[50] = np.nan
        with np.errstate(all="ignore"):
            f = vtkTIPPDelaunay2D()
            warnings = []
            f.AddObserver("WarningEvent", lambda *_: warnings.append(1))
            f.SetInputData(dataset(p))
            f.Update()
        ids = vtk_to_numpy(f.GetOutput().GetPointData().GetArray("RepresentativePointId"))
        expected = np.arange(100)
        expected[[40, 50]] = 7, -1
        np.testing.assert_array_equal(ids, expected)
        self.assertEqual(
            (f.GetNumberOfDuplicatePoints(), f.GetNumberOfRejectedPoints(), len(warnings)), (1, 1, 1)
        )

    def test_transform_turns_the_plane(self):
        p = scattered(100)
        turn = vtkTransform()
        turn.RotateX(-90)  # z becomes y
        turned = triangles(self.run_filter(p, Transform=turn))
        swapped = triangles(self.run_filter(np.ascontiguousarray(p[:, [0, 2, 1]])))
        as_set = lambda ids: {tuple(sorted(t)) for t in ids.tolist()}
        self.assertEqual(as_set(turned), as_set(swapped))

    def test_statistics_are_readable_as_columns_and_field_data(self):
        self.run_filter(scattered(1000))
        table = WrapDataObject(self.filter.GetStatistics())
        self.assertEqual(table.RowData.keys(), ["Stage", "ActivePartitions", "MeshTriangles"])
        self.assertEqual(table.FieldData["Points"][0], 1000)
        fields = self.filter.GetStatistics().GetFieldData()
        names = fields.GetAbstractArray("PhaseName")
        self.assertEqual(names.GetNumberOfValues(), len(table.FieldData["PhaseSeconds"]))
        self.assertEqual(names.GetValue(0), "projection")

    def test_best_fitting_plane_is_a_transform(self):
        p = scattered(100)
        p[:, 2] = 0.001 * p[:, 2] + 5
        transform = vtkTIPPDelaunay2D.ComputeBestFittingPlane(dataset(p))
        z = [transform.TransformPoint(q)[2] for q in p]
        self.assertLess(np.abs(z).max(), 0.01)

    def test_progress_observers_can_abort(self):
        f = vtkTIPPDelaunay2D()
        f.SetInputData(dataset(scattered(1000)))
        f.SetTolerance(1e-9)
        f.AddObserver("ProgressEvent", lambda caller, _: caller.AbortExecuteOn())
        f.Update()
        self.assertEqual(f.GetOutput().GetNumberOfCells(), 0)


@unittest.skipUnless(importlib.util.find_spec("pyvista"), "pyvista is not installed")
class PyVista(unittest.TestCase):
    def test_output_is_wrapped(self):
        import pyvista

        f = vtkTIPPDelaunay2D()
        f.SetInputData(pyvista.PolyData(scattered(100)))
        f.Update()
        mesh = pyvista.wrap(f.GetOutput())
        self.assertEqual(mesh.n_points, 100)
        self.assertTrue(mesh.is_all_triangles)


if __name__ == "__main__":
    unittest.main()
