#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes all shore vertices of a binned GSHHG file as an n x 2 .npy of longitude and latitude, in the file's order.

A vertex is stored as two unsigned 16-bit fractions of its bin, counted from the bin's south-west corner. Bins go
eastwards from longitude 0, row by row from the north pole (GMT, gmt_shore.c).

A third file gets the shoreline edges inside bins: two vertex indices each, in float64.
"""
import sys

import netCDF4
import numpy

if len(sys.argv) not in (3, 4):
    sys.exit("usage: gshhg-to-npy.py /usr/share/gmt-gshhg/binned_GSHHS_f.nc OUTPUT.npy [EDGES.npy]")

with netCDF4.Dataset(sys.argv[1]) as source:
    source.set_auto_mask(False)

    def read(name):
        return source.variables[name][:]

    size = float(read("Bin_size_in_minutes")[0]) / 60
    columns = int(read("N_bins_in_360_longitude_range")[0])
    segments_of_bin = read("N_segments_in_a_bin")
    first_segment = read("Id_of_first_segment_in_a_bin")
    points_of_segment = read("Embedded_npts_levels_exit_entry_for_a_segment") >> 9
    first_point = read("Id_of_first_point_in_a_segment")
    dx = read("Relative_longitude_from_SW_corner_of_bin").view(numpy.uint16)
    dy = read("Relative_latitude_from_SW_corner_of_bin").view(numpy.uint16)

bin_of_segment = numpy.full(len(points_of_segment), -1)
for b in numpy.flatnonzero(segments_of_bin):
    bin_of_segment[first_segment[b] : first_segment[b] + segments_of_bin[b]] = b
bin_of_point = numpy.full(len(dx), -1)
for s, b in enumerate(bin_of_segment):
    bin_of_point[first_point[s] : first_point[s] + points_of_segment[s]] = b
if (bin_of_point < 0).any():
    sys.exit(f"{sys.argv[1]}: {(bin_of_point < 0).sum()} vertices are in no bin; is the file whole?")

longitude = (bin_of_point % columns) * size + dx * (size / 65535)
longitude[longitude > 180] -= 360
latitude = 90 - (bin_of_point // columns + 1) * size + dy * (size / 65535)
numpy.save(sys.argv[2], numpy.column_stack((longitude, latitude)))
if len(sys.argv) == 4:
    is_last = numpy.zeros(len(dx), bool)
    is_last[first_point + points_of_segment - 1] = True
    first = numpy.flatnonzero(~is_last)
    first = first[abs(longitude[first] - longitude[first + 1]) < 180]  # leaves out edges around the earth
    numpy.save(sys.argv[3], numpy.column_stack((first, first + 1)).astype(float))
