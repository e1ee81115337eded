"""Compares time steps with xugrid and netCDF4, which are not needed otherwise: where they are not installed, the tests are
skipped.

usage: TestSeriesPeers.py TIPP SHARED_DATA [-v]
"""

import importlib.util
import os
import subprocess
import sys
import tempfile
import unittest
import warnings

HAS_PEERS = all(importlib.util.find_spec(name) for name in ("xugrid", "netCDF4", "numpy"))
if HAS_PEERS:
    import numpy as np
    import xarray
    import xugrid

TIPP, DATA = "", ""


@unittest.skipUnless(HAS_PEERS, "xugrid and netCDF4 are not installed")
class SeriesPeers(unittest.TestCase):
    def setUp(self):
        warnings.simplefilter("ignore")
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)

    def path(self, name):
        return os.path.join(self.temporary.name, name)

    def tipp(self, *words):
        done = subprocess.run([TIPP, *words], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)

    def data(self, name):
        path = os.path.join(DATA, name)
        if not os.path.exists(path):
            self.skipTest(f"{path} is not here")
        return path

    def maps(self, source, *words):
        self.tipp("resample", source, "-o", self.path("maps.nc"), "--step", "all", *words)
        maps = xarray.open_dataset(self.path("maps.nc"), decode_times=False)
        self.addCleanup(maps.close)
        axes = [maps[name].values for name in (("lon", "lat") if "lon" in maps else ("x", "y"))]
        points = np.stack(np.meshgrid(*axes), -1).reshape(-1, 2)
        return maps, points

    def expect_equal(self, ours, theirs, tolerance):
        """Values that both have agree; which samples on the border of the mesh have one may differ."""
        both = np.isfinite(ours) & np.isfinite(theirs)
        self.assertGreater(both.sum(), 0.1 * ours.size)
        self.assertLess((np.isfinite(ours) != np.isfinite(theirs)).sum(), 0.02 * ours.size)
        self.assertLess(np.abs(ours - theirs)[both].max(), tolerance * np.ptp(theirs[both]))

    def test_values_at_nodes(self):
        source = self.data("netcdf/adcirc_1t.nc")
        maps, points = self.maps(source, "--dims", "200", "150", "--arrays", "ssh", "u")
        peer = xarray.open_dataset(source, decode_times=False)
        self.addCleanup(peer.close)
        grid = xugrid.Ugrid2d(peer["longitude"].values, peer["latitude"].values, -1, peer["element"].values.astype(int) - 1)
        faces, weights = grid.compute_barycentric_weights(points)
        for name in ("ssh", "u"):
            for step in range(peer.sizes["time"]):
                corners = peer[name].values[step][grid.face_node_connectivity[faces]]
                theirs = np.where(faces < 0, np.nan, (weights * corners).sum(1))
                self.expect_equal(maps[name].values[step].ravel(), theirs, 1e-6)

    def test_values_on_polygons(self):
        source = self.data("netcdf/dflow_simplebox_hex7_map.nc")
        maps, points = self.maps(source, "--dims", "173", "131", "--arrays", "mesh2d_s1", "mesh2d_waterdepth")
        peer = xugrid.open_dataset(source, decode_times=False)
        faces = peer.ugrid.grid.locate_points(points)
        for name in ("mesh2d_s1", "mesh2d_waterdepth"):
            for step in range(peer.sizes["time"]):
                theirs = np.where(faces < 0, np.nan, peer[name].values[step][faces])
                ours = maps[name].values[step].ravel()
                both = np.isfinite(ours) & np.isfinite(theirs)
                self.assertGreater(both.sum(), 0.1 * ours.size)
                # A sample on an edge may be in either polygon.
                self.assertLess((ours != theirs.astype(np.float32))[both].sum(), 0.01 * both.sum())

    def test_values_at_stations(self):
        source = self.data("netcdf/adcirc_1t.nc")
        peer = xarray.open_dataset(source, decode_times=False)
        self.addCleanup(peer.close)
        grid = xugrid.Ugrid2d(peer["longitude"].values, peer["latitude"].values, -1, peer["element"].values.astype(int) - 1)
        stations = grid.face_coordinates[::500] + 1e-4
        np.savetxt(self.path("stations.csv"), stations, delimiter=",", header="x,y", comments="", fmt="%.17g")
        self.tipp("query", self.path("stations.csv"), source, "-o", self.path("series.npy"), "--arrays", "ssh")
        ours = np.load(self.path("series.npy"))[:, :, 0]
        faces, weights = grid.compute_barycentric_weights(stations)
        corners = peer["ssh"].values[:, grid.face_node_connectivity[faces]]
        theirs = np.where(faces < 0, np.nan, (weights * corners).sum(2))
        self.expect_equal(ours.ravel(), theirs.ravel(), 1e-9)

    def test_written_meshes_are_read(self):
        source = self.data("netcdf/adcirc_1t.nc")
        self.tipp("flatten", source, "-o", self.path("mesh.nc"), "--crs", "EPSG:4326")
        peer = xarray.open_dataset(source, decode_times=False)
        self.addCleanup(peer.close)
        written = xugrid.open_dataset(self.path("mesh.nc"), decode_times=False)
        grid = written.ugrid.grid
        np.testing.assert_array_equal(grid.face_node_connectivity, peer["element"].values.astype(int) - 1)
        np.testing.assert_array_equal(grid.node_x, peer["longitude"].values)
        np.testing.assert_array_equal(grid.node_y, peer["latitude"].values)
        np.testing.assert_array_equal(written["ssh"].values, peer["ssh"].values)
        np.testing.assert_array_equal(written["bathymetry"].values, peer["bathymetry"].values)
        np.testing.assert_array_equal(written["time"].values, peer["time"].values)
        self.assertEqual(written["ssh"].dims, ("time", grid.node_dimension))


if __name__ == "__main__":
    TIPP, DATA = sys.argv[1:3]
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
