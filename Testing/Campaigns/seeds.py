# SPDX-License-Identifier: BSD-3-Clause
"""Makes small valid files of every format that a command reads, for mutants.py, with Python's standard library only."""
import base64
import struct
import zlib

SIDE = 4
POINTS = [(x + 0.1 * y, y + 0.07 * x * x, 0.5 * x) for y in range(SIDE) for x in range(SIDE)]
QUADS = [(i, i + 1, i + 1 + SIDE, i + SIDE) for i in (x + SIDE * y for y in range(SIDE - 1) for x in range(SIDE - 1))]
TRIANGLES = [t for a, b, c, d in QUADS for t in ((a, b, c), (a, c, d))]
CUBE = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
TETRAHEDRA = [(0, 1, 3, 7), (0, 1, 5, 7), (0, 2, 3, 7), (0, 2, 6, 7), (0, 4, 5, 7), (0, 4, 6, 7)]
TRIANGLE, STRIP, QUAD, TETRA, HEXAHEDRON, POLYHEDRON = 5, 6, 9, 10, 12, 42


class Mesh:
    """Points, and cells as (type, ids)."""

    def __init__(self, points, cells, faces=None):
        self.points = points
        self.cells = cells
        self.faces = faces  # the faces of the only cell, a polyhedron

    @property
    def connectivity(self):
        return [i for _, ids in self.cells for i in ids]

    @property
    def offsets(self):
        ends, end = [], 0
        for _, ids in self.cells:
            end += len(ids)
            ends.append(end)
        return ends


SURFACE = Mesh(POINTS, [(TRIANGLE, t) for t in TRIANGLES])
MIXED = Mesh(POINTS, [(TRIANGLE, t) for t in TRIANGLES[:8]] + [(QUAD, q) for q in QUADS[4:]])
VOLUME = Mesh(CUBE, [(TETRA, t) for t in TETRAHEDRA])
SOLIDS = Mesh(CUBE, [(HEXAHEDRON, (0, 1, 3, 2, 4, 5, 7, 6)), (TETRA, TETRAHEDRA[0])])
FACES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
POLYHEDRAL = Mesh(CUBE, [(POLYHEDRON, tuple(range(8)))], FACES)


def npy(code, shape, values):
    kinds = {"d": "<f8", "f": "<f4", "q": "<i8", "i": "<i4"}
    header = "{'descr': '%s', 'fortran_order': False, 'shape': %s, }" % (kinds[code], repr(tuple(shape)))
    header += " " * (-(len(header) + 11) % 64) + "\n"
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header.encode() + pack(code, values)


def pack(code, values, order="<"):
    return struct.pack(f"{order}{len(values)}{code}", *values)


def flat(tuples):
    return [value for row in tuples for value in row]


class Xml:
    """A VTK XML file; `mode` is ascii, base64, zlib, raw or encoded."""
    NAMES = {"d": "Float64", "f": "Float32", "q": "Int64", "i": "Int32", "B": "UInt8"}

    def __init__(self, kind, mode):
        self.mode = mode
        compressor = ' compressor="vtkZLibDataCompressor"' if mode == "zlib" else ""
        self.lines = ['<?xml version="1.0"?>',
                      f'<VTKFile type="{kind}" version="1.0" byte_order="LittleEndian" header_type="UInt64"{compressor}>']
        self.appended = b""
        self.kind = kind

    def add(self, text):
        self.lines.append(text)

    def array(self, name, code, values, components=1):
        start = f'<DataArray type="{self.NAMES[code]}" Name="{name}" NumberOfComponents="{components}"'
        data = pack(code, values)
        if self.mode == "ascii":
            self.add(f'{start} format="ascii">\n{" ".join(map(str, values))}\n</DataArray>')
        elif self.mode == "base64":
            self.add(f'{start} format="binary">{base64.b64encode(struct.pack("<Q", len(data)) + data).decode()}</DataArray>')
        elif self.mode == "zlib":
            packed = zlib.compress(data)
            head = struct.pack("<4Q", 1, len(data), 0, len(packed))
            text = base64.b64encode(head) + base64.b64encode(packed)
            self.add(f'{start} format="binary">{text.decode()}</DataArray>')
        else:
            self.add(f'{start} format="appended" offset="{len(self.appended)}"/>')
            block = struct.pack("<Q", len(data)) + data
            self.appended += block if self.mode == "raw" else base64.b64encode(block)

    def content(self):
        text = "\n".join(self.lines).encode()
        if self.mode in ("raw", "encoded"):
            encoding = "raw" if self.mode == "raw" else "base64"
            text += f'\n<AppendedData encoding="{encoding}">\n_'.encode() + self.appended + b"\n</AppendedData>"
        return text + b"\n</VTKFile>\n"


