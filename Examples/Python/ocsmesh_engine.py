"""An engine for OCSMesh that makes meshes with tipp, for boundaries and size functions of any length.

    import ocsmesh_engine
    ocsmesh_engine.register()
    engine = get_mesh_engine("tipp", min_angle=30)     # of ocsmesh.engines.factory
    mesh = engine.generate(shape, sizing)

The sizing is the length of edges in the shape's unit: a number, or a MeshData whose values are lengths. Boundaries get
further points where sizes or angles need them; with keep_border=True they do not.
"""
import numpy as np
from ocsmesh.engines import factory
from ocsmesh.engines.base import BaseMeshEngine, BaseMeshOptions
from ocsmesh.internal import MeshData

import tipp


class TippOptions(BaseMeshOptions):
    """The arguments of tipp.mesh(), such as min_angle=30, smooth=5, shortest_edge=10.0 or keep_border=True."""

    def __init__(self, **arguments):
        self._arguments = arguments

    def get_config(self):
        return dict(self._arguments)


class TippEngine(BaseMeshEngine):
    """Meshes by exact Delaunay refinement: no angle is below min_angle, and no triangle larger than its size allows."""

    def generate(self, shape, sizing=None, seed=None):
        """Returns a mesh of the polygons of a GeoSeries. The points of `seed` that are inside become nodes."""
        points = None if seed is None else seed.coords
        found = tipp.mesh(points, polygons=[shape.union_all()], **self._arguments(sizing))
        return _mesh_data(found.points, found.cells, getattr(shape, "crs", None))

    def remesh(self, mesh, remesh_region=None, sizing=None, seed=None):
        """Returns the mesh with new triangles for those that lie in the region, or for all if there is none.

        The edges between old and new triangles are kept. So are the nodes and triangles outside of the region.
        """
        if len(mesh.quad):
            raise NotImplementedError("tipp makes triangles; split the quadrilaterals first.")
        triangles = np.asarray(mesh.tria)
        is_old = np.zeros(len(triangles), bool)
        if remesh_region is not None:
            is_old[:] = True
            is_old[_open(mesh).cells_in(polygon=remesh_region.union_all(), whole=True)] = False
        nodes, rings = _border(triangles[~is_old])
        border = mesh.coords[nodes]
        inner = np.zeros((0, 2)) if seed is None else seed.coords
        arguments = self._arguments(sizing)
        if is_old.any():
            arguments["keep_border"] = True  # the old triangles beside it have no further nodes
        found = tipp.mesh(np.concatenate([border, inner]), polygons=rings, **arguments)
        kept, old = np.unique(triangles[is_old], return_inverse=True)
        # Nodes of the result: those of old triangles, then new ones; border nodes of both are those of old triangles.
        ids = np.arange(len(found.points)) + len(kept)
        at = np.searchsorted(kept, nodes)
        is_shared = np.isin(nodes, kept)
        ids[:len(nodes)][is_shared] = at[is_shared]
        coords = np.concatenate([mesh.coords[kept], found.points[:, :2]])
        return _mesh_data(coords, np.concatenate([old.reshape(-1, 3), ids[found.cells]]), mesh.crs)

    def _arguments(self, sizing):
        arguments = self._options.get_config()
        if isinstance(sizing, (int, float)):
            arguments["size"] = float(sizing)
        elif sizing is not None:
            arguments["size"] = _size_function(sizing)
        return arguments


def register():
    """Makes "tipp" a name of get_mesh_engine()."""
    factory._ENGINES["tipp"] = (TippEngine, TippOptions)


def _triangles(mesh):
    """Returns the triangles of a MeshData, or those of its nodes' Delaunay triangulation if it has none."""
    return np.asarray(mesh.tria) if len(mesh.tria) else tipp.delaunay(mesh.coords)


def _open(mesh):
    """Opens a MeshData for queries."""
    return tipp.open(tipp.Mesh(np.column_stack([mesh.coords, np.zeros(mesh.num_nodes)]), _triangles(mesh)))


def _size_function(sizing):
    """Returns sizes as a function of x and y: linear in the triangles, and beyond them as at their nearest location."""
    opened, triangles = _open(sizing), _triangles(sizing)
    values = np.asarray(sizing.values, float).reshape(sizing.num_nodes, -1)[:, 0]

    def size(x, y):
        nearest = opened.closest(np.column_stack([np.ravel(x), np.ravel(y)]))
        corners = triangles[nearest.cells]
        from_corner = sizing.coords[corners] - nearest.points[:, None, :2]
        opposite = [_cross(from_corner[:, (i + 1) % 3], from_corner[:, (i + 2) % 3]) for i in range(3)]
        weights = np.column_stack(opposite) / sum(opposite)[:, None]
        return (weights * values[corners]).sum(axis=1).reshape(np.shape(x))

    return size


def _cross(u, v):
    return u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]


def _border(triangles):
    """Returns the nodes of edges that have one triangle, and the closed lines of these edges, which index the nodes.

    The lines have the triangles to their left, so that outer ones are counter-clockwise and those of holes clockwise.
    """
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    inner = {(a, b) for a, b in edges.tolist()}
    nodes = sorted({a for a, b in inner if (b, a) not in inner} | {b for a, b in inner if (b, a) not in inner})
    index = {node: i for i, node in enumerate(nodes)}
    following = {}
    for a, b in sorted(inner):
        if (b, a) not in inner:
            following.setdefault(index[a], []).append(index[b])
    rings = []
    while following:
        ring = [min(following)]
        while True:
            choices = following[ring[-1]]
            ring.append(choices.pop())
            if not choices:
                del following[ring[-2]]
            if ring[-1] == ring[0]:
                break
        rings.append(ring[:-1])
    return np.array(nodes, int), rings


def _mesh_data(points, triangles, crs):
    """Returns a MeshData without the points that no triangle has."""
    used, ids = np.unique(triangles, return_inverse=True)
    return MeshData(coords=points[used, :2], tria=ids.reshape(-1, 3), crs=crs)
