# SPDX-License-Identifier: BSD-3-Clause
"""Reads surfaces (.vtp) and images (.vti) as TIPP writes them, without VTK: appended, raw, uncompressed, little-endian
data in one piece. Nothing in a file is trusted: counts and offsets are compared with the file's size."""
from __future__ import annotations

import contextlib
import math
import os
from typing import Any, BinaryIO, Callable, Iterator, NoReturn

import numpy as np

from . import _arguments as check
from ._data import Image, Mesh

FORMATS = (".vtp", ".vti")
OTHERS = (".vtk", ".vtr", ".vts", ".vtm", ".ply", ".stl", ".obj", ".pvtp", ".pvtu", ".pvti", ".pvtr", ".pvts", ".vtkhdf")
_KINDS = {".vtp": "PolyData", ".vti": "ImageData", ".vtu": "UnstructuredGrid"}
_LONGEST_HEAD = 64 << 20
_LARGEST = 2**31 - 1
_TYPES = {f"{name}{8 * size}": np.dtype(f"<{kind}{size}") for name, kind, sizes in (
    ("Int", "i", (1, 2, 4, 8)), ("UInt", "u", (1, 2, 4, 8)), ("Float", "f", (4, 8))) for size in sizes}


def extension_of(path: str) -> str:
    return os.path.splitext(path)[1].lower()


def read(path: str, options: dict[str, Any]) -> Mesh | Image:
    """Returns the mesh or image in a file of FORMATS, with the arrays that the options name."""
    kind = extension_of(path)
    if kind not in FORMATS:
        _refuse(path, f"is a {kind} file, which only VTK reads")
    for name, default in (("bounds", None), ("time", None), ("borrowed", False), ("merge", True)):
        if options[name] != default:
            raise ValueError(f"{name} needs a mesh in pieces or a flat one, but {path} is neither; leave it out.")
    with _opened(path) as content:
        data = _surface(content) if kind == ".vtp" else _image(content)
    for wanted, groups, what in ((options["point_arrays"], (data.point_data,), "point"),
                                 (options["cell_arrays"], (data.cell_data, getattr(data, "line_data", {})), "cell")):
        check.require_arrays(wanted, [name for group in groups for name in group], what)
        for group in groups:
            for name in [name for name in group if wanted is not None and name not in wanted]:
                del group[name]
    return data


def require_raw(path: str) -> None:
    """Raises RuntimeError for a .vtu file that is compressed, encoded, or otherwise not as TIPP writes them."""
    with _opened(path):
        pass


@contextlib.contextmanager
def _opened(path: str) -> Iterator[_File]:
    try:
        with open(path, "rb") as file:
            yield _File(path, file, _KINDS[extension_of(path)])
    except OSError as error:
        raise RuntimeError(f"{path} cannot be opened: {error.strerror}.") from None


def _refuse(path: str, what: str) -> NoReturn:
    raise RuntimeError(f"{path} {what}; with PyVista, pyvista.read({path!r}) reads it.")


