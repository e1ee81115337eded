#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# RelativeOverlapRegridder of xugrid 0.15.3, whose default method is "first_order_conservative", keeps sums over faces
# and not the integral. So a constant temperature of 10 degrees on 16 squares becomes 40 degrees on the 4 squares that
# cover the same area, and 2.5 degrees on 64. Meshes of one resolution look right. The documentation says only that the
# relative overlap "is required for e.g. first-order" conservative regridding.
# Expected: what remapping libraries mean by the name, such as ESMF's conservative method and CDO's remapcon: the area's
# mean value, so that constants stay and integrals are kept. In xugrid that is OverlapRegridder's method "mean".
# Consequence: temperatures, depths and concentrations are multiplied by the ratio of areas, without a warning.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install xugrid==0.15.3 numba-celltree==0.4.2
"$folder/venv/bin/python" -W ignore - <<'PYTHON' | tee "$folder/seen"
import importlib.metadata

import numpy
import xarray
import xugrid


def squares(count):
    x, y = (axis.ravel() for axis in numpy.meshgrid(*2 * [numpy.linspace(0, 1, count + 1)]))
    first = numpy.arange((count + 1) ** 2).reshape(count + 1, -1)[:-1, :-1].ravel()
    return xugrid.Ugrid2d(x, y, -1, first[:, None] + [0, 1, count + 2, count + 1])


print("xugrid", importlib.metadata.version("xugrid"))
source = squares(4)
constant = xarray.DataArray(numpy.full(source.n_face, 10.0), dims=[source.face_dimension])
temperature = xugrid.UgridDataArray(constant, source)
print(f"{source.n_face} faces: 10, integral {(temperature.values * source.area).sum():g}")
for count in (2, 4, 8):
    target = squares(count)
    for regridder, method in (
        (xugrid.RelativeOverlapRegridder, "first_order_conservative"),
        (xugrid.OverlapRegridder, "mean"),
    ):
        found = regridder(temperature, target, method=method).regrid(temperature).values
        low, high, integral = found.min(), found.max(), (found * target.area).sum()
        print(f"{target.n_face} faces, {method}: {low:g} to {high:g}, integral {integral:g}")
PYTHON
cat > "$folder/expected" <<'TEXT'
xugrid 0.15.3
16 faces: 10, integral 10
4 faces, first_order_conservative: 40 to 40, integral 40
4 faces, mean: 10 to 10, integral 10
16 faces, first_order_conservative: 10 to 10, integral 10
16 faces, mean: 10 to 10, integral 10
64 faces, first_order_conservative: 2.5 to 2.5, integral 2.5
64 faces, mean: 10 to 10, integral 10
TEXT
diff "$folder/expected" "$folder/seen" && echo "As described."
