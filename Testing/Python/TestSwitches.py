# SPDX-License-Identifier: BSD-3-Clause
"""tipp.triangulate: the dictionaries and switches of the package triangle. Runs with and without VTK."""
import unittest

import numpy as np

import tipp

VERTICES = [[0, 0], [4, 0], [4, 4], [0, 4], [1, 1], [3, 1], [3, 3], [1, 3], [0.5, 0.5]]
SEGMENTS = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4]]
PLAIN = {"vertices": VERTICES}
GRAPH = {"vertices": VERTICES, "segments": SEGMENTS}
FULL = {
    **GRAPH, "vertex_attributes": [[i, 1.0] for i in range(9)], "vertex_markers": [[5 + i] for i in range(9)],
    "segment_markers": [[i + 2] for i in range(8)], "holes": [[2, 2]], "regions": [[0.1, 0.1, 7.0, 0.1]],
}
# The arrays, in the order of triangle 20250106, with their types and numbers of columns.
POINTS, CELLS = [("vertices", "<f8", 2), ("vertex_markers", "<i4", 1)], [("triangles", "<i4", 3)]
NEIGHBORS, EDGES = [("neighbors", "<i4", 3)], [("edges", "<i4", 2), ("edge_markers", "<i4", 1)]
LINES = [("segments", "<i4", 2), ("segment_markers", "<i4", 1)]
VALUES = [POINTS[0], ("vertex_attributes", "<f8", 2), POINTS[1]]
PLACES, ATTRIBUTES = [("holes", "<f8", 2), ("regions", "<f8", 4)], [("triangle_attributes", "<f8", 1)]
EXPECTED = [
    (PLAIN, "", POINTS + CELLS), (PLAIN, "a0.2", POINTS + CELLS), (PLAIN, "q", POINTS + CELLS),
    (PLAIN, "c", POINTS + CELLS + LINES), (PLAIN, "e", POINTS + CELLS + EDGES),
    (PLAIN, "en", POINTS + CELLS + NEIGHBORS + EDGES), (GRAPH, "p", POINTS + CELLS + LINES),
    (GRAPH, "pq", POINTS + CELLS + LINES), (GRAPH, "pqen", POINTS + CELLS + NEIGHBORS + LINES + EDGES),
    (GRAPH, "pc", POINTS + CELLS + LINES), (GRAPH, "pqA", POINTS + CELLS + LINES),
    (FULL, "p", VALUES + CELLS + LINES + PLACES), (FULL, "pq30a0.1", VALUES + CELLS + LINES + PLACES),
    (FULL, "pqAaen", VALUES + CELLS + ATTRIBUTES + NEIGHBORS + LINES + PLACES + EDGES),
    (FULL, "pqS3", VALUES + CELLS + LINES + PLACES), (FULL, "pqj", VALUES + CELLS + LINES + PLACES),
]


def areas(found):
    a, b, c = (found["vertices"][corner] for corner in found["triangles"].T)
    (px, py), (qx, qy) = (b - a).T, (c - a).T
    return (px * qy - py * qx) / 2


def angles(found):
    """Returns the smallest angle of each triangle, in degrees."""
    p = found["vertices"][found["triangles"]]
    result = []
    for i in range(3):
        (ux, uy), (vx, vy) = (p[:, i - 2] - p[:, i]).T, (p[:, i - 1] - p[:, i]).T
        result.append(np.degrees(np.arctan2(ux * vy - uy * vx, ux * vx + uy * vy)))
    return np.min(result, axis=0)


class Dictionaries(unittest.TestCase):
    def test_keys_types_and_columns_are_those_of_triangle(self):
        for given, switches, arrays in EXPECTED:
            with self.subTest(switches):
                found = tipp.triangulate(given, switches)
                self.assertEqual({name: (kind, columns) for name, kind, columns in arrays},
                                 {name: (values.dtype.str, values.shape[1]) for name, values in found.items()})

    def test_rows_fit_each_other(self):
        found = tipp.triangulate(FULL, "pq30AaenQ")
        for names in (("vertices", "vertex_attributes", "vertex_markers"), ("edges", "edge_markers"),
                      ("triangles", "triangle_attributes", "neighbors"), ("segments", "segment_markers")):
            self.assertEqual(1, len({len(found[name]) for name in names}))

    def test_vertices_come_first(self):
        np.testing.assert_array_equal(VERTICES, tipp.triangulate(FULL, "pq30a0.1")["vertices"][:9])

    def test_input_does_not_change(self):
        given = {name: np.array(values) for name, values in FULL.items()}
        tipp.triangulate(given, "pq30a0.1")
        for name, values in FULL.items():
            np.testing.assert_array_equal(values, given[name])

    def test_result_can_be_an_input(self):
        found = tipp.triangulate(FULL, "pq30")
        del found["triangles"]
        self.assertAlmostEqual(12, areas(tipp.triangulate(found, "pq30a0.1")).sum())


