# SPDX-License-Identifier: BSD-3-Clause
"""Meshes and images made of arrays, which functions return whatever is installed."""
from __future__ import annotations

import importlib
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from ._arguments import data_object, text
from ._arrays import grid_position
from ._show import arrays_text, as_html, as_text, box_text, Rows

if TYPE_CHECKING:
    from numpy.typing import NDArray

CONSTRAINT_IDS = "ConstraintId"  # the cell array of lines that are constraints

_MESHIO_KINDS = {1: "vertex", 2: "line", 3: "triangle", 4: "tetra"}  # by the number of corners


def imported(module: str, use: str) -> Any:
    """Returns a module that the package does not need. Raises ModuleNotFoundError that says what needs it."""
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        if (error.name or "").split(".")[0] != module.split(".")[0]:
            raise
        raise ModuleNotFoundError(f"{use} needs {module}, which is not installed; install it with pip.",
                                  name=module) from None


class Data:
    """The common base of Mesh and Image."""

    point_data: dict[str, np.ndarray]
    cell_data: dict[str, np.ndarray]

    def __eq__(self, other: object) -> bool:
        """Returns whether all values and names are equal; NaN equals NaN."""
        if type(other) is not type(self):
            return NotImplemented
        return all(_are_equal(getattr(self, name), getattr(other, name)) for name in self.__dataclass_fields__)

    __hash__ = None  # type: ignore[assignment]

    def array(self, name: str) -> np.ndarray:
        """Returns the array with this name of the points, else of the cells, else of a mesh's lines."""
        groups = [self.point_data, self.cell_data, getattr(self, "line_data", {})]
        for arrays in groups:
            if name in arrays:
                return arrays[name]
        raise KeyError(f"there is no array '{name}'; there are {[known for arrays in groups for known in arrays]}.")

    def __getitem__(self, name: str) -> np.ndarray:
        """The same as array(name), as in PyVista."""
        return self.array(text(name, "name"))

    @property
    def bounds(self) -> tuple[float, float, float, float, float, float]:
        """(xmin, xmax, ymin, ymax, zmin, zmax) of the finite points, as in VTK and PyVista."""
        raise NotImplementedError

    def to_vtk(self) -> Any:
        """Converts to a data set of VTK, which shares the arrays' memory. Raises ModuleNotFoundError without VTK."""
        raise NotImplementedError

    def to_pyvista(self) -> Any:
        """Converts to a data set of PyVista, which shares the arrays' memory. Raises ModuleNotFoundError without
        PyVista."""
        pyvista = imported("pyvista", f"{type(self).__name__}.to_pyvista()")
        return pyvista.wrap(self.to_vtk())

    def plot(self, **options: Any) -> Any:
        """Shows a picture with PyVista; the options are those of pyvista.plot(), such as scalars="height". Raises
        ModuleNotFoundError without PyVista."""
        return self.to_pyvista().plot(**options)

    def _rows(self) -> Rows:
        raise NotImplementedError

    def __repr__(self) -> str:
        return as_text(f"tipp.{type(self).__name__}", self._rows())

    def _repr_html_(self) -> str:
        return as_html(f"tipp.{type(self).__name__}", self._rows())


def _are_equal(a: Any, b: Any) -> bool:
    if isinstance(a, dict):
        return a.keys() == b.keys() and all(_are_equal(a[name], b[name]) for name in a)
    if a is None or b is None:
        return a is b
    x, y = np.asarray(a), np.asarray(b)
    return np.array_equal(x, y, equal_nan=x.dtype.kind == "f" and y.dtype.kind == "f")


