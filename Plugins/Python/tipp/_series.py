# SPDX-License-Identifier: BSD-3-Clause
"""tipp.resample_series and times: maps of the output of models through time, and when its steps are."""
from __future__ import annotations

import dataclasses
import os
import re
from typing import Any, Iterable, NamedTuple, Sequence

import numpy as np

from . import _arguments as check
from . import _engine
from ._arguments import ProgressBar, progress_of
from ._arrays import grid_position
from ._bounds import bounds_of, BoundsLike
from ._data import imported

_STEPS = re.compile(r"all|[0-9]+|[0-9]*:[0-9]*(:0*[1-9][0-9]*)?")
_COORDINATES = ("time", "y", "x", "spatial_ref")


class Times(NamedTuple):
    """The time steps of a mesh."""

    values: np.ndarray
    """float64, ascending; empty if nothing varies in time."""
    units: str
    """The unit and origin in the manner of CF, such as "seconds since 2008-09-01"; empty if the file does not say."""
    calendar: str
    """In the manner of CF; empty: the standard one."""


@dataclasses.dataclass(frozen=True)
class Maps:
    """Maps of arrays on a regular grid, through time."""

    x: np.ndarray
    """The samples' coordinates, ascending."""
    y: np.ndarray
    spacing: tuple[float, float]
    steps: np.ndarray
    """The numbers of the steps in the file, from 0."""
    times: Times
    """When these steps are."""
    arrays: dict[str, np.ndarray]
    """float32, (steps, y, x), or (y, x) for what does not vary in time; NaN where there is no value."""
    attributes: dict[str, dict[str, str]]
    """For each array what the file says of it: long_name, standard_name and units."""
    crs: str
    """The coordinate reference system: WKT, or a text as in the file; empty if it does not say."""

    def to_xarray(self) -> Any:
        """Converts to an xarray.Dataset with the coordinates time, y and x, in the manner of CF.

        Times are decoded to dates if the file states their origin, and the calendar is one that xarray can decode; if
        not, they are numbers with the attributes units and calendar. The reference system is the coordinate spatial_ref,
        as rioxarray expects: `rio.crs`, `rio.bounds()` and `rio.to_raster()` work. Raises ModuleNotFoundError without
        xarray.
        """
        xarray = imported("xarray", "Maps.to_xarray()")
        taken = [name for name in self.arrays if name in _COORDINATES]
        if taken:
            raise RuntimeError(f"the mesh has an array called '{taken[0]}', which is the name of a coordinate: name others "
                               "with arrays.")
        west, south = (float(axis[0]) - width / 2 for axis, width in zip((self.x, self.y), self.spacing))
        reference = {"GeoTransform": " ".join(repr(v) for v in (west, self.spacing[0], 0.0, south, 0.0, self.spacing[1]))}
        if self.crs:
            reference.update(spatial_ref=self.crs, crs_wkt=self.crs)
        coordinates = {"y": ("y", self.y, {"axis": "Y"}), "x": ("x", self.x, {"axis": "X"}),
                       "spatial_ref": ((), 0, reference)}
        if any(values.ndim == 3 for values in self.arrays.values()):
            coordinates["time"] = _time_of(xarray, self.times)
        elif len(self.steps) == 1:
            coordinates["time"] = xarray.Dataset(coords={"time": _time_of(xarray, self.times)})["time"][0]
        variables = {name: (("time", "y", "x")[-values.ndim:], values, {**self.attributes[name], "_FillValue": np.nan})
                     for name, values in self.arrays.items()}
        result = xarray.Dataset(variables, coordinates)
        for name in self.arrays:
            result[name].encoding["grid_mapping"] = "spatial_ref"
        return result

    def __repr__(self) -> str:
        return (f"tipp.Maps({len(self.steps)} steps, {len(self.y)} rows x {len(self.x)} columns, "
                f"{', '.join(self.arrays) or 'no arrays'})")


