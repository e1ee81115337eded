# SPDX-License-Identifier: BSD-3-Clause
# The extension module of the wheel. Arrays are in C order; options are those that the functions of the package check.
from typing import Any, Callable, Sequence, overload

from numpy.typing import NDArray

_Array = NDArray[Any]
_Progress = Callable[[float], Any]
_Options = dict[str, Any]
_Arrays = dict[str, _Array]
# (n, 2) corners, the first corner of each ring and the end, each ring's zone, and whether it is a hole.
_Rings = tuple[_Array, _Array, _Array, _Array]
_Lattice = tuple[Sequence[float], Sequence[float], tuple[int, int, int]]  # origin, spacing, number of samples

def triangulate(
    points: _Array,
    pairs: _Array | None,
    cells: _Array | None,
    polygon_begin: int,
    splits_crossings: bool,
    marks_edges: bool,
    tolerance: float,
    max_edge: float,
    columns: int,
    rows: int,
    in_stages: bool,
    threads: int,
    neighbors: bool,
    details: bool,
    progress: _Progress | None,
    /,
) -> dict[str, Any]: ...
def mesh(
    points: _Array,
    pairs: _Array,
    polygon_begin: int,
    options: _Options,
    lengths: _Array | None,
    surface: tuple[_Array, _Array, _Array] | None,  # points, (m, 3) int32 corners, lengths at the points
    values: bool,
    progress: _Progress | None,
    /,
) -> dict[str, Any]: ...
def blend(values: _Array, ids: _Array, weights: _Array, /) -> _Array: ...
def match_positions(points: _Array, corners: _Array, /) -> tuple[_Array, _Array]: ...
def interpolate(values: _Array, crossings: _Array, /) -> _Array: ...
def alpha_shape(
    points: _Array, cells: _Array, alpha: float, covered: _Array, /
) -> tuple[_Array, _Array, _Array, _Array]: ...
def tetrahedralize(
    points: _Array, tolerance: float, partitions: int, threads: int, neighbors: bool, progress: _Progress | None, /
) -> dict[str, Any]: ...
def neighbors(cells: _Array, /) -> _Array: ...

class Locator:
    def __init__(self, points: _Array, cells: _Array, neighbors: _Array, /) -> None: ...
    def find(self, queries: _Array, threads: int, /) -> _Array: ...
    def interpolate(self, queries: _Array, values: _Array, fill_value: float, threads: int, /) -> _Array: ...

