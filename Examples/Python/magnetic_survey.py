# SPDX-License-Identifier: BSD-3-Clause
"""Draws a map of the magnetic field from the flight lines of a survey.

Usage: magnetic_survey.py SURVEY.csv[.xz] PICTURE.png [COLUMN]

The table's first line has the names of its columns. Longitude, latitude and COLUMN (default:
total_field_anomaly_nt) are used. Flight lines are far apart, and the points on them close together, so many
triangles are thin. Triangles with a circumradius above 0.02 degrees are left out: they would cover areas
without measurements.
"""
import csv
import lzma
import sys

import numpy as np

import tipp
from pictures import ANOMALY, coloured, lit, save_png


def read_table(path):
    with (lzma.open(path, "rt") if path.endswith(".xz") else open(path, encoding="utf-8")) as file:
        names = next(csv.reader(file))
        return {name: column for name, column in zip(names, np.loadtxt(file, delimiter=",").T)}


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    table = read_table(sys.argv[1])
    column = sys.argv[3] if len(sys.argv) == 4 else "total_field_anomaly_nt"
    if column not in table:
        sys.exit(f"{sys.argv[1]} has no column {column}; it has {', '.join(table)}.")
    points = np.stack([table["longitude"], table["latitude"]], axis=1)

    mesh = tipp.delaunay_2d(points, alpha=0.02, point_data={"field": table[column]})
    image = tipp.resample(mesh, dimensions=(600, 0, 0), null_value=np.nan)
    grid = tipp.as_array(image, "field")

    low, high = np.nanpercentile(grid, [2, 98])
    save_png(sys.argv[2], lit(coloured(grid, ANOMALY, low, high), grid, 3 / (high - low)))
    print(f"{len(points)} points, {len(mesh.cells)} triangles, {grid.shape[1]} x {grid.shape[0]} samples, "
          f"{column} from {np.nanmin(grid):.0f} to {np.nanmax(grid):.0f}")


if __name__ == "__main__":
    main()
