# SPDX-License-Identifier: BSD-3-Clause
"""Helpers of tipp.dem for all engines: decompression with laspy, and band names."""
from __future__ import annotations

import contextlib
import importlib.util
import os
import tempfile
from typing import Any, Iterable, Iterator


@contextlib.contextmanager
def uncompressed(paths: list[str]) -> Iterator[list[str]]:
    """Yields the paths, with .laz files replaced by temporary .las files, which laspy writes if it is installed."""
    compressed = [path for path in paths if path.lower().endswith(".laz")]
    if not compressed or importlib.util.find_spec("laspy") is None:
        yield paths
        return
    import laspy

    with tempfile.TemporaryDirectory() as folder:
        files = []
        for number, path in enumerate(paths):
            if path not in compressed:
                files.append(path)
                continue
            files.append(os.path.join(folder, f"{number}.las"))
            try:
                with laspy.open(path) as source, laspy.open(files[-1], "w", header=source.header, do_compress=False) as to:
                    for block in source.chunk_iterator(1_000_000):
                        to.write_points(block)
            except Exception as error:
                raise RuntimeError(f"{path}: cannot be decompressed by laspy ({error}).") from None
        yield files


DERIVED = ("slope", "aspect", "hillshade", "void", "density")
RANKED = (1, 2)  # "min" and "max" of tipp.dem


def require_bands(names: Iterable[str], known: Iterable[str]) -> None:
    """Raises KeyError for a band that is neither a column nor derived from the triangles."""
    columns = [*known]
    for name in names:
        if name not in (*columns, *DERIVED, "elevation"):
            raise KeyError(f"there is no attribute '{name}'; there are {columns}.")


def needs_elevation(options: dict[str, Any]) -> bool:
    is_ranked = options["duplicates"] in RANKED or (options["thin_size"] > 0 and options["thin_rule"] < 2)
    return is_ranked or not {"elevation", *DERIVED[:3]}.isdisjoint(options["attributes"])
