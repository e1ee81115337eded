#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the columns 'longitude' and 'latitude' of an .xz-compressed CSV as an n x 2 .npy, in the file's order."""
import csv
import lzma
import sys

import numpy

if len(sys.argv) != 3:
    sys.exit("usage: csv-to-npy.py INPUT.csv.xz OUTPUT.npy")

with lzma.open(sys.argv[1], "rt") as source:
    columns = next(csv.reader([source.readline()]))
    used = [columns.index(name) for name in ("longitude", "latitude")]
    numpy.save(sys.argv[2], numpy.loadtxt(source, delimiter=",", usecols=used))