def fields(xml, mesh_points, cells):
    xml.add("<PointData>")
    xml.array("height", "d", [p[0] - 2 * p[1] for p in mesh_points])
    xml.array("wind", "f", [float(i) for i in range(2 * len(mesh_points))], 2)
    xml.add("</PointData><CellData>")
    xml.array("rank", "i", list(range(cells)))
    xml.add("</CellData>")


def vtu(mesh, mode):
    xml = Xml("UnstructuredGrid", mode)
    xml.add(f'<UnstructuredGrid><Piece NumberOfPoints="{len(mesh.points)}" NumberOfCells="{len(mesh.cells)}">')
    fields(xml, mesh.points, len(mesh.cells))
    xml.add("<Points>")
    xml.array("Points", "d", [float(v) for v in flat(mesh.points)], 3)
    xml.add("</Points><Cells>")
    xml.array("connectivity", "q", mesh.connectivity)
    xml.array("offsets", "q", mesh.offsets)
    xml.array("types", "B", [kind for kind, _ in mesh.cells])
    if mesh.faces:
        stream = [len(mesh.faces)] + [v for face in mesh.faces for v in (len(face), *face)]
        xml.array("faces", "q", stream)
        xml.array("faceoffsets", "q", [len(stream)])
    xml.add("</Cells></Piece></UnstructuredGrid>")
    return xml.content()


def vtp(mode):
    xml = Xml("PolyData", mode)
    xml.add(f'<PolyData><Piece NumberOfPoints="{len(POINTS)}" NumberOfVerts="1" NumberOfLines="1" NumberOfStrips="1" '
            f'NumberOfPolys="{len(TRIANGLES)}">')
    fields(xml, POINTS, len(TRIANGLES) + 3)
    xml.add("<Points>")
    xml.array("Points", "f", [float(v) for v in flat(POINTS)], 3)
    xml.add("</Points>")
    for section, cells in (("Verts", [(0,)]), ("Lines", [(0, 1)]), ("Strips", [(0, 1, 4, 5)]), ("Polys", TRIANGLES)):
        mesh = Mesh(POINTS, [(0, ids) for ids in cells])
        xml.add(f"<{section}>")
        xml.array("connectivity", "i", mesh.connectivity)
        xml.array("offsets", "i", mesh.offsets)
        xml.add(f"</{section}>")
    xml.add("</Piece></PolyData>")
    return xml.content()


def structured(kind, mode):
    extent = f"0 {SIDE - 1} 0 {SIDE - 1} 0 0"
    more = ' Origin="0 0 0" Spacing="1 1 1"' if kind == "ImageData" else ""
    xml = Xml(kind, mode)
    xml.add(f'<{kind} WholeExtent="{extent}"{more}><Piece Extent="{extent}">')
    fields(xml, POINTS, len(QUADS))
    if kind == "StructuredGrid":
        xml.add("<Points>")
        xml.array("Points", "d", [float(v) for v in flat(POINTS)], 3)
        xml.add("</Points>")
    if kind == "RectilinearGrid":
        xml.add("<Coordinates>")
        for name, count in (("x", SIDE), ("y", SIDE), ("z", 1)):
            xml.array(name, "d", [float(i) for i in range(count)])
        xml.add("</Coordinates>")
    xml.add(f"</Piece></{kind}>")
    return xml.content()


def pvtu(source):
    return (f"""<?xml version="1.0"?>
<VTKFile type="PUnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<PUnstructuredGrid GhostLevel="0"><PPointData><PDataArray type="Float64" Name="height"/>
<PDataArray type="Float32" Name="wind" NumberOfComponents="2"/></PPointData>
<PCellData><PDataArray type="Int32" Name="rank"/></PCellData>
<PPoints><PDataArray type="Float64" Name="Points" NumberOfComponents="3"/></PPoints>
<Piece Source="{source}"/></PUnstructuredGrid></VTKFile>
""").encode()


