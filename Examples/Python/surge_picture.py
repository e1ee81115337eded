# SPDX-License-Identifier: BSD-3-Clause
"""Draws a flood map: the ground, shaded, and how deep the water stood on what is land.

Usage: surge_picture.py DEPTH.npy LEVEL.npy PICTURE.png
(rows x columns: the depth of the ground, positive down, and the highest level; NaN where it stayed dry)
"""
import sys

import numpy as np

from pictures import TERRAIN, coloured, lit, save_png

WATER = [(0.80, 0.90, 0.97), (0.42, 0.68, 0.90), (0.10, 0.35, 0.72), (0.05, 0.12, 0.40)]
SEA = (0.62, 0.72, 0.80)
SHADES = 24  # of a colour: few make small files


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    ground, level = -np.load(sys.argv[1]), np.load(sys.argv[2])
    flooded = (level > ground) & (ground > 0)
    picture = lit(coloured(ground, TERRAIN, 0, 14), ground, 0.25)
    picture[ground <= 0] = SEA
    picture[flooded] = coloured(level - ground, WATER, 0, 4)[flooded]
    save_png(sys.argv[3], np.round(picture * SHADES) / SHADES)
    print(f"flooded: {flooded.sum()} of {(ground > 0).sum()} samples on land, up to {np.nanmax(np.where(flooded, level - ground, 0)):.1f} m deep")


main()
