# SPDX-License-Identifier: BSD-3-Clause
"""Objects of other libraries as points and meshes, each where the library is installed."""
import importlib.util
import os
import tempfile
import unittest

import numpy as np

import tipp

XYZ = np.random.default_rng(9).random((400, 3)) * [60, 40, 3]
PART = (10, 30, 5, 25)


def needs(name):
    return unittest.skipUnless(importlib.util.find_spec(name), f"{name} is not installed")


class Points(unittest.TestCase):
    """Each object has the points XYZ."""

    def check_points(self, points):
        np.testing.assert_array_equal(tipp.delaunay(points), tipp.delaunay(XYZ))
        mesh = tipp.delaunay_2d(points)
        self.assertIsInstance(mesh, tipp.Mesh)
        np.testing.assert_array_equal(mesh.points, XYZ)
        np.testing.assert_array_equal(tipp.dem(points, 2.0).array, tipp.dem(XYZ, 2.0).array)

    @needs("meshio")
    def test_meshio(self):
        import meshio

        mesh = meshio.Mesh(XYZ, [("vertex", np.arange(400).reshape(-1, 1))], point_data={"depth": XYZ[:, 0]})
        self.check_points(mesh)
        np.testing.assert_array_equal(tipp.delaunay_2d(mesh)["depth"], XYZ[:, 0])
        both = tipp.delaunay_2d(mesh, point_data={"more": XYZ[:, 1]})
        self.assertEqual(["depth", "more"], sorted(both.point_data))

    @needs("laspy")
    def test_laspy(self):
        import laspy

        las = laspy.LasData(laspy.LasHeader(point_format=6, version="1.4"))
        whole = np.round(XYZ * 2**20) / 2**20
        las.header.scales = [2.0**-20] * 3
        las.x, las.y, las.z = whole.T
        np.testing.assert_array_equal(tipp.delaunay_2d(las).points, whole)
        np.testing.assert_array_equal(tipp.dem(las, 2.0).array, tipp.dem(whole, 2.0).array)

    @needs("geopandas")
    def test_geopandas(self):
        import geopandas

        series = geopandas.GeoSeries.from_xy(*XYZ.T)
        self.check_points(series)
        self.check_points(geopandas.GeoDataFrame({"name": np.arange(400)}, geometry=series))

    @needs("pandas")
    def test_pandas(self):
        import pandas

        self.check_points(pandas.DataFrame({"id": np.arange(400), "Y": XYZ[:, 1], "X": XYZ[:, 0], "Z": XYZ[:, 2]}))

    @needs("polars")
    def test_polars(self):
        import polars

        self.check_points(polars.DataFrame({"id": np.arange(400), "y": XYZ[:, 1], "x": XYZ[:, 0], "z": XYZ[:, 2]}))

    @needs("xarray")
    def test_variables_of_xarray(self):
        import xarray

        axes = {name: ("point", XYZ[:, i]) for i, name in enumerate("xyz")}
        self.check_points(xarray.Dataset({**axes, "id": ("point", np.arange(400))}))
        self.check_points(xarray.Dataset({"z": axes["z"]}, coords={"x": axes["x"], "y": axes["y"]}))
        self.check_points(xarray.DataArray(XYZ, dims=("point", "axis")))

    def test_a_mesh_of_tipp(self):
        self.check_points(tipp.delaunay_2d(XYZ))


@needs("xarray")
class Rasters(unittest.TestCase):
    def setUp(self):
        import xarray

        self.x, self.y = np.arange(5.0), np.arange(30.0, 26.0, -1)
        values = self.x + 10 * self.y[:, np.newaxis]
        self.raster = xarray.DataArray(values, {"y": self.y, "x": self.x}, ("y", "x"))

    def points(self, raster):
        return tipp.delaunay_2d(raster).points

    def test_pixels_are_points_with_their_values_as_heights(self):
        points = self.points(self.raster)
        self.assertEqual((20, 3), points.shape)
        np.testing.assert_array_equal(points[:, 2], points[:, 0] + 10 * points[:, 1])
        np.testing.assert_array_equal(points, self.points(self.raster.expand_dims(band=[1])))

    def test_axes_in_any_order_and_longitudes_are_found(self):
        turned = self.raster.rename(x="lon", y="lat").transpose("lon", "lat")
        np.testing.assert_array_equal(self.points(turned), self.points(self.raster))

    def test_pixels_without_a_value_are_left_out(self):
        marked = self.raster.astype(int).where(self.raster != 301, -9999)
        marked.attrs["_FillValue"] = -9999
        self.assertEqual(19, len(self.points(marked)))
        self.assertEqual(19, len(self.points(self.raster.where(self.raster != 301))))

    def test_several_bands_and_missing_coordinates_are_refused_with_advice(self):
        import xarray

        with self.assertRaisesRegex(ValueError, r"^points is a DataArray with the dimensions \['band', 'y', 'x'\]; give .*sel"):
            tipp.delaunay(xarray.concat([self.raster, self.raster], "band"))
        with self.assertRaisesRegex(ValueError, "^points is a DataArray without coordinates along x; assign them"):
            tipp.delaunay(self.raster.drop_vars("x"))

    def test_a_dem_becomes_points_again(self):
        dem = tipp.dem(XYZ, 2.0)
        self.assertEqual(int(np.isfinite(dem.array).sum()), len(self.points(dem.to_xarray())))


