# SPDX-License-Identifier: BSD-3-Clause
"""Maps of the output of a model through time, in NumPy arrays. usage: series_maps.py MESH"""
import sys

import numpy as np

import tipp

times = tipp.times(sys.argv[1])
print(len(times.values), "steps,", times.units)
maps = tipp.resample_series(sys.argv[1], (0, 60000, 10000, 40000), spacing=500, step="::6", arrays="fort.63",
                            return_type="tipp")  # "xarray" makes an xarray.Dataset
unit = maps.attributes["fort.63"]["units"]
for time, level in zip(maps.times.values, maps.arrays["fort.63"]):
    print(f"{time:.0f}: {np.isfinite(level).sum()} wet samples, highest {np.nanmax(level):.2f} {unit}")