def _time_of(xarray: Any, times: Times) -> Any:
    """Returns the coordinate of times, decoded if that is possible."""
    attributes = {"standard_name": "time", "axis": "T"}
    stated = {key: text for key, text in (("units", times.units), ("calendar", times.calendar)) if text}
    numbers = ("time", times.values, {**attributes, **stated})
    if " since " not in times.units:
        return numbers
    try:
        return xarray.decode_cf(xarray.Dataset(coords={"time": numbers}))["time"]
    except (ImportError, OverflowError, ValueError):  # a calendar that needs cftime, or a unit that is none of CF's
        return numbers


def times(path: str | os.PathLike[str], *, values: str | os.PathLike[str] | Iterable[Any] = (), wrap: bool = False) -> Times:
    """Returns the time steps of a partitioned or flat mesh, or of the output of a model.

    Parameters
    ----------
    path, values, wrap
        As for read().

    Returns
    -------
    Times
        A named tuple: values, units, calendar. read(time=...) takes one of the values.

    Raises
    ------
    TypeError, ValueError
        If an argument is of a wrong type or value.
    RuntimeError
        If the mesh cannot be read; the message says why.

    Examples
    --------
    >>> last = tipp.read("surge.nc", time=tipp.times("surge.nc").values[-1])
    """
    options = {"values": check.paths(values, "values"), "wrap": check.flag(wrap, "wrap")}
    with check.python_words():
        found, units, calendar = _engine.times(check.path(path, "path"), options)
    return Times(np.asarray(found, np.float64), units, calendar)


def resample_series(
    path: str | os.PathLike[str],
    bounds: BoundsLike | None = None,
    dimensions: Sequence[int] | None = None,
    *,
    spacing: float | Sequence[float] | None = None,
    step: int | str | None = None,
    arrays: str | Iterable[str] | None = None,
    reduce: str | Iterable[str] = (),
    with_steps: bool = False,
    waterline: str | None = None,
    no_data: float | None = None,
    values: str | os.PathLike[str] | Iterable[Any] = (),
    wrap: bool = False,
    crs: str | None = None,
    return_type: str = "xarray",
    threads: int = 0,
    progress_bar: ProgressBar = False,
) -> Any:
    """Samples time steps of the output of a model on a regular grid.

    The triangles of the samples are found once; then one step after another is read and sampled, as `tipp resample --step`
    does it. Values at nodes are interpolated linearly in each triangle.

    Parameters
    ----------
    path
        The output of a model, as for read(), or a flat or partitioned mesh of triangles.
    bounds
        (xmin, xmax, ymin, ymax), both ends included, in the mesh's units, a tipp.Bounds, or a data set, geometry or
        raster, whose bounds are used. A range that does not meet the mesh is an error. None: the mesh's bounding box.
    dimensions
        The number of samples along x and y; 0 uses the spacing of the other axis. None: (256, 0).
    spacing
        The distance of samples, along both axes or along x and y, from the lower bound on, instead of `dimensions`.
    step
        The time steps: a number, counted from 0, "all", or "FIRST:LAST:STRIDE", where each may be left out, and LAST is
        included. One number gives maps without a time axis of several. None: all.
    arrays
        The name or the names of the arrays to sample. None: all, or with `reduce` those that vary in time.
    reduce
        Maps that are made of all these steps: one or more of "max", "min", "mean", "time-of-max" and "above:LEVEL".
    with_steps
        With `reduce`: whether the steps are in the result, too.
    waterline
        The array with the depth of the ground, positive down: water ends in partly wet triangles where the level is not
        above the ground.
    no_data
        A value that counts as none, such as -99999. Missing values that the file states are none without it.
    values
        The name or the names of more files, with values at the mesh's nodes or cells.
    wrap
        Of a mesh in degrees: whether cells that cross the meridian at which longitudes jump are on either side of it.
    crs
        The coordinate reference system, such as "EPSG:32617", instead of the one that the file states.
    return_type
        "xarray" or "tipp": what the result is.
    threads, progress_bar
        As for delaunay().

    Returns
    -------
    xarray.Dataset or tipp.Maps
        The maps, of float32 and NaN where there is no value, with the coordinates time, y and x. Units, names, dates and
        the reference system are those of the file: see Maps.to_xarray(). tipp.Maps has NumPy arrays, and does not need
        xarray.

    Raises
    ------
    TypeError, ValueError
        If an argument is of a wrong type or value.
    RuntimeError
        If the file cannot be read, or has no such arrays or steps, or the bounds do not meet the mesh; the message says
        why.
    ModuleNotFoundError
        If xarray is not installed, which return_type="tipp" does not need.
    KeyboardInterrupt
        Promptly after Ctrl-C.

    Examples
    --------
    >>> maps = tipp.resample_series("surge.nc", spacing=200, step="::12")
    """
    kind = check.choice(return_type, "return_type", {"xarray": 0, "tipp": 1})
    options: dict[str, Any] = {
        "bounds": None if bounds is None else bounds_of(bounds, "bounds")[:4],
        "dimensions": (256, 0) if dimensions is None else tuple(check.several(dimensions, "dimensions", 2, check.whole)),
        "spacing": (0.0, 0.0) if spacing is None else _spacing(spacing),
        "step": _step(step),
        "arrays": [] if arrays is None else check.names(arrays, "arrays"),
        "reduce": check.names(reduce, "reduce"),
        "with_steps": check.flag(with_steps, "with_steps"),
        "waterline": "" if waterline is None else check.text(waterline, "waterline"),
        "no_data": None if no_data is None else check.number(no_data, "no_data"),
        "values": check.paths(values, "values"),
        "wrap": check.flag(wrap, "wrap"),
        "crs": "" if crs is None else check.text(crs, "crs"),
        "threads": check.threads(threads),
    }
    if options["with_steps"] and not options["reduce"]:
        raise ValueError("with_steps needs reduce.")
    source = check.path(path, "path")
    if kind == 0:
        imported("xarray", "resample_series() without return_type='tipp'")
    with check.python_words():
        found = _engine.resample_series(source, options, progress_of(progress_bar))
    maps = _maps_of(found, options["step"].isdigit())
    return maps if kind == 1 else maps.to_xarray()


