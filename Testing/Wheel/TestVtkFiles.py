# SPDX-License-Identifier: BSD-3-Clause
"""The wheel reads VTK's XML files as TIPP writes them, and refuses others with advice."""
import importlib.util
import pathlib
import struct
import tempfile
import unittest

import numpy as np

import tipp
from tipp import _vtkxml

HAS_VTK = importlib.util.find_spec("vtkmodules") is not None
ALL = {"bounds": None, "time": None, "borrowed": False, "merge": True, "point_arrays": None, "cell_arrays": None}
NAMES = {"<f8": "Float64", "<f4": "Float32", "<i8": "Int64", "<i4": "Int32", "|u1": "UInt8", "|i1": "Int8"}


class Writer:
    """Makes the text of a file with appended raw data."""

    def __init__(self, count="Q"):
        self.data = b""
        self.count = count

    def array(self, name, values):
        values = np.asarray(values)
        kind = NAMES[values.dtype.str]
        columns = f' NumberOfComponents="{values.shape[1]}"' if values.ndim == 2 else ""
        text = f'<DataArray type="{kind}" Name="{name}"{columns} format="appended" offset="{len(self.data)}"/>\n'
        self.data += struct.pack("<" + self.count, values.nbytes) + values.tobytes()
        return text

    def arrays(self, section, arrays):
        return f"<{section}>\n" + "".join(self.array(*item) for item in arrays.items()) + f"</{section}>\n"

    def cells(self, section, lists):
        ids = np.concatenate([np.zeros(0, np.int32), *lists]).astype(np.int32)
        ends = np.cumsum([len(each) for each in lists], dtype=np.int64)
        return self.arrays(section, {"connectivity": ids, "offsets": ends})

    def file(self, kind, attributes, piece, sections):
        header = "UInt64" if self.count == "Q" else "UInt32"
        return (f'<?xml version="1.0"?>\n<VTKFile type="{kind}" version="1.0" byte_order="LittleEndian" '
                f'header_type="{header}">\n<{kind}{attributes}>\n<Piece {piece}>\n{sections}</Piece>\n</{kind}>\n'
                '<AppendedData encoding="raw">\n   _').encode() + self.data + b"\n</AppendedData>\n</VTKFile>\n"


POINTS = np.array([[0, 0, 1], [1, 0, 2], [1, 1, 3], [0, 1, 4.5]])


def surface(count="Q", triangles=((0, 1, 2), (0, 2, 3)), lines=((0, 1, 2), (3, 0)), vertices=((3,),)):
    writer = Writer(count)
    sections = (writer.arrays("PointData", {"h": POINTS[:, 2].astype(np.float32), "flow": POINTS[:, :2]}) +
                writer.arrays("CellData", {"id": np.arange(len(vertices) + len(lines) + len(triangles))}) +
                writer.arrays("Points", {"Points": POINTS}) + writer.cells("Verts", vertices) +
                writer.cells("Lines", lines) + writer.cells("Strips", ()) + writer.cells("Polys", triangles))
    return writer.file("PolyData", "", f'NumberOfPoints="4" NumberOfVerts="{len(vertices)}" NumberOfLines="{len(lines)}" '
                       f'NumberOfStrips="0" NumberOfPolys="{len(triangles)}"', sections)


def image(count="Q"):
    writer = Writer(count)
    sections = (writer.arrays("PointData", {"h": np.arange(12.0), "vtkValidPointMask": np.ones(12, np.int8)}) +
                writer.arrays("CellData", {"c": np.arange(6, dtype=np.int32)}))
    return writer.file("ImageData", ' WholeExtent="2 5 0 2 0 0" Origin="0.5 -1 0" Spacing="0.25 2 1"',
                       'Extent="2 5 0 2 0 0"', sections)


def tetrahedron():
    writer = Writer()
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
    sections = (writer.arrays("PointData", {"h": corners.sum(axis=1)}) + writer.arrays("Points", {"Points": corners}) +
                writer.arrays("Cells", {"connectivity": np.arange(4), "offsets": np.array([4]),
                                        "types": np.array([10], np.uint8)}))
    return writer.file("UnstructuredGrid", "", 'NumberOfPoints="4" NumberOfCells="1"', sections)


