# SPDX-License-Identifier: BSD-3-Clause
"""Points of xarray objects: the pixels of a raster, or variables x, y and z. xarray is not imported."""
from __future__ import annotations

from typing import Any

import numpy as np

_AXES = (("x", "lon", "longitude", "easting"), ("y", "lat", "latitude", "northing"))


class Table:
    """The variables of a Dataset that are columns, in the form of a table."""

    def __init__(self, dataset: Any, what: str) -> None:
        self._dataset = dataset
        along: dict[Any, list[Any]] = {}
        for name, variable in dataset.variables.items():
            if variable.ndim == 1:
                along.setdefault(variable.dims, []).append(name)
        lists = [names for names in along.values() if len(names) > 1]
        if len(lists) != 1:  # such as a raster, whose x and y are the axes of other variables
            names = [str(name) for name in dataset.data_vars]
            raise ValueError(f"{what} is a Dataset without a list of x and y along one dimension; give one of its variables "
                             f"{names}, such as dataset[{names[0]!r}], or an array." if names else f"{what} is an empty Dataset.")
        self.columns = lists[0]

    def __getitem__(self, name: Any) -> np.ndarray:
        return np.asarray(self._dataset[name])


def is_xarray(value: Any) -> bool:
    return any(kind.__module__.split(".")[0] == "xarray" for kind in type(value).__mro__)


def raster_points(raster: Any, name: str) -> np.ndarray:
    """Returns the (n, 3) pixel centres of a DataArray and their values as z. Pixels without a value are left out."""
    dimensions = [next((each for each in raster.dims if str(each).lower() in known), None) for known in _AXES]
    raster = raster.squeeze([each for each in raster.dims if each not in dimensions and raster.sizes[each] == 1], drop=True)
    if None in dimensions or raster.ndim != 2:
        raise ValueError(f"{name} is a DataArray with the dimensions {[str(each) for each in raster.dims]}; give a raster with "
                         "x and y, such as one band by sel(band=1), or an array.")
    missing = [str(each) for each in dimensions if each not in raster.coords]
    if missing:
        raise ValueError(f"{name} is a DataArray without coordinates along {missing[0]}; assign them, or give an array.")
    x, y = (np.asarray(raster[each], np.float64) for each in dimensions)
    values = np.asarray(raster.transpose(dimensions[1], dimensions[0]))
    if values.dtype.kind not in "fiub":
        raise TypeError(f"{name} is a DataArray of type {values.dtype}; give real numbers.")
    values = values.astype(np.float64)
    has_value = np.isfinite(values)
    for key in ("_FillValue", "missing_value", "nodata"):
        if raster.attrs.get(key) is not None:
            has_value &= ~np.isin(values, np.atleast_1d(raster.attrs[key]))
    return np.column_stack([*(each[has_value] for each in np.meshgrid(x, y)), values[has_value]])
