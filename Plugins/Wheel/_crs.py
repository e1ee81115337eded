# SPDX-License-Identifier: BSD-3-Clause
"""Coordinate reference systems: those without an EPSG code known to the wheel, for GeoTIFF files; WKT for others."""
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


def to_wkt1(crs: bytes) -> bytes:
    """Translates the text of a system to WKT 1 with pyproj or rasterio; returns nothing if they do not understand it.

    Raises
    ------
    ValueError
        If neither package is installed, and the text is not WKT 1 already.
    """
    text = crs.decode(errors="replace")
    for wkt1_of in (_wkt1_by_pyproj, _wkt1_by_rasterio):
        try:
            return wkt1_of(text).encode()
        except ImportError:
            pass
    if text.lstrip().startswith(("GEOGCS[", "PROJCS[", "COMPD_CS[")):
        return crs
    raise ValueError(f"The coordinate reference system {text[:60]!r} is written as WKT, which needs a package of Python "
                     "that translates it: pip install pyproj.")


def _wkt1_by_pyproj(text: str) -> str:
    import pyproj

    try:
        return pyproj.CRS.from_user_input(text).to_wkt("WKT1_GDAL", output_axis_rule=True) or ""
    except pyproj.exceptions.CRSError:
        return ""


def _wkt1_by_rasterio(text: str) -> str:
    import rasterio.crs
    import rasterio.errors

    try:
        return str(rasterio.crs.CRS.from_user_input(text).to_wkt(version="WKT1_GDAL"))
    except rasterio.errors.CRSError:
        return ""


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