def dem(
    points: Sequence[str] | tuple[_Array, _Arrays], options: _Options, progress: _Progress | None, /
) -> tuple[list[_Array], tuple[float, float, int, int], str, int]: ...
def raster_grid(bounds: Sequence[float], resolution: float, is_aligned: bool, /) -> tuple[float, float, int, int]: ...
def resample(
    points: _Array,
    cells: _Array,
    hidden: _Array | None,
    point_data: _Arrays,
    cell_data: _Arrays,
    bounds: Sequence[float],
    point_bounds: Sequence[float] | None,
    dimensions: Sequence[int],
    spacing: Sequence[float],
    null_value: float,
    device: str,
    threads: int,
    progress: _Progress | None,
    /,
) -> tuple[_Lattice, list[_Array], _Array, list[str]]: ...
def pixel_means(
    points: _Array,
    cells: _Array,
    hidden: _Array | None,
    point_data: _Arrays,  # float64
    cell_data: _Arrays,
    bounds: Sequence[float],
    point_bounds: Sequence[float] | None,
    dimensions: Sequence[int],
    spacing: Sequence[float],
    null_value: float,
    threads: int,
    progress: _Progress | None,
    /,
) -> tuple[_Lattice, list[_Array], _Array]: ...  # the means of the arrays, and the covered shares
def remap(
    points: _Array,
    cells: _Array,
    hidden: _Array | None,
    point_data: _Arrays,  # float64
    cell_data: _Arrays,
    target_points: _Array,
    target_cells: _Array,
    null_value: float,
    threads: int,
    progress: _Progress | None,
    /,
) -> tuple[list[_Array], _Array]: ...
def volume(
    points: _Array,
    cells: _Array,
    hidden: _Array | None,
    other_points: _Array,
    other_cells: _Array,
    other_hidden: _Array | None,
    bounds: Sequence[float] | None,
    threads: int,
    progress: _Progress | None,
    /,
) -> tuple[list[float], list[int]]: ...  # cut, fill and areas; how many triangles are covered twice
def require_sensible(bounds: Sequence[float], point_bounds: Sequence[float], /) -> None: ...
def bounds_in_words(bounds: Sequence[float], /) -> str: ...
def range_lattice(bounds: Sequence[float], dimensions: Sequence[int], spacing: Sequence[float], /) -> _Lattice: ...
def read_points(
    paths: Sequence[str], wanted: Sequence[str] | None, classes: Sequence[int], returns: int, keep: Sequence[str], /
) -> tuple[_Array, _Arrays, str]: ...
def column_names(paths: Sequence[str], /) -> list[str]: ...
def find_coordinates(names: Sequence[str], /) -> list[int]: ...
def triangulate_files(
    paths: Sequence[str], output: str, options: _Options, progress: _Progress | None, /
) -> tuple[dict[str, int], list[str]]: ...
def tetrahedralize_files(
    paths: Sequence[str], output: str, options: _Options, progress: _Progress | None, /
) -> tuple[dict[str, int], list[str]]: ...
def run_tool(words: list[bytes], /) -> int: ...
def array_names(path: str, options: _Options, /) -> tuple[list[str], list[str]]: ...
def times(path: str, options: _Options, /) -> tuple[list[float], str, str]: ...
def resample_series(path: str, options: _Options, progress: _Progress | None, /) -> dict[str, Any]: ...
def read(
    path: str, bounds: Sequence[float] | None, options: _Options, progress: _Progress | None, /
) -> list[dict[str, Any]]: ...
def partition_file(path: str, output: str, options: _Options, progress: _Progress | None, /) -> None: ...
def partition_arrays(
    points: _Array,
    cells: _Array,
    point_data: _Arrays,
    cell_data: _Arrays,
    output: str,
    options: _Options,
    progress: _Progress | None,
    /,
) -> None: ...

class Query:
    @overload
    def __init__(self, path: str, memory: int, step: int, threads: int, /) -> None: ...
    @overload
    def __init__(
        self, points: _Array, cells: _Array, point_data: _Arrays, cell_data: _Arrays, ids: _Array | None, threads: int, /
    ) -> None: ...
    def names(self) -> list[str]: ...
    def locate(self, points: _Array, /) -> tuple[_Array, _Array]: ...
    def sample(self, points: _Array, names: Sequence[str], /) -> tuple[_Array, _Arrays]: ...
    def neighbors(self, cells: _Array, /) -> _Array: ...
    def star(self, points: _Array, /) -> tuple[_Array, _Array]: ...
    def ring_of_points(self, points: _Array, k: int, /) -> tuple[_Array, _Array]: ...
    def ring_of_cells(self, cells: _Array, k: int, /) -> tuple[_Array, _Array]: ...
    def boundary(self) -> tuple[_Array, _Array]: ...
    def contours(self, array: str, component: int, levels: _Array, /) -> tuple[_Array, _Array, _Array]: ...
    def profile(
        self, polyline: _Array, spacing: float, names: Sequence[str], /
    ) -> tuple[_Array, _Array, _Array, _Arrays]: ...
    def closest(self, points: _Array, /) -> tuple[_Array, _Array, _Array]: ...
    def cells_in(self, box: Sequence[float], rings: _Rings | None, whole: bool, /) -> _Array: ...
    def points_in(self, box: Sequence[float], rings: _Rings | None, /) -> _Array: ...
    def zones(self, rings: _Rings, count: int, array: str, component: int, level: float, /) -> tuple[_Array, ...]: ...
    def descend(self, points: _Array, array: str, component: int, /) -> tuple[_Array, _Array, _Array, _Array]: ...
    def components(self) -> tuple[_Array, _Array]: ...