class VtkFiles(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name, content=None):
        path = pathlib.Path(self.folder.name, name)
        if content is not None:
            path.write_bytes(content)
        return str(path)

    def refuses(self, content, words, name="x.vtp"):
        with self.assertRaisesRegex(RuntimeError, words) as raised:
            _vtkxml.read(self.path(name, content), ALL)
        self.assertRegex(str(raised.exception), r"copy or write it again\.$|pyvista\.read\('.*'\) reads it\.$")

    def test_a_surface_has_its_points_cells_and_arrays(self):
        for count in "QI":
            mesh = _vtkxml.read(self.path("x.vtp", surface(count)), ALL)
            np.testing.assert_array_equal(POINTS, mesh.points)
            np.testing.assert_array_equal([[0, 1, 2], [0, 2, 3]], mesh.cells)
            np.testing.assert_array_equal([[0, 1], [1, 2], [3, 0]], mesh.lines)
            np.testing.assert_array_equal([[3]], mesh.vertices)
            np.testing.assert_array_equal(POINTS[:, :2], mesh.point_data["flow"])
            self.assertEqual(([3, 4], [1, 1, 2]), (mesh.cell_data["id"].tolist(), mesh.line_data["id"].tolist()))

    def test_an_image_has_its_place_and_arrays(self):
        for count in "QI":
            found = _vtkxml.read(self.path("x.vti", image(count)), ALL)
            self.assertEqual(((1.0, -1.0, 0.0), (0.25, 2.0, 1.0), (4, 3, 1)), (found.origin, found.spacing, found.dimensions))
            np.testing.assert_array_equal(np.arange(12.0).reshape(3, 4), tipp.as_array(found, "h"))
            np.testing.assert_array_equal(np.arange(6), found.cell_data["c"])

    def test_the_function_gives_a_mesh_and_an_image(self):
        mesh, grid = tipp.read(self.path("x.vtp", surface())), tipp.read(self.path("x.vti", image()))
        self.assertEqual((tipp.Mesh, tipp.Image), (type(mesh), type(grid)))
        self.assertEqual([1.0, 2.0, 3.0, 4.5], mesh["h"].tolist())
        self.assertEqual((3, 4), grid["h"].shape)

    @unittest.skipUnless(HAS_VTK, "VTK is not installed")
    def test_the_function_gives_data_of_vtk_on_request(self):
        mesh, grid = (tipp.read(self.path(*file), return_type="vtk") for file in (("x.vtp", surface()), ("x.vti", image())))
        self.assertEqual(["vtkUnstructuredGrid", "vtkImageData"], [data.GetClassName() for data in (mesh, grid)])
        self.assertEqual([-1, 1, 1, 2, 3, 4], sorted(tipp.as_array(mesh, "id").tolist()))  # a vertex has no value
        self.assertEqual(list(range(6)), tipp.as_array(grid, "c").ravel().tolist())

    def test_a_grid_of_tetrahedra_is_read(self):
        mesh = tipp.read(self.path("x.vtu", tetrahedron()))
        self.assertEqual([0, 1, 1, 1], sorted(tipp.as_array(mesh, "h").tolist()))
        self.assertEqual((1, 4), mesh.cells.shape)

    def test_grids_of_other_kinds_name_pyvista(self):
        good = tetrahedron()
        for old, new, words in (
                (b'header_type', b'compressor="vtkZLibDataCompressor" header_type', "is compressed"),
                (b'encoding="raw"', b'encoding="base64"', "has encoded data"),
                (b'type="Float64" Name="Points"', b'type="Int64" Name="Points"', "not three coordinates of Float32 or"),
                (struct.pack("<QB", 1, 10), struct.pack("<QB", 1, 12), "where all must be triangles or all tetrahedra")):
            with self.assertRaisesRegex(RuntimeError, words + r".*; with PyVista, pyvista\.read\('.*x\.vtu'\) reads it\."):
                tipp.read(self.path("x.vtu", good.replace(old, new)))

    def test_an_image_is_stored_as_triangles(self):
        output = self.path("x.tipp")
        tipp.write(self.path("x.vti", image()), output)
        mesh = tipp.read(output, return_type="tipp")
        self.assertEqual((12, 3), mesh.cells.shape)
        self.assertEqual([0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5], sorted(mesh["c"].tolist()))

    def test_only_the_named_arrays_are_kept(self):
        mesh = tipp.read(self.path("x.vtp", surface()), point_arrays="h", cell_arrays=[])
        self.assertEqual(4, len(tipp.as_array(mesh, "h")))
        for name in ("flow", "id"):
            with self.assertRaises(KeyError):
                tipp.as_array(mesh, name)
        with self.assertRaisesRegex(KeyError, "no point array 'w'"):
            tipp.read(self.path("x.vtp"), point_arrays="w")

    def test_options_for_pieces_are_refused(self):
        for options in ({"bounds": [0, 1] * 3}, {"time": 1.0}, {"borrowed": True}, {"merge": False}):
            with self.assertRaisesRegex(ValueError, f"{next(iter(options))} needs a mesh in pieces"):
                tipp.read(self.path("x.vtp", surface()), **options)

    def test_files_of_other_kinds_name_what_is_wrong_and_pyvista(self):
        good = surface()
        for old, new, words in (
                (b'header_type', b'compressor="vtkZLibDataCompressor" header_type', "is compressed; with PyVista"),
                (b'encoding="raw"', b'encoding="base64"', "has encoded data; with PyVista"),
                (b'"LittleEndian"', b'"BigEndian"', "is not little-endian"),
                (b'format="appended"', b'format="ascii"', "has the array '.*' as text or encoded"),
                (b'NumberOfStrips="0"', b'NumberOfStrips="2"', "has triangle strips"),
                (b"</PolyData>", b"<Piece/></PolyData>", "has several elements Piece")):
            self.refuses(good.replace(old, new), words)
        self.refuses(surface(triangles=((0, 1, 2, 3),)), "polygons that are not triangles")
        self.refuses(good[:good.index(b"<AppendedData")] + b"</VTKFile>", "has its arrays as text or encoded")
        self.refuses(b"solid", r"is a \.stl file, which only VTK reads", "x.stl")
        self.refuses(image().replace(b'Origin=', b'Direction="0 1 0 1 0 0 0 0 1" Origin='), "whose axes are turned", "x.vti")

    def test_damaged_files_name_what_is_wrong(self):
        good = surface()
        for old, new, words in (
                (b'NumberOfPoints="4"', b'NumberOfPoints="5"', "has 4 tuples in the array '.*' where 5 are due"),
                (b'NumberOfPoints="4"', b'NumberOfPoints="-4"', "has -4 as NumberOfPoints"),
                (b'NumberOfPolys="2"', b'NumberOfPolys="3"', "no list of ids and offsets for 3 Polys"),
                (b'offset="0"', b'offset="99999"', "with an offset or a number of components that it cannot hold"),
                (b'NumberOfComponents="2"', b'NumberOfComponents="3"', "no whole number of tuples"),
                (b'type="PolyData"', b'type="PolyDatum"', "is not a VTK XML file of type PolyData"),
                (b'type="Float32"', b'type="Float16"', "has the array 'h' of an unknown type"),
                (b"<PolyData>", b"<PolyData", "is not well-formed XML"),
                (b"<VTKFile", b"<!DOCTYPE a [<!ENTITY b 'c'>]><VTKFile", "has a document type")):
            self.refuses(good.replace(old, new, 1), words)
        self.refuses(surface(triangles=((0, 1, 9),)), "Polys that refer to points from 0 to 9, but there are 4 points")
        self.refuses(good[:-80], "more than are left|cannot hold")
        self.refuses(b"", "is not well-formed XML")
        self.refuses(image().replace(b'WholeExtent="2 5', b'WholeExtent="5 2').replace(b'Extent="2 5', b'Extent="5 2'),
                     "extent that is empty", "x.vti")
        with self.assertRaisesRegex(RuntimeError, "missing.vtp cannot be opened: No such file"):
            tipp.read(self.path("missing.vtp"))

    def test_mutants_are_refused_or_stay_within_the_file(self):
        random = np.random.default_rng(11)
        for name, good in (("x.vtp", surface()), ("x.vti", image())):
            refused = 0
            for _ in range(1500):
                mutant = bytearray(good)
                for _ in range(random.integers(1, 4)):
                    at = random.integers(len(mutant))
                    kind = random.integers(3)
                    if kind == 0:
                        mutant[at] = random.integers(256)
                    elif kind == 1:
                        del mutant[at:at + random.integers(1, 60)]
                    else:
                        mutant[at:at] = mutant[at - 9:at + 9]
                try:
                    data = _vtkxml.read(self.path(name, bytes(mutant)), ALL)
                except RuntimeError as error:
                    refused += 1
                    self.assertNotIn("\n", str(error))
                    continue
                if name == "x.vtp":
                    for cells in (data.cells, data.lines, data.vertices):
                        if cells is not None and cells.size:
                            self.assertTrue(0 <= cells.min() <= cells.max() < len(data.points))
                for values in data.point_data.values():
                    self.assertEqual(len(data.points) if name == "x.vtp" else np.prod(data.dimensions), len(values))
            self.assertGreater(refused, 500)


