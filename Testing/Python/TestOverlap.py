# SPDX-License-Identifier: BSD-3-Clause
"""tipp.remap, tipp.volume and conservative tipp.resample against exact rational arithmetic."""
import unittest
import warnings
from fractions import Fraction

import numpy as np

import tipp


def surface(count, seed, scale=1.0, shift=(0.0, 0.0)):
    """A triangulation of random points with random heights, and arrays of points and of cells."""
    random = np.random.default_rng(seed)
    points = scale * random.random((count, 3)) + [*shift, 0]
    mesh = tipp.delaunay_2d(points, point_data={"depth": random.random(count)})
    mesh.cell_data["rain"] = random.random(len(mesh.cells))
    return mesh


def square(height, x=0.0, width=1.0, slope=0.0):
    corners = np.array([(x, 0, 0), (x + width, 0, 0), (x + width, width, 0), (x, width, 0)], float)
    corners[:, 2] = height + slope * (corners[:, 0] - x)
    return tipp.Mesh(corners, np.array([(0, 1, 2), (0, 2, 3)]), {"depth": corners[:, 2].copy()},
                     {"rain": np.array([height, height + 1.0])})


def rational(mesh, values):
    """The corners of each triangle, counter-clockwise, as rational x, y and value."""
    triangles = []
    for cell in mesh.cells:
        corners = [tuple(Fraction(float(number)) for number in (*mesh.points[i, :2], values[i])) for i in cell]
        triangles.append(corners if side(*corners) > 0 else corners[::-1])
    return triangles


def side(a, b, p):
    """Twice the area of the triangle a, b, p."""
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])


def clipped(polygon, distance):
    """The part of a polygon of any tuples where a linear function is not negative."""
    result = []
    for a, b in zip(polygon, polygon[1:] + polygon[:1]):
        of_a, of_b = distance(a), distance(b)
        if of_a >= 0:
            result.append(a)
        if of_a * of_b < 0:
            share = of_a / (of_a - of_b)
            result.append(tuple(u + share * (v - u) for u, v in zip(a, b)))
    return result


def common(first, second):
    """The common part of two triangles, with the value of the second one."""
    part = second
    for k in range(3):
        part = clipped(part, lambda p, k=k: side(first[k], first[(k + 1) % 3], p))
    return part


def at(triangle, p):
    """The value in a triangle's plane."""
    weights = [side(triangle[(k + 1) % 3], triangle[(k + 2) % 3], p) for k in range(3)]
    return sum(w * corner[2] for w, corner in zip(weights, triangle)) / sum(weights)


def area_and_integral(polygon):
    area = integral = Fraction(0)
    for a, b, c in zip(polygon[:1] * len(polygon), polygon[1:], polygon[2:]):
        area += side(a, b, c) / 2
        integral += side(a, b, c) * (a[2] + b[2] + c[2]) / 6
    return area, integral


def exact_volumes(before, after, window=None):
    """Cut, fill and the common area, exactly."""
    cut = fill = whole = Fraction(0)
    for first in rational(before, before.points[:, 2]):
        for second in rational(after, after.points[:, 2]):
            part = [(x, y, z - at(first, (x, y))) for x, y, z in common(first, second)]
            for axis, low, high in () if window is None else ((0, *window[:2]), (1, *window[2:])):
                part = clipped(part, lambda p, i=axis, v=low: p[i] - Fraction(v))
                part = clipped(part, lambda p, i=axis, v=high: Fraction(v) - p[i])
            whole += area_and_integral(part)[0]
            fill += area_and_integral(clipped(part, lambda p: p[2]))[1]
            cut -= area_and_integral(clipped(part, lambda p: -p[2]))[1]
    return [float(cut), float(fill), float(whole)]


def without_warnings(call):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return call()


