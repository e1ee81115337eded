# SPDX-License-Identifier: BSD-3-Clause
"""Draws two triangulations of a lake's points: without constraints, and with its shore and islands as polygons.

Usage: constraints_picture.py POINTS.txt PICTURE.png SHORE ISLAND...      (POINTS: a line that is skipped, then x and y:
       first the shore's points in order, then those of each island; SHORE, ISLAND: the numbers of their points)
"""
import sys

import numpy as np

import tipp
from pictures import save_png

WIDTH = 620  # pixels of one view
EDGES, SHORE = (0.45, 0.62, 0.78), (0.70, 0.15, 0.10)


def read_outlines(points, counts):
    """Returns the shore, counter-clockwise, and the islands, clockwise."""
    rings = np.split(points[: sum(counts)], np.cumsum(counts)[:-1])
    for i, ring in enumerate(rings):
        x, y = ring.T
        is_left = np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) > 0
        rings[i] = ring if is_left == (i == 0) else ring[::-1]
    return rings


def draw(picture, ends, low, scale, colour, left):
    """Draws lines from ends[:, 0] to ends[:, 1]."""
    for a, b in (ends - low) * scale:
        count = 2 + int(2 * np.abs(b - a).max())
        x, y = (a + (b - a) * np.linspace(0, 1, count)[:, None]).round().astype(int).T
        picture[y + 10, x + 10 + left] = colour


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    points = np.loadtxt(sys.argv[1], skiprows=1)
    rings = read_outlines(points, [int(count) for count in sys.argv[3:]])
    plain = tipp.delaunay(points)
    lake = tipp.delaunay_2d(points, polygons=rings)
    kept = lake.cells

    low, size = points.min(axis=0), np.ptp(points, axis=0)
    scale = (WIDTH - 20) / size[0]
    picture = np.ones((int(size[1] * scale) + 21, 2 * WIDTH, 3))
    shore = np.concatenate([np.stack([ring, np.roll(ring, -1, axis=0)], axis=1) for ring in rings])
    inside = lake.points[:, :2]
    for left, places, triangles in ((0, points, plain), (WIDTH, inside, kept)):
        edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
        draw(picture, places[edges], low, scale, EDGES, left)
        draw(picture, shore, low, scale, SHORE, left)
    save_png(sys.argv[2], picture)
    print(f"{len(points)} points, {len(rings)} outlines, {len(plain)} triangles, {len(kept)} inside")


if __name__ == "__main__":
    main()
