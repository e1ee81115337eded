# SPDX-License-Identifier: BSD-3-Clause
"""Writes NetCDF-4 files for the C++ code, with netCDF4 or h5netcdf, as the NetCDF library does in the C++ tool."""
from __future__ import annotations

import contextlib
import os
from typing import Any, Iterator, Sequence

import numpy as np

_TYPES = {f"{name}{8 * size}": np.dtype(f"{kind}{size}") for name, kind, sizes in (
    ("Int", "i", (1, 2, 4, 8)), ("UInt", "u", (1, 2, 4, 8)), ("Float", "f", (4, 8))) for size in sizes}
_LEVEL = 1  # of compression, of 9: larger ones take twice the time for a few per cent
failed: list[Any] = []  # files that could not be written
_FILL_INT = -2147483647  # the library's fill value of a variable that nobody writes

Attributes = Sequence[tuple[str, bytes, list[float]]]  # name; text, or else integers
Variable = tuple[bytes, str, list[int], Attributes, list[int], str]  # see create_file()


def create_file(path: bytes, is_classic: bool, dimensions: list[tuple[str, int]], variables: list[Variable],
                attributes: Attributes) -> _Netcdf4File | _H5netcdfFile:
    """Creates a file, or replaces what is in it.

    Parameters
    ----------
    is_classic
        Whether the file states that it has only the types of the classic formats, where the package can say so.
    dimensions
        Names and sizes; 0 for an unlimited one.
    variables
        Names, types as VTK names them, indices of dimensions, attributes, sizes of compressed chunks or an empty list,
        and what the fill value is: "usual", "nan" or "none".
    attributes
        Those of the file.
    """
    file: _Netcdf4File | _H5netcdfFile
    with _keeping_failed([]):
        try:
            file = _Netcdf4File(os.fsdecode(path), is_classic)
        except ImportError:
            file = _H5netcdfFile(os.fsdecode(path))
    with _keeping_failed(file):
        file.set_attributes(file.file, attributes)
        for name, size in dimensions:
            file.add_dimension(name, size or None)
        for encoded, kind, axes, own, chunk, fill in variables:
            names = tuple(dimensions[axis][0] for axis in axes)
            variable = file.add_variable(encoded.decode(), _TYPES[kind], names, chunk, fill)
            file.set_attributes(variable, own)
            file.variables.append(variable)
    return file


@contextlib.contextmanager
def _keeping_failed(file: Any) -> Iterator[None]:
    """Keeps a file in `failed` if writing it fails, as on a full disk: HDF5 prints errors again, or crashes, when it is
    told to give up the file. Errors lose the addresses and times that HDF5 appends."""
    try:
        yield
    except (OSError, RuntimeError) as error:
        failed.append(file)
        raise RuntimeError(str(error).split(" (file write failed")[0]) from error


def write_part(file: _File, variable: int, start: list[int], count: list[int], values: memoryview) -> None:
    """Writes values in the type of the variable, from an index on a number along each dimension."""
    with _keeping_failed(file):
        file.write(variable, start, count, values)


def close_file(file: _File) -> None:
    with _keeping_failed(file):
        file.close()


class _File:
    """A file that is being written; `variables` are in the order of their numbers."""

    def __init__(self, file: Any) -> None:
        self.file = file
        self.variables: list[Any] = []

    def write(self, variable: int, start: list[int], count: list[int], values: memoryview) -> None:
        to = self.variables[variable]
        part = tuple(slice(begin, begin + size) for begin, size in zip(start, count))
        to[part] = np.frombuffer(values, to.dtype).reshape(count)

    def close(self) -> None:
        self.file.close()


class _Netcdf4File(_File):
    def __init__(self, path: str, is_classic: bool) -> None:
        import netCDF4

        super().__init__(netCDF4.Dataset(path, "w", format="NETCDF4_CLASSIC" if is_classic else "NETCDF4"))

    def add_dimension(self, name: str, size: int | None) -> None:
        self.file.createDimension(name, size)

    def add_variable(self, name: str, dtype: Any, dimensions: tuple[str, ...], chunk: list[int], fill: str) -> Any:
        storage: dict[str, Any] = {}
        if chunk:
            storage = {"zlib": True, "complevel": _LEVEL, "shuffle": True, "chunksizes": chunk}
        missing = {"usual": None, "nan": np.nan, "none": False}[fill]
        variable = self.file.createVariable(name, dtype, dimensions, fill_value=missing, **storage)
        variable.set_auto_maskandscale(False)  # values are stored as they are
        return variable

    def set_attributes(self, of: Any, attributes: Attributes) -> None:
        for name, text, numbers in attributes:
            # As bytes, text becomes an array of characters, also beyond ASCII.
            of.setncattr(name, text or np.array(numbers, np.int32))


class _H5netcdfFile(_File):
    def __init__(self, path: str) -> None:
        import h5netcdf

        super().__init__(h5netcdf.File(path, "w"))
        self._datasets: list[Any] = []  # HDF5's own objects

    def add_dimension(self, name: str, size: int | None) -> None:
        self.file.dimensions[name] = size

    def add_variable(self, name: str, dtype: Any, dimensions: tuple[str, ...], chunk: list[int], fill: str) -> Any:
        storage: dict[str, Any] = {}
        if chunk:
            storage = {"compression": "gzip", "compression_opts": _LEVEL, "shuffle": True, "chunks": tuple(chunk)}
        missing = dtype.type(np.nan) if fill == "nan" else None
        variable = self.file.create_variable(name, dimensions, dtype, fillvalue=missing, **storage)
        if not dimensions:
            variable[...] = _FILL_INT
        # While these are open, values that are still in memory are written by calls that report a failure, and not
        # when a temporary object is deleted, where Python only prints it.
        self._datasets.append(getattr(variable, "_h5ds", None))
        return variable

    def set_attributes(self, of: Any, attributes: Attributes) -> None:
        import h5py

        for name, text, numbers in attributes:
            kind = h5py.string_dtype("utf-8", len(text))  # an array of characters, also beyond ASCII
            of.attrs[name] = np.array(text, kind) if text else np.array(numbers, np.int32)

    def write(self, variable: int, start: list[int], count: list[int], values: memoryview) -> None:
        to = self.variables[variable]
        for axis, end in zip(to.dimensions, map(sum, zip(start, count))):
            if self.file.dimensions[axis].isunlimited() and self.file.dimensions[axis].size < end:
                self.file.resize_dimension(axis, end)
        super().write(variable, start, count, values)

    def close(self) -> None:
        self.file.flush()
        super().close()
