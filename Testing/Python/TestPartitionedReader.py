# SPDX-License-Identifier: BSD-3-Clause
"""vtkPartitionedUnstructuredReader as Python programs use it."""
import pathlib
import tempfile
import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from tipp import vtkPartitionedUnstructuredReader


def write_flat(folder, n=20):
    """Writes a lattice of triangles with points in random order, by the three lines in the documentation."""
    x, y = np.meshgrid(np.arange(n), np.arange(n))
    number = np.random.default_rng(1).permutation(n * n).reshape(n, n)
    points = np.empty((n * n, 2))
    points[number.ravel()] = np.c_[x.ravel(), y.ravel()]
    a, b, c, d = (number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1])
    cells = np.concatenate([np.stack(t, -1).reshape(-1, 3) for t in ((a, b, c), (a, c, d))])
    (folder / "point_data").mkdir(parents=True)
    np.save(folder / "cells.npy", cells)
    np.save(folder / "points.npy", points)
    np.save(folder / "point_data" / "heat.npy", points.sum(axis=1).astype("f4"))
    return points, cells


class Read(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = pathlib.Path(self.temporary.name) / "mesh"
        self.points, self.cells = write_flat(self.folder)
        self.reader = vtkPartitionedUnstructuredReader()
        self.reader.SetFileName(str(self.folder))

    def output(self):
        self.reader.Update()
        return self.reader.GetOutputDataObject(0)

    def test_a_point_without_coordinates_that_no_cell_has_is_kept(self):
        np.save(self.folder / "points.npy", np.r_[self.points, [[np.nan, 5]]])
        np.save(self.folder / "point_data" / "heat.npy", np.zeros(len(self.points) + 1))
        mesh = self.output()
        self.assertEqual((len(self.points) + 1, len(self.cells)), (mesh.GetNumberOfPoints(), mesh.GetNumberOfCells()))

    def test_numpy_arrays_are_read_by_global_ids(self):
        mesh = self.output()
        ids = vtk_to_numpy(mesh.GetPointData().GetGlobalIds())
        self.assertEqual(sorted(ids), list(range(len(self.points))))
        np.testing.assert_array_equal(
            vtk_to_numpy(mesh.GetPoints().GetData())[:, :2], self.points[ids])
        np.testing.assert_array_equal(
            vtk_to_numpy(mesh.GetPointData().GetArray("heat")),
            self.points[ids].sum(axis=1).astype("f4"))
        cells = vtk_to_numpy(mesh.GetCellData().GetGlobalIds())
        corners = vtk_to_numpy(mesh.GetCells().GetConnectivityArray()).reshape(-1, 3)
        np.testing.assert_array_equal(ids[corners], self.cells[cells])

    def test_only_a_range_is_read(self):
        self.reader.SetBounds(2.5, 3.5, 2.5, 3.5, 0, 0)
        self.assertEqual(self.output().GetNumberOfCells(), 2 * 4)

    def test_pieces_are_a_partitioned_data_set(self):
        self.reader.MergePiecesOff()
        self.reader.SetTiling("grid:2x3")
        pieces = self.output()
        self.assertEqual(pieces.GetClassName(), "vtkPartitionedDataSet")
        self.assertEqual(pieces.GetNumberOfPartitions(), 6)

    def test_arrays_are_chosen_by_name(self):
        self.reader.UpdateInformation()
        selection = self.reader.GetPointDataArraySelection()
        self.assertEqual(selection.GetArrayName(0), "heat")
        selection.DisableArray("heat")
        self.assertFalse(self.output().GetPointData().HasArray("heat"))

    def test_can_read_file_recognizes_meshes(self):
        self.assertTrue(self.reader.CanReadFile(str(self.folder)))
        self.assertFalse(self.reader.CanReadFile(str(self.folder / "cells.npy")))


if __name__ == "__main__":
    unittest.main()