class Volume(unittest.TestCase):
    def expect(self, expected, found):
        np.testing.assert_allclose([found.cut, found.fill, found.area], expected, rtol=0, atol=1e-14)

    def test_random_surfaces_have_the_volumes_of_rational_arithmetic(self):
        for seed in range(3):
            before, after = surface(12, 2 * seed), surface(15, 2 * seed + 1)
            self.expect(exact_volumes(before, after), tipp.volume(before, after))

    def test_bounds_cut_the_surfaces(self):
        before, after = surface(12, 1), surface(15, 2)
        window = (0.25, 0.75, 0.3, 0.6)
        self.expect(exact_volumes(before, after, window), tipp.volume(before, after, bounds=window))
        self.assertEqual(tipp.volume(before, after, bounds=window),
                         tipp.volume(before, after, bounds=tipp.Bounds(west=0.25, east=0.75, south=0.3, north=0.6)))

    def test_two_planes_have_the_volume_of_a_prism(self):
        result = tipp.volume(square(10.0, width=4.0), square(7.0, x=1.0, width=2.0))
        self.assertEqual(tipp.CutFill(cut=12.0, fill=0.0, net=-12.0, area=4.0, only_before=12.0, only_after=0.0), result)

    def test_planes_that_cross_have_cut_and_fill(self):
        result = tipp.volume(square(0.0, width=4.0), square(-1.0, width=4.0, slope=1.0))
        np.testing.assert_allclose(result, (2.0, 18.0, 16.0, 16.0, 0.0, 0.0), rtol=1e-15)

    def test_the_result_does_not_depend_on_threads(self):
        before, after = surface(3000, 1), surface(2500, 2)
        results = [tipp.volume(before, after, threads=threads) for threads in (1, 2, 5)]
        self.assertEqual(results[0], results[1])
        self.assertEqual(results[0], results[2])

    def test_surfaces_that_do_not_meet_are_an_error_that_names_both_ranges(self):
        with self.assertRaisesRegex(RuntimeError, "no area in common: .*x from 0 to 1 .*x from 7 to 8 .*reference system"):
            tipp.volume(square(0.0), square(0.0, x=7.0))

    def test_bounds_of_another_place_are_an_error(self):
        with self.assertRaisesRegex(RuntimeError, "bounds"):
            tipp.volume(square(0.0), square(1.0), bounds=(50, 51, 0, 1))

    def test_cells_with_heights_that_are_not_finite_are_left_out_with_a_warning(self):
        holed = square(1.0)
        holed.points[3, 2] = np.nan
        with self.assertWarnsRegex(RuntimeWarning, "^the surface after has cells .* not finite, which are left out: 1"):
            result = tipp.volume(square(0.0), holed)
        self.assertEqual((0.5, 0.5), (result.fill, result.area))

    def test_cells_that_overlap_are_a_warning(self):
        doubled = square(1.0)
        doubled = tipp.Mesh(doubled.points, np.concatenate([doubled.cells, doubled.cells]))
        with self.assertWarnsRegex(RuntimeWarning, "^the surface after has cells that overlap"):
            self.assertEqual(2.0, tipp.volume(square(0.0), doubled).fill)

    def test_a_volume_that_is_too_large_for_a_number_is_an_error(self):
        with self.assertRaisesRegex(RuntimeError, "too large for a number"):
            tipp.volume(square(-1e308), square(1e308))

    def test_a_surface_without_cells_is_an_error(self):
        empty = tipp.Mesh(np.zeros((0, 3)), np.zeros((0, 3), np.int64))
        with self.assertRaisesRegex(RuntimeError, "^the surface before has no cells with an area"):
            tipp.volume(empty, square(0.0))
        with self.assertRaisesRegex(RuntimeError, "and the surface after has no cells with an area"):
            tipp.volume(square(0.0), empty)

    def test_cells_with_a_volume_are_refused(self):
        solid = tipp.delaunay_3d(np.random.default_rng(1).random((20, 3)))
        with self.assertRaisesRegex(RuntimeError, "cells with a volume: give a surface"):
            tipp.volume(square(0.0), solid)


