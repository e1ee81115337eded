#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# use_zarr_fill_value_as_mask of xarray 2026.9.0's open_zarr has no effect, without an error or a warning. So triangles
# [0, 1, 2] and [0, 2, 3] that zarr 3.1.6 wrote in Zarr's format 2 lose their node 0 even with the option False: every 0
# becomes NaN, and so do depths of 0 m. zarr's create_array gives an array the fill value 0 unless it is told otherwise,
# and for format 2 xarray takes that value for the mark of missing data. True has no effect on format 3 either.
# Expected: the documentation says that with False "the fill_value is ignored and the data are not masked".
# Consequence: every triangle at the first node is broken, and dry points vanish from statistics. mask_and_scale=False
# helps the reader, and fill_value=None the writer.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install zarr==3.1.6 xarray==2026.9.0 numpy==2.4.6
cd "$folder"
"$folder/venv/bin/python" -W error - <<'PYTHON' | tee "$folder/seen"
import importlib.metadata

import numpy
import xarray
import zarr

ARRAYS = {
    "triangles": (("face", "corner"), numpy.array([[0, 1, 2], [0, 2, 3]], "int32")),
    "depth": (("node",), numpy.array([0.0, 1.5, 0.0, 2.5])),
}
print(*(f"{name} {importlib.metadata.version(name)}" for name in ("xarray", "zarr")))
for zarr_format, arrays in ((2, {}), (2, {"fill_value": None}), (3, {})):
    print(f"format {zarr_format}, {arrays or 'fill value not given'}")
    group = zarr.create_group("mesh.zarr", zarr_format=zarr_format, overwrite=True)
    for key, (dimensions, values) in ARRAYS.items():
        if zarr_format == 2:
            options = {"attributes": {"_ARRAY_DIMENSIONS": list(dimensions)}}
        else:
            options = {"dimension_names": dimensions}
        group.create_array(key, shape=values.shape, dtype=values.dtype, **options, **arrays)[:] = values
    for options in (
        {},
        {"use_zarr_fill_value_as_mask": False},
        {"use_zarr_fill_value_as_mask": True},
        {"mask_and_scale": False},
    ):
        with xarray.open_zarr("mesh.zarr", consolidated=False, **options) as mesh:
            print(f"  {options}: {mesh.triangles.values.tolist()}, {mesh.depth.values.tolist()}")
PYTHON
cat > "$folder/expected" <<'TEXT'
xarray 2026.9.0 zarr 3.1.6
format 2, fill value not given
  {}: [[nan, 1.0, 2.0], [nan, 2.0, 3.0]], [nan, 1.5, nan, 2.5]
  {'use_zarr_fill_value_as_mask': False}: [[nan, 1.0, 2.0], [nan, 2.0, 3.0]], [nan, 1.5, nan, 2.5]
  {'use_zarr_fill_value_as_mask': True}: [[nan, 1.0, 2.0], [nan, 2.0, 3.0]], [nan, 1.5, nan, 2.5]
  {'mask_and_scale': False}: [[0, 1, 2], [0, 2, 3]], [0.0, 1.5, 0.0, 2.5]
format 2, {'fill_value': None}
  {}: [[0, 1, 2], [0, 2, 3]], [0.0, 1.5, 0.0, 2.5]
  {'use_zarr_fill_value_as_mask': False}: [[0, 1, 2], [0, 2, 3]], [0.0, 1.5, 0.0, 2.5]
  {'use_zarr_fill_value_as_mask': True}: [[0, 1, 2], [0, 2, 3]], [0.0, 1.5, 0.0, 2.5]
  {'mask_and_scale': False}: [[0, 1, 2], [0, 2, 3]], [0.0, 1.5, 0.0, 2.5]
format 3, fill value not given
  {}: [[0, 1, 2], [0, 2, 3]], [0.0, 1.5, 0.0, 2.5]
  {'use_zarr_fill_value_as_mask': False}: [[0, 1, 2], [0, 2, 3]], [0.0, 1.5, 0.0, 2.5]
  {'use_zarr_fill_value_as_mask': True}: [[0, 1, 2], [0, 2, 3]], [0.0, 1.5, 0.0, 2.5]
  {'mask_and_scale': False}: [[0, 1, 2], [0, 2, 3]], [0.0, 1.5, 0.0, 2.5]
TEXT
diff "$folder/expected" "$folder/seen" && echo "As described."