@needs("meshio")
class Meshes(unittest.TestCase):
    def setUp(self):
        self.mesh = tipp.delaunay_2d(XYZ, point_data={"depth": XYZ[:, 0]})
        self.other = self.mesh.to_meshio()

    def test_functions_take_meshes_of_meshio(self):
        expected = tipp.resample(self.mesh, PART, (6, 7))
        self.assertEqual(expected, tipp.resample(self.other, PART, (6, 7)))
        with tipp.open(self.other) as opened:
            np.testing.assert_allclose(opened.interpolate([[20, 20]], "depth"), [20])
        self.assertTrue(tipp.check(self.other))
        with tempfile.TemporaryDirectory() as folder:
            tipp.write(self.other, os.path.join(folder, "mesh.tipp"))
            self.assertEqual(len(self.mesh.cells), len(tipp.read(os.path.join(folder, "mesh.tipp")).cells))

    def test_arrays_of_cells_are_those_of_the_triangles(self):
        import meshio

        lines = np.array([[0, 1]])
        marked = meshio.Mesh(XYZ, [("line", lines), ("triangle", self.mesh.cells[:5]), ("triangle", self.mesh.cells[5:])],
                             cell_data={"kind": [np.array([9]), np.full(5, 2), np.full(len(self.mesh.cells) - 5, 2)]})
        with tipp.open(marked) as opened:
            self.assertEqual([2], opened.interpolate([[20, 20]], "kind").tolist())

    def test_other_cells_are_refused_by_kind(self):
        import meshio

        with self.assertRaisesRegex(TypeError, "^mesh has cells of the kind 'quad'; give triangles or tetrahedra"):
            tipp.resample(meshio.Mesh(XYZ, [("quad", np.array([[0, 1, 2, 3]]))]), dimensions=(3, 3))


class Ranges(unittest.TestCase):
    """Objects whose bounds are a range, of the libraries themselves."""

    def check_range(self, thing):
        np.testing.assert_array_equal(tipp.dem(XYZ, 1.0, bounds=thing).array, tipp.dem(XYZ, 1.0, bounds=PART).array)

    @needs("shapely")
    def test_shapely(self):
        from shapely.geometry import box

        self.check_range(box(10, 5, 30, 25))

    @needs("geopandas")
    def test_geopandas(self):
        import geopandas
        from shapely.geometry import box

        self.check_range(geopandas.GeoSeries([box(10, 5, 20, 25), box(20, 5, 30, 25)]))
        self.check_range(geopandas.GeoDataFrame(geometry=[box(10, 5, 30, 25)]))

    @needs("rasterio")
    def test_rasterio(self):
        from rasterio.coords import BoundingBox
        from rasterio.io import MemoryFile
        from rasterio.transform import from_bounds

        self.check_range(BoundingBox(10, 5, 30, 25))
        with MemoryFile() as memory:
            with memory.open(driver="GTiff", width=4, height=4, count=1, dtype="uint8",
                             transform=from_bounds(10, 5, 30, 25, 4, 4)) as raster:
                self.check_range(raster)

    @needs("rioxarray")
    def test_rioxarray(self):
        import rioxarray  # pylint: disable=unused-import

        self.check_range(tipp.dem(XYZ, 1.0, bounds=PART).to_xarray())

    @needs("pyvista")
    def test_pyvista(self):
        import pyvista

        box = pyvista.Box(bounds=(10, 30, 5, 25, 0, 9))
        self.check_range(box)
        self.check_range(box.bounds)


if __name__ == "__main__":
    unittest.main()
