# SPDX-License-Identifier: BSD-3-Clause
"""tipp.open, which returns meshes for queries."""
import importlib.util
import pathlib
import tempfile
import threading
import unittest

import numpy as np

import tipp


class Query(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        rng = np.random.default_rng(5)
        self.points = rng.random((3000, 2))
        self.height = self.points[:, 0] - 2 * self.points[:, 1]
        self.mesh = tipp.delaunay_2d(self.points, point_data={"height": self.height})
        self.path = str(self.folder / "mesh.tipp")
        tipp.write(self.mesh, self.path, tiling="grid:3x3")
        self.asked = np.concatenate([rng.random((2000, 2)) * 1.2 - 0.1, self.points[:100]])

    def test_a_stored_mesh_answers_as_the_one_in_memory(self):
        with tipp.open(self.mesh) as whole, tipp.open(self.path) as stored:
            cells, weights = stored.locate(self.asked)
            expected = whole.locate(self.asked)
            np.testing.assert_array_equal(cells, expected[0])
            np.testing.assert_array_equal(weights, expected[1])
            self.assertTrue((cells == -1).any() and (cells >= 0).any())
            np.testing.assert_allclose(weights[cells >= 0].sum(axis=1), 1)

    def test_linear_fields_are_interpolated(self):
        with tipp.open(self.path) as mesh:
            self.assertEqual(mesh.array_names, ["elevation", "height"])
            values = mesh.interpolate(self.asked, "height")
            inside = mesh.locate(self.asked)[0] >= 0
            np.testing.assert_allclose(values[inside], (self.asked[:, 0] - 2 * self.asked[:, 1])[inside], atol=1e-12)
            self.assertTrue(np.isnan(values[~inside]).all())
            self.assertEqual(set(mesh.interpolate(self.asked)), {"elevation", "height"})

    def test_scipy_gives_the_same_values(self):
        if not importlib.util.find_spec("scipy"):
            self.skipTest("scipy is not installed")
        from scipy.interpolate import LinearNDInterpolator

        wave = np.sin(20 * self.points[:, 0]) * self.points[:, 1]
        mesh = tipp.delaunay_2d(self.points, point_data={"wave": wave})
        ours = tipp.open(mesh).interpolate(self.asked, "wave")
        theirs = LinearNDInterpolator(self.points, wave)(self.asked)
        both = ~np.isnan(ours) & ~np.isnan(theirs)
        self.assertGreater(both.sum(), 1000)
        np.testing.assert_allclose(ours[both], theirs[both], atol=1e-9)

    def test_sixteen_threads_share_a_mesh(self):
        with tipp.open(self.path, memory="64K", threads=1) as mesh, tipp.open(self.mesh) as whole:
            expected = whole.interpolate(self.asked, "height")
            found = [None] * 16

            def work(i):
                for _ in range(3):
                    found[i] = mesh.interpolate(self.asked, "height")

            threads = [threading.Thread(target=work, args=(i,)) for i in range(16)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            for values in found:
                np.testing.assert_array_equal(values, expected)

    def test_sixteen_threads_run_all_queries(self):
        box = (0.2, 0.7, 0.1, 0.6)
        square = [(0.15, 0.2), (0.8, 0.25), (0.5, 0.9)]
        questions = [
            lambda m: m.locate(self.asked)[0],
            lambda m: m.interpolate(self.asked, "height"),
            lambda m: m.closest(self.asked).distances,
            lambda m: m.neighbors(np.arange(50)),
            lambda m: m.ring(points=[5], k=3)[0],
            lambda m: m.boundary()[0],
            lambda m: m.components()[0],
            lambda m: np.concatenate([line for _, line in m.contours([-0.5, 0.25], "height")]),
            lambda m: m.profile([(0.2, 0.3), (0.7, 0.6)], 0, "height").distances,
            lambda m: m.descend(self.asked[:20], "height")[3].points,
            lambda m: m.cells_in(box=box),
            lambda m: m.points_in(polygon=square),
            lambda m: np.array(m.zones([square], "height")),
        ]
        with tipp.open(self.path, memory="64K", threads=1) as mesh, tipp.open(self.mesh) as whole:
            expected = [ask(whole) for ask in questions]
            failures = []

            def work(i):
                for k in range(len(questions)):
                    number = (i + k) % len(questions)
                    try:
                        np.testing.assert_array_equal(questions[number](mesh), expected[number])
                    except Exception as error:  # pylint: disable=broad-except
                        failures.append((number, error))

            threads = [threading.Thread(target=work, args=(i,)) for i in range(16)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            self.assertEqual(failures, [])

    def test_closest_locations(self):
        far = np.array([[-1.0, 0.5], [0.5, 3.0], [0.5, 0.5], [np.nan, 0.0]])
        with tipp.open(self.path) as mesh, tipp.open(self.mesh) as whole:
            ours, theirs = mesh.closest(self.asked), whole.closest(self.asked)
            for one, other in zip(ours, theirs):
                np.testing.assert_array_equal(one, other)
            inside = mesh.locate(self.asked)[0] >= 0
            np.testing.assert_array_equal(ours.distances == 0, inside)
            apart = np.hypot(*(ours.points[:, :2] - self.asked).T)
            np.testing.assert_allclose(apart, ours.distances, atol=1e-12)
            # No point of the border may be nearer.
            border = self.points[mesh.boundary()[0]]
            for point, distance in zip(self.asked[~inside], ours.distances[~inside]):
                self.assertLessEqual(distance, np.hypot(*(border - point).T).min() + 1e-12)
            found = mesh.closest(far)
            np.testing.assert_array_equal(found.cells < 0, [False, False, False, True])
            self.assertEqual(found.distances[3], np.inf)
            self.assertTrue((found.distances[:2] > 0.9).all())

    def test_regions(self):
        triangles = tipp.delaunay(self.points)
        x, y = self.points.T
        with tipp.open(self.path) as mesh:
            inside = (0.25 <= x) & (x <= 0.5) & (0.3 <= y) & (y <= 0.9)
            corners = [(0.25, 0.3), (0.5, 0.3), (0.5, 0.9), (0.25, 0.9)]
            for region in ({"box": (0.25, 0.5, 0.3, 0.9)}, {"polygon": corners}, {"polygon": np.array(corners)[::-1]}):
                np.testing.assert_array_equal(mesh.points_in(**region), np.flatnonzero(inside))
                whole = mesh.cells_in(**region, whole=True)
                np.testing.assert_array_equal(whole, np.flatnonzero(inside[triangles].all(axis=1)))
                self.assertTrue(set(whole) < set(mesh.cells_in(**region)))
            with self.assertRaises(ValueError):
                mesh.cells_in()
            with self.assertRaisesRegex(ValueError, "3 bounds"):
                mesh.cells_in(box=(0, 1, 2))
            with self.assertRaisesRegex(RuntimeError, "cross"):
                mesh.cells_in(polygon=[(0, 0), (1, 1), (1, 0), (0, 1)])

    def test_zones_have_the_volumes_of_a_plane(self):
        outer = [(0.2, 0.2), (0.8, 0.2), (0.8, 0.7), (0.2, 0.7)]
        hole = np.array([(0.4, 0.3), (0.6, 0.3), (0.6, 0.6), (0.4, 0.6)])
        with tipp.open(self.path) as mesh, tipp.open(self.mesh) as whole:
            zones = mesh.zones([outer, [outer, hole], [(5, 5), (6, 5), (6, 6)]], "height", level=-0.2)
            for ours, theirs in zip(zones, whole.zones([outer, [outer, hole], [(5, 5), (6, 5), (6, 6)]], "height",
                                                       level=-0.2)):
                np.testing.assert_array_equal(ours, theirs)
            np.testing.assert_allclose(zones.area, [0.3, 0.24, 0], atol=1e-14)
            np.testing.assert_allclose(zones.integral, [0.3 * (0.5 - 0.9), 0.3 * -0.4 - 0.06 * -0.4, 0], atol=1e-14)
            np.testing.assert_allclose(zones.minimum[:2], [0.2 - 1.4] * 2, atol=1e-12)
            np.testing.assert_allclose(zones.maximum[:2], [0.8 - 0.4] * 2, atol=1e-12)
            np.testing.assert_allclose(zones.mean[:2], zones.integral[:2] / zones.area[:2])
            # The plane is above -0.2 to the right of the line from (0.2, 0.2) to (0.8, 0.5): in a triangle that is 0.6
            # high at its end.
            self.assertAlmostEqual(zones.volume_above[0], 0.6 * 0.3 / 2 * 0.2)
            self.assertTrue(np.isnan(zones.mean[2]))
            self.assertEqual(zones.cells[2], 0)
            self.assertEqual(mesh.zones([], "height").area.shape, (0,))

    def test_zones_are_the_rows_of_a_table_of_geometries(self):
        ring = [[0.2, 0.2], [0.8, 0.3], [0.5, 0.8], [0.2, 0.2]]
        table = {"type": "FeatureCollection", "features": [
            {"type": "Feature", "geometry": shape, "properties": {}} for shape in (
                {"type": "Polygon", "coordinates": [ring]}, None, {"type": "MultiPolygon", "coordinates": [[ring]]})]}
        with tipp.open(self.path) as mesh:
            expected = mesh.zones([ring[:-1]], "height")
            zones = mesh.zones(table, "height")
            self.assertEqual([expected.area[0], 0, expected.area[0]], zones.area.tolist())
            self.assertEqual([expected.integral[0], 0, expected.integral[0]], zones.integral.tolist())
            np.testing.assert_array_equal(mesh.cells_in(polygon=ring[:-1]), mesh.cells_in(polygon=table))
            line = {"type": "LineString", "coordinates": [[0.1, 0.1], [0.9, 0.8]]}
            np.testing.assert_array_equal(mesh.profile(line["coordinates"], 0.1).points, mesh.profile(line, 0.1).points)

    def test_zones_of_shapely(self):
        if not importlib.util.find_spec("shapely"):
            self.skipTest("shapely is not installed")
        from shapely.geometry import LineString, MultiPolygon, Polygon

        one = Polygon([(0.2, 0.2), (0.8, 0.3), (0.5, 0.8)], [[(0.45, 0.4), (0.55, 0.4), (0.5, 0.5)]])
        two = Polygon([(0.85, 0.2), (0.95, 0.2), (0.9, 0.6)])
        with tipp.open(self.path) as mesh:
            zones = mesh.zones([one, two, MultiPolygon([one, two])], "height")
            np.testing.assert_allclose(zones.area, [one.area, two.area, one.area + two.area], rtol=1e-12)
            with self.assertRaises(TypeError):
                mesh.zones([LineString([(0, 0), (1, 1)])], "height")

    def test_a_descent_that_starts_at_a_pit_has_one_point(self):
        with tipp.open(self.path) as mesh:
            pit = mesh.descend(self.asked[:200], "height")
            pit = next(line for line in pit if line.pit >= 0).points[-1:]
            down = mesh.descend(np.concatenate([pit[:, :2], pit[:, :2]]), "height")
            for line in down:
                np.testing.assert_array_equal(line.points, pit)

    def test_descents_of_a_plane_end_at_its_lowest_point(self):
        with tipp.open(self.path) as mesh, tipp.open(self.mesh) as whole:
            ours, theirs = mesh.descend(self.asked[:200], "height"), whole.descend(self.asked[:200], "height")
            self.assertEqual(len(ours), 200)
            inside = mesh.locate(self.asked[:200])[0] >= 0
            for line, other, is_inside in zip(ours, theirs, inside):
                np.testing.assert_array_equal(line.points, other.points)
                self.assertEqual(line.pit, other.pit)
                self.assertEqual(len(line.points) > 0, is_inside)
                self.assertTrue((np.diff(line.values) <= 0).all())
                np.testing.assert_allclose(line.values, line.points[:, 0] - 2 * line.points[:, 1], atol=1e-9)
            pits = {line.pit for line in ours if len(line.points)}
            self.assertTrue(pits <= set(mesh.boundary()[0].tolist()))

    def test_contours_are_those_of_vtk_contour_filter(self):
        from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
        from vtkmodules.vtkFiltersCore import vtkContourFilter

        wave = np.sin(9 * self.points[:, 0]) * np.cos(7 * self.points[:, 1])
        surface = tipp.delaunay_2d(self.points, point_data={"wave": wave})
        levels = [-0.71, -0.3, 0.123, 0.5]
        ours = tipp.open(surface).contours(levels, "wave")
        theirs = vtkContourFilter()
        theirs.SetInputData(surface.to_vtk())
        theirs.SetInputArrayToProcess(0, 0, 0, 0, "wave")
        theirs.SetOutputPointsPrecision(1)
        for level in levels:
            theirs.SetValue(0, level)
            theirs.Update()
            lines = theirs.GetOutput()
            ends = vtk_to_numpy(lines.GetPoints().GetData())[vtk_to_numpy(
                lines.GetLines().GetConnectivityArray()).reshape(-1, 2)]
            found = [line for l, line in ours if l == level]
            middles = np.concatenate([(line[1:] + line[:-1]) / 2 for line in found])
            expected = ends.mean(axis=1)
            self.assertEqual(len(middles), len(expected))

            def ordered(points):
                return points[np.lexsort(np.round(points[:, :2], 7).T)]

            np.testing.assert_allclose(ordered(middles)[:, :2], ordered(expected)[:, :2], atol=1e-6)

    def test_neighbors_rings_boundary_and_components(self):
        triangles = tipp.delaunay(self.points)
        with tipp.open(self.path) as mesh:
            cells = np.arange(len(triangles))
            neighbors = mesh.neighbors(cells)
            self.assertEqual(neighbors.shape, triangles.shape)
            for cell in range(0, len(triangles), 37):
                for i, other in enumerate(neighbors[cell]):
                    edge = set(np.delete(triangles[cell], i))
                    if other >= 0:
                        self.assertEqual(len(edge & set(triangles[other])), 2)
            star = mesh.star([7, 8])
            for point, found in zip([7, 8], star):
                np.testing.assert_array_equal(found, np.flatnonzero((triangles == point).any(axis=1)))
            ring = mesh.ring(points=[7])[0]
            np.testing.assert_array_equal(ring, np.setdiff1d(triangles[star[0]], [7]))
            around = mesh.ring(cells=[0], k=1)[0]
            shared = np.isin(triangles, triangles[0]).any(axis=1)
            np.testing.assert_array_equal(around, np.setdiff1d(np.flatnonzero(shared), [0]))
            loops = mesh.boundary()
            self.assertEqual(len(loops), 1)
            self.assertEqual((neighbors < 0).sum(), len(loops[0]))
            labels, sizes = mesh.components()
            np.testing.assert_array_equal(labels, 0)
            np.testing.assert_array_equal(sizes, [len(triangles)])

    def test_the_filter_can_replace_vtk_probe_filter(self):
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkFiltersCore import vtkProbeFilter

        cloud = tipp.delaunay_2d(self.asked, point_data={"own": np.arange(len(self.asked), dtype=np.float64)},
                                 return_type="vtk")
        for source in ({"FileName": self.path}, {"SourceData": self.mesh.to_vtk()}):
            query = tipp.vtkPartitionedMeshQuery()
            query.SetInputData(cloud)
            for name, value in source.items():
                getattr(query, "Set" + name)(value)
            query.SetPassPointArrays(True)
            query.Update()
            probe = vtkProbeFilter()
            probe.SetInputData(cloud)
            probe.SetSourceData(self.mesh.to_vtk())
            probe.Update()
            ours, theirs = query.GetOutput().GetPointData(), probe.GetOutput().GetPointData()
            self.assertEqual(query.GetOutput().GetNumberOfCells(), cloud.GetNumberOfCells())
            self.assertIsNotNone(ours.GetArray("own"))
            mask = vtk_to_numpy(ours.GetArray("vtkValidPointMask"))
            same = mask == vtk_to_numpy(theirs.GetArray("vtkValidPointMask"))
            self.assertGreater(same.mean(), 0.99)  # vtkProbeFilter has a tolerance
            np.testing.assert_allclose(vtk_to_numpy(ours.GetArray("height"))[same],
                                       vtk_to_numpy(theirs.GetArray("height"))[same], atol=1e-6)
            cells = vtk_to_numpy(ours.GetArray("CellId"))
            np.testing.assert_array_equal(cells >= 0, mask != 0)
            self.assertEqual(np.abs(vtk_to_numpy(ours.GetArray("height"))[mask == 0]).max(), 0)

    def test_direct_queries_update_the_source(self):
        from vtkmodules.vtkCommonCore import vtkIdTypeArray
        from vtkmodules.vtkFiltersGeneral import vtkShrinkFilter

        shrink = vtkShrinkFilter()
        shrink.SetInputData(self.mesh.to_vtk())
        query = tipp.vtkPartitionedMeshQuery()
        query.SetSourceConnection(shrink.GetOutputPort())
        cells, sizes = vtkIdTypeArray(), vtkIdTypeArray()
        self.assertEqual(query.Components(cells, sizes), 1)
        self.assertEqual(sizes.GetNumberOfValues(), len(self.mesh.cells))  # no two cells are connected

    def test_contours_of_a_plane_are_straight(self):
        with tipp.open(self.path) as mesh, tipp.open(self.mesh) as whole:
            lines = mesh.contours([-0.5, 0.25, 7], "height")
            self.assertEqual([level for level, _ in lines], [-0.5, 0.25])
            for level, points in lines:
                np.testing.assert_allclose(points[:, 0] - 2 * points[:, 1], level, atol=1e-12)
            for (_, ours), (_, theirs) in zip(lines, whole.contours([-0.5, 0.25], "height")):
                np.testing.assert_array_equal(ours, theirs)
            self.assertEqual(mesh.contours([7], "height"), [])

    def test_profiles_cross_pieces(self):
        with tipp.open(self.path) as mesh, tipp.open(self.mesh) as whole:
            corners = [(0.2, 0.3), (0.7, 0.6), (0.7, 0.9)]
            for spacing in (0, 0.01):
                ours, theirs = mesh.profile(corners, spacing, "height"), whole.profile(corners, spacing, "height")
                np.testing.assert_array_equal(ours.points, theirs.points)
                np.testing.assert_array_equal(ours.cells, theirs.cells)
                np.testing.assert_allclose(ours.values["height"], ours.points[:, 0] - 2 * ours.points[:, 1], atol=1e-12)
                self.assertAlmostEqual(ours.distances[-1], np.hypot(0.5, 0.3) + 0.3)
                self.assertTrue((np.diff(ours.distances) > 0).all())

    def test_errors_are_one_sentence(self):
        with self.assertRaisesRegex(RuntimeError, "nowhere"):
            tipp.open(str(self.folder / "nowhere"))
        with tipp.open(self.path) as mesh:
            with self.assertRaisesRegex(KeyError, "depth"):
                mesh.interpolate(self.asked, "depth")
            with self.assertRaisesRegex(RuntimeError, "no cell 1000000"):
                mesh.neighbors([1000000])
            with self.assertRaises(TypeError):
                mesh.star([0.5])
            with self.assertRaises(ValueError):
                mesh.ring(k=2)
        with self.assertRaisesRegex(ValueError, "closed"):
            mesh.locate(self.asked)

    def test_no_points_and_no_ids(self):
        with tipp.open(self.path) as mesh:
            cells, weights = mesh.locate(np.zeros((0, 2)))
            self.assertEqual((cells.shape, weights.shape), ((0,), (0, 3)))
            self.assertEqual(mesh.neighbors([]).shape, (0, 3))
            self.assertEqual(mesh.star([]), [])


unittest.main()