@dataclass(eq=False, repr=False)
class Mesh(Data):
    """A mesh of triangles or tetrahedra.

    Functions return it for arrays and files; it shares its memory with the data sets that to_vtk() and to_pyvista()
    return.

    Attributes
    ----------
    points : (n, 3)
        Coordinates.
    cells : (m, 3) or (m, 4)
        Point ids of each triangle or tetrahedron.
    point_data, cell_data : dict
        Arrays by name, with a value or a row for each point or cell.
    lines, vertices : (k, 2), (k, 1) or None
        The edges and the points in no triangle of delaunay_2d(alpha=...) and delaunay_3d(alpha=...). With marks="lines",
        `lines` are the edges on constraints.
    line_data : dict
        Arrays of `lines`: with marks="lines", "ConstraintId" is the constraint of each.
    triangles : (k, 3) or None
        The triangles in no tetrahedron of delaunay_3d(alpha=...).

    Examples
    --------
    >>> mesh = tipp.delaunay_2d(points, point_data={"height": height})
    >>> mesh.points.shape, mesh.cells.shape
    ((100000, 3), (199964, 3))
    """

    points: NDArray[Any]
    cells: NDArray[Any]
    point_data: dict[str, NDArray[Any]] = field(default_factory=dict)
    cell_data: dict[str, NDArray[Any]] = field(default_factory=dict)
    lines: NDArray[Any] | None = None
    vertices: NDArray[Any] | None = None
    line_data: dict[str, NDArray[Any]] = field(default_factory=dict)
    triangles: NDArray[Any] | None = None

    @property
    def bounds(self) -> tuple[float, float, float, float, float, float]:
        finite = self.points[np.isfinite(self.points).all(axis=1)]
        if len(finite) == 0:
            return (np.nan,) * 6
        low, high = finite.min(axis=0).tolist(), finite.max(axis=0).tolist()
        flat = [0.0] * (3 - len(low))  # a mesh that a user made may have two coordinates
        return tuple(bound for pair in zip(low + flat, high + flat) for bound in pair)

    def to_vtk(self) -> Any:
        """Converts to a vtkPolyData of triangles or a vtkUnstructuredGrid of tetrahedra, which shares the arrays' memory.
        Raises ModuleNotFoundError without VTK."""
        require_vtk("Mesh.to_vtk()")
        from ._vtk import grid_of, surface_of

        return grid_of(self) if np.shape(self.cells)[1] == 4 else surface_of(self, None)

    def to_meshio(self) -> Any:
        """Converts to a meshio.Mesh, for example to write a file of another format. Lines and vertices are blocks of their
        own, with NaN, -1 or 0 in cell arrays that they do not have. Raises ModuleNotFoundError without meshio.

        Examples
        --------
        >>> tipp.delaunay_2d(points).to_meshio().write("mesh.ply")
        """
        meshio = imported("meshio", "Mesh.to_meshio()")
        blocks = self.blocks()
        arrays = {name: [block[name] for _, block in blocks] for name in blocks[0][1]}
        return meshio.Mesh(self.points, [(_MESHIO_KINDS[ids.shape[1]], ids) for ids, _ in blocks],
                           point_data=dict(self.point_data), cell_data=arrays)

    def count_thin(self) -> int:
        """Returns the number of cells besides `cells`, which have fewer dimensions."""
        return sum(len(ids) for ids in (self.triangles, self.lines, self.vertices) if ids is not None)

    def without_thin(self) -> Mesh:
        """Returns the mesh without its cells of fewer dimensions, in the same memory."""
        return Mesh(self.points, self.cells, self.point_data, self.cell_data)

    def blocks(self) -> list[tuple[np.ndarray, dict[str, np.ndarray]]]:
        """Returns the cells of each kind, in the order that VTK requires: vertices, lines, triangles and tetrahedra; and
        the cell arrays of each, with NaN, -1 or 0 where it has no value."""
        groups = [(self.vertices, {}), (self.lines, self.line_data), (self.triangles, {}), (self.cells, self.cell_data)]
        like = {**self.line_data, **self.cell_data}
        return [(ids, {name: data[name] if name in data else _missing(values, len(ids)) for name, values in like.items()})
                for ids, data in groups if ids is not None]

    def _rows(self) -> Rows:
        kind = "tetrahedra" if np.shape(self.cells)[-1] == 4 else "triangles"
        counts = [f"{len(self.cells)} {kind}"]
        counts += [f"{len(ids)} {name}" for name, ids in (("triangles", self.triangles), ("lines", self.lines),
                                                         ("vertices", self.vertices)) if ids is not None]
        return [("points", f"{len(self.points)}, {box_text(self.bounds)}"), ("cells", ", ".join(counts)),
                ("point_data", arrays_text(self.point_data)), ("cell_data", arrays_text({**self.cell_data, **self.line_data}))]


def _missing(like: np.ndarray, count: int) -> np.ndarray:
    value = {"f": np.nan, "i": -1}.get(like.dtype.kind, 0)
    return np.full((count, *like.shape[1:]), value, like.dtype)


@dataclass(eq=False, repr=False)
class Image(Data):
    """Samples at origin + index * spacing.

    Attributes
    ----------
    origin, spacing : (x, y, z)
        The position of the first sample, and the distances between samples.
    dimensions : (x, y, z)
        The number of samples along each axis.
    point_data, cell_data : dict
        Arrays by name, x fastest. array(name) returns one in the image's shape.

    Examples
    --------
    >>> tipp.resample(mesh, dimensions=(300, 200, 1)).array("height").shape
    (200, 300)
    """

    origin: tuple[float, float, float]
    spacing: tuple[float, float, float]
    dimensions: tuple[int, int, int]
    point_data: dict[str, NDArray[Any]] = field(default_factory=dict)
    cell_data: dict[str, NDArray[Any]] = field(default_factory=dict)

    def array(self, name: str) -> np.ndarray:
        """Returns an array in the image's shape, (z, y, x) without axes of one sample."""
        values = super().array(name)
        counts = self.dimensions if name in self.point_data else [max(n - 1, 1) for n in self.dimensions]
        shape = [n for n in reversed(counts) if n > 1] or [1]
        return values.reshape(*shape, *values.shape[1:])

    @property
    def bounds(self) -> tuple[float, float, float, float, float, float]:
        ends = [grid_position(self.origin[i], self.spacing[i], 2 * (self.dimensions[i] - 1)) for i in range(3)]
        return tuple(bound for pair in zip(self.origin, ends) for bound in pair)  # type: ignore[return-value]

    def to_vtk(self) -> Any:
        """Converts to a vtkImageData, which shares the arrays' memory. Raises ModuleNotFoundError without VTK."""
        require_vtk("Image.to_vtk()")
        from ._vtk import image_of

        return image_of(self)

    def to_xarray(self) -> Any:
        """Converts to an xarray.Dataset of the point arrays, along x and y, and z if there are several layers. Samples
        outside of all cells are not masked: see the variable vtkValidPointMask. Raises ModuleNotFoundError without
        xarray."""
        xarray = imported("xarray", "Image.to_xarray()")
        axes = [axis for axis in (2, 1, 0) if axis < 2 or self.dimensions[2] > 1]
        shape = [self.dimensions[axis] for axis in axes]
        coordinates = {"xyz"[axis]: [grid_position(self.origin[axis], self.spacing[axis], 2 * i)
                                     for i in range(self.dimensions[axis])] for axis in axes}
        names = ["xyz"[axis] for axis in axes]
        variables = {name: ([*names, *(f"{name}_component" for _ in values.shape[1:])],
                            values.reshape(*shape, *values.shape[1:])) for name, values in self.point_data.items()}
        return xarray.Dataset(variables, coordinates)

    def _rows(self) -> Rows:
        return [("dimensions", " x ".join(str(count) for count in self.dimensions)),
                ("bounds", box_text(self.bounds)),
                ("spacing", ", ".join(f"{step:.10g}" for step in self.spacing)),
                ("point_data", arrays_text(self.point_data))]


