# SPDX-License-Identifier: BSD-3-Clause
"""Reads NetCDF files for the C++ code, with netCDF4 or h5netcdf. Called in a process of its own for each file, which a
damaged one may crash."""
from __future__ import annotations

import importlib.util
import os
from typing import Any

_NAMES = {"i": "Int", "u": "UInt", "f": "Float"}
_MOST_NUMBERS = 1 << 16  # of an attribute; no convention has longer ones
_open: list[tuple[Any, str, tuple[int, ...]]] = []  # variables of the open file, their types and shapes

_kept: list[Any] = []  # the open file, which h5netcdf closes if nothing refers to it

Attributes = list[tuple[str, str, list[float], bool]]


def missing_package(is_to_write: bool) -> str:
    """Returns what to install; "" if files can be read or written."""
    for packages in (("netCDF4",), ("h5netcdf", "h5py")):
        if all(importlib.util.find_spec(name) for name in packages):
            return ""
    return (f"is a NetCDF file, which needs a package of Python that {'writes' if is_to_write else 'reads'} it: "
            "pip install netCDF4.")


def open_file(path: bytes) -> tuple[list[tuple[str, int]], list[tuple[str, str, list[int], Attributes]], Attributes]:
    """Opens a file. Returns its dimensions, its variables with their types, dimensions and attributes, and its own
    attributes."""
    os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")  # locks fail on many file systems of clusters
    try:
        dimensions, variables, attributes = _by_netcdf4(os.fsdecode(path))
    except ImportError:
        dimensions, variables, attributes = _by_h5netcdf(os.fsdecode(path))
    number = {name: index for index, (name, _) in enumerate(dimensions)}
    _open[:] = [(variable, kind, tuple(variable.shape)) for _, variable, kind, _, _ in variables]
    described = [(name, kind, [number[axis] for axis in axes], own) for name, _, kind, axes, own in variables]
    return dimensions, described, attributes


def _by_netcdf4(path: str) -> Any:
    import netCDF4

    file = netCDF4.Dataset(path)
    file.set_auto_maskandscale(False)
    file.set_auto_chartostring(False)
    _kept.append(file)
    variables = [(name, v, _kind_of(v.dtype), v.dimensions, [_attribute(key, v.getncattr(key)) for key in v.ncattrs()])
                 for name, v in file.variables.items()]
    return ([(name, len(dimension)) for name, dimension in file.dimensions.items()], variables,
            [_attribute(key, file.getncattr(key)) for key in file.ncattrs()])


def _by_h5netcdf(path: str) -> Any:
    import h5netcdf

    try:
        file = h5netcdf.File(path, "r", decode_vlen_strings=True)
    except OSError as error:
        raise RuntimeError(f"{error} (h5netcdf reads NetCDF 4 alone; netCDF4 also reads older files)") from None
    _kept.append(file)
    variables = [(name, v, _kind_of(v.dtype), v.dimensions, [_attribute(key, value) for key, value in v.attrs.items()])
                 for name, v in file.variables.items()]
    return ([(name, dimension.size) for name, dimension in file.dimensions.items()], variables,
            [_attribute(key, value) for key, value in file.attrs.items()])


def _kind_of(dtype: Any) -> str:
    """Returns the name of a type of numbers as VTK has it, "S" for characters, "" for others."""
    kind = getattr(dtype, "kind", "")
    if kind in _NAMES:
        return f"{_NAMES[kind]}{8 * dtype.itemsize}"
    return "S" if kind == "S" and dtype.itemsize == 1 else ""


def _attribute(name: str, value: Any) -> tuple[str, str, list[float], bool]:
    import numpy as np

    if isinstance(value, bytes):
        value = value.decode(errors="replace")
    if isinstance(value, str):
        return name, value.split("\0")[0], [], False
    values = np.atleast_1d(value)
    if values.dtype.kind in _NAMES and values.size <= _MOST_NUMBERS:
        return name, "", [float(number) for number in values.ravel()], values.dtype == np.float32
    if values.dtype.kind in "OUS" and values.size <= _MOST_NUMBERS:
        return name, " ".join(str(text) for text in values.ravel()), [], False
    return name, "", [], False


def read_part(variable: int, start: list[int], count: list[int]) -> bytes:
    """Returns the bytes of values in their own type, from an index on a number along each dimension."""
    import numpy as np

    values, kind, shape = _open[variable]
    part = np.asarray(values[tuple(slice(begin, begin + size) for begin, size in zip(start, count))] if shape
                      else values[...])
    if part.size != np.prod(count, dtype=int) or _kind_of(part.dtype) != kind:
        raise RuntimeError("a variable has other values than the file says")
    return np.ascontiguousarray(part, part.dtype.newbyteorder("=")).tobytes()
