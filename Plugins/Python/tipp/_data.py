# SPDX-License-Identifier: BSD-3-Clause
"""Meshes and images for Pythons without VTK. Where VTK is installed, the functions return its data sets."""
from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np


class Data:
    """What Mesh and Image have in common."""

    point_data: dict[str, np.ndarray]
    cell_data: dict[str, np.ndarray]

    def array(self, name: str) -> np.ndarray:
        """An array of the points, else of the cells, else of a mesh's lines."""
        groups = [self.point_data, self.cell_data, getattr(self, "line_data", {})]
        for arrays in groups:
            if name in arrays:
                return arrays[name]
        raise KeyError(f"there is no array '{name}'; there are {[known for arrays in groups for known in arrays]}.")


@dataclass
class Mesh(Data):
    """A mesh of triangles or tetrahedra.

    `points` are (n, 3) coordinates, `cells` (m, 3) or (m, 4) point ids; `lines` and `vertices` are what
    delaunay_2d(alpha=...) leaves besides triangles. With marks="lines", `lines` are those of the constraints and
    `line_data["ConstraintId"]` tells which.
    """

    points: np.ndarray
    cells: np.ndarray
    point_data: dict[str, np.ndarray] = field(default_factory=dict)
    cell_data: dict[str, np.ndarray] = field(default_factory=dict)
    lines: np.ndarray | None = None
    vertices: np.ndarray | None = None
    line_data: dict[str, np.ndarray] = field(default_factory=dict)


@dataclass
class Image(Data):
    """Samples at origin + index * spacing; as_array() gives them in the image's shape."""

    origin: tuple[float, float, float]
    spacing: tuple[float, float, float]
    dimensions: tuple[int, int, int]
    point_data: dict[str, np.ndarray] = field(default_factory=dict)
    cell_data: dict[str, np.ndarray] = field(default_factory=dict)

    def array(self, name: str) -> np.ndarray:
        """An array in the image's shape, (z, y, x) without axes of one sample."""
        values = super().array(name)
        shape = [n for n in reversed(self.dimensions) if n > 1] or [1]
        return values.reshape(*shape, *values.shape[1:])