def _spacing(value: Any) -> tuple[float, float]:
    if not isinstance(value, (Sequence, np.ndarray)) or isinstance(value, (str, bytes)):
        value = (value, value)
    result = tuple(check.several(value, "spacing", 2, _distance))
    return result[0], result[1]


def _distance(value: Any, _name: str) -> float:
    number = check.number(value, "spacing", at_least=0)
    if number == 0:
        raise ValueError("spacing is 0; give a distance above 0.")
    return number


def _step(value: Any) -> str:
    if value is None or isinstance(value, str):
        if value is not None and not _STEPS.fullmatch(value):
            raise ValueError(f"step is {check.shown(value)}; give a number, 'all' or 'FIRST:LAST:STRIDE', such as '0:99:10'.")
        return value or ""
    return str(check.whole(value, "step"))


def _maps_of(found: dict[str, Any], is_one_step: bool) -> Maps:
    """Converts what an engine returns. One step that was asked for by its number is no axis."""
    columns, rows = found["dimensions"]
    axes = [np.array([grid_position(found["origin"][axis], found["spacing"][axis], 2 * i) for i in range(count)])
            for axis, count in enumerate((columns, rows))]
    arrays, attributes = {}, {}
    for name, samples, described in found["arrays"]:
        has_axis = described["varies"] and not is_one_step
        arrays[name] = samples.reshape(*([len(found["steps"])] if has_axis else []), rows, columns)
        attributes[name] = {key: described[key] for key in ("long_name", "standard_name", "units") if described[key]}
    when = Times(np.asarray(found["times"], np.float64), found["time_units"], found["calendar"])
    return Maps(axes[0], axes[1], tuple(found["spacing"]), np.asarray(found["steps"], np.int64), when, arrays, attributes,
                found["crs"])
