# SPDX-License-Identifier: BSD-3-Clause
"""The arguments of the package's functions: checks, the properties of VTK classes with their values, and progress."""
from __future__ import annotations

import contextlib
import math
import numbers
import operator
import os
import re
import sys
from typing import Any, Callable, Iterable, Iterator, Mapping, Union

import numpy as np

_LARGEST_INT = (1 << 31) - 1  # C's int
_MOST_THREADS = 4096
_SHIFTS = {None: 0, "K": 10, "M": 20, "G": 30, "T": 40}


def number(value: Any, name: str, *, at_least: float = -math.inf, finite: bool = True) -> float:
    """Returns the value as a float. Without `finite` it may be infinite or NaN."""
    if type(value) is float and at_least <= value and -math.inf < value < math.inf:  # fast path for small calls
        return value
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, numbers.Real):
        raise TypeError(f"{name} is {shown(value)}; give a number.")
    try:
        result = float(value)
    except OverflowError:
        result = math.inf
    if finite and not math.isfinite(result):
        raise ValueError(f"{name} is {shown(value)}; give a finite number.")
    if result < at_least:
        raise ValueError(f"{name} is {shown(value)}; give {at_least:g} or more.")
    return result


def whole(value: Any, name: str, *, at_least: int = 0, at_most: int = _LARGEST_INT) -> int:
    """Returns the value as an integer. Floats are rejected."""
    try:
        if isinstance(value, (bool, np.bool_)):
            raise TypeError
        result = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} is {shown(value)}; give a whole number.") from None
    if not at_least <= result <= at_most:
        raise ValueError(f"{name} is {shown(value)}; give a whole number from {at_least} to {at_most}.")
    return result


def threads(value: Any) -> int:
    return whole(value, "threads", at_most=_MOST_THREADS)


def memory(value: Any, name: str) -> int:
    """Returns a number of bytes, from a number or a text such as '512M', '1 GB' or '2 GiB'. K, M, G and T are
    powers of 1024, in any case, with B or iB or without."""
    if not isinstance(value, str):
        return whole(value, name, at_least=1, at_most=(1 << 63) - 1)
    match = re.fullmatch(r"([0-9]+) *(?:([KMGT])(?:I?B)?|B)?", value.upper())
    size = int(match[1]) << _SHIFTS[match[2]] if match and len(value) < 30 else 0
    if not 0 < size < 1 << 63:
        raise ValueError(f"{name} is {shown(value)}; give a number of bytes, such as 536870912, '512M' or '2 GB'.")
    return size


def flag(value: Any, name: str) -> bool:
    if value is True or value is False:
        return value
    if not isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{name} is {shown(value)}; give True or False.")
    return bool(value)


def a_list(values: Any, name: str) -> list[Any]:
    if isinstance(values, (str, bytes, Mapping)) or not isinstance(values, Iterable):
        raise TypeError(f"{name} is {values!r}; give a list.")
    return list(values)


def several(value: Any, name: str, count: int, check: Any, **limits: Any) -> list[Any]:
    """Returns `count` values, each converted by `check`."""
    if isinstance(value, (str, bytes, Mapping, set, frozenset)) or not isinstance(value, Iterable):
        raise TypeError(f"{name} is {shown(value)}; give {count} numbers.")
    values = list(value)
    if len(values) != count:
        raise ValueError(f"{name} has {len(values)} values; give {count}.")
    return [check(v, f"{name}[{i}]", **limits) for i, v in enumerate(values)]


def names(value: Any, name: str) -> list[str]:
    """Returns a list of array names; a single text is one name."""
    if isinstance(value, str):
        return [value]
    is_list = isinstance(value, Iterable) and not isinstance(value, (bytes, Mapping))
    result = list(value) if is_list else [value]
    for one in result:
        if not isinstance(one, str):
            raise TypeError(f"{name} is {shown(value)}; give a name or a list of names.")
    return [str(one) for one in result]


def require_arrays(wanted: list[str] | None, known: list[str], kind: str = "") -> None:
    """Raises KeyError for a name that the mesh does not have; `kind` is 'point', 'cell' or empty."""
    for name in wanted or []:
        if name not in known:
            raise KeyError(f"the mesh has no {kind and kind + ' '}array '{name}'; it has {known}.")


DERIVED_BANDS = ("slope", "aspect", "hillshade", "void", "density")
_RANKED = (1, 2)  # "min" and "max" of tipp.dem


