# SPDX-License-Identifier: BSD-3-Clause
"""The wheel inside Python: threads, forks, layouts of arrays, memory, progress, Ctrl-C, help."""
import ast
import multiprocessing
import os
import pickle
import pydoc
import resource
import select
import signal
import subprocess
import sys
import threading
import unittest

import numpy as np

import tipp


def random_points(count, columns=2, kind=np.float64):
    return np.random.default_rng(7).random((count, columns)).astype(kind)


def canonical(triangles):
    return np.sort(np.sort(triangles, axis=1).view("i4,i4,i4"), axis=0)


def resident():
    """The resident memory of this process in bytes."""
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * resource.getpagesize()


def count(points):
    return len(tipp.delaunay(points, threads=2))


def count_in_child(points, queue):
    queue.put(len(tipp.delaunay(points)))


class Interpreter(unittest.TestCase):
    def test_every_layout_of_an_array_gives_the_same_triangles(self):
        wide = random_points(2000, 6)
        expected = canonical(tipp.delaunay(np.ascontiguousarray(wide[:, 1:3])))
        layouts = {
            "columns of a wider array": wide[:, 1:3],
            "Fortran's order": np.asfortranarray(wide[:, 1:3]),
            "the other byte order": wide[:, 1:3].astype(">f8"),
            "read-only": np.ascontiguousarray(wide[:, 1:3]),
            "a transposed array": np.ascontiguousarray(wide[:, 1:3].T).T,
            "lists": wide[:, 1:3].tolist(),
            "three columns": np.column_stack([wide[:, 1:3], wide[:, 5]]),
            "every second row": np.repeat(wide[:, 1:3], 2, axis=0)[::2],
        }
        layouts["read-only"].setflags(write=False)
        for name, points in layouts.items():
            with self.subTest(name):
                np.testing.assert_array_equal(expected, canonical(tipp.delaunay(points)))
        np.testing.assert_array_equal(expected, canonical(tipp.delaunay(wide[::-1, 1:3][::-1])))

    def test_sixteen_threads_of_python_triangulate_at_once(self):
        points = random_points(5000)
        expected = tipp.delaunay(points)
        results = [None] * 16

        def work(i):
            results[i] = tipp.delaunay(points)

        threads = [threading.Thread(target=work, args=(i,)) for i in range(16)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for result in results:
            np.testing.assert_array_equal(canonical(expected), canonical(result))

    def answer_of_child(self, work):
        """Returns what work() returns in a forked child, which must end within a minute."""
        reader, writer = os.pipe()
        child = os.fork()
        if child == 0:
            try:
                with open(writer, "wb") as file:
                    pickle.dump(work(), file)
            finally:
                os._exit(0)  # without an answer after an exception
        os.close(writer)
        try:
            with open(reader, "rb") as file:
                self.assertTrue(select.select([file], [], [], 60)[0], "the child hangs")
                return pickle.load(file)
        finally:
            os.kill(child, signal.SIGKILL)
            os.waitpid(child, 0)

    def test_a_forked_child_gets_the_results_of_its_parent(self):
        points = random_points(50_000)
        space = random_points(5_000, 3)
        heights = points[:, 0] + points[:, 1]
        mesh = tipp.delaunay_2d(points, point_data={"h": heights}, threads=2)
        for name, work in {
            "triangles": lambda: canonical(tipp.delaunay(points, threads=2)),
            "stages": lambda: canonical(tipp.delaunay(points, threads=2, schedule="stages")),
            "queues": lambda: canonical(tipp.delaunay(points, threads=2, schedule="producer-consumer")),
            "the usual threads": lambda: canonical(tipp.delaunay(points)),
            "alpha": lambda: tipp.delaunay_2d(points, alpha=0.01, threads=2).lines,
            "tetrahedra": lambda: tipp.Delaunay(space, threads=2).simplices,
            "found": lambda: tipp.Delaunay(space, threads=2).find_simplex(space),
            "raster": lambda: tipp.dem(np.column_stack([points, heights]), 0.01, threads=2).array,
            "image": lambda: tipp.as_array(tipp.resample(mesh, dimensions=(90, 80, 1), threads=2), "h"),
        }.items():
            with self.subTest(name):
                np.testing.assert_array_equal(work(), self.answer_of_child(work))

    def test_an_opened_mesh_answers_in_a_forked_child(self):
        points = random_points(50_000)
        with tipp.open(tipp.delaunay_2d(points, point_data={"h": points[:, 0]}), threads=2) as mesh:
            self.assertIsNotNone(tipp.delaunay(points, threads=2))

            def work():
                return mesh.interpolate(points[::2] * 1.2, "h")

            child = self.answer_of_child(work)
            np.testing.assert_array_equal(work(), child)

    def test_a_pool_of_forked_processes_triangulates(self):
        points = random_points(50_000)
        expected = len(tipp.delaunay(points, threads=2))
        with multiprocessing.get_context("fork").Pool(2) as pool:
            self.assertEqual([expected] * 4, pool.map_async(count, [points] * 4).get(timeout=120))

    def test_a_forked_child_may_fork_again(self):
        points = random_points(20_000)
        tipp.delaunay(points, threads=2)

        def work():
            tipp.delaunay(points, threads=2)
            return self.answer_of_child(lambda: len(tipp.delaunay(points, threads=2)))

        self.assertEqual(len(tipp.delaunay(points)), self.answer_of_child(work))

    def test_a_spawned_child_triangulates(self):
        points = random_points(1000)
        context = multiprocessing.get_context("spawn")
        queue = context.Queue()
        child = context.Process(target=count_in_child, args=(points, queue))
        child.start()
        self.assertEqual(len(tipp.delaunay(points)), queue.get(timeout=60))
        child.join(60)

    def test_many_small_calls_leave_memory_flat(self):
        points = random_points(20)

        def calls(count):
            for _ in range(count):
                tipp.delaunay(points, threads=1)

        calls(20_000)
        before = resident()
        calls(int(os.environ.get("TIPP_SMALL_CALLS", "100000")))
        self.assertLess(resident() - before, 4 << 20)

    def test_references_are_released(self):
        points = random_points(1000)
        triangles = tipp.delaunay(points)
        before = sys.getrefcount(points)
        for _ in range(100):
            triangles = tipp.delaunay(points, progress_bar=lambda done: True)
        self.assertEqual(before, sys.getrefcount(points))
        self.assertEqual(2, sys.getrefcount(triangles))

    def test_results_are_pickled(self):
        mesh = tipp.Delaunay(random_points(100))
        mesh.find_simplex([[0.5, 0.5]])
        again = pickle.loads(pickle.dumps(mesh))
        np.testing.assert_array_equal(mesh.simplices, again.simplices)
        np.testing.assert_array_equal(mesh.find_simplex([[0.5, 0.5]]), again.find_simplex([[0.5, 0.5]]))
        flat = tipp.Mesh(mesh.points, mesh.simplices)
        np.testing.assert_array_equal(flat.cells, pickle.loads(pickle.dumps(flat)).cells)

    def test_a_progress_function_is_called_and_can_stop_the_run(self):
        points = random_points(200_000)
        heard = []
        tipp.delaunay(points, progress_bar=heard.append)
        self.assertEqual((sorted(heard), 1.0), (heard, heard[-1]))
        with self.assertRaisesRegex(RuntimeError, "progress callback stopped the run"):
            tipp.delaunay(points, progress_bar=lambda done: False)
        with self.assertRaisesRegex(ZeroDivisionError, "division"):
            tipp.delaunay(points, progress_bar=lambda done: 1 / 0)

    def test_ctrl_c_is_a_keyboard_interrupt(self):
        code = ("import numpy, os, signal, tipp\n"
                "signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell may have it ignored\n"
                "p = numpy.random.default_rng(1).random((300_000, 2))\n"
                "def send(done):\n    os.kill(os.getpid(), signal.SIGINT)\n"
                "tipp.delaunay(p, progress_bar=send)\n")
        run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
        self.assertEqual("KeyboardInterrupt", run.stderr.splitlines()[-1])
        self.assertEqual(-signal.SIGINT, run.returncode)

    def test_importing_the_package_does_not_import_numpy(self):
        subprocess.run([sys.executable, "-c", "import sys, tipp; assert 'numpy' not in sys.modules; tipp.Mesh; import numpy"],
                       check=True)

    def test_type_checkers_see_the_names_that_there_are(self):
        with open(tipp.__file__, encoding="utf-8") as file:
            tree = ast.parse(file.read())
        (block,) = [node for node in tree.body if isinstance(node, ast.If)]
        stated = {alias.asname: node.module for node in block.body for alias in node.names if node.module != "_filters"}
        self.assertEqual(stated, tipp._MODULES)
        for name in stated:
            self.assertIn(name, dir(tipp))
            self.assertTrue(hasattr(tipp, name))

    def test_help_is_an_overview_and_types_are_there(self):
        text = pydoc.render_doc(tipp, renderer=pydoc.plaintext)
        self.assertLess(text.count("\n"), 300)
        for name in ("delaunay_2d", "delaunay_file", "resample", "read", "write"):
            self.assertIn(f"{name}(", text)
        package = os.path.dirname(tipp.__file__)
        self.assertTrue(os.path.exists(os.path.join(package, "py.typed")))


if __name__ == "__main__":
    unittest.main()
