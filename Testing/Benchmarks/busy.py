# SPDX-License-Identifier: BSD-3-Clause
"""Compares several threads with one thread on a quiet and on a busy machine, and this build with an older one.

busy.py BUILD [--old BUILD] [--loops 0,1,2] [--threads T] [--rounds R] [--rows "NAME;NAME"] [--large]

Each row is measured while as many other processes as --loops says run endless loops. It runs in a process of its own
for each build, which calls the Python function on one and on T threads alternately; the table has the medians. --large adds 50 million points. BUILD is a build folder with the Python package.
"""
import argparse
import contextlib
import os
import pathlib
import statistics
import subprocess
import sys
import time

WORDS = {0: "quiet", 1: "1 busy loop", 2: "2 busy loops"}


def uniform(count, dimensions=2):
    import numpy as np
    return np.random.default_rng(7).random((count, dimensions))


def triangulation(count):
    import tipp
    points = uniform(count)
    return lambda threads: tipp.delaunay(points, threads=threads)


def tetrahedra(count):
    import tipp
    points = uniform(count, 3)
    return lambda threads: tipp.delaunay_3d(points, threads=threads, return_type="tipp")


def constraints(count):
    import numpy as np
    import tipp
    corners = count // 50
    angle = np.linspace(0, 2 * np.pi, corners, endpoint=False)
    radius = 0.4 + 0.05 * np.sin(60 * angle)
    line = 0.5 + radius[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
    points = np.vstack([line, uniform(count)])
    edges = np.column_stack([np.arange(corners), np.roll(np.arange(corners), -1)])
    return lambda threads: tipp.delaunay_2d(points, edges=edges, threads=threads, return_type="tipp")


def resampling(count):
    import numpy as np
    import tipp
    points = uniform(count)
    mesh = tipp.delaunay_2d(points, point_data={"height": np.sin(9 * points[:, 0])}, return_type="vtk")
    return lambda threads: tipp.resample(mesh, dimensions=(2048, 2048, 1), threads=threads)


def terrain(count):
    import numpy as np
    import tipp
    points = np.column_stack([1000 * uniform(count), np.sin(np.arange(count))])
    return lambda threads: tipp.dem(points, 1.0, threads=threads)


def query(count):
    import numpy as np
    import tipp
    points = uniform(count)
    mesh = tipp.delaunay_2d(points, point_data={"height": np.sin(9 * points[:, 0])})
    queries = np.random.default_rng(8).random((count, 2))
    opened = {}

    def call(threads):
        if threads not in opened:
            opened[threads] = tipp.open(mesh, threads=threads)
        return opened[threads].interpolate(queries)
    return call


ROWS = {
    "delaunay 1,000": (triangulation, 1_000, 400),
    "delaunay 10,000": (triangulation, 10_000, 200),
    "delaunay 100,000": (triangulation, 100_000, 60),
    "delaunay 200,000": (triangulation, 200_000, 40),
    "delaunay 1,000,000": (triangulation, 1_000_000, 12),
    "delaunay 10,000,000": (triangulation, 10_000_000, 3),
    "delaunay3d 10,000": (tetrahedra, 10_000, 30),
    "delaunay3d 100,000": (tetrahedra, 100_000, 9),
    "delaunay3d 500,000": (tetrahedra, 500_000, 3),
    "constraints 1,000,000": (constraints, 1_000_000, 9),
    "resample 1,000,000": (resampling, 1_000_000, 12),
    "dem 1,000,000": (terrain, 1_000_000, 12),
    "query 1,000,000": (query, 1_000_000, 6),
}
LARGE = {"delaunay 50,000,000": (triangulation, 50_000_000, 1)}


def measure(name, threads, rounds):
    """Prints the median seconds of one and of `threads` threads, and the peak memory in MB."""
    make, count, repeat = (ROWS | LARGE)[name]
    call = make(count)
    times = {1: [], threads: []}
    for number in (1, threads):
        call(number)
    for turn in range(rounds * repeat):
        for number in (1, threads) if turn % 2 == 0 else (threads, 1):
            begin = time.perf_counter()
            result = call(number)
            times[number].append(time.perf_counter() - begin)
            del result
    import resource
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1000
    print(*(statistics.median(times[number]) for number in (1, threads)), peak)


@contextlib.contextmanager
def busy_loops(count):
    loops = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(count)]
    try:
        time.sleep(0.5 if loops else 0)
        yield
    finally:
        for loop in loops:
            loop.kill()
            loop.wait()


def run_row(build, name, threads, rounds):
    environment = {**os.environ, "PYTHONPATH": str(build / "lib" / "python3" / "dist-packages")}
    line = [sys.executable, __file__, str(build), "--measure", name, "--threads", str(threads), "--rounds", str(rounds)]
    done = subprocess.run(line, env=environment, check=True, capture_output=True, text=True)
    return [float(word) for word in done.stdout.split()]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--old", type=pathlib.Path)
    parser.add_argument("--loops", default="0,1,2")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--rounds", type=int, default=1)
    parser.add_argument("--rows")
    parser.add_argument("--large", action="store_true")
    parser.add_argument("--measure", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.measure:
        measure(arguments.measure, arguments.threads, arguments.rounds)
        return
    builds = {"this": arguments.build.resolve()}
    if arguments.old:
        builds = {"old": arguments.old.resolve(), **builds}
    names = arguments.rows.split(";") if arguments.rows else [*ROWS, *(LARGE if arguments.large else ())]
    print(f"{'row':24} {'machine':13} {'build':5} {'1 thread':>10} {f'{arguments.threads} threads':>10}"
          f" {'ratio':>6} {'peak MB':>8}")
    for name in names:
        for loops in map(int, arguments.loops.split(",")):
            with busy_loops(loops):
                for which, build in builds.items():
                    one, several, peak = run_row(build, name, arguments.threads, arguments.rounds)
                    print(f"{name:24} {WORDS.get(loops, f'{loops} busy loops'):13} {which:5} {one:10.5f} {several:10.5f}"
                          f" {several / one:6.2f} {peak:8.0f}", flush=True)


if __name__ == "__main__":
    main()