def require_bands(wanted: Iterable[str], known: Iterable[str]) -> None:
    """Raises KeyError for a band that is neither a column nor derived from the triangles."""
    columns = [*known]
    for name in wanted:
        if name not in (*columns, *DERIVED_BANDS, "elevation"):
            raise KeyError(f"there is no attribute '{name}'; there are {columns}.")


def require_columns(options: Mapping[str, Any], known: list[str]) -> None:
    """Raises KeyError if tipp.dem needs a column that is not among those of the files."""
    missing = [name for name in options["attributes"] if name not in (*known, *DERIVED_BANDS, "elevation")]
    if needs_elevation(options) and not {"z", "Z", "elevation"} & {*known}:
        missing.append("z")
    if missing:
        raise KeyError(f"the points have no column '{missing[0]}'; there are {known}.")


def needs_elevation(options: Mapping[str, Any]) -> bool:
    """Returns whether tipp.dem uses the points' elevation."""
    is_ranked = options["duplicates"] in _RANKED or (options["thin_size"] > 0 and options["thin_rule"] < 2)
    return is_ranked or not {"elevation", *DERIVED_BANDS[:3]}.isdisjoint(options["attributes"])


def text(value: Any, name: str) -> str:
    if not isinstance(value, str):
        raise TypeError(f"{name} is {shown(value)}; give a text.")
    return str(value)


def choice(value: Any, name: str, choices: Mapping[str, int]) -> int:
    if text(value, name) not in choices:
        raise ValueError(f"{name} is {shown(value)}; it is one of {', '.join(choices)}.")
    return choices[value]


def path(value: Any, name: str) -> str:
    if not isinstance(value, (str, bytes, os.PathLike)):
        raise TypeError(f"{name} is {shown(value)}; give a path.")
    result = os.fsdecode(value)
    if "\0" in result:
        raise ValueError(f"{name} has a null character; give a path without it.")
    return result


def paths(value: Any, name: str) -> list[str]:
    """Returns a list of paths; a single one is a list of one."""
    if isinstance(value, (str, bytes, os.PathLike)):
        return [path(value, name)]
    return [path(one, name) for one in a_list(value, name)]


@contextlib.contextmanager
def python_words() -> Iterator[None]:
    """In messages of a RuntimeError, options of the command line become arguments."""
    try:
        yield
    except RuntimeError as error:
        message = str(error).replace("give --wrap", "give wrap=True")
        raise type(error)(re.sub(r"--([a-z]+(-[a-z]+)*)", lambda option: option[1].replace("-", "_"), message)) from None


def are_files(points: Any) -> bool:
    """Returns whether points are given as the name or names of files."""
    first = next(iter(points), None) if isinstance(points, (list, tuple)) else points
    return isinstance(first, (str, os.PathLike))


def is_vtk_object(value: Any) -> bool:
    return type(value) is not np.ndarray and callable(getattr(value, "IsA", None)) and not isinstance(value, type)


def data_object(value: Any, name: str, kinds: Iterable[str], wanted: str) -> Any:
    """Returns the value if it is a VTK object of one of these classes."""
    if not is_vtk_object(value) or not any(value.IsA(kind) for kind in kinds):
        raise TypeError(f"{name} is {shown(value)}; give {wanted}.")
    return value


def require_point_set(points: Any, point_data: Any = None, wanted: str = "a vtkPointSet or an array") -> None:
    """Checks a VTK object that is given as points; arrays are checked when they are converted."""
    if is_vtk_object(points):
        if point_data is not None:
            raise ValueError("point_data needs an array of points; a data set has its own.")
        data_object(points, "points", ("vtkPointSet",), wanted)


def shown(value: Any) -> str:
    """Returns the repr of a short value, or the type of a long one."""
    if is_vtk_object(value):
        return f"a {value.GetClassName()}"
    simple = value is None or isinstance(value, (str, bytes, bool, int, float, complex, np.generic))
    try:
        shown = repr(value) if simple else ""
    except ValueError:  # an int with too many digits for repr()
        shown = ""
    shown = " ".join(shown.split())
    return shown if shown and len(shown) <= 60 else f"of type {type(value).__name__}"


# The options of the functions, and the properties of VTK's classes that have their values.
TRIANGULATION = {"tolerance": "Tolerance", "max_edge": "MaximumEdgeLength", "partitions": "NumberOfPartitions",
                 "schedule": "Schedule", "threads": "NumberOfThreads"}