def require_vtk(use: str) -> None:
    """Raises ModuleNotFoundError without VTK."""
    from ._vtkmodules import root

    if root() is None:
        raise ModuleNotFoundError(f"{use} needs VTK, which is not installed; install vtk with pip.", name="vtkmodules")


def as_array(data: Any, name: str) -> np.ndarray:
    """Returns an array of a mesh's or an image's points or cells, in the memory of the mesh or image.

    Parameters
    ----------
    data
        A tipp.Mesh, a tipp.Image, or any data set of VTK or PyVista. For an image, the result has the image's shape,
        (z, y, x) without axes of one sample, followed by the components if there are several.
    name
        The array's name; point data is searched before cell data.

    Returns
    -------
    numpy.ndarray
        A view: it keeps the data alive, and writing to it writes to the data set.

    Raises
    ------
    TypeError
        If the data are of another type, or the name is no text.
    KeyError
        If there is no such array; the message lists those that there are.

    Examples
    --------
    >>> grid = tipp.as_array(tipp.resample(mesh, dimensions=(300, 200, 1)), "height")
    >>> grid.shape
    (200, 300)
    """
    text(name, "name")
    if isinstance(data, Data):
        return data.array(name)
    data_object(data, "data", ("vtkDataSet",), "a tipp.Mesh, a tipp.Image or a data set of VTK")
    from ._vtk import numpy_of

    of_points, of_cells = data.GetPointData(), data.GetCellData()
    array = of_points.GetArray(name) or of_cells.GetArray(name)
    if array is None:
        names = [d.GetArrayName(i) for d in (of_points, of_cells) for i in range(d.GetNumberOfArrays())]
        raise KeyError(f"there is no array '{name}'; there are {names}.")
    values = numpy_of(array)
    if not data.IsA("vtkImageData"):
        return values
    samples = _samples(data, bool(of_points.HasArray(name)))
    return values.reshape(*samples, *values.shape[1:])


def _samples(image: Any, of_points: bool) -> list[int]:
    counts = [n if of_points else max(n - 1, 1) for n in image.GetDimensions()]
    return [n for n in reversed(counts) if n > 1] or [1]


def as_mesh(mesh: Any) -> Any:
    """Returns a meshio.Mesh as a tipp.Mesh, other values as they are. Raises TypeError for cells that a Mesh cannot have."""
    kinds = {kind.__module__.split(".")[0] for kind in type(mesh).__mro__}
    if "meshio" not in kinds:
        return mesh
    corners = {name: count for count, name in _MESHIO_KINDS.items()}
    blocks: dict[str, list[int]] = {}
    for number, block in enumerate(mesh.cells):
        if block.type not in corners:
            raise TypeError(f"mesh has cells of the kind '{block.type}'; give triangles or tetrahedra.")
        blocks.setdefault(block.type, []).append(number)

    def joined(kind: str, lists: Any) -> np.ndarray:
        return np.concatenate([np.asarray(lists[number]) for number in blocks[kind]])

    ids = {kind: joined(kind, [block.data for block in mesh.cells]) for kind in blocks}
    kind = "tetra" if "tetra" in ids else "triangle"
    points = np.asarray(mesh.points)
    if points.ndim == 2 and points.shape[1] == 2:
        points = np.column_stack([points, np.zeros(len(points), points.dtype)])
    return Mesh(points, ids.get(kind, np.zeros((0, 3), np.int64)), {name: np.asarray(a) for name, a in mesh.point_data.items()},
                {name: joined(kind, lists) for name, lists in mesh.cell_data.items() if kind in blocks},
                ids.get("line"), ids.get("vertex"), {}, ids.get("triangle") if kind == "tetra" else None)