class Legacy:
    """A legacy VTK file, ascii or binary."""
    NAMES = {"d": "double", "i": "int", "q": "vtktypeint64"}

    def __init__(self, kind, binary, version):
        self.binary = binary
        self.version = version
        self.content = (f"# vtk DataFile Version {version}\nmesh\n{'BINARY' if binary else 'ASCII'}\n"
                        f"DATASET {kind}\n").encode()

    def add(self, text):
        self.content += f"{text}\n".encode()

    def values(self, code, values):
        self.content += pack(code, values, ">") + b"\n" if self.binary else f"{' '.join(map(str, values))}\n".encode()

    def cells(self, key, cells):
        connectivity = flat(cells)
        if self.version == "4.2":
            self.add(f"{key} {len(cells)} {len(connectivity) + len(cells)}")
            self.values("i", [v for ids in cells for v in (len(ids), *ids)])
            return
        self.add(f"{key} {len(cells) + 1} {len(connectivity)}")
        offsets = [0] + Mesh(POINTS, [(0, ids) for ids in cells]).offsets
        for name, values in (("OFFSETS", offsets), ("CONNECTIVITY", connectivity)):
            self.add(f"{name} vtktypeint64")
            self.values("q", values)

    def data(self, points, cells):
        self.add(f"POINT_DATA {len(points)}\nSCALARS height double 1\nLOOKUP_TABLE default")
        self.values("d", [p[0] - 2 * p[1] for p in points])
        self.add(f"FIELD FieldData 1\nwind 2 {len(points)} double")
        self.values("d", [float(i) for i in range(2 * len(points))])
        self.add(f"CELL_DATA {cells}\nSCALARS rank int 1\nLOOKUP_TABLE default")
        self.values("i", list(range(cells)))
        return self.content

    def coordinates(self, points):
        self.add(f"POINTS {len(points)} double")
        self.values("d", [float(v) for v in flat(points)])


def legacy_grid(mesh, binary, version):
    file = Legacy("UNSTRUCTURED_GRID", binary, version)
    file.coordinates(mesh.points)
    if mesh.faces:
        stream = (len(mesh.faces), *[v for face in mesh.faces for v in (len(face), *face)])
        file.cells("CELLS", [stream])
    else:
        file.cells("CELLS", [ids for _, ids in mesh.cells])
    file.add(f"CELL_TYPES {len(mesh.cells)}")
    file.values("i", [kind for kind, _ in mesh.cells])
    return file.data(mesh.points, len(mesh.cells))


def legacy_surface(binary, version):
    file = Legacy("POLYDATA", binary, version)
    file.coordinates(POINTS)
    file.cells("VERTICES", [(0,)])
    file.cells("LINES", [(0, 1, 2)])
    file.cells("POLYGONS", TRIANGLES)
    file.cells("TRIANGLE_STRIPS", [(0, 1, 4, 5)])
    return file.data(POINTS, len(TRIANGLES) + 3)


def legacy_structured(kind, binary):
    file = Legacy(kind, binary, "4.2")
    file.add(f"DIMENSIONS {SIDE} {SIDE} 1")
    if kind == "STRUCTURED_GRID":
        file.coordinates(POINTS)
    elif kind == "RECTILINEAR_GRID":
        for axis, count in (("X", SIDE), ("Y", SIDE), ("Z", 1)):
            file.add(f"{axis}_COORDINATES {count} double")
            file.values("d", [float(i) for i in range(count)])
    else:
        file.add("ORIGIN 0 0 0\nSPACING 1 1 1")
    return file.data(POINTS, len(QUADS))


def stl():
    facets = [[POINTS[i] for i in t] for t in TRIANGLES]
    return b" " * 80 + struct.pack("<I", len(facets)) + b"".join(
        struct.pack("<12fH", 0, 0, 1, *flat(corners), 0) for corners in facets)


def ply():
    head = (f"ply\nformat ascii 1.0\nelement vertex {len(POINTS)}\nproperty float x\nproperty float y\nproperty float z\n"
            f"element face {len(TRIANGLES)}\nproperty list uchar int vertex_indices\nend_header\n")
    return (head + "".join(f"{x} {y} {z}\n" for x, y, z in POINTS) +
            "".join("3 %d %d %d\n" % t for t in TRIANGLES)).encode()


