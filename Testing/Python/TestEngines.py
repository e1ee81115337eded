# SPDX-License-Identifier: BSD-3-Clause
"""Tests of the examples that make meshes for OCSMesh and ANUGA, with stand-ins for what these packages offer."""
import pathlib
import sys
import types
import unittest

import numpy as np

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "Examples" / "Python"
sys.path.insert(0, str(EXAMPLES))


class MeshData:
    """As of ocsmesh.internal: nodes, triangles, quadrilaterals, and values at the nodes."""

    def __init__(self, coords, tria=None, quad=None, values=None, crs=None):
        self.coords = np.array(coords, float)
        self.tria = np.empty((0, 3), int) if tria is None else np.array(tria)
        self.quad = np.empty((0, 4), int) if quad is None else np.array(quad)
        self.values = np.zeros((len(self.coords), 1)) if values is None else np.array(values).reshape(-1, 1)
        self.crs = crs

    @property
    def num_nodes(self):
        return len(self.coords)


class BaseMeshOptions:
    pass


class BaseMeshEngine:
    def __init__(self, options):
        if not isinstance(options, BaseMeshOptions):
            raise ValueError("options must be BaseMeshOptions")
        self._options = options


class Shape:
    """As a GeoSeries: polygons with a coordinate reference system."""

    def __init__(self, *polygons):
        self.crs = "EPSG:25832"
        self._polygons = polygons

    def union_all(self):
        union = types.SimpleNamespace()
        union.__geo_interface__ = {"type": "MultiPolygon", "coordinates": self._polygons}
        return union


def install_ocsmesh():
    names = ("ocsmesh", "ocsmesh.internal", "ocsmesh.engines", "ocsmesh.engines.base", "ocsmesh.engines.factory")
    made = {name: types.ModuleType(name) for name in names}
    made["ocsmesh.internal"].MeshData = MeshData
    made["ocsmesh.engines.base"].BaseMeshEngine = BaseMeshEngine
    made["ocsmesh.engines.base"].BaseMeshOptions = BaseMeshOptions
    made["ocsmesh.engines.factory"]._ENGINES = {}
    made["ocsmesh.engines"].factory = made["ocsmesh.engines.factory"]
    sys.modules.update(made)


install_ocsmesh()
import anuga_triangles  # noqa: E402
import ocsmesh_engine  # noqa: E402


def rectangle(west, south, east, north):
    return [(west, south), (east, south), (east, north), (west, north), (west, south)]


def areas(mesh):
    a, b, c = (mesh.coords[mesh.tria[:, i]] for i in range(3))
    return ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2


def triangles_as_coordinates(mesh):
    return {tuple(sorted(map(tuple, corners))) for corners in mesh.coords[mesh.tria].tolist()}


class TestOcsmesh(unittest.TestCase):
    def setUp(self):
        ocsmesh_engine.register()
        engine, options = sys.modules["ocsmesh.engines.factory"]._ENGINES["tipp"]
        self.engine = engine(options(min_angle=30))
        self.shape = Shape([rectangle(0, 0, 10, 10), rectangle(4, 4, 6, 6)[::-1]], [rectangle(20, 0, 30, 5)])

    def test_polygons_with_holes(self):
        mesh = self.engine.generate(self.shape, 0.8)
        self.assertAlmostEqual(100 - 4 + 50, areas(mesh).sum())
        self.assertLessEqual(areas(mesh).max(), np.sqrt(3) / 4 * 0.64)
        self.assertEqual("EPSG:25832", mesh.crs)

    def test_sizes_of_a_mesh(self):
        sizing = MeshData([[0, 0], [30, 0], [30, 10], [0, 10]], [[0, 1, 2], [0, 2, 3]], values=[0.3, 2, 2, 0.3])
        mesh = self.engine.generate(self.shape, sizing)
        west = mesh.coords[mesh.tria].mean(axis=1)[:, 0] < 1
        self.assertLess(areas(mesh)[west].max(), areas(mesh)[~west].max() / 4)

    def test_sizes_of_nodes_reach_beyond_them(self):
        sizing = MeshData([[4, 4], [6, 4], [6, 6], [4, 6]], values=[0.5, 0.5, 0.5, 0.5])
        self.assertLessEqual(areas(self.engine.generate(self.shape, sizing)).max(), np.sqrt(3) / 4 * 0.25 * 1.001)

    def test_seeds_are_nodes(self):
        mesh = self.engine.generate(self.shape, 2, MeshData([[3.25, 3.5], [5, 5]]))
        self.assertIn((3.25, 3.5), set(map(tuple, mesh.coords.tolist())))
        self.assertNotIn((5.0, 5.0), set(map(tuple, mesh.coords.tolist())))  # in the hole

    def test_remesh_of_a_region_keeps_the_rest(self):
        mesh = self.engine.generate(self.shape, 1)
        finer = self.engine.remesh(mesh, Shape([rectangle(2, 2, 8, 8)]), 0.3)
        self.assertAlmostEqual(areas(mesh).sum(), areas(finer).sum())
        self.assertGreater(len(finer.tria), 2 * len(mesh.tria))
        inside = ((mesh.coords[mesh.tria] >= 2) & (mesh.coords[mesh.tria] <= 8)).all(axis=(1, 2))
        outside = MeshData(mesh.coords, mesh.tria[~inside])
        self.assertLess(triangles_as_coordinates(outside), triangles_as_coordinates(finer))
        self.assertEqual(len(finer.coords), len(set(map(tuple, finer.coords.tolist()))))

    def test_remesh_of_all(self):
        mesh = self.engine.generate(self.shape, 2)
        finer = self.engine.remesh(mesh, sizing=0.5)
        self.assertAlmostEqual(areas(mesh).sum(), areas(finer).sum())
        self.assertGreater(len(finer.tria), 3 * len(mesh.tria))

    def test_quadrilaterals_are_refused(self):
        with self.assertRaisesRegex(NotImplementedError, "split the quadrilaterals"):
            self.engine.remesh(MeshData([[0, 0], [1, 0], [1, 1], [0, 1]], quad=[[0, 1, 2, 3]]))


class TestAnuga(unittest.TestCase):
    def test_the_package_triangle_is_tipp(self):
        anuga_triangles.use_tipp()
        import triangle
        with self.assertRaises(ImportError):
            import meshpy.triangle  # noqa: F401
        # As ANUGA's mesh engine calls it, with the arrays that it makes of its lists.
        given = {"vertices": np.array([[0, 0], [100, 0], [100, 60], [0, 60], [0, 30], [100, 30]], float),
                 "segments": np.array([[0, 1], [1, 5], [5, 2], [2, 3], [3, 4], [4, 0], [4, 5]], np.int32),
                 "regions": np.array([[50, 10, 7, 90], [50, 50, 8, 9]], float),
                 "segment_markers": np.array([1, 2, 2, 3, 4, 4, 0], np.int32)}
        found = triangle.triangulate(given, "jQpzq28.0a1000.0aAn")
        a, b, c = (found["vertices"][found["triangles"][:, i]] for i in range(3))
        size = ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2
        region = found["triangle_attributes"].ravel()
        self.assertEqual({7, 8}, set(region.tolist()))
        self.assertLessEqual(size[region == 8].max(), 9)
        self.assertLessEqual(size[region == 7].max(), 90)
        self.assertAlmostEqual(6000, size.sum())
        self.assertLessEqual({1, 2, 3, 4}, set(found["segment_markers"].ravel().tolist()))
        self.assertEqual(found["triangles"].shape, found["neighbors"].shape)


if __name__ == "__main__":
    unittest.main()