class Bounds(unittest.TestCase):
    def test_an_angle_without_a_number_is_20(self):
        vertices = np.random.default_rng(5).random((300, 2))
        found = tipp.triangulate({"vertices": vertices}, "q")
        self.assertTrue(20 - 1e-9 <= angles(found).min() < 22)

    def test_angle_and_area(self):
        found = tipp.triangulate(GRAPH, "pq33a.1")
        self.assertGreaterEqual(angles(found).min(), 33 - 1e-9)
        self.assertLessEqual(areas(found).max(), 0.1)

    def test_numbers_may_have_exponents(self):
        plain = tipp.triangulate(GRAPH, "pq32.5a0.05e")
        for switches in ("pq3.25e1a5e-2e", "pq32.5a.05e", "pq32.5a5E-02e", "pq32.5a5e-02e"):
            with self.subTest(switches):
                found = tipp.triangulate(GRAPH, switches)
                np.testing.assert_array_equal(plain["triangles"], found["triangles"])
                self.assertIn("edges", found)

    def test_areas_of_regions(self):
        given = {**GRAPH, "regions": [[0.1, 0.1, 1, 0.3], [2, 2, 2, -1]]}
        found = tipp.triangulate(given, "pqAa")
        outer = found["triangle_attributes"][:, 0] == 1
        self.assertLessEqual(areas(found)[outer].max(), 0.3)
        self.assertGreater(areas(found)[~outer].max(), 0.3)
        self.assertEqual({1, 2}, set(found["triangle_attributes"].ravel().tolist()))

    def test_an_area_and_those_of_regions(self):
        given = {**GRAPH, "regions": [[0.1, 0.1, 1, 0.02], [2, 2, 2, 9]]}
        found = tipp.triangulate(given, "pqAa0.1a")
        outer = found["triangle_attributes"][:, 0] == 1
        self.assertLessEqual(areas(found)[outer].max(), 0.02)
        self.assertLessEqual(areas(found)[~outer].max(), 0.1)
        self.assertGreater(areas(found)[~outer].max(), 0.02)

    def test_areas_of_regions_need_the_switch(self):
        self.assertGreater(areas(tipp.triangulate(FULL, "pqA")).max(), 0.1)

    def test_without_bounds_there_are_no_new_points(self):
        vertices = np.random.default_rng(3).random((60, 2))
        found = tipp.triangulate({"vertices": vertices})
        self.assertEqual(60, len(found["vertices"]))
        self.assertEqual({tuple(sorted(triangle)) for triangle in tipp.delaunay(vertices).tolist()},
                         {tuple(sorted(triangle)) for triangle in found["triangles"].tolist()})

    def test_no_points(self):
        self.assertEqual(9, len(tipp.triangulate(GRAPH, "pqa0.1S0")["vertices"]))
        self.assertEqual(12, len(tipp.triangulate(GRAPH, "pqa0.1S3")["vertices"]))

    def test_kept_segments(self):
        self.assertEqual(8, len(tipp.triangulate(GRAPH, "pqa0.1YY")["segments"]))
        border = tipp.triangulate(GRAPH, "pqa0.1Y")
        self.assertEqual(4, (border["segment_markers"] == 1).sum())
        self.assertGreater(len(border["segments"]), 8)

    def test_threads_do_not_matter(self):
        one, four = (tipp.triangulate(FULL, "pq30a0.001en", threads=count) for count in (1, 4))
        for name, values in one.items():
            np.testing.assert_array_equal(values, four[name])