class _File:
    """An open file: the elements of its XML part, and its arrays."""

    def __init__(self, path: str, file: BinaryIO, kind: str) -> None:
        self.path = path
        self._file = file
        self._size = os.fstat(file.fileno()).st_size
        head = file.read(_LONGEST_HEAD)
        begin = head.find(b"<AppendedData")
        end = head.find(b">", begin)
        self._begin = head.find(b"_", end) + 1  # of the data
        has_data = begin >= 0 and end >= 0 and self._begin > 0 and not head[end + 1:self._begin - 1].strip()
        self._elements = self._parse(head[:end + 1] + b"</AppendedData></VTKFile>" if has_data else head,
                                     has_data or len(head) < _LONGEST_HEAD)
        root = self._attributes("VTKFile")
        if root.get("type") != kind:
            self.fail(f"is not a VTK XML file of type {kind}")
        if root.get("compressor"):
            self.refuse("is compressed")
        if not has_data:
            self.refuse("has its arrays as text or encoded, not as appended raw data")
        if self._attributes("VTKFile", "AppendedData").get("encoding") != "raw":
            self.refuse("has encoded data")
        if root.get("byte_order") != "LittleEndian":
            self.refuse("is not little-endian")
        sizes = {"UInt32": 4, "UInt64": 8}
        if root.get("header_type", "UInt32") not in sizes:
            self.fail("has a header_type that is neither UInt32 nor UInt64")
        self._count_size = sizes[root.get("header_type", "UInt32")]
        self._in_piece = ("VTKFile", kind, "Piece")
        self.whole = self._attributes("VTKFile", kind)
        self.piece = self._attributes(*self._in_piece)

    def fail(self, what: str) -> NoReturn:
        raise RuntimeError(f"{self.path} {what}; copy or write it again.")

    def refuse(self, what: str) -> NoReturn:
        _refuse(self.path, what)

    def _parse(self, text: bytes, is_whole: bool) -> list[tuple[tuple[str, ...], dict[str, str]]]:
        """Returns the path of names and the attributes of each element."""
        from xml.parsers import expat  # slow to load

        elements: list[tuple[tuple[str, ...], dict[str, str]]] = []
        names: list[str] = []

        def begin(name: str, attributes: dict[str, str]) -> None:
            names.append(name)
            elements.append((tuple(names), attributes))

        def refuse_types(*_: Any) -> NoReturn:  # entities could make the text endlessly long
            self.fail("has a document type, which VTK never writes")

        parser = expat.ParserCreate()
        parser.StartElementHandler = begin
        parser.EndElementHandler = lambda _name: names.pop()
        parser.StartDoctypeDeclHandler = refuse_types
        try:
            parser.Parse(text, is_whole)
        except expat.ExpatError as error:
            self.fail(f"is not well-formed XML in line {error.lineno}")
        return elements

    def _attributes(self, *names: str) -> dict[str, str]:
        """Returns the attributes of the only element with this path of names."""
        found = [attributes for path, attributes in self._elements if path == names]
        if len(found) > 1:
            self.refuse(f"has several elements {names[-1]}")
        if not found:
            self.fail(f"has no element {names[-1]}")
        return found[0]

    def numbers(self, element: dict[str, str], name: str, count: int, kind: Callable[[str], Any]) -> list[Any]:
        """Returns the numbers of an attribute; whole ones have 32 bits, as VTK's image extents."""
        try:
            values = [kind(word) for word in element.get(name, "").split()]
        except ValueError:
            values = []
        is_good = all(math.isfinite(v) if kind is float else abs(v) <= _LARGEST for v in values)
        if len(values) != count or not is_good:
            self.fail(f"has no {'number' if count == 1 else f'{count} numbers'} as {name}")
        return values

    def count(self, name: str) -> int:
        """Returns a count of the piece; 0 if it is missing."""
        number = self.numbers(self.piece, name, 1, int)[0] if name in self.piece else 0
        if number < 0:
            self.fail(f"has {number} as {name}")
        return number

    def arrays(self, section: str, due: int | None) -> dict[str, np.ndarray]:
        """Returns the numeric arrays in a section of the piece, after checking that they have `due` tuples."""
        found = dict(self._arrays_in(section))
        for name, values in found.items():
            if due is not None and len(values) != due:
                self.fail(f"has {len(values)} tuples in the array '{name}' where {due} are due")
        return found

    def _arrays_in(self, section: str) -> Iterator[tuple[str, np.ndarray]]:
        for path, element in self._elements:
            if path == (*self._in_piece, section, "DataArray"):
                yield element.get("Name", ""), self._array(element)

    def _array(self, element: dict[str, str]) -> np.ndarray:
        name = element.get("Name", "")
        if element.get("format") != "appended":
            self.refuse(f"has the array '{name}' as text or encoded, not as appended raw data")
        dtype = _TYPES.get(element.get("type", ""))
        if dtype is None:
            self.fail(f"has the array '{name}' of an unknown type")
        columns = self.numbers(element, "NumberOfComponents", 1, int)[0] if "NumberOfComponents" in element else 1
        room = self._size - self._begin - self._count_size
        try:
            offset = int(element.get("offset", ""))
        except ValueError:
            offset = -1
        if columns < 1 or not 0 <= offset <= room:
            self.fail(f"has the array '{name}' with an offset or a number of components that it cannot hold")
        self._file.seek(self._begin + offset)
        size = int.from_bytes(self._file.read(self._count_size), "little")
        if size > room - offset or size % (columns * dtype.itemsize):
            self.fail(f"has the array '{name}' with {size} bytes, more than are left or no whole number of tuples")
        values = np.fromfile(self._file, dtype, size // dtype.itemsize).astype(dtype.newbyteorder("="), copy=False)
        return values if columns == 1 else values.reshape(-1, columns)

    def cells(self, section: str, count: int, points: int) -> tuple[np.ndarray, np.ndarray]:
        """Returns the point ids of all cells of a section, and where each cell begins; and the end."""
        arrays = self.arrays(section, None)
        ids = arrays.get("connectivity", np.zeros(0, np.int32))
        ends = arrays.get("offsets", np.zeros(0, np.int32))
        if ids.ndim != 1 or ends.ndim != 1 or ids.dtype.kind != "i" or ends.dtype.kind != "i" or len(ends) != count:
            self.fail(f"has no list of ids and offsets for {count} {section}")
        starts = np.concatenate([np.zeros(1, np.int64), ends])
        if (starts[1:] < starts[:-1]).any() or starts[-1] != len(ids):  # differences could overflow
            self.fail(f"has offsets of {section} that do not fit their ids")
        if len(ids) and not 0 <= ids.min() <= ids.max() < points:
            self.fail(f"has {section} that refer to points from {ids.min()} to {ids.max()}, but there are {points} points")
        return ids, starts


def _surface(file: _File) -> Mesh:
    if file.count("NumberOfStrips"):
        file.refuse("has triangle strips")
    count = file.count("NumberOfPoints")
    counts = [file.count(f"NumberOf{name}") for name in ("Verts", "Lines", "Polys")]
    points = next(iter(file.arrays("Points", count).values()), np.zeros((0, 3)))
    if len(points) != count or points.shape[1:] != (3,) or points.dtype.kind != "f":
        file.fail("has points that are not three floating-point coordinates each")
    vertices, _ = file.cells("Verts", counts[0], count)
    line_ids, line_starts = file.cells("Lines", counts[1], count)
    ids, starts = file.cells("Polys", counts[2], count)
    if (np.diff(starts) != 3).any():
        file.refuse("has polygons that are not triangles")
    mesh = Mesh(points, ids.reshape(-1, 3), file.arrays("PointData", count))
    of_cells = file.arrays("CellData", sum(counts))
    mesh.cell_data = {name: values[counts[0] + counts[1]:] for name, values in of_cells.items()}
    if counts[0]:
        mesh.vertices = vertices.reshape(-1, 1)
    if counts[1]:
        cell = np.repeat(np.arange(counts[1]), np.diff(line_starts))
        firsts = np.flatnonzero(cell[:-1] == cell[1:])  # a line of many points becomes its edges
        mesh.lines = np.column_stack([line_ids[firsts], line_ids[firsts + 1]])
        mesh.line_data = {name: values[counts[0]:][cell[firsts]] for name, values in of_cells.items()}
    return mesh


def _image(file: _File) -> Image:
    extent = file.numbers(file.whole, "WholeExtent", 6, int)
    if file.numbers(file.piece, "Extent", 6, int) != extent:
        file.refuse("has a piece of an image")
    if "Direction" in file.whole and file.numbers(file.whole, "Direction", 9, float) != [1, 0, 0, 0, 1, 0, 0, 0, 1]:
        file.refuse("has an image whose axes are turned")
    x, y, z = (high - low + 1 for low, high in zip(extent[::2], extent[1::2]))
    if min(x, y, z) < 1 or max(x, y, z) > _LARGEST:
        file.fail("has an extent that is empty or too large")
    spacing = file.numbers(file.whole, "Spacing", 3, float)
    origin = [at + low * step
              for at, low, step in zip(file.numbers(file.whole, "Origin", 3, float), extent[::2], spacing)]
    cells = max(x - 1, 1) * max(y - 1, 1) * max(z - 1, 1)
    return Image((origin[0], origin[1], origin[2]), (spacing[0], spacing[1], spacing[2]), (x, y, z),
                 file.arrays("PointData", x * y * z), file.arrays("CellData", cells))
