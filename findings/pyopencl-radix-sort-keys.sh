#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# RadixSort of PyOpenCL 2026.1.4 returns keys in a wrong order, without an error or a warning, in two common cases:
# - Keys of 64 bits, such as Morton codes, are sorted by their lower 32 bits, as key_dtype is uint32 unless it is given.
# - Negative keys follow the positive ones, whatever key_dtype is: numpy.int32 and numpy.int64 are accepted and have no
#   effect on the order.
# The documentation asks for "an integer-valued C expression" as key, and does not explain key_dtype.
# Expected: the order of the values, or an error for a type of key that cannot be sorted. uint32 and, with key_dtype,
# uint64 are right.
# Consequence: a spatial index built on the device is wrong once a code exceeds 32 bits; small tests pass.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install pyopencl==2026.1.4 pocl-binary-distribution==3.0 mako==1.3.10 numpy==2.2.6
POCL_CACHE_DIR="$folder/pocl" PYOPENCL_NO_CACHE=1 "$folder/venv/bin/python" -W ignore - <<'PYTHON' | tee "$folder/seen"
import importlib.metadata

import numpy
import pyopencl
import pyopencl.array
from pyopencl.algorithm import RadixSort

platform = next(p for p in pyopencl.get_platforms() if p.name == "Portable Computing Language")
context = pyopencl.Context(platform.get_devices()[:1])
queue = pyopencl.CommandQueue(context)
print("PyOpenCL", importlib.metadata.version("pyopencl"))
for type_name, values, options in (
    ("uint", [7, 2**31 + 1, 3], {}),
    ("ulong", [2**40 + 1, 2**33, 5], {}),
    ("ulong", [2**40 + 1, 2**33, 5], {"key_dtype": numpy.uint64}),
    ("int", [4, -2, 3, -1], {}),
    ("int", [4, -2, 3, -1], {"key_dtype": numpy.int32}),
    ("long", [4, -2, 3, -1], {"key_dtype": numpy.int64}),
):
    dtype = {"uint": "uint32", "ulong": "uint64", "int": "int32", "long": "int64"}[type_name]
    keys = pyopencl.array.to_device(queue, numpy.array(values, dtype))
    sort = RadixSort(context, f"{type_name} *keys", key_expr="keys[i]", sort_arg_names=["keys"], **options)
    (found,), _ = sort(keys)
    found = found.get().tolist()
    key_type = numpy.dtype(options.get("key_dtype", "uint32")).name
    word = "sorted" if found == sorted(values) else "NOT SORTED"
    print(f"{type_name} keys, key_dtype {key_type}{'' if options else ' (default)'}: {found} {word}")
PYTHON
cat > "$folder/expected" <<'TEXT'
PyOpenCL 2026.1.4
uint keys, key_dtype uint32 (default): [3, 7, 2147483649] sorted
ulong keys, key_dtype uint32 (default): [8589934592, 1099511627777, 5] NOT SORTED
ulong keys, key_dtype uint64: [5, 8589934592, 1099511627777] sorted
int keys, key_dtype uint32 (default): [3, 4, -2, -1] NOT SORTED
int keys, key_dtype int32: [3, 4, -2, -1] NOT SORTED
long keys, key_dtype int64: [3, 4, -2, -1] NOT SORTED
TEXT
diff "$folder/expected" "$folder/seen" && echo "As described."
