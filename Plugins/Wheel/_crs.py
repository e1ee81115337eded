# SPDX-License-Identifier: BSD-3-Clause
"""Coordinate reference systems that state no EPSG code known to the wheel, for GeoTIFF files."""
from __future__ import annotations


def translate(crs: bytes) -> bytes:
    """Translates the text of a system with pyproj or rasterio.

    Parameters
    ----------
    crs
        WKT, PROJJSON, "EPSG:code", "ESRI:code" or another text that they understand.

    Returns
    -------
    b"projected:CODE" or b"geographic:CODE", either with "+CODE" for the system of heights; or a GeoTIFF of one pixel
    with the system; or nothing if neither package is installed, or pyproj alone finds no EPSG code.

    Raises
    ------
    ValueError
        If they do not understand the text.
    """
    text = crs.decode(errors="replace")
    return _by_code(text) or _by_file(text)


def _by_code(text: str) -> bytes:
    try:
        import pyproj
    except ImportError:
        return b""
    try:
        system = pyproj.CRS.from_user_input(text)
    except pyproj.exceptions.CRSError as error:
        raise _misunderstood(text) from error
    parts = system.sub_crs_list if system.is_compound else [system]
    certain = 90  # per cent: only the names differ
    codes = [part.to_epsg(min_confidence=certain) for part in parts]
    if not all(codes) or not (parts[0].is_projected or parts[0].is_geographic):
        return b""
    kind = "projected" if parts[0].is_projected else "geographic"
    return f"{kind}:{'+'.join(map(str, codes))}".encode()


def _by_file(text: str) -> bytes:
    try:
        import rasterio
        import rasterio.errors
        import rasterio.io
    except ImportError:
        return b""
    form = {"driver": "GTiff", "width": 1, "height": 1, "count": 1, "dtype": "uint8"}
    try:
        system = rasterio.crs.CRS.from_user_input(text)
    except rasterio.errors.CRSError as error:
        raise _misunderstood(text) from error
    with rasterio.io.MemoryFile() as memory:
        with memory.open(**form, crs=system, transform=rasterio.Affine(1, 0, 1, 0, -1, 1)):
            pass
        return memory.read()


def _misunderstood(text: str) -> ValueError:
    return ValueError(f"{text[:60]!r} is no coordinate reference system that PROJ knows; give --crs EPSG:CODE.")