class Domains(unittest.TestCase):
    def test_segments_need_p(self):
        self.assertAlmostEqual(16, areas(tipp.triangulate(FULL, "q")).sum())

    def test_holes(self):
        self.assertAlmostEqual(12, areas(tipp.triangulate(FULL, "pq")).sum())

    def test_segments_enclose_the_domain(self):
        inner = {"vertices": VERTICES, "segments": SEGMENTS[4:]}
        self.assertAlmostEqual(4, areas(tipp.triangulate(inner, "p")).sum())
        self.assertAlmostEqual(16, areas(tipp.triangulate(inner, "pc")).sum())

    def test_unused_vertices_are_left_out(self):
        inner = {"vertices": VERTICES, "segments": SEGMENTS[4:]}
        found = tipp.triangulate(inner, "pjen")
        self.assertEqual((4, 2), (len(found["vertices"]), len(found["triangles"])))
        self.assertEqual({0, 1, 2, 3}, set(found["segments"].ravel().tolist()))

    def test_mesh_is_refined_again(self):
        coarse = tipp.triangulate(FULL, "p")
        largest = np.full((len(coarse["triangles"]), 1), -1.0)
        largest[0] = 0.01
        given = {"vertices": coarse["vertices"], "triangles": coarse["triangles"], "triangle_max_area": largest}
        found = tipp.triangulate(given, "rqa")
        self.assertAlmostEqual(12, areas(found).sum())
        corners = coarse["vertices"][coarse["triangles"][0]]
        inside = np.ones(len(found["triangles"]), bool)
        for a, b in zip(corners, np.roll(corners, -1, axis=0)):
            (ux, uy), (vx, vy) = b - a, (found["vertices"][found["triangles"]].mean(axis=1) - a).T
            inside &= ux * vy > uy * vx
        self.assertLessEqual(areas(found)[inside].max(), 0.01)
        self.assertGreater(areas(found)[~inside].max(), 0.01)
        self.assertNotIn("segments", found)

    def test_a_mesh_around_a_hole_with_an_island_is_refined_again(self):
        wide = tipp.triangulate(GRAPH | {"holes": [[2, 2]]}, "p")
        island = np.array([[1.6, 1.6], [2.4, 1.7], [2, 2.3]])
        given = {"vertices": np.vstack([wide["vertices"], island]) + 1e6,
                 "triangles": np.vstack([wide["triangles"], len(wide["vertices"]) + np.arange(3)])}
        found = tipp.triangulate(given, "rq30a0.05")
        self.assertAlmostEqual(12 + 0.26, areas(found).sum(), places=6)

    def test_segments_of_a_mesh_are_kept(self):
        coarse = tipp.triangulate(GRAPH, "p")
        found = tipp.triangulate(coarse, "rpq30a0.1")
        inner = np.isin(found["vertices"][found["segments"]], (1, 3)).any(axis=(1, 2))
        self.assertTrue(inner.any())
        self.assertAlmostEqual(16, areas(found).sum())


class Markers(unittest.TestCase):
    def test_markers_of_segments(self):
        found = tipp.triangulate(FULL, "pq")
        for (a, b), (marker,) in zip(found["vertices"][found["segments"]], found["segment_markers"]):
            middle = (a + b) / 2
            side = [middle[1] == 0, middle[0] == 4, middle[1] == 4, middle[0] == 0,
                    middle[1] == 1, middle[0] == 3, middle[1] == 3, middle[0] == 1]
            self.assertIn(marker - 2, np.flatnonzero(side))

    def test_markers_of_vertices(self):
        found = tipp.triangulate({**FULL, "vertex_markers": [[0]] * 8 + [[9]]}, "pqa0.2")
        markers = found["vertex_markers"][:, 0]
        self.assertEqual([2, 2, 3, 4, 6, 6, 7, 8, 9], markers[:9].tolist())
        x, y = found["vertices"].T
        on_segment = np.isin(x, (0, 4)) | np.isin(y, (0, 4)) | (
            (np.isin(x, (1, 3)) | np.isin(y, (1, 3))) & (np.maximum(abs(x - 2), abs(y - 2)) == 1))
        np.testing.assert_array_equal(on_segment[9:], markers[9:] != 0)

    def test_markers_of_segments_come_before_the_border(self):
        given = {"vertices": VERTICES[:4], "segments": SEGMENTS[:4], "segment_markers": [[0], [0], [4], [5]]}
        self.assertEqual([5, 1, 4, 4], tipp.triangulate(given, "p")["vertex_markers"].ravel().tolist())

    def test_border_is_1_if_nothing_is_given(self):
        found = tipp.triangulate(GRAPH, "pqa0.2e")
        x, y = found["vertices"].T
        border = np.isin(x, (0, 4)) | np.isin(y, (0, 4))
        np.testing.assert_array_equal(border, found["vertex_markers"][:, 0])
        ends = found["vertices"][found["edges"]]
        same = (ends[:, 0] == ends[:, 1]) & np.isin(ends[:, 0], (0, 4))
        np.testing.assert_array_equal(same.any(axis=1), found["edge_markers"][:, 0])

    def test_hull_without_segments(self):
        found = tipp.triangulate(PLAIN, "e")
        self.assertEqual([1, 1, 1, 1, 0, 0, 0, 0, 0], found["vertex_markers"].ravel().tolist())
        self.assertEqual(4, found["edge_markers"].sum())

    def test_attributes_are_linear(self):
        given = {**FULL, "vertex_attributes": np.array(VERTICES) @ [[1.0, 3.0], [2.0, -1.0]]}
        found = tipp.triangulate(given, "pq30a0.1")
        np.testing.assert_allclose(found["vertices"] @ [[1.0, 3.0], [2.0, -1.0]], found["vertex_attributes"], atol=1e-12)

    def test_neighbors_share_the_opposite_edge(self):
        found = tipp.triangulate(GRAPH, "pqn")
        for triangle, beside in zip(found["triangles"], found["neighbors"]):
            for corner, other in enumerate(beside):
                edge = {*np.delete(triangle, corner).tolist()}
                if other >= 0:
                    self.assertTrue(edge <= {*found["triangles"][other].tolist()})
        self.assertEqual(sum(found["segment_markers"].ravel() == 1), (found["neighbors"] < 0).sum())