def obj():
    return ("".join("v %g %g %g\n" % p for p in POINTS) +
            "".join("f %d %d %d\n" % (a + 1, b + 1, c + 1) for a, b, c in TRIANGLES)).encode()


def adcirc():
    return (f"mesh\n{len(TRIANGLES)} {len(POINTS)}\n" +
            "".join(f"{i + 1} {x} {y} {z}\n" for i, (x, y, z) in enumerate(POINTS)) +
            "".join(f"{i + 1} 3 {a + 1} {b + 1} {c + 1}\n" for i, (a, b, c) in enumerate(TRIANGLES)) + "0\n0\n0\n0\n"
            ).encode()


def selafin():
    """Output of TELEMAC: two steps of a variable, in records of Fortran."""
    def record(data):
        return struct.pack(">I", len(data)) + data + struct.pack(">I", len(data))

    count = len(POINTS)
    file = record(b"title".ljust(72) + b"SERAFIN ") + record(pack("i", (1, 0), ">")) + record(b"BOTTOM".ljust(32))
    file += record(pack("i", (1, 0, 0, 0, 0, 0, 0, 0, 0, 0), ">"))
    file += record(pack("i", (len(TRIANGLES), count, 3, 1), ">")) + record(pack("i", [i + 1 for i in flat(TRIANGLES)], ">"))
    file += record(pack("i", range(1, count + 1), ">"))
    file += b"".join(record(pack("f", [p[axis] for p in POINTS], ">")) for axis in (0, 1))
    for time in (0.0, 60.0):
        file += record(pack("f", [time], ">")) + record(pack("f", [p[2] + time for p in POINTS], ">"))
    return file


