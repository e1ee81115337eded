# SPDX-License-Identifier: BSD-3-Clause
"""Makes a storm surge at a coast as ADCIRC writes it: a grid, and water levels at its nodes through a day.

Usage: made_surge.py COAST.14 LEVELS.63      (coordinates and levels in metres, times in seconds; 60 by 40 km)
"""
import sys

import numpy as np

COLUMNS, ROWS = 160, 110
STEPS, SECONDS = 49, 1800  # between steps
DRY = -99999


def ground(x, y):
    """The ground's elevation: the sea, a beach with dunes, a valley and a hill."""
    inland = y / 40
    valley = np.exp(-(((x - 22 - 6 * np.sin(y / 9)) / 2.5) ** 2)) * np.clip(inland - 0.25, 0, 1)
    hill = 7 * np.exp(-((x - 44) ** 2 + (y - 26) ** 2) / 20)
    dunes = 2.5 * np.exp(-(((y - 14 - np.sin(x / 5)) / 0.8) ** 2)) * (1 - np.exp(-(((x - 22) / 3) ** 2)))
    return -14 + 32 * inland**1.1 - 6 * inland**2 - 9 * valley + hill + dunes


def level(x, y, hours):
    """The water's level: a tide, and a surge that grows inland and comes later there."""
    late = hours - 12 - y / 25
    surge = (2.4 + y / 25) * np.exp(-((late / 3.5) ** 2)) * (1 - 0.3 * np.cos(x / 19))
    return surge + 0.5 * np.sin(2 * np.pi * hours / 12.4)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    random = np.random.default_rng(2)
    column, row = np.meshgrid(np.arange(COLUMNS), np.arange(ROWS))
    inner = (column % (COLUMNS - 1) > 0) & (row % (ROWS - 1) > 0)
    x = 60 * (column + np.where(inner, random.uniform(-0.3, 0.3, column.shape), 0)) / (COLUMNS - 1)
    y = 40 * (row + np.where(inner, random.uniform(-0.3, 0.3, column.shape), 0)) / (ROWS - 1)
    x, y = x.ravel(), y.ravel()
    first = (row[:-1, :-1] * COLUMNS + column[:-1, :-1]).ravel() + 1
    triangles = np.concatenate([np.stack([first, first + 1, first + COLUMNS], 1),
                                np.stack([first + 1, first + COLUMNS + 1, first + COLUMNS], 1)])
    with open(sys.argv[1], "w", encoding="ascii") as file:
        file.write(f"a coast\n{len(triangles)} {len(x)}\n")
        file.writelines(f"{i} {1000 * a:.2f} {1000 * b:.2f} {-h:.3f}\n"
                        for i, (a, b, h) in enumerate(zip(x, y, ground(x, y)), 1))
        file.writelines(f"{i} 3 {a} {b} {c}\n" for i, (a, b, c) in enumerate(triangles, 1))
        file.write("0\n0\n0\n0\n")  # no boundaries
    with open(sys.argv[2], "w", encoding="ascii") as file:
        file.write(f"a surge\n{STEPS} {len(x)} {SECONDS} 1 1\n")
        for step in range(STEPS):
            values = level(x, y, step * SECONDS / 3600)
            values[values <= ground(x, y)] = DRY
            file.write(f"{step * SECONDS} {step}\n")
            file.writelines(f"{i} {value:.4f}\n" for i, value in enumerate(values, 1))


main()