class Misuse(unittest.TestCase):
    def assert_refused(self, kind, message, given, switches="p"):
        with self.assertRaisesRegex(kind, message):
            tipp.triangulate(given, switches)

    def test_switches(self):
        for letter in "DXCvousBPNEIOgw ":
            self.assert_refused(ValueError, f"opts has the switch '{letter}', which is not supported", GRAPH, "pq" + letter)
        self.assert_refused(ValueError, "the angle of q is 35.0; give at most 34 degrees", GRAPH, "pq35")
        self.assert_refused(ValueError, "the area of a is 0.0; give a number above 0", GRAPH, "pa0")
        self.assert_refused(ValueError, "opts has the switch 'q.' without a number", GRAPH, "pq.")
        self.assert_refused(ValueError, "opts has the switch r, but tri has no key 'triangles'", GRAPH, "rq")

    def test_edges_of_three_triangles(self):
        given = {"vertices": [[0, 0], [1, 0], [0, 1], [1, 1]], "triangles": [[0, 1, 2], [0, 1, 3]]}
        self.assert_refused(ValueError, "the triangles 0 and 1 lie on the same side of the edge between vertices 0 and 1",
                            given, "rq")
        given["triangles"] = [[0, 1, 2], [3, 1, 1]]
        self.assert_refused(ValueError, "triangle 1 has the vertex 1 twice", given, "rq")

    def test_triangles_that_overlap(self):
        apart = [[0, 0], [4, 0], [0, 4]]
        for name, others in (("crossing", [[1, 1], [5, 1], [1, 5]]), ("inside", [[1, 1], [2, 1], [1, 2]])):
            with self.subTest(name):
                given = {"vertices": apart + others, "triangles": [[0, 1, 2], [3, 4, 5]]}
                self.assert_refused(ValueError, "give a mesh whose triangles do not overlap", given, "rq")

    def test_switches_without_effect(self):
        plain = tipp.triangulate(GRAPH, "pq")
        np.testing.assert_array_equal(plain["triangles"], tipp.triangulate(GRAPH, "pqQVziFl")["triangles"])

    def test_nothing_enclosed_gives_empty_arrays(self):
        found = tipp.triangulate({"vertices": VERTICES[:4], "segments": SEGMENTS[:3]}, "pq")
        self.assertEqual(found["triangles"].shape, (0, 3))
        self.assertEqual(found["segments"].shape, (0, 2))

    def test_keys(self):
        self.assert_refused(TypeError, "tri is of type list; give a dictionary", VERTICES)
        self.assert_refused(ValueError, "tri has no key 'vertices'", {})
        self.assert_refused(ValueError, "tri has the key 'point', which is not supported", {**GRAPH, "point": 1})
        self.assert_refused(ValueError, r"tri\['vertices'\] has the shape \(2, 3\)", {"vertices": [[1, 2, 3], [4, 5, 6]]})
        self.assert_refused(ValueError, "there is no vertex 9, because there are 9 vertices", {**GRAPH, "segments": [[0, 9]]})
        self.assert_refused(TypeError, "give integers", {**GRAPH, "segments": [[0.5, 1]]})
        self.assert_refused(ValueError, r"tri\['segment_markers'\] has 1 rows; give 8", {**GRAPH, "segment_markers": [[1]]})
        self.assert_refused(ValueError, r"tri\['holes'\] has a number that is NaN", {**GRAPH, "holes": [[np.nan, 0]]})


if __name__ == "__main__":
    unittest.main()
