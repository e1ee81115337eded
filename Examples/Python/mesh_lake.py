"""Makes a mesh of a lake with an island, fine at the shores, and prints what it has."""
import numpy as np

import tipp


def shore(radius, corners):
    """Returns a closed, wavy line around the origin, counter-clockwise."""
    angles = np.linspace(0, 2 * np.pi, corners, endpoint=False)
    radii = radius * (1 + 0.1 * np.sin(5 * angles) + 0.05 * np.sin(11 * angles))
    return np.column_stack([radii * np.cos(angles), radii * np.sin(angles)])


def length_of_edges(x, y):
    """Returns 20 m at the island, growing to 100 m."""
    return np.clip(20 + 0.1 * (np.hypot(x, y) - 300), 20, 100)


lake, island = shore(2000, 200), shore(300, 60)
mesh = tipp.mesh(polygons=[lake, island[::-1]], min_angle=30, size=length_of_edges)

outside = np.count_nonzero(mesh.cell_data["OutsideBounds"])
print(len(mesh.points), "points,", len(mesh.cells), "triangles,", outside, "of them outside of the bounds")
