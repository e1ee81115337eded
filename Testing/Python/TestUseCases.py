# SPDX-License-Identifier: BSD-3-Clause
"""The benchmark of use cases must run without scipy and gdal, and report that they are missing.

Usage: TestUseCases.py PROGRAM TIPP [unittest's options]
"""
import contextlib
import importlib.util
import io
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

import numpy as np

import tipp

PROGRAM, TOOL = sys.argv[1:3]
del sys.argv[1:3]
specification = importlib.util.spec_from_file_location("use_cases", PROGRAM)
use_cases = importlib.util.module_from_spec(specification)
specification.loader.exec_module(use_cases)


def lines_of_input(name, path, width):
    """The output of the benchmark if no peer is installed."""
    printed = io.StringIO()
    with mock.patch.object(sys, "argv", [PROGRAM, TOOL, f"{name}={path}:{width}"]), \
            mock.patch("importlib.util.find_spec", return_value=None), \
            mock.patch("shutil.which", return_value=None), contextlib.redirect_stdout(printed):
        use_cases.main()
    return printed.getvalue().splitlines()


def lines_of(points, width):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "points.npy"
        np.save(path, points)
        return lines_of_input("small", path, width)


class UseCases(unittest.TestCase):
    def setUp(self):
        self.points = np.random.default_rng(1).random((500, 3)) * (2, 1, 10)

    def test_absent_peers_are_reported(self):
        head, memory, files = lines_of(self.points, 20)
        self.assertRegex(head, r"^small: 500 points, 20 x 10 samples$")
        self.assertRegex(memory, r"^  in memory: ours \d+\.\d{3} s; scipy is not installed$")
        self.assertRegex(files, r"^  from file to file: ours \d+\.\d{3} s; gdal_grid is not installed$")

    def test_a_mesh_is_sampled_beside_vtk(self):
        mesh = tipp.delaunay_2d(self.points[:, :2], point_data={"value": self.points[:, 2]})
        with tempfile.TemporaryDirectory() as folder:
            path = f"{folder}/mesh.tipp"
            tipp.write(mesh, path)
            head, memory = lines_of_input("small", path, 20)
        self.assertRegex(head, r"^small: \d+ triangles, 20 x 10 samples$")
        self.assertRegex(memory, r"^  in memory: ours \d+\.\d{3} s, vtkProbeFilter .* matplotlib is not installed$")

    def test_points_without_a_value_are_left_out(self):
        self.points[7, 2] = np.nan
        self.assertIn("499 points", lines_of(self.points, 20)[0])

    def test_missing_arguments_show_the_usage(self):
        with mock.patch.object(sys, "argv", [PROGRAM, TOOL]), self.assertRaisesRegex(SystemExit, "Usage"):
            use_cases.main()


if __name__ == "__main__":
    unittest.main()