class Remap(unittest.TestCase):
    def test_means_are_those_of_rational_arithmetic(self):
        source, target = surface(15, 1), surface(12, 2)
        result = tipp.remap(source, target)
        goals = rational(target, target.points[:, 2])
        of_points = rational(source, source.point_data["depth"])
        for i, goal in enumerate(goals):
            area, depth, rain = Fraction(0), Fraction(0), Fraction(0)
            for triangle, value in zip(of_points, source.cell_data["rain"]):
                covered, integral = area_and_integral(common(goal, triangle))
                area += covered
                depth += integral
                rain += covered * Fraction(float(value))
            share = area / (side(*goal) / 2)
            self.assertAlmostEqual(float(share), result.cell_data["CoveredShare"][i], delta=1e-12)
            if share > Fraction(1, 1000):
                self.assertAlmostEqual(float(depth / area), result.cell_data["depth"][i], delta=1e-11)
                self.assertAlmostEqual(float(rain / area), result.cell_data["rain"][i], delta=1e-11)

    def test_the_result_has_the_cells_of_the_target_and_the_arrays_that_are_named(self):
        source, target = surface(50, 1), surface(40, 2)
        result = tipp.remap(source, target, arrays="rain")
        np.testing.assert_array_equal(target.points, result.points)
        np.testing.assert_array_equal(target.cells, result.cells)
        self.assertEqual({"rain", "CoveredShare"}, set(result.cell_data))
        self.assertEqual({}, result.point_data)
        self.assertEqual((np.dtype(float), (len(target.cells),)),
                         (result.cell_data["rain"].dtype, result.cell_data["rain"].shape))

    def test_cells_that_are_not_covered_have_the_null_value(self):
        apart = tipp.remap(square(1.0), square(0.0, x=5.0))
        self.assertTrue(np.isnan(apart.cell_data["rain"]).all())
        apart = tipp.remap(square(1.0), square(0.0, x=5.0), null_value=-9)
        self.assertEqual([-9.0, -9.0], apart.cell_data["rain"].tolist())
        self.assertEqual([0.0, 0.0], apart.cell_data["CoveredShare"].tolist())

    def test_components_are_averaged_each(self):
        source = square(1.0)
        source.cell_data["flow"] = np.array([(1.0, 2.0), (3.0, 6.0)])
        flow = tipp.remap(source, square(0.0, width=2.0), arrays="flow").cell_data["flow"]
        self.assertEqual((2, 2), flow.shape)
        np.testing.assert_allclose(flow, source.cell_data["flow"], rtol=1e-15)

    def test_an_array_that_the_source_does_not_have_is_a_key_error(self):
        with self.assertRaisesRegex(KeyError, "no array 'wind'"):
            tipp.remap(square(1.0), square(0.0), arrays="wind")

    def test_the_result_does_not_depend_on_threads(self):
        source, target = surface(3000, 1), surface(2500, 2)
        one = tipp.remap(source, target, threads=1)
        self.assertEqual(one, tipp.remap(source, target, threads=2))
        self.assertEqual(one, tipp.remap(source, target, threads=5))

    def test_the_result_is_of_the_kind_of_the_target_or_as_asked(self):
        vtk = tipp.remap(square(1.0), square(0.0).to_vtk())
        self.assertEqual("vtkPolyData", vtk.GetClassName())
        self.assertIsInstance(tipp.remap(square(1.0).to_vtk(), square(0.0)), tipp.Mesh)
        self.assertTrue(tipp.remap(square(1.0), square(0.0), return_type="vtk").IsA("vtkPolyData"))

    def test_cells_that_overlap_are_a_warning(self):
        doubled = square(1.0)
        doubled = tipp.Mesh(doubled.points, np.concatenate([doubled.cells, doubled.cells]), doubled.point_data)
        with self.assertWarnsRegex(RuntimeWarning, "2 cells of the result are covered more than once"):
            self.assertEqual([2.0, 2.0], tipp.remap(doubled, square(0.0)).cell_data["CoveredShare"].tolist())


class ConservativeResample(unittest.TestCase):
    def test_pixels_keep_the_integral_of_the_mesh(self):
        mesh = surface(500, 3)
        image = without_warnings(lambda: tipp.resample(
            mesh, (0, 1, 0, 1), (40, 30), arrays=["depth", "rain"], method="conservative", covered_share=True,
            null_value=np.nan))
        corners = mesh.points[mesh.cells][:, :, :2]
        a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
        areas = np.abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2
        shares = tipp.as_array(image, "CoveredShare")
        self.assertEqual((np.dtype(float), (30, 40)), (shares.dtype, shares.shape))
        covered = shares > 0
        pixel = shares[covered] * image.spacing[0] * image.spacing[1]
        self.assertAlmostEqual(areas.sum(), pixel.sum(), delta=1e-13)
        for name, values in (("rain", mesh.cell_data["rain"]), ("depth", mesh.point_data["depth"][mesh.cells].mean(axis=1))):
            self.assertAlmostEqual((areas * values).sum(), (pixel * tipp.as_array(image, name)[covered]).sum(), delta=1e-13)
        np.testing.assert_array_equal(covered, tipp.as_array(image, "vtkValidPointMask") == 1)

    def test_shares_are_left_out_unless_they_are_asked_for(self):
        image = tipp.resample(square(1.0), dimensions=(3, 3), arrays="rain", method="conservative")
        self.assertNotIn("CoveredShare", image.point_data)

    def test_a_pixel_without_a_width_is_an_error(self):
        with self.assertRaisesRegex(RuntimeError, "does not tell the width of its pixel"):
            tipp.resample(square(1.0), dimensions=(1, 3), arrays="rain", method="conservative")

    def test_meshes_with_a_volume_are_refused(self):
        solid = tipp.delaunay_3d(np.random.default_rng(1).random((20, 3)))
        with self.assertRaisesRegex(RuntimeError, "means are over areas: give a surface"):
            tipp.resample(solid, dimensions=(3, 3, 1), method="conservative")


if __name__ == "__main__":
    unittest.main()
