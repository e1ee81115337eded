# SPDX-License-Identifier: BSD-3-Clause
"""Ctrl-C and other threads of Python while the package's functions run."""
import os
import pathlib
import signal
import tempfile
import threading
import unittest
import unittest.mock

import numpy as np

import tipp


def random_points(count):
    return np.random.default_rng(5).random((count, 3))


def files_in(folder):
    root = pathlib.Path(folder)
    return {str(f.relative_to(root)): f.read_bytes() for f in root.rglob("*") if f.is_file()}


class Interrupt(unittest.TestCase):
    def setUp(self):
        # A shell that starts this program in the background makes it ignore Ctrl-C.
        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(signal.SIGINT, signal.default_int_handler))

    def test_ctrl_c_stops_a_triangulation(self):
        points = random_points(100_000)
        former = signal.getsignal(signal.SIGINT)
        calls = self.interrupt_at(3, lambda: tipp.delaunay(points, threads=1, progress_bar=True))
        self.assertEqual(calls, 3)
        self.assertIs(signal.getsignal(signal.SIGINT), former)
        self.assertEqual(tipp.delaunay(points[:100]).shape[1], 3)

    def interrupt_at(self, call, work):
        """Sends Ctrl-C when progress has been shown that many times. Returns how often it was shown in all."""
        calls = []

        def show(fraction):
            calls.append(fraction)
            if len(calls) == call:
                signal.raise_signal(signal.SIGINT)

        with unittest.mock.patch("tipp._arguments._show", show), self.assertRaises(KeyboardInterrupt):
            work()
        return len(calls)

    def test_ctrl_c_stops_write_and_read_at_once(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "mesh.tipp")
            tipp.delaunay_file(self.save_points(folder), path)
            again = os.path.join(folder, "again.tipp")
            whole = tipp.read(path)
            for call in (1, 2, 5, 15):
                calls = self.interrupt_at(call, lambda: tipp.write(whole, again, progress_bar=True))
                self.assertLessEqual(calls, call + 1)
                self.assertEqual(sorted(os.listdir(folder)), ["mesh.tipp", "points.npy"])
            self.assertLessEqual(self.interrupt_at(1, lambda: tipp.read(path, progress_bar=True)), 2)

    def save_points(self, folder):
        path = os.path.join(folder, "points.npy")
        np.save(path, random_points(20_000))
        return path

    def test_other_threads_may_call(self):
        shapes = []
        thread = threading.Thread(target=lambda: shapes.append(tipp.delaunay(random_points(100)).shape))
        thread.start()
        thread.join()
        self.assertEqual(shapes[0][1], 3)

    def test_a_run_out_of_core_is_resumed_after_ctrl_c(self):
        def press(fraction):
            if fraction > 0.4:
                signal.raise_signal(signal.SIGINT)

        with tempfile.TemporaryDirectory() as folder:
            points = os.path.join(folder, "points.npy")
            np.save(points, random_points(60_000)[:, :2])
            whole, mesh = os.path.join(folder, "whole.tipp"), os.path.join(folder, "mesh.tipp")
            tipp.delaunay_file(points, whole, memory="1M")
            with unittest.mock.patch("tipp._arguments._show", press), self.assertRaises(KeyboardInterrupt):
                tipp.delaunay_file(points, mesh, memory="1M", progress_bar=True)
            self.assertFalse(os.path.exists(mesh))
            with self.assertRaisesRegex(RuntimeError, "resume that run"):
                tipp.delaunay_file(points, mesh, memory="1M")
            self.assertEqual(tipp.delaunay_file(points, mesh, memory="1M", resume=True)["resumed"], 1)
            self.assertEqual(files_in(mesh), files_in(whole))


if __name__ == "__main__":
    unittest.main()