def netcdf():
    """Output of ADCIRC in NetCDF's classic format: the mesh and a variable at the nodes."""
    def text(value):
        return struct.pack(">I", len(value)) + value.encode().ljust((len(value) + 3) // 4 * 4, b"\0")

    integer, double = 4, 6
    variables = [("x", [0], double, pack("d", [p[0] for p in POINTS], ">")),
                 ("y", [0], double, pack("d", [p[1] for p in POINTS], ">")),
                 ("element", [1, 2], integer, pack("i", [i + 1 for i in flat(TRIANGLES)], ">")),
                 ("depth", [0], double, pack("d", [p[2] for p in POINTS], ">"))]

    def header(begin):
        data = b"CDF\x01" + pack("I", (0, 10, 3), ">")
        for name, size in (("node", len(POINTS)), ("nele", len(TRIANGLES)), ("nvertex", 3)):
            data += text(name) + struct.pack(">I", size)
        data += pack("I", (0, 0, 11, len(variables)), ">")
        for name, dimensions, kind, values in variables:
            data += text(name) + pack("I", [len(dimensions), *dimensions, 0, 0, kind, len(values), begin], ">")
            begin += len(values)
        return data

    return header(len(header(0))) + b"".join(values for _, _, _, values in variables)


def sms():
    return ("MESH2D\n" + "".join(f"E3T {i + 1} {a + 1} {b + 1} {c + 1} 1\n" for i, (a, b, c) in enumerate(TRIANGLES)) +
            "".join(f"ND {i + 1} {x} {y} {z}\n" for i, (x, y, z) in enumerate(POINTS))).encode()


def gmsh():
    """A mesh of Gmsh, version 4.1."""
    return (f"$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 1 0\n1 0 0 0 9 9 0 1 4 0\n$EndEntities\n$Nodes\n"
            f"1 {len(POINTS)} 1 {len(POINTS)}\n2 1 0 {len(POINTS)}\n" +
            "".join(f"{i + 1}\n" for i in range(len(POINTS))) + "".join(f"{x} {y} {z}\n" for x, y, z in POINTS) +
            f"$EndNodes\n$Elements\n1 {len(TRIANGLES)} 1 {len(TRIANGLES)}\n2 1 2 {len(TRIANGLES)}\n" +
            "".join(f"{i + 1} {a + 1} {b + 1} {c + 1}\n" for i, (a, b, c) in enumerate(TRIANGLES)) +
            "$EndElements\n").encode()


def nodes_of_triangle():
    return (f"{len(POINTS)} 2 1 0\n" +
            "".join(f"{i + 1} {x} {y} {z}\n" for i, (x, y, z) in enumerate(POINTS))).encode()


def table(separator, header):
    rows = [header] if header else []
    return "\n".join(rows + [separator.join(map(str, p)) for p in POINTS] + [""]).encode()


def flat_folder():
    """The contents of the files of a flat mesh, by relative path."""
    return {
        "points.npy": npy("d", (len(POINTS), 3), [float(v) for v in flat(POINTS)]),
        "cells.npy": npy("q", (len(TRIANGLES), 3), flat(TRIANGLES)),
        "point_data/height.npy": npy("d", (len(POINTS),), [p[0] for p in POINTS]),
        "cell_data/rank.npy": npy("i", (len(TRIANGLES),), list(range(len(TRIANGLES)))),
    }


def meshes():
    """The contents of files with points and cells, by name."""
    files = {"ascii.vtp": vtp("ascii"), "raw.vtp": vtp("raw"), "points.ply": ply(), "points.stl": stl(), "points.obj": obj(),
             "polyhedral.vtu": vtu(POLYHEDRAL, "ascii"), "polyhedral.vtk": legacy_grid(POLYHEDRAL, False, "4.2"),
             "solids.vtu": vtu(SOLIDS, "ascii"), "solids.vtk": legacy_grid(SOLIDS, True, "4.2"), "fort.14": adcirc(),
             "hgrid.gr3": adcirc(), "mesh.2dm": sms(), "mesh.msh": gmsh(), "mesh.slf": selafin(), "mesh.nc": netcdf(),
             "points.node": nodes_of_triangle()}
    for mode in ("ascii", "base64", "zlib", "raw", "encoded"):
        files[f"{mode}.vtu"] = vtu(SURFACE, mode)
        files[f"volume-{mode}.vtu"] = vtu(VOLUME, mode)
    files["mixed.vtu"] = vtu(MIXED, "base64")
    for version in ("4.2", "5.1"):
        for binary in (False, True):
            name = f"{version}-{'binary' if binary else 'ascii'}"
            files[f"surface-{name}.vtk"] = legacy_surface(binary, version)
            files[f"mixed-{name}.vtk"] = legacy_grid(MIXED, binary, version)
            files[f"volume-{name}.vtk"] = legacy_grid(VOLUME, binary, version)
    for kind, extension in (("ImageData", "vti"), ("StructuredGrid", "vts"), ("RectilinearGrid", "vtr")):
        files[f"ascii.{extension}"] = structured(kind, "ascii")
        files[f"raw.{extension}"] = structured(kind, "raw")
    for kind in ("STRUCTURED_GRID", "RECTILINEAR_GRID", "STRUCTURED_POINTS"):
        files[f"{kind.lower()}.vtk"] = legacy_structured(kind, kind == "STRUCTURED_GRID")
    return files


def las(minor, form):
    """A LAS file of a version and point format, with the keys of a reference system before the points."""
    keys = struct.pack("<12H", 1, 1, 0, 2, 3072, 0, 1, 26910, 4096, 0, 1, 5703)
    record = struct.pack("<H16sHH32s", 0, b"LASF_Projection", 34735, len(keys), b"") + keys
    size = 375 if minor == 4 else 227
    length = {1: 28, 3: 34, 7: 36}[form]
    header = bytearray(size)
    header[:4] = b"LASF"
    struct.pack_into("<BB", header, 24, 1, minor)
    struct.pack_into("<HIIBHI", header, 94, size, size + len(record), 1, form, length, 0 if form > 5 else len(POINTS))
    struct.pack_into("<6d", header, 131, 0.01, 0.01, 0.01, 0, 0, 0)
    if minor == 4:
        struct.pack_into("<Q", header, 247, len(POINTS))
    body = b"".join(struct.pack("<3iHB", *(round(100 * c) for c in p), 9, 17 if form > 5 else 9).ljust(length, b"\2")
                    for p in POINTS)
    return bytes(header) + record + body


def points():
    """The contents of files with points only, by name."""
    return {"old.las": las(2, 3), "plain.las": las(1, 1), "new.las": las(4, 7), "points.npy": npy("d", (len(POINTS), 2), flat(p[:2] for p in POINTS)),
            "points.csv": table(",", "x,y,height"), "points.txt": table(" ", ""), "points.xyz": table(" ", "")}
