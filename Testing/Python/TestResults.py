# SPDX-License-Identifier: BSD-3-Clause
"""The type of results, and what they can be converted to."""
import importlib.util
import os
import pickle
import tempfile
import unittest

import numpy as np

import tipp

HAS_VTK, HAS_PYVISTA, HAS_MESHIO, HAS_XARRAY, HAS_RIOXARRAY = (
    importlib.util.find_spec(name) is not None for name in ("vtkmodules", "pyvista", "meshio", "xarray", "rioxarray"))
POINTS = np.random.default_rng(8).random((500, 3))
DATA = {"height": POINTS[:, 2].copy(), "pair": POINTS[:, :2].copy()}


def mesh_of(**options):
    return tipp.delaunay_2d(POINTS, point_data=DATA, **options)


class Types(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = os.path.join(folder.name, "mesh.tipp")

    def stored(self):
        tipp.write(mesh_of(), self.path)
        return self.path

    def test_arrays_and_files_give_tipps_types(self):
        self.assertIsInstance(mesh_of(), tipp.Mesh)
        self.assertIsInstance(tipp.resample(mesh_of(), dimensions=(3, 3)), tipp.Image)
        self.assertIsInstance(tipp.read(self.stored()), tipp.Mesh)
        self.assertIsInstance(tipp.read(self.path, merge=False)[0], tipp.Mesh)
        self.assertIsInstance(mesh_of(return_statistics=True)[0], tipp.Mesh)

    def test_a_mesh_in_gives_a_mesh_of_the_same_points_and_data_out(self):
        self.assertEqual(mesh_of(), tipp.delaunay_2d(mesh_of()))

    @unittest.skipUnless(HAS_VTK, "VTK is not installed")
    def test_vtk_in_gives_vtk_out(self):
        mesh = mesh_of(return_type="vtk")
        self.assertEqual("vtkPolyData", mesh.GetClassName())
        self.assertEqual("vtkPolyData", tipp.delaunay_2d(mesh).GetClassName())
        self.assertEqual("vtkImageData", tipp.resample(mesh, dimensions=(3, 3)).GetClassName())

    @unittest.skipUnless(HAS_VTK, "VTK is not installed")
    def test_return_type_chooses_vtk_or_tipp(self):
        mesh = mesh_of(return_type="vtk")
        self.assertEqual(mesh_of(), tipp.delaunay_2d(mesh, return_type="tipp"))
        self.assertIsInstance(tipp.resample(mesh, dimensions=(3, 3), return_type="tipp"), tipp.Image)
        self.assertEqual("vtkImageData", tipp.resample(mesh_of(), dimensions=(3, 3), return_type="vtk").GetClassName())
        self.assertEqual("vtkUnstructuredGrid", tipp.read(self.stored(), return_type="vtk").GetClassName())
        self.assertEqual("vtkPartitionedDataSet", tipp.read(self.path, merge=False, return_type="vtk").GetClassName())

    @unittest.skipUnless(HAS_PYVISTA, "PyVista is not installed")
    def test_pyvista_in_gives_pyvista_out(self):
        import pyvista

        mesh = tipp.delaunay_2d(pyvista.PolyData(POINTS))
        self.assertIsInstance(mesh, pyvista.PolyData)
        self.assertIsInstance(tipp.resample(mesh, dimensions=(3, 3)), pyvista.ImageData)
        self.assertIsInstance(mesh_of(return_type="pyvista"), pyvista.PolyData)
        self.assertIsInstance(tipp.read(self.stored(), return_type="pyvista"), pyvista.UnstructuredGrid)

    @unittest.skipIf(HAS_VTK, "VTK is installed")
    def test_a_type_that_is_not_installed_is_refused(self):
        for kind in ("vtk", "pyvista"):
            with self.assertRaisesRegex(ModuleNotFoundError, f"^return_type='{kind}' needs VTK, which is not installed"):
                mesh_of(return_type=kind)
        with self.assertRaisesRegex(ModuleNotFoundError, r"^Mesh.to_vtk\(\) needs VTK"):
            mesh_of().to_vtk()


class Mesh(unittest.TestCase):
    def kinds(self):
        """Meshes with every kind of cell."""
        square = [[0.2, 0.2], [0.8, 0.2], [0.5, 0.8]]
        yield mesh_of()
        yield mesh_of(alpha=0.05)
        yield mesh_of(polygons=[square], marks="lines")
        yield mesh_of(neighbors=True)
        tetrahedra = tipp.Mesh(POINTS[:5], np.array([[0, 1, 2, 3]]), {}, {"n": np.array([7.0])}, np.array([[3, 4]]),
                               np.array([[4]]), {}, np.array([[2, 3, 4]]))
        yield tetrahedra

    def test_points_and_cells_are_arrays(self):
        mesh = mesh_of()
        self.assertEqual((500, 3), mesh.points.shape)
        np.testing.assert_array_equal(np.sort(mesh.cells, axis=None), np.sort(tipp.delaunay(POINTS), axis=None))
        np.testing.assert_array_equal(mesh["height"], DATA["height"])
        np.testing.assert_array_equal(mesh.bounds, np.column_stack([POINTS.min(axis=0), POINTS.max(axis=0)]).ravel())
        with self.assertRaisesRegex(KeyError, "no array 'depth'.*'height', 'pair'"):
            mesh["depth"]

    def test_points_of_two_columns_get_z_of_zero(self):
        mesh = tipp.delaunay_2d(POINTS[:, :2])
        self.assertEqual((500, 3), mesh.points.shape)
        self.assertFalse(mesh.points[:, 2].any())

    @unittest.skipUnless(HAS_VTK, "VTK is not installed")
    def test_a_mesh_of_vtk_has_all_cells_and_values(self):
        from tipp._vtk import from_vtk

        for mesh in self.kinds():
            data = mesh.to_vtk()
            self.assertEqual(len(mesh.cells) + mesh.count_thin(), data.GetNumberOfCells())
            back = from_vtk(data)
            for name in ("points", "cells", "lines", "vertices", "triangles", "point_data", "cell_data", "line_data"):
                with self.subTest(mesh._rows(), part=name):
                    self.assertTrue(tipp._data._are_equal(getattr(mesh, name), getattr(back, name)))

    @unittest.skipUnless(HAS_VTK, "VTK is not installed")
    def test_a_mesh_of_vtk_shares_the_memory(self):
        mesh = mesh_of()
        data = mesh.to_vtk()
        mesh.points[0, 0] = 77
        mesh["height"][1] = 88
        self.assertEqual((77, 88), (data.GetPoint(0)[0], data.GetPointData().GetArray("height").GetValue(1)))

    @unittest.skipUnless(HAS_PYVISTA, "PyVista is not installed")
    def test_a_mesh_of_pyvista_has_the_arrays(self):
        surface = mesh_of().to_pyvista()
        np.testing.assert_array_equal(surface["height"], DATA["height"])
        self.assertEqual(surface.n_cells, len(mesh_of().cells))

    @unittest.skipUnless(HAS_MESHIO, "meshio is not installed")
    def test_a_mesh_of_meshio_is_written_and_has_a_block_for_each_kind_of_cell(self):
        import meshio

        for mesh in self.kinds():
            other = mesh.to_meshio()
            counts = {block.type: len(block.data) for block in other.cells}
            self.assertEqual(len(mesh.cells) + mesh.count_thin(), sum(counts.values()))
            self.assertTrue(all(len(lists) == len(other.cells) for lists in other.cell_data.values()))
        with tempfile.TemporaryDirectory() as folder:
            mesh_of().to_meshio().write(f"{folder}/mesh.vtk")
            back = meshio.read(f"{folder}/mesh.vtk")
        np.testing.assert_array_equal(back.cells_dict["triangle"], mesh_of().cells)

    @unittest.skipIf(HAS_MESHIO or HAS_PYVISTA, "meshio or PyVista is installed")
    def test_missing_packages_are_named(self):
        with self.assertRaisesRegex(ModuleNotFoundError, r"^Mesh.to_meshio\(\) needs meshio, which is not installed"):
            mesh_of().to_meshio()
        with self.assertRaisesRegex(ModuleNotFoundError, r"^Mesh.to_pyvista\(\) needs pyvista, which is not installed"):
            mesh_of().plot()

    def test_a_description_has_five_lines(self):
        for mesh in self.kinds():
            lines = repr(mesh).splitlines()
            self.assertEqual(5, len(lines))
            self.assertEqual("tipp.Mesh", lines[0])
        self.assertRegex(repr(mesh_of()), "points +500, x 0.*cells +[0-9]+ triangles\n.*height float64, pair float64.2.".replace(
            ".*", "(?s:.*)"))

    def test_a_description_for_notebooks_escapes_names(self):
        page = tipp.Mesh(POINTS, np.array([[0, 1, 2]]), {"<b>&": np.zeros(500)})._repr_html_()
        self.assertIn("&lt;b&gt;&amp; float64", page)
        self.assertNotIn("<b>", page)

    def test_a_mesh_without_points_is_described(self):
        empty = tipp.Mesh(np.zeros((0, 3)), np.zeros((0, 3), int))
        self.assertEqual(5, len(repr(empty).splitlines()))
        self.assertTrue(np.isnan(empty.bounds).all())

    def test_a_mesh_is_pickled(self):
        self.assertEqual(mesh_of(), pickle.loads(pickle.dumps(mesh_of())))


class Image(unittest.TestCase):
    def setUp(self):
        self.image = tipp.resample(mesh_of(), (0.2, 0.8, 0.1, 0.9), (4, 9))

    def test_arrays_have_the_shape_of_the_image(self):
        self.assertEqual((9, 4), self.image["height"].shape)
        self.assertEqual((9, 4, 2), self.image["pair"].shape)
        self.assertEqual((0.2, 0.8, 0.1, 0.9, 0, 0), self.image.bounds)
        self.assertEqual(5, len(repr(self.image).splitlines()))
        self.assertIn("4 x 9 x 1", self.image._repr_html_())

    @unittest.skipUnless(HAS_VTK, "VTK is not installed")
    def test_an_image_of_vtk_hides_samples_outside(self):
        wide = tipp.resample(mesh_of(), (-0.5, 1.5, -0.5, 1.5), (9, 9))
        data = wide.to_vtk()
        np.testing.assert_array_equal(tipp.as_array(data, "height"), wide["height"])
        np.testing.assert_array_equal(tipp.as_array(data, "vtkGhostType")[:9] != 0, wide["vtkValidPointMask"][:9] == 0)

    @unittest.skipUnless(HAS_XARRAY, "xarray is not installed")
    def test_an_image_of_xarray_has_coordinates(self):
        data = self.image.to_xarray()
        np.testing.assert_array_equal(data["height"].sel(x=0.4, y=0.3, method="nearest"), self.image["height"][2, 1])
        self.assertEqual(("y", "x", "pair_component"), data["pair"].dims)


class Dem(unittest.TestCase):
    def setUp(self):
        self.points = POINTS * [100, 50, 1]

    def raster(self, **options):
        return tipp.dem(self.points, 1.0, **options)

    def test_it_unpacks_to_array_transform_and_crs(self):
        array, transform, crs = self.raster(crs="EPSG:25832") if HAS_RIOXARRAY else self.raster()
        self.assertEqual(((50, 100), (1, 0, 0, 0, -1, 50)), (array.shape, transform))
        self.assertEqual("EPSG:25832" if HAS_RIOXARRAY else None, crs)

    def test_it_is_an_array(self):
        raster = self.raster()
        np.testing.assert_array_equal(np.asarray(raster), raster.array)
        self.assertEqual(np.float32, np.asarray(raster, np.float32).dtype)
        self.assertIsNot(np.array(raster), raster.array)

    def test_a_band_is_selected_by_name(self):
        raster = self.raster(attributes=["elevation", "slope"])
        self.assertEqual(("elevation", "slope"), raster.bands)
        np.testing.assert_array_equal(raster.sel(band="slope").array, raster.array[1])
        with self.assertRaisesRegex(KeyError, r"no band 'aspect'; there are \['elevation', 'slope'\]"):
            raster.sel(band="aspect")

    def test_bounds_are_those_of_the_pixels(self):
        self.assertEqual((0, 100, 0, 50), self.raster().bounds)
        np.testing.assert_array_equal(self.raster(bounds=self.raster()).array, self.raster().array)

    def test_a_description_has_five_lines(self):
        self.assertEqual(["tipp.Dem", "  bands   elevation", "  pixels  50 rows x 100 columns, 1 wide",
                          "  bounds  x 0 to 100, y 0 to 50", "  crs     none"], repr(self.raster()).splitlines())
        self.assertIn("50 rows x 100 columns", self.raster()._repr_html_())

    @unittest.skipUnless(HAS_XARRAY, "xarray is not installed")
    def test_xarray_has_name_bands_and_pixel_centres(self):
        data = self.raster(attributes=["elevation", "slope"]).to_xarray()
        self.assertEqual(("dem", ("band", "y", "x")), (data.name, data.dims))
        self.assertEqual((0.5, 49.5), (float(data.x[0]), float(data.y[0])))
        np.testing.assert_array_equal(data.sel(band="slope"), self.raster(attributes="slope").array)
        single = self.raster(attributes="slope").to_xarray()
        self.assertEqual(("slope", ("y", "x"), "slope"), (single.name, single.dims, str(single.band.values)))

    @unittest.skipUnless(HAS_RIOXARRAY, "rioxarray is not installed")
    def test_rioxarray_finds_missing_value_reference_system_and_bounds(self):
        import rioxarray

        data = self.raster(attributes=["elevation", "slope"], crs="EPSG:25832").to_xarray()
        self.assertTrue(np.isnan(data.rio.nodata))
        self.assertEqual(25832, data.rio.crs.to_epsg())
        self.assertEqual((0, 0, 100, 50), data.rio.bounds())
        self.assertEqual((1, 0, 0, 0, -1, 50), tuple(data.rio.transform())[:6])
        with tempfile.TemporaryDirectory() as folder:
            data.rio.to_raster(f"{folder}/dem.tif")
            with rioxarray.open_rasterio(f"{folder}/dem.tif") as back:
                np.testing.assert_array_equal(back.values, data.values)
        np.testing.assert_array_equal(self.raster(bounds=data).array, self.raster().array)


@unittest.skipUnless(hasattr(tipp, "Delaunay"), "only the wheel has this class")
class ScipysDelaunay(unittest.TestCase):
    def test_a_description_has_five_lines(self):
        mesh = tipp.Delaunay([[0, 0], [1, 0], [0, 2], [1, 0]])
        self.assertEqual(["tipp.Delaunay", "  points     4, x 0 to 1, y 0 to 2", "  simplices  1 triangles", "  hull       3 edges",
                          "  coplanar   1 points left out"], repr(mesh).splitlines())
        self.assertIn("1 triangles", mesh._repr_html_())


if __name__ == "__main__":
    unittest.main()
