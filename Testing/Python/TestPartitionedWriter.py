# SPDX-License-Identifier: BSD-3-Clause
import pathlib
import tempfile
import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkCommand
from vtkmodules.vtkCommonDataModel import vtkPartitionedDataSet
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkFiltersCore import vtkTriangleFilter
from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader

try:
    from vtkmodules.vtkIOHDF import vtkHDFReader
except ImportError:
    vtkHDFReader = None  # a VTK without HDF5

from tipp import vtkPartitionedUnstructuredWriter


def plane(x=0.0):
    source = vtkPlaneSource()
    source.SetOrigin(x, 0, 0)
    source.SetPoint1(x + 1, 0, 0)
    source.SetPoint2(x, 1, 0)
    source.SetResolution(10, 10)
    triangles = vtkTriangleFilter()
    triangles.SetInputConnection(source.GetOutputPort())
    triangles.Update()
    return triangles.GetOutput()


def read(path):
    reader = vtkXMLPUnstructuredGridReader()
    reader.SetFileName(str(path / "mesh.pvtu"))
    reader.Update()
    return reader.GetOutput()


class PartitionedWriter(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.path = self.folder / "mesh.tipp"
        self.errors = []
        self.writer = vtkPartitionedUnstructuredWriter()
        self.writer.AddObserver(vtkCommand.ErrorEvent, lambda *_: self.errors.append(1))
        self.writer.SetFileName(str(self.path))

    def test_writes_an_input(self):
        self.writer.SetInputData(plane())
        self.assertEqual(self.writer.Write(), 1)
        mesh = read(self.path)
        self.assertEqual(mesh.GetNumberOfCells(), 200)
        ids = vtk_to_numpy(mesh.GetCellData().GetGlobalIds())
        self.assertTrue((np.sort(ids) == np.arange(200)).all())
        self.assertEqual(len(list((self.path / "pieces").iterdir())), 16)

    def test_copies_borrowed_cells(self):
        self.writer.SetInputData(plane())
        self.writer.SetTiling("grid:2x2")
        self.writer.DuplicateBorrowersOn()
        self.assertEqual(self.writer.Write(), 1)
        ghosts = vtk_to_numpy(read(self.path).GetCellGhostArray())
        self.assertEqual((ghosts == 0).sum(), 200)
        self.assertGreater((ghosts == 1).sum(), 0)

    @unittest.skipUnless(vtkHDFReader, "this VTK has no vtkHDFReader")
    def test_vtk_reads_equal_grids_from_the_vtkhdf_and_the_pvtu(self):
        for borrowers_are_duplicated in (False, True):
            self.writer.SetInputData(plane())
            self.writer.SetDuplicateBorrowers(borrowers_are_duplicated)
            self.assertEqual(self.writer.Write(), 1)
            reader = vtkHDFReader()
            reader.SetFileName(str(self.path / "mesh.vtkhdf"))
            reader.Update()
            self.assert_equal_grids(read(self.path), reader.GetOutput())

    def assert_equal_grids(self, expected, found):
        def arrays_of(grid):
            cells = grid.GetCells()
            arrays = [grid.GetPoints().GetData(), cells.GetConnectivityArray(), cells.GetOffsetsArray(),
                      grid.GetCellTypesArray()]
            for data in (grid.GetPointData(), grid.GetCellData()):
                names = sorted(data.GetArrayName(i) for i in range(data.GetNumberOfArrays()))
                arrays += [data.GetArray(name) for name in names]
            return arrays

        self.assertEqual(len(arrays_of(expected)), len(arrays_of(found)))
        for one, other in zip(arrays_of(expected), arrays_of(found)):
            np.testing.assert_array_equal(vtk_to_numpy(one), vtk_to_numpy(other))

    def test_joins_the_parts_of_a_partitioned_data_set(self):
        parts = vtkPartitionedDataSet()
        parts.SetPartition(0, plane())
        parts.SetPartition(1, plane(1.0))
        self.writer.SetInputDataObject(parts)
        self.assertEqual(self.writer.Write(), 1)
        ids = vtk_to_numpy(read(self.path).GetPointData().GetGlobalIds())
        self.assertEqual(len(np.unique(ids)), 21 * 11)

    def test_accepts_a_flat_mesh(self):
        flat = self.folder / "flat"
        flat.mkdir()
        np.save(flat / "cells.npy", np.array([[0, 1, 2], [0, 2, 3]], dtype=np.int32))
        np.save(flat / "points.npy", np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]]))
        self.writer.SetInputFileName(str(flat))
        self.writer.SetTiling("grid:1x1")
        self.assertEqual(self.writer.Write(), 1)
        self.assertEqual(read(self.path).GetNumberOfCells(), 2)

    def test_reports_errors(self):
        self.writer.SetInputFileName(str(self.folder / "none"))
        self.assertEqual(self.writer.Write(), 0)
        self.writer.SetInputFileName(None)
        self.assertEqual(self.writer.Write(), 0)
        self.writer.SetInputData(plane())
        self.writer.SetTiling("hexagons")
        self.assertEqual(self.writer.Write(), 0)
        self.assertGreaterEqual(len(self.errors), 2)
        self.assertFalse(self.path.exists())

    def test_stops_on_request(self):
        self.writer.SetInputData(plane())
        self.writer.AddObserver(
            vtkCommand.ProgressEvent, lambda writer, _: writer.SetAbortExecute(1))
        self.assertEqual(self.writer.Write(), 0)
        self.assertFalse(self.path.exists())


if __name__ == "__main__":
    unittest.main()
