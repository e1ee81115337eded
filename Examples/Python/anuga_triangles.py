"""Makes the meshes of ANUGA with tipp: call use_tipp() before the first mesh is made.

ANUGA makes its meshes with the packages meshpy or triangle, which both wrap Triangle, whose licence keeps it out of
Debian. tipp.triangulate() takes the dictionaries and switches of the package triangle, so it is put in its place.

    import anuga_triangles
    anuga_triangles.use_tipp()
    import anuga
    domain = anuga.create_domain_from_regions(...)
"""
import sys
import types

import tipp


def use_tipp():
    """Lets `import triangle` give tipp.triangulate(), and `import meshpy` fail, which ANUGA would prefer."""
    triangle = types.ModuleType("triangle", "The package triangle, by tipp.")
    triangle.triangulate = tipp.triangulate
    sys.modules["triangle"] = triangle
    sys.modules["meshpy"] = sys.modules["meshpy.triangle"] = None


if __name__ == "__main__":
    use_tipp()
    import triangle

    # A channel in a floodplain as ANUGA's mesh engine asks for it: p, the input's segments; q28, the smallest angle; a, the
    # areas of regions; A, their numbers; n, neighbours; and markers of segments, which are its boundary tags.
    plain = {"vertices": [(0, 0), (1000, 0), (1000, 600), (0, 600), (0, 280), (1000, 320)],
             "segments": [(0, 1), (1, 5), (5, 2), (2, 3), (3, 4), (4, 0), (4, 5)],
             "segment_markers": [1, 2, 2, 3, 4, 4, 5],
             "regions": [(500, 100, 7, 2000.0), (500, 500, 8, 200.0)]}
    found = triangle.triangulate(plain, "jQpzq28aAn")
    north = found["triangle_attributes"].ravel() == 8
    print(len(found["vertices"]), "points,", len(found["triangles"]), "triangles,", north.sum(), "of them in the north;",
          "tags of segments", sorted(set(found["segment_markers"].ravel().tolist())))
