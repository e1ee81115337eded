# SPDX-License-Identifier: BSD-3-Clause
"""vtkTIPPPointsToImage as Python programs use it, from a package built with VTK and from the wheel."""
import unittest

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

import tipp
from tipp import vtkTIPPPointsToImage


def data_of(xyz, lines=(), polygons=(), **arrays):
    data = vtkPolyData()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(xyz, np.float64), deep=True))
    data.SetPoints(points)
    for chains, put in ((lines, data.SetLines), (polygons, data.SetPolys)):
        cells = vtkCellArray()
        for chain in chains:
            cells.InsertNextCell(len(chain), chain)
        put(cells)
    for name, values in arrays.items():
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        data.GetPointData().AddArray(array)
    return data


def values_of(image, name):
    columns, rows, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetArray(name)).reshape(rows, columns)[::-1]


class PointsToImage(unittest.TestCase):
    def setUp(self):
        rng = np.random.default_rng(5)
        xy = rng.random((3000, 2)) * 100
        self.xyz = np.column_stack([xy, np.sin(xy[:, 0] / 9) + xy[:, 1] / 30])
        self.intensity = rng.random(3000)

    def run_filter(self, data, bands=("elevation",), **properties):
        self.filter = vtkTIPPPointsToImage()
        self.filter.SetInputData(data)
        self.filter.ClearBands()
        for band in bands:
            self.filter.AddBand(band)
        for name, value in properties.items():
            getattr(self.filter, "Set" + name)(value)
        self.filter.Update()
        return self.filter.GetOutput()

    def test_the_image_is_the_array_of_dem(self):
        bands = ["elevation", "intensity", "slope", "void"]
        expected = tipp.dem(self.xyz, 0.7, attributes=bands, point_data={"intensity": self.intensity}, max_edge=6)
        image = self.run_filter(data_of(self.xyz, intensity=self.intensity), bands, Resolution=0.7, MaximumEdgeLength=6)
        for band, values in zip(bands, expected.array):
            np.testing.assert_array_equal(values, values_of(image, band))
        transform = image.GetFieldData().GetArray("GeoTransform")
        width, _, west, _, height, north = expected.transform
        self.assertEqual([west, width, 0, north, 0, height], [transform.GetValue(i) for i in range(6)])
        np.testing.assert_allclose(image.GetOrigin()[:2], (west + 0.35, north - (image.GetDimensions()[1] - 0.5) * 0.7))
        self.assertEqual("elevation", image.GetPointData().GetScalars().GetName())
        self.assertEqual(0, image.GetCellData().GetNumberOfArrays())

    def test_bounds_alignment_duplicates_and_thinning_are_those_of_dem(self):
        cloud = np.concatenate([self.xyz, self.xyz + [0, 0, 2]])
        for properties, options in (
                ({"UseInputBounds": False, "SamplingBounds": (10.1, 50, 20.3, 80)}, {"bounds": (10.1, 50, 20.3, 80)}),
                ({"AlignToResolution": False}, {"align": False}),
                ({"Duplicates": vtkTIPPPointsToImage.DUPLICATES_MEAN}, {"duplicates": "mean"}),
                ({"Duplicates": vtkTIPPPointsToImage.DUPLICATES_HIGHEST}, {"duplicates": "max"}),
                ({"ThinningSize": 2, "ThinningRule": vtkTIPPPointsToImage.THIN_LOWEST}, {"thin": (2, "min")}),
                ({"MemoryLimit": 1 << 20, "NumberOfThreads": 2}, {})):
            image = self.run_filter(data_of(cloud), Resolution=0.9, **properties)
            np.testing.assert_array_equal(tipp.dem(cloud, 0.9, **options).array, values_of(image, "elevation"), str(options))

    def test_breaklines_shape_the_surface_and_a_boundary_limits_it(self):
        lines = data_of([[5, 5, 9], [95, 60, 9]], lines=[(0, 1)])
        area = data_of([[10, 10, 0], [90, 15, 0], [80, 90, 0], [15, 80, 0]], polygons=[(0, 1, 2, 3)])
        expected = tipp.dem(self.xyz, 0.5, breaklines=lines, boundary=area)
        self.filter = vtkTIPPPointsToImage()
        self.filter.SetInputData(data_of(self.xyz))
        self.filter.SetResolution(0.5)
        self.filter.SetBreaklinesData(lines)
        self.filter.SetBoundaryData(area)
        self.filter.Update()
        found = values_of(self.filter.GetOutput(), "elevation")
        np.testing.assert_array_equal(expected.array, found)
        self.assertTrue(np.isnan(found[0, 0]))
        self.assertGreater(np.nanmax(found), 8)

    def test_the_resolution_is_about_one_point_a_pixel_unless_it_is_set(self):
        image = self.run_filter(data_of(self.xyz))
        self.assertAlmostEqual(3000, image.GetNumberOfPoints(), delta=200)
        self.assertEqual(0, self.filter.GetResolution())

    def test_errors_are_reported_and_not_raised(self):
        for data, bands, sentence in ((data_of(np.full((2, 3), np.nan)), ("elevation",), "no point with finite"),
                                      (data_of(self.xyz), ("density", "missing"), "missing"),
                                      (data_of(self.xyz), (), "no band")):
            told = []

            def note(_caller, _event, text, told=told):
                told.append(text)

            note.CallDataType = "string0"
            self.filter = vtkTIPPPointsToImage()
            self.filter.AddObserver("ErrorEvent", note)
            self.filter.SetInputData(data)
            self.filter.ClearBands()
            for band in bands:
                self.filter.AddBand(band)
            self.filter.Update()
            self.assertIn(sentence, " ".join(told))


if __name__ == "__main__":
    unittest.main()
