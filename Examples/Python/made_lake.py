# SPDX-License-Identifier: BSD-3-Clause
"""Makes a lake with islands: its shores as a .poly file, and soundings.

Usage: made_lake.py LAKE.poly SOUNDINGS.csv      (coordinates and depths in metres; the lake is 20 km wide)
"""
import math
import random
import sys

ISLANDS = [(-4200, 900, 1100), (-900, -1500, 450), (3400, 1300, 800), (4300, -900, 260), (600, 2100, 180)]  # x, y, radius
DEEPEST = 60


def shore(x, y, width, height, count, rough, seed):
    """Returns the corners of a shore around a place, counter-clockwise: an ellipse with bays."""
    waves = random.Random(seed)
    bays = [(k, rough / k**0.8 * waves.uniform(-1, 1), waves.uniform(0, 2 * math.pi)) for k in range(2, 40)]
    corners = []
    for i in range(count):
        angle = 2 * math.pi * i / count
        r = 1 + sum(size * math.cos(k * angle + phase) for k, size, phase in bays)
        corners.append((x + width / 2 * r * math.cos(angle), y + height / 2 * r * math.sin(angle)))
    return corners


def write_poly(path, shores, holes):
    """Writes the closed lines in the format of Triangle."""
    corners = [corner for ring in shores for corner in ring]
    with open(path, "w", encoding="ascii") as file:
        file.write(f"{len(corners)} 2 0 0\n")
        file.writelines(f"{i} {x:.2f} {y:.2f}\n" for i, (x, y) in enumerate(corners, 1))
        file.write(f"{len(corners)} 0\n")
        first = number = 1
        for ring in shores:
            for i in range(len(ring)):
                file.write(f"{number} {first + i} {first + (i + 1) % len(ring)}\n")
                number += 1
            first += len(ring)
        file.write(f"{len(holes)}\n")
        file.writelines(f"{i} {x:.2f} {y:.2f}\n" for i, (x, y) in enumerate(holes, 1))


def depth(x, y):
    """The depth in metres: a basin with a trench, shallow at the shores."""
    basin = max(0.0, 1 - (x / 10500) ** 2 - (y / 6500) ** 2)
    trench = math.exp(-((y - 0.25 * x) / 700) ** 2)
    near = min(1, *(max(0, math.hypot(x - a, y - b) / r - 1) for a, b, r in ISLANDS))
    return 1 + DEEPEST * near * basin * (0.4 + 0.6 * trench)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    shores = [shore(0, 0, 20000, 11000, 480, 0.045, 3)]
    shores += [shore(x, y, 2 * r, 1.5 * r, max(24, r // 15), 0.08, x) for x, y, r in ISLANDS]
    write_poly(sys.argv[1], shores, [(x, y) for x, y, _ in ISLANDS])
    with open(sys.argv[2], "w", encoding="ascii") as file:
        file.write("x,y,depth\n")
        for x in range(-11000, 11001, 100):
            file.writelines(f"{x},{y},{depth(x, y):.2f}\n" for y in range(-7000, 7001, 100))


if __name__ == "__main__":
    main()