@unittest.skipUnless(HAS_VTK, "VTK is not installed")
class WrittenByVtk(unittest.TestCase):
    def test_what_vtk_writes_raw_is_read_and_what_it_compresses_is_refused(self):
        from vtkmodules.vtkIOXML import vtkXMLImageDataWriter, vtkXMLPolyDataWriter

        points = np.random.default_rng(2).random((50, 3))
        mesh = tipp.delaunay_2d(points, point_data={"x": points[:, 0]}, neighbors=True, return_type="vtk")
        for data, writer, name in ((mesh, vtkXMLPolyDataWriter(), "x"),
                                   (tipp.resample(mesh, dimensions=(7, 5, 1)), vtkXMLImageDataWriter(), "x")):
            with tempfile.TemporaryDirectory() as folder:
                path = f"{folder}/data.{writer.GetDefaultFileExtension()}"
                writer.SetFileName(path)
                writer.SetInputData(data)
                writer.EncodeAppendedDataOff()
                with_compression = writer.GetCompressor()
                writer.SetCompressor(None)
                writer.Write()
                again = tipp.read(path, return_type="vtk")
                np.testing.assert_array_equal(tipp.as_array(data, name), tipp.as_array(again, name))
                self.assertEqual((data.GetBounds(), data.GetNumberOfCells()), (again.GetBounds(), again.GetNumberOfCells()))
                writer.SetCompressor(with_compression)
                writer.Write()
                with self.assertRaisesRegex(RuntimeError, r"data\.vt[pi] is compressed; with PyVista, pyvista\.read\("):
                    tipp.read(path)


if __name__ == "__main__":
    unittest.main()
