# SPDX-License-Identifier: BSD-3-Clause
"""vtkRangeResampleFilter as Python programs use it."""
import unittest

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData

from tipp import vtkRangeResampleFilter, vtkTIPPDelaunay2D


def surface(points, **arrays):
    data = vtkPolyData()
    vtk_points = vtkPoints()
    vtk_points.SetData(numpy_to_vtk(points, deep=True))
    data.SetPoints(vtk_points)
    delaunay = vtkTIPPDelaunay2D()
    delaunay.SetInputData(data)
    delaunay.Update()
    mesh = delaunay.GetOutput()
    for name, values in arrays.items():
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        mesh.GetPointData().AddArray(array)
    return mesh


def clustered(count):
    rng = np.random.default_rng(3)
    centres = rng.random((20, 3))
    spread = 10.0 ** rng.uniform(-5, -2, 20)
    which = rng.integers(20, size=count)
    return centres[which] + spread[which, None] * rng.standard_normal((count, 3))


def arrays_of(image):
    data = image.GetPointData()
    return {
        data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())
    }


class Resample(unittest.TestCase):
    def run_filter(self, mesh, bounds=None, **properties):
        self.filter = vtkRangeResampleFilter()
        self.filter.SetInputData(mesh)
        if bounds:
            self.filter.SetUseInputBounds(False)
            self.filter.SetSamplingBounds(bounds)
        for name, value in properties.items():
            getattr(self.filter, "Set" + name)(value)
        self.filter.Update()
        return self.filter.GetOutput()

    def test_a_linear_field_of_clustered_points_is_reproduced_in_every_sample(self):
        p = clustered(20000)
        image = self.run_filter(
            surface(p, f=1 + 2 * p[:, 0] - 3 * p[:, 1]), SamplingDimensions=(300, 200, 1)
        )
        arrays = arrays_of(image)
        nx, ny, _ = image.GetDimensions()
        dx, dy, _ = image.GetSpacing()
        x0, y0, _ = image.GetOrigin()
        x, y = np.meshgrid(x0 + dx * np.arange(nx), y0 + dy * np.arange(ny))
        expected = (1 + 2 * x - 3 * y).ravel()
        valid = arrays["vtkValidPointMask"] == 1
        self.assertGreater(valid.mean(), 0.3)
        self.assertLess(np.abs(arrays["f"] - expected)[valid].max(), 1e-12)

    def test_the_mask_is_the_convex_hull(self):
        p = clustered(2000)
        image = self.run_filter(surface(p), SamplingDimensions=(80, 80, 1))
        valid = arrays_of(image)["vtkValidPointMask"].astype(bool)
        samples = np.array([image.GetPoint(i)[:2] for i in range(image.GetNumberOfPoints())])
        # A sample is outside if all points are on one side of some line through it.
        angles = np.linspace(0, 2 * np.pi, 721)
        directions = np.stack([np.cos(angles), np.sin(angles)])
        outside = (samples @ directions > (p[:, :2] @ directions).max(axis=0) + 1e-12).any(axis=1)
        self.assertFalse((valid & outside).any())
        self.assertLess((~valid & ~outside).mean(), 0.01)

    def test_numpy_shape_is_that_of_the_dimensions(self):
        p = np.random.default_rng(1).random((500, 3))
        image = self.run_filter(
            surface(p, f=p[:, 0]),
            (0.2, 0.8, 0.2, 0.8, 0, 0),
            SamplingDimensions=(1, 1, 1),
            Delta=(0.1, 0.2, 0),
        )
        self.assertEqual(image.GetDimensions()[:2], (7, 4))
        rows = arrays_of(image)["f"].reshape(4, 7)
        np.testing.assert_allclose(rows[0], 0.2 + 0.1 * np.arange(7), atol=1e-14)

    def test_null_value_marks_samples_outside(self):
        p = np.random.default_rng(1).random((500, 3))
        image = self.run_filter(
            surface(p, f=p[:, 0]), (2, 3, 2, 3, 0, 0), SamplingDimensions=(5, 5, 1), NullValue=np.nan
        )
        self.assertTrue(np.isnan(arrays_of(image)["f"]).all())

    def test_statistics_are_a_table(self):
        p = np.random.default_rng(1).random((500, 3))
        self.run_filter(surface(p, f=p[:, 0]), SamplingDimensions=(50, 50, 1))
        fields = self.filter.GetStatistics().GetFieldData()
        self.assertEqual(fields.GetArray("Samples").GetValue(0), 2500)
        self.assertGreater(fields.GetArray("SamplesHit").GetValue(0), 2000)


if __name__ == "__main__":
    unittest.main()
