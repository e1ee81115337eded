# SPDX-License-Identifier: BSD-3-Clause
"""Draws the edges of a mesh, coloured by their lengths, and its border.

Usage: mesh_picture.py MESH PICTURE.png [WIDTH]      (MESH: .vtu or another file of a mesh; WIDTH: in pixels, default 800)
"""
import sys

import numpy as np

import tipp
from pictures import coloured, save_png

LENGTHS = [(0.45, 0.10, 0.35), (0.85, 0.35, 0.25), (0.90, 0.65, 0.30), (0.35, 0.60, 0.75), (0.25, 0.40, 0.65)]
BORDER = (0.1, 0.1, 0.1)
FINER = 3  # pixels are drawn so many times finer and then averaged
SHADES = 7  # of a colour: few make small files


def edges_of(triangles):
    """Returns the edges as pairs of ids, and the number of triangles at each."""
    pairs = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    return np.unique(np.sort(pairs, axis=1), axis=0, return_counts=True)


def draw(picture, ends, colours, thick):
    """Draws lines from ends[:, 0] to ends[:, 1], in pixels."""
    for (a, b), colour in zip(ends, colours):
        steps = np.linspace(0, 1, 2 + int(2 * np.abs(b - a).max()))[:, None]
        x, y = (a + (b - a) * steps).astype(int).T
        for dx in range(thick):
            for dy in range(thick):
                picture[y + dy, x + dx] = colour


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    width = int(sys.argv[3]) if len(sys.argv) > 3 else 800
    mesh = tipp.read(sys.argv[1])
    xy = mesh.points[:, :2]
    edges, sides = edges_of(mesh.cells)
    lengths = np.log(np.linalg.norm(xy[edges[:, 0]] - xy[edges[:, 1]], axis=1))

    low, size = xy.min(axis=0), np.ptp(xy, axis=0)
    margin = 10 * FINER
    scale = (width * FINER - 2 * margin) / size[0]
    picture = np.ones((int(size[1] * scale) // FINER * FINER + 2 * margin, width * FINER, 3))
    ends = (xy[edges] - low) * scale + margin
    draw(picture, ends, coloured(lengths, LENGTHS, *np.percentile(lengths, [2, 98])), FINER - 1)
    draw(picture, ends[sides == 1], np.tile(BORDER, (np.sum(sides == 1), 1)), FINER + 1)
    rows, columns = picture.shape[0] // FINER, width
    picture = picture.reshape(rows, FINER, columns, FINER, 3).mean(axis=(1, 3))
    save_png(sys.argv[2], np.round(picture * SHADES) / SHADES)
    print(f"{len(xy)} points, {len(mesh.cells)} triangles, edges of {np.exp(lengths.min()):.3g} to {np.exp(lengths.max()):.3g}")


if __name__ == "__main__":
    main()