MESH = {"alpha": "Alpha", "offset": "Offset", "bound": "BoundingTriangulation",
        "map_duplicates": "GenerateRepresentativeIds", "neighbors": "GenerateNeighborIds"}
DELAUNAY_2D = {**TRIANGULATION, **MESH, "crossings": "SplitCrossings", "marks": "ConstraintMarks"}
DELAUNAY_3D = {**MESH, "tolerance": "Tolerance", "partitions": "NumberOfPartitions", "threads": "NumberOfThreads"}
DELAUNAY_FILE = {"memory": "MemoryLimit", "partitions": "NumberOfPartitions", "max_edge": "MaximumEdgeLength",
                 "map_duplicates": "GenerateRepresentativeIds", "neighbors": "GenerateNeighborIds",
                 "constraints": "ConstraintsFileName", "boundary": "BoundaryFileName", "crossings": "SplitCrossings",
                 "mark_constraints": "GenerateConstraintEdges", "count_only": "CountOnly", "resume": "Resume",
                 "scratch": "ScratchFolder", "threads": "NumberOfThreads"}
DEM = {"align": "AlignToResolution", "soft": "SoftBreaklines", "max_edge": "MaximumEdgeLength", "duplicates": "Duplicates",
       "thin_size": "ThinningSize", "thin_rule": "ThinningRule", "memory": "MemoryLimit", "threads": "NumberOfThreads"}
MESHING = {"min_angle": "MinimumAngle", "max_area": "MaximumArea", "shortest_edge": "ShortestEdge",
           "keep_border": "KeepBorder", "keep_segments": "KeepSegments", "convex": "Convex", "crossings": "SplitCrossings",
           "marks": "GenerateSegments", "most_points": "MostPoints", "smooth": "SmoothingRounds",
           "memory": "MemoryLimit", "scratch": "ScratchFolder", "threads": "NumberOfThreads"}
QUERY = {"memory": "MemoryLimit", "step": "Step", "threads": "NumberOfThreads"}
READ = {"merge": "MergePieces", "tiling": "Tiling", "memory_limit": "MemoryLimit"}
SERIES = {"dimensions": "SamplingDimensions", "spacing": "Delta", "step": "Steps", "with_steps": "WithSteps",
          "waterline": "Waterline", "crs": "ReferenceSystem", "threads": "NumberOfThreads"}
WRITE = {"tiling": "Tiling", "duplicate_borrowers": "DuplicateBorrowers", "memory_limit": "MemoryLimit",
         "threads": "NumberOfThreads"}


def set_properties(algorithm: Any, properties: Mapping[str, str], options: Mapping[str, Any]) -> None:
    """Sets the properties of an algorithm to the values of the options."""
    for option, name in properties.items():
        value = options[option]
        getattr(algorithm, "Set" + name)(*(value if isinstance(value, tuple) else (value,)))


def options_of(algorithm: Any, properties: Mapping[str, str]) -> dict[str, Any]:
    """Returns the options with the values of an algorithm's properties."""
    return {option: getattr(algorithm, "Get" + name)() for option, name in properties.items()}


def array_of(statistic: str) -> str:
    """Returns the name that a statistic, such as "spilled_bytes", has in a table of VTK."""
    return {"duplicates": "DuplicatePoints", "rejected": "RejectedPoints"}.get(
        statistic, statistic.title().replace("_", ""))


Progress = Callable[[float], Any]
"""Called with the finished fraction. Returns False, or raises an exception, to stop the run."""
ProgressBar = Union[bool, Progress]

THIN_LEFT_OUT = "{} cells of fewer dimensions are left out: a partitioned mesh has triangles or tetrahedra only."
STOPPED = "the progress callback stopped the run."
_BAR = 40  # characters


def _show(fraction: float) -> None:
    done = int(_BAR * min(max(fraction, 0.0), 1.0))
    sys.stderr.write(f"\r[{'#' * done}{' ' * (_BAR - done)}] {100 * fraction:3.0f} %")
    sys.stderr.flush()


def progress_of(progress_bar: Any) -> Progress | None:
    """Returns the progress function for an argument `progress_bar`, which is True, False or a function."""
    if callable(progress_bar) and not isinstance(progress_bar, type):
        return progress_bar
    return _show if flag(progress_bar, "progress_bar") else None


def finish(progress: Progress | None) -> None:
    """Ends the progress bar's line."""
    if progress is _show:
        sys.stderr.write("\n")
